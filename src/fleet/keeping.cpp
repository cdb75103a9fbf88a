#include "fleet/keeping.hpp"

#include <fmt/format.h>

#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

using Standing = keeper::Keeper::State;

constexpr uint64_t kEcho = UINT64_MAX;  // unlike that of a record

// What the broker gives back of ours before the machine knows of the connection.
std::string echo_of(const std::string& instance) {
    return instance + ".echo";
}

}  // namespace

Post Keeping::post(const Topic& topic, const Message& message) const {
    const KindInfo& info = info_of(topic.kind);
    return {.topic = text_of(options_.fleet, topic),
            .payload = payload_of(message, options_.fleet),
            .qos = info.qos,
            .retained = info.retained};
}

void Keeping::hear(const LinkEvent& event, Time now) {
    now_ = now;
    std::visit([this](const auto& one) { on(one); }, event);
    tell_state();
}

void Keeping::tick(Time now) {
    now_ = now;
    if (connected_ && !knows_all_ && now_ >= echo_at_) send_echo();
    perform(keeper_.tick(now));
    tell_state();
}

// Its own records do not come back to it; those of another keeper do.
void Keeping::on(const Connected&) {
    connected_ = true;
    knows_all_ = false;
    early_.clear();
    const auto filter = [this](Kind kind, bool own) {
        return Filter{filter_of(options_.fleet, kind), own};
    };
    actions_.emplace_back(Subscribe{{filter(Kind::Task, false), filter(Kind::Shared, false),
                                     filter(Kind::Question, false), filter(Kind::Beat, true)}});
    first_echo_ = echoes_ + 1;
    send_echo();
}

// Sent again until one returns: a broker drops what does not fit into its queue for a client. Not
// retained: it says nothing to anybody else.
void Keeping::send_echo() {
    echo_at_ = now_ + kAskAgainEvery;
    Post echo =
        post({.kind = Kind::Beat}, keeper::Beat{0, echo_of(options_.keeper.instance), ++echoes_});
    echo.retained = false;
    echo.number = kEcho;
    actions_.emplace_back(std::move(echo));
}

void Keeping::on(const Lost& lost) {
    connected_ = knows_all_ = false;
    waiting_.clear();  // the machine publishes all again
    in_flight_.clear();
    perform(keeper_.take(keeper::Lost{}, now_));
    if (std::exchange(lost_told_, lost.why) != lost.why) say("warning", "keeper: " + lost.why);
}

void Keeping::on(const Received& received) {
    const Message& message = received.heard.message;
    if (const auto* record = std::get_if<keeper::Record>(&message)) {
        return tell(keeper::Retained{*record});
    }
    if (const auto* asked = std::get_if<Question>(&message)) {
        // It is asked again; a question that was retained is old, whoever asked it.
        if (received.retained || !knows_all_) return;
        return tell(keeper::Asked{
            {received.heard.topic.robot, static_cast<uint64_t>(asked->epoch), asked->number},
            asked->request});
    }
    const auto* beat = std::get_if<keeper::Beat>(&message);
    if (beat == nullptr) return;
    if (received.retained) return tell(keeper::LastBeat{beat->epoch});
    if (!beat->instance.ends_with(".echo")) return tell(*beat);
    const bool ours = beat->instance == echo_of(options_.keeper.instance);
    if (!ours || beat->number < first_echo_ || knows_all_) return;
    knows_all_ = true;
    perform(keeper_.take(keeper::Connected{}, now_));
    for (const keeper::Input& input : std::exchange(early_, {})) tell(input);
}

void Keeping::on(const Acknowledged& acknowledged) {
    in_flight_.erase(acknowledged.number);
    if (acknowledged.refused.empty()) {
        tell(keeper::Acknowledged{acknowledged.number});
    } else if (!std::exchange(refusal_told_, true)) {
        say("warning", "keeper: the broker refuses what it publishes: " + acknowledged.refused +
                           "; its access list must let this user write keeper/, shared/ and task/ "
                           "(docs/fleet.md, \"Rights\")");
    }
    send_records();
}

void Keeping::on(const Malformed& malformed) {
    if (!std::exchange(malformed_told_, true)) {
        say("warning", "keeper: what it cannot read is passed over: " + malformed.why);
    }
}

void Keeping::tell(const keeper::Input& input) {
    if (!knows_all_) return early_.push_back(input);
    perform(keeper_.take(input, now_));
}

void Keeping::perform(const keeper::Actions& actions) {
    for (const keeper::Action& action : actions) {
        std::visit([this](const auto& one) { perform(one); }, action);
    }
    send_records();
}

// It passes the records that wait: it says that this keeper lives, and nothing of them.
void Keeping::perform(const keeper::Beat& beat) {
    actions_.emplace_back(post({.kind = Kind::Beat}, beat));
}

void Keeping::perform(const keeper::Publish& publish) {
    Post record = post(topic_of(publish.record), publish.record);
    record.number = publish.publication;
    if (publish.gone) record.payload.clear();
    waiting_.push_back(std::move(record));
}

void Keeping::perform(const keeper::Answer& answer) {
    actions_.emplace_back(
        post({.kind = Kind::Reply, .robot = answer.asker.robot},
             Reply{static_cast<int64_t>(answer.asker.epoch), answer.asker.number, answer.reply}));
}

void Keeping::perform(const keeper::Leave& leave) {
    why_out_ = leave.why;
    waiting_.clear();
}

void Keeping::send_records() {
    while (!waiting_.empty() && in_flight_.size() < kRecordsInFlight) {
        in_flight_.insert(waiting_.front().number);
        actions_.emplace_back(std::move(waiting_.front()));
        waiting_.pop_front();
    }
}

void Keeping::tell_state() {
    const Standing state = keeper_.state();
    if (std::exchange(told_state_, state) == state) return;
    if (state == Standing::Serving) lost_told_.clear();
    const std::string whose = fmt::format("keeper of the fleet \"{}\"", options_.fleet);
    switch (state) {
        case Standing::Listening:
            return say("note", whose + ": listens whether there is another one");
        case Standing::Resting:
            return say("note", whose + ": waits until leases of an earlier keeper have ended");
        case Standing::Serving:
            return say("note", fmt::format("{}: serves, epoch {}", whose, keeper_.epoch()));
        case Standing::Out:
            return say("warning", whose + ": stays out: " + why_out_);
        case Standing::Away:
            return;  // Lost was told
    }
}

}  // namespace vagus::fleet
