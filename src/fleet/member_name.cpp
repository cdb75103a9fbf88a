// Who has the name of a robot. Two programs that want one name must not both drive what people
// think is one robot. A broker gives no locks; what it gives is one order of the messages of a
// topic, the same for everyone. So:
//
// - Who comes subscribes to the name's topics, then publishes a question there. When its own
//   question comes back, everything that was retained has come before it.
// - If nobody was said to be online, the name is free. If somebody was, it has kNameAnswerWithin to
//   answer the question.
// - Of two that claim at once, the one whose `online` the broker had last has the name: the other
//   sees that one behind its own.
// - Who stays out asks from time to time, so that whoever has the name can say that it is wanted.
#include <fmt/format.h>

#include <algorithm>

#include "fleet/member.hpp"

namespace vagus::fleet {
namespace {

constexpr const char* kName = "name";  // the question, and where it is answered
constexpr const char* kOnline = "online";
constexpr const char* kOwnName =
    "Give each robot a name of its own (--robot, or \"name\" in its world)";

}  // namespace

Post Member::connection(const std::string& state) const {
    return post_of(Kind::Connection, "", Connection{state, options_.instance, options_.epoch});
}

std::vector<Filter> Member::filters_of_name() const {
    const auto of = [this](Kind kind, const std::string& name) {
        return Filter{
            text_of(options_.fleet, {.kind = kind, .robot = options_.robot, .name = name})};
    };
    std::vector<Filter> filters = {of(Kind::Connection, ""), of(Kind::Answer, kName)};
    // Stop is heard whoever has the name.
    filters.push_back({text_of(options_.fleet, {.kind = Kind::Command, .name = "stop"})});
    for (const std::string& group : options_.project.groups) {
        filters.push_back(
            {text_of(options_.fleet, {.kind = Kind::Command, .group = group, .name = "stop"})});
    }
    filters.push_back(of(Kind::Ask, kName));  // the last one: its echo comes behind all others
    return filters;
}

std::vector<Filter> Member::filters_of_work() const {
    std::vector<Filter> filters = {
        {filter_of_commands(options_.fleet, options_.robot)},
        {text_of(options_.fleet, {.kind = Kind::Want, .robot = options_.robot})}};
    for (const Hears& one : options_.project.hear) {
        filters.push_back({filter_of_event(options_.fleet, one.event), false});
    }
    return filters;
}

void Member::on(const Connected&) {
    act(Subscribe{filters_of_name()});
    holder_.reset();
    ask_for_name();
}

void Member::on(const Lost& lost) {
    if (standing_ == Standing::Holding) apart_since_ = now_;
    standing_ = Standing::Apart;
    outbox_.link_lost();
    if (lost.why != lost_told_) say("warning", "fleet: " + lost.why);
    lost_told_ = lost.why;
}

void Member::ask_for_name() {
    standing_ = Standing::Asking;
    asked_ = false;
    name_until_ = now_ + kNameAnswerWithin;
    act(post_of(Kind::Ask, kName, Ask{options_.instance}));
}

void Member::hear_question(const Ask& ask) {
    if (ask.instance != options_.instance) {
        if (standing_ != Standing::Holding) return;
        if (asked_by_.size() >= kNameAskersMax) asked_by_.pop_front();
        return asked_by_.push_back(ask.instance);
    }
    if (standing_ != Standing::Asking) return;
    asked_ = true;
    if (!holder_) claim();
}

void Member::hear_answer(const Answer& answer) {
    const bool is_for_us = answer.id == options_.instance;
    if (standing_ != Standing::Asking || !is_for_us || answer.instance == options_.instance) return;
    holder_ = Connection{kOnline, answer.instance, 0};
    stay_out("another robot has this name, and answers");
}

// As soon as the name is certain: of a hundred that claim it at once each would answer all others,
// and all others would hear it.
void Member::answer_who_wants_it() {
    if (standing_ != Standing::Holding || onlines_out_ > 0 || asked_by_.empty()) return;
    tell_who_wants_it();
    for (const std::string& instance : std::exchange(asked_by_, {})) {
        act(post_of(Kind::Answer, kName,
                    Answer{.id = instance, .done = true, .instance = options_.instance}));
    }
}

// Both sides are told: who wants it stays out and says so, and a robot that works must not be taken
// for the other one.
void Member::tell_who_wants_it() {
    if (!wanted_until_) {
        state_news_ = true;
        say("warning", fmt::format("fleet: another program wants the name \"{}\", too, and was "
                                   "told to stay out. {}",
                                   options_.robot, kOwnName));
    }
    wanted_until_ = now_ + kNameWantedFor;
}

// What is wrong with the robot stays in front.
std::vector<std::string> Member::problems() const {
    std::vector<std::string> problems = shown_.problems;
    if (!wanted_until_) return problems;
    problems.resize(std::min(problems.size(), kProblemsMax - 1));
    problems.emplace_back("two programs want this name; the other one stays out");
    return problems;
}

void Member::say_online() {
    ++onlines_out_;
    act(connection(kOnline));
}

void Member::claim() {
    standing_ = Standing::Holding;
    onlines_out_ = 0;
    asked_by_.clear();
    wanted_until_.reset();
    settled_at_.reset();
    alone_told_ = false;
    lost_told_.clear();
    say_online();
    act(Subscribe{filters_of_work()});
    publish_description();
    publish_version();
    for (auto& [place, telling] : telling_) telling.news = true;
    state_at_ = now_ - kStateEveryMax;
    say("note", fmt::format("fleet: this robot is \"{}\" of the fleet \"{}\"", options_.robot,
                            options_.fleet));
    hear_early_events();
    tick(now_);
}

void Member::stay_out(const std::string& why) {
    early_.clear();
    if (standing_ == Standing::Holding) apart_since_ = now_;
    standing_ = Standing::Out;
    ask_again_at_ = now_ + kNameAskAgain;
    say("error", fmt::format("fleet: \"{}\" of the fleet \"{}\": {}; this one stays out of the "
                             "fleet until the name is free. {}",
                             options_.robot, options_.fleet, why, kOwnName));
}

void Member::hear_connection(const Connection& said) {
    if (said.instance != options_.instance) return hear_connection_of_other(said);
    if (standing_ != Standing::Holding) return;
    // A will of ours that came late: an earlier connection of ours was missed.
    if (said.state != kOnline) return say_online();
    onlines_out_ = std::max(onlines_out_ - 1, 0);
}

void Member::hear_connection_of_other(const Connection& said) {
    if (standing_ == Standing::Holding) return hear_rival(said);
    const bool online = said.state == kOnline;
    // One more that stayed out has gone; whoever has the name says so again.
    const bool is_holder = !holder_ || holder_->instance == said.instance;
    if (!online && standing_ == Standing::Out && !is_holder) return;
    holder_.reset();
    if (online) holder_ = said;
    if (!online && standing_ == Standing::Out) return ask_for_name();
    if (!online && standing_ == Standing::Asking && asked_) claim();
}

// What it claimed counts if no `online` of ours is on its way, which the broker has behind it.
void Member::hear_rival(const Connection& said) {
    // Its last words stand where ours did.
    if (said.state != kOnline) return say_online();
    if (onlines_out_ == 0) {
        holder_ = said;
        return stay_out("another robot has claimed this name behind this one");
    }
    settled_at_ = now_ + kNameSettles;
}

// Until it heard that the name is ours, another one told of itself below it.
void Member::settle() {
    settled_at_.reset();
    publish_description();
    publish_version();
    for (auto& [place, telling] : telling_) telling.news = true;
    state_news_ = true;
}

void Member::tick_name() {
    answer_who_wants_it();
    if (standing_ == Standing::Holding && wanted_until_ && now_ >= *wanted_until_) {
        wanted_until_.reset();
        state_news_ = true;
    }
    if (standing_ == Standing::Holding && settled_at_ && now_ >= *settled_at_) settle();
    if (standing_ == Standing::Out && now_ >= ask_again_at_) {
        ask_again_at_ = now_ + kNameAskAgain;
        act(post_of(Kind::Ask, kName, Ask{options_.instance}));
    }
    if (standing_ != Standing::Asking || now_ < name_until_) return;
    if (asked_) return claim();  // who was there does not answer
    say("warning", fmt::format("fleet: the broker does not pass on what this robot says "
                               "(robot/{}/…); look at its access list",
                               escape(options_.robot)));
    ask_for_name();
}

void Member::tick_alone() {
    if (standing_ == Standing::Holding || alone_told_) return;
    if (now_ < apart_since_ + kBrokerLostAfter) return;
    alone_told_ = true;
    const std::string why =
        fmt::format("not in the fleet \"{}\" for {} s", options_.fleet, kBrokerLostAfter / 1s);
    if (options_.project.broker_lost == BrokerLost::Stop) return act(StopAlone{why});
    say("warning", fmt::format("fleet: {}; this robot goes on, as its project says", why));
}

void Member::leave() {
    if (standing_ == Standing::Holding) act(connection("offline"));
    standing_ = Standing::Apart;
    alone_told_ = true;
}

}  // namespace vagus::fleet
