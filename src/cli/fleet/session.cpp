#include "cli/fleet/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/output.hpp"
#include "net/end_signal.hpp"
#include "net/wall_clock.hpp"

namespace vagus::cli {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLookForEndEvery = 50ms;

}  // namespace

int complain_of(const Error& error) {
    const bool usage = error.code == Code::BadInput || error.code == Code::NotFound;
    return complain(error, usage ? kExitUsage : kExitFailed);
}

fleet::Chosen chosen_by(const FleetCall& call) {
    fleet::Chosen to{.all = call.robot.empty() && call.group.empty(), .group = call.group};
    if (!call.robot.empty()) to.robots = fleet::names_in(call.robot);
    return to;
}

Result<std::unique_ptr<FleetSession>> FleetSession::open(const FleetCall& call,
                                                         fleet::Operator::Options options) {
    options.name = serve::operator_name();
    serve::LinkOptions link = TRY(serve::link_of_fleet(call.broker, options.name));
    options.fleet = link.target.fleet;
    net::watch_for_end();
    std::unique_ptr<FleetSession> session(new FleetSession());
    session->fleet_ = options.fleet;
    session->target_ = to_string(link.target);
    session->desk_ = std::make_unique<fleet::Operator>(std::move(options));
    const auto wake = [raw = session.get()] { raw->bell_.ring(); };
    session->link_ = std::make_unique<serve::MosquittoLink>(std::move(link), wake);
    return session;
}

Duration FleetSession::now() const {
    return net::wall_now();
}

// What is shown of robots is not true any more while the broker is gone. Each reason is said once;
// before the first connection know_all() says it.
void FleetSession::note(const fleet::LinkEvent& event) {
    if (const auto* lost = std::get_if<fleet::Lost>(&event)) {
        const bool is_news = std::exchange(lost_, lost->why) != lost->why;
        if (was_connected_ && is_news) complain(lost->why + "; trying again");
    } else if (std::get_if<fleet::Connected>(&event)) {
        if (was_connected_ && !lost_.empty()) complain("connected again");
        lost_.clear();
        was_connected_ = true;
    }
}

void FleetSession::turn() {
    for (const fleet::LinkEvent& event : link_->take()) {
        note(event);
        desk_->hear(event, now());
        event_(event);
    }
    desk_->tick(now());
    for (const fleet::OperatorAction& action : desk_->take()) {
        if (const auto* filters = std::get_if<fleet::Subscribe>(&action)) {
            link_->subscribe(filters->filters);
        } else {
            link_->publish(std::get<fleet::Post>(action));
        }
    }
}

bool FleetSession::wait_until(const std::function<bool()>& holds, Duration within) {
    const Duration until = now() + within;
    for (;;) {
        turn();
        if (holds()) return true;
        if (now() >= until || net::end_asked()) return false;
        const Duration next = std::min({until, desk_->next_tick(), now() + kLookForEndEvery});
        bell_.wait(std::max(next - now(), Duration{}));
    }
}

Status FleetSession::know_all(Duration within) {
    if (wait_until([this] { return desk_->knows_all(); }, within)) return Status::done();
    return Error{Code::Unavailable, why_unknown(within)};
}

// A program that was stopped (SIGSTOP), or is no broker, takes a connection and says nothing.
std::string FleetSession::why_unknown(Duration waited) const {
    if (!lost_.empty()) return lost_;
    if (net::end_asked()) return fmt::format("ended before {} answered", target_);
    if (!was_connected_) {
        return fmt::format(
            "no connection to {}: it did not answer within {} s; is the broker "
            "stopped, or something else at that port?",
            target_, seconds_of(waited));
    }
    if (!desk_->refused().empty()) {
        return fmt::format(
            "the broker does not pass on what this user says: {}; name another "
            "--login",
            desk_->refused());
    }
    if (!desk_->is_answered()) {
        return fmt::format(
            "the broker of {} took the connection, and has said nothing more "
            "within {} s; is it stopped, or the link too slow? --wait gives it more "
            "time",
            target_, seconds_of(waited));
    }
    return "the broker does not pass on what this user says; look at its access list, or name "
           "another --login";
}

}  // namespace vagus::cli
