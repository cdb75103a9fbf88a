#include "serve/fleet/fleet_desk.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fleet/limits.hpp"
#include "serve/web/origin.hpp"

namespace vagus::serve {

namespace {

constexpr const char* kNoFleet = "no fleet is open; open one with its address first";

fleet::Command command_of(const Json& in) {
    fleet::Command command{.verb = in["verb"]};
    command.node = in.value("node", "");
    command.name = in.value("name", "");
    command.supervisor = in.value("supervisor", "");
    command.event = in.value("event", "");
    command.values = in.value("values", std::vector<int16_t>());
    return command;
}

// What robots would find wrong with it, which they would not answer.
std::optional<std::string> fault_of_command(fleet::Command command) {
    command.id = command.reply = "check";
    const fleet::Topic topic{.kind = fleet::Kind::Command, .robot = "r", .name = command.verb};
    const auto heard =
        fleet::read("check", fleet::text_of("check", topic), fleet::payload_of(command));
    if (heard.ok()) return std::nullopt;
    return heard.error().what;
}

}  // namespace

FleetDesk::FleetDesk(Desk& desk, Connect connect, RolloutPlaces places)
    : desk_(desk), connect_(std::move(connect)), rollouts_(desk, std::move(places)) {
    desk.topics().document("fleet", [this](const Json&) {
        return view_ ? view_->document() : Json{{"state", "none"}, {"robots", Json::object()}};
    });
    desk.topics().stream("fleet_events", Protocol::get().limit("fleet_events_kept"));
    declare_commands();
    declare_rollout_commands();
}

void FleetDesk::declare_commands() {
    desk_.command("fleet.open", [this](const Call& call) {
        FleetOptions options{.target = call.in["target"]};
        options.ca = call.in.value("ca", "");
        options.login = call.in.value("login", "");
        options.certificate = call.in.value("certificate", "");
        options.key = call.in.value("key", "");
        call.answer(open(options, now_));
    });
    desk_.command("fleet.close", [this](const Call& call) {
        close();
        call.done();
    });
    desk_.command("fleet.order", [this](const Call& call) { order(call); });
    desk_.command("fleet.stop", [this](const Call& call) { stop(call); });
}

void FleetDesk::declare_rollout_commands() {
    desk_.command("fleet.deploy", [this](const Call& call) {
        if (!is_ready(call)) return;
        RolloutDesk::Order order = rollout_order(call);
        order.robots = robots_in_order(call.in);
        order.steps = call.in.value("steps", fleet::kStepsUnlessTold);
        order.without = call.in.value("without", std::vector<std::string>());
        rollouts_.begin(std::move(order), now_,
                        [call](const Status& begun) { call.answer(begun); });
    });
    desk_.command("fleet.rollback", [this](const Call& call) {
        if (is_ready(call)) call.answer(rollouts_.roll_back(rollout_order(call), now_));
    });
    desk_.command("fleet.rollout_stop",
                  [this](const Call& call) { call.answer(rollouts_.stop(name_of(call))); });
}

// Who wants something of robots that cannot be told is told that.
bool FleetDesk::is_ready(const Call& call) const {
    if (!view_) {
        call.fail("unavailable", kNoFleet);
    } else if (!view_->is_connected()) {
        const std::string why = view_->why();
        call.fail("unavailable", "it could not be sent: " +
                                     (why.empty() ? "the broker has not answered yet" : why));
    } else {
        return true;
    }
    return false;
}

std::string FleetDesk::name_of(const Call& call) const {
    const Clients::Member* const member = desk_.clients().find(call.member);
    return member ? member->name : "";
}

RolloutDesk::Order FleetDesk::rollout_order(const Call& call) const {
    const bool here = is_loopback(host_) || host_ == "localhost" || host_ == "[::1]";
    return {
        .fleet = view_->fleet(), .target = target_, .broker_is_here = here, .by = name_of(call)};
}

// Those that are there come first: they say at once whether it is a good version.
std::vector<std::string> FleetDesk::robots_in_order(const Json& in) const {
    fleet::Chosen to{.all = !in.contains("robots")};
    if (!to.all) to.robots = in["robots"].get<std::vector<std::string>>();
    return view_->desk().chosen_online_first(to);
}

Status FleetDesk::open(const FleetOptions& options, Time now) {
    const std::string name = operator_name();
    LinkOptions link = TRY(link_of_fleet(options, name));
    close();
    now_ = now;
    view_ = std::make_unique<FleetView>(FleetView::Options{.target = to_string(link.target),
                                                           .fleet = link.target.fleet,
                                                           .name = name,
                                                           .user = link.login.user});
    target_ = to_string(link.target);
    host_ = link.target.host;
    link_ = connect_(std::move(link));
    rollouts_.enter(target_);
    return Status::done();
}

void FleetDesk::close() {
    for (const Waiting& one : std::exchange(waiting_, {})) {
        one.call.fail("unavailable", "the fleet was closed meanwhile");
    }
    rollouts_.leave("the fleet was closed; robots that have the version keep it");
    link_.reset();
    view_.reset();
    desk_.topics().forget("fleet_events");
    desk_.topics().touch("fleet");
}

// ---- orders ----

void FleetDesk::order(const Call& call) {
    fleet::Command command = command_of(call.in);
    const auto fault = fault_of_command(command);
    if (fault) return call.fail("bad_input", *fault);
    begin(call, {.command = std::move(command), .to = {.robots = call.in["robots"]}});
}

void FleetDesk::stop(const Call& call) {
    fleet::Chosen to{.all = !call.in.contains("robots")};
    if (!to.all) to.robots = call.in["robots"].get<std::vector<std::string>>();
    begin(call, {.command = {.verb = "stop"}, .to = std::move(to)});
}

void FleetDesk::begin(const Call& call, fleet::Order order) {
    if (!view_) return call.fail("unavailable", kNoFleet);
    if (!order.to.all && order.to.robots.empty()) {
        return call.fail("bad_input", "no robot is chosen; name at least one");
    }
    // Stop is never refused for the sake of others: the oldest that waits makes room.
    if (waiting_.size() >= kFleetOrdersMax) {
        if (order.command.verb != "stop") {
            return call.fail("limit", fmt::format("{} orders are under way, which is the most; "
                                                  "wait until one of them is answered",
                                                  kFleetOrdersMax));
        }
        settle(waiting_.front());
        waiting_.pop_front();
    }
    const std::string verb = order.command.verb;
    const fleet::OrderNumber number = view_->desk().begin(std::move(order), now_);
    waiting_.push_back({call, number, verb, now_});
    view_->desk().tick(now_);
    perform_all();
}

bool FleetDesk::is_online(const std::string& robot) const {
    return view_->desk().is_online(robot);
}

bool FleetDesk::is_settled(const Waiting& waiting) const {
    if (view_->desk().is_over(waiting.number)) return true;
    if (now_ >= waiting.since + kFleetAnswerWithin) return true;
    const std::vector<fleet::Outcome> outcomes = view_->desk().outcomes(waiting.number);
    if (outcomes.empty() || now_ < waiting.since + kFleetAwayAfter) return false;
    return std::all_of(outcomes.begin(), outcomes.end(), [this](const fleet::Outcome& one) {
        return one.answered || !is_online(one.robot);
    });
}

Json FleetDesk::outcome_of(const fleet::Outcome& one) const {
    Json outcome = {{"robot", one.robot}, {"result", "done"}, {"what", ""}};
    if (one.answered && one.answer.done) return outcome;
    if (one.answered) {
        std::string what = one.answer.what;
        if (!one.answer.silent.empty()) {
            what += fmt::format("{}not known to have stopped: {}", what.empty() ? "" : "; ",
                                fmt::join(one.answer.silent, ", "));
        }
        outcome["result"] = "refused";
        outcome["what"] = what;
        return outcome;
    }
    outcome["result"] = is_online(one.robot) ? "silent" : "away";
    return outcome;
}

void FleetDesk::settle(const Waiting& waiting) {
    const std::string refused = view_->desk().refusal(waiting.number);
    Json outcomes = Json::array();
    for (const fleet::Outcome& one : view_->desk().outcomes(waiting.number)) {
        outcomes.push_back(outcome_of(one));
    }
    view_->desk().end(waiting.number);
    if (!refused.empty()) {
        return waiting.call.fail("not_allowed",
                                 "the broker does not pass it on (" + refused +
                                     "); open the fleet with the login of an operator");
    }
    if (!view_->is_connected()) {
        const std::string why = view_->why();
        return waiting.call.fail(
            "unavailable", fmt::format("it could not be sent: {}; a robot that has no broker stops "
                                       "after {} s unless its project says otherwise",
                                       why.empty() ? "the broker has not answered yet" : why,
                                       fleet::kBrokerLostAfter / 1s));
    }
    log_order(waiting, outcomes);
    waiting.call.done({{"outcomes", std::move(outcomes)}});
}

// Other pages see what was ordered, and who did not do it.
void FleetDesk::log_order(const Waiting& waiting, const Json& outcomes) {
    size_t done = 0;
    std::string missing;
    for (const Json& one : outcomes) {
        if (one["result"] == "done") {
            ++done;
        } else if (missing.size() < fleet::kLineBytesMax) {
            missing += (missing.empty() ? "" : ", ") + one["robot"].get<std::string>();
        }
    }
    std::string text = fmt::format("{} of {} robots", done, outcomes.size());
    if (!missing.empty()) text += "; not " + missing;
    desk_.topics().add("fleet_events", {{"wall", desk_.wall_ms()},
                                        {"kind", "order"},
                                        {"robot", name_of(waiting.call)},
                                        {"name", waiting.verb},
                                        {"args", Json::array()},
                                        {"text", text}});
}

// ---- time ----

void FleetDesk::tick(Time now) {
    now_ = now;
    rollouts_.tick(now);
    if (!view_) return;
    for (const fleet::LinkEvent& event : link_->take()) {
        view_->hear(event, now, desk_.wall_ms());
        rollouts_.hear(event, now);
        if (std::holds_alternative<fleet::Connected>(event)) {
            link_->subscribe({{fleet::filter_of(view_->fleet(), fleet::Kind::Version)}});
        }
    }
    rollouts_.tick(now);
    view_->desk().tick(now);
    perform_all();
    for (Json& event : view_->take_events()) desk_.topics().add("fleet_events", std::move(event));
    for (auto one = waiting_.begin(); one != waiting_.end();) {
        const bool settled = is_settled(*one);
        if (settled) settle(*one);
        one = settled ? waiting_.erase(one) : std::next(one);
    }
    to_show_ = view_->take_news() || to_show_;
    if (now >= next_ages_) {
        next_ages_ = now + kFleetAgesEvery;
        to_show_ = view_->age(now) || to_show_;
    }
    if (!to_show_ || now < next_shown_) return;
    to_show_ = false;
    next_shown_ = now + kFleetShownEvery;
    desk_.topics().touch("fleet");
}

void FleetDesk::perform_all() {
    for (const fleet::OperatorAction& action : view_->desk().take()) {
        if (const auto* filters = std::get_if<fleet::Subscribe>(&action)) {
            link_->subscribe(filters->filters);
        } else {
            link_->publish(std::get<fleet::Post>(action));
        }
    }
    for (const fleet::Post& post : rollouts_.take()) link_->publish(post);
}

Time FleetDesk::next_tick() const {
    if (!view_) return rollouts_.next_tick();
    Time next = std::min({next_ages_, view_->desk().next_tick(), rollouts_.next_tick()});
    if (to_show_) next = std::min(next, next_shown_);
    return next;
}

}  // namespace vagus::serve
