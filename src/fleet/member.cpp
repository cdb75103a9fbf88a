#include "fleet/member.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace vagus::fleet {
namespace {

constexpr std::string_view kStop = "stop";

}  // namespace

Description description_of(const ProjectPart& part, std::string_view project,
                           std::string_view plan) {
    Description said{.project = std::string(utf8_prefix(project, kLineBytesMax)),
                     .plan = std::string(utf8_prefix(plan, kLineBytesMax)),
                     .groups = part.groups,
                     .send = part.send};
    for (const Hears& one : part.hear) {
        if (!contains(said.hear, one.event)) said.hear.push_back(one.event);
    }
    return said;
}

Member::Member(MemberOptions options, Time now)
    : options_(std::move(options)), now_(now), apart_since_(now) {
    since_ = clock();
}

Post Member::post_of(Kind kind, const std::string& name, const Message& message) const {
    const KindInfo& info = info_of(kind);
    return {.topic = text_of(options_.fleet, {.kind = kind, .robot = options_.robot, .name = name}),
            .payload = payload_of(message),
            .qos = info.qos,
            .retained = info.retained};
}

void Member::hear(const LinkEvent& event, Time now) {
    now_ = now;
    std::visit([this](const auto& one) { on(one); }, event);
}

void Member::on(const Received& received) {
    const Topic& topic = received.heard.topic;
    const Message& message = received.heard.message;
    if (const auto* event = std::get_if<Event>(&message)) return hear_event(topic, *event);
    if (const auto* command = std::get_if<Command>(&message)) return hear_command(topic, *command);
    if (topic.robot != options_.robot) return;
    if (const auto* said = std::get_if<Connection>(&message)) return hear_connection(*said);
    if (const auto* want = std::get_if<Want>(&message)) {
        if (standing_ == Standing::Holding) act(Fetch{*want});
        return;
    }
    if (const auto* ask = std::get_if<Ask>(&message)) return hear_question(*ask);
    if (const auto* answer = std::get_if<Answer>(&message)) return hear_answer(*answer);
}

void Member::on(const Acknowledged& acknowledged) {
    outbox_.acknowledged(acknowledged.number);
    if (acknowledged.refused.empty()) return;
    if (left_out_++ > 0) return;
    say("warning", "fleet: the broker refuses events of this robot: " + acknowledged.refused);
}

// ---- events ----

int64_t Member::emitted(const std::string& event, const std::vector<int16_t>& args, Time now) {
    now_ = now;
    if (!contains(options_.project.send, event)) return 0;
    if (args.size() > kWordsMax || !sent_rates_.allows(event, now)) {
        ++left_out_;
        return 0;
    }
    const int64_t number = ++numbers_;
    Post post =
        post_of(Kind::Event, event, Event{number, options_.epoch, options_.project.groups, args});
    post.expires_s = kEventAgeSeconds;
    outbox_.add(std::move(post), now);
    send_events();
    return number;
}

void Member::send_events() {
    if (standing_ != Standing::Holding) return;
    for (Post& post : outbox_.take_due(now_)) act(std::move(post));
}

bool Member::hears(const std::string& event, const std::vector<std::string>& groups) const {
    const auto& list = options_.project.hear;
    return std::any_of(list.begin(), list.end(), [&](const Hears& one) {
        return one.event == event && (one.from.empty() || contains(groups, one.from));
    });
}

void Member::hear_event(const Topic& topic, const Event& event) {
    const bool ours = topic.robot == options_.robot;
    if (ours || standing_ == Standing::Out || !hears(topic.name, event.groups)) return;
    if (standing_ != Standing::Holding) {
        if (early_.size() >= kEarlyMax) {
            early_.pop_front();
            ++left_out_;
        }
        return early_.push_back({topic, event, now_});
    }
    if (!heard_.is_new(topic.robot, event.epoch, event.number)) return;
    if (!heard_rates_.allows(topic.robot + "/" + topic.name, now_)) {
        ++left_out_;
        return;
    }
    act(EmitOnBus{topic.name, event.args, topic.robot, event.number});
}

void Member::hear_early_events() {
    for (const Early& early : std::exchange(early_, {})) {
        if (now_ - early.at <= kEventAgeMax) hear_event(early.topic, early.event);
    }
}

// ---- commands ----

bool Member::is_for_us(const Topic& topic) const {
    if (!topic.robot.empty()) return topic.robot == options_.robot;
    // Only stop goes to many at once.
    if (topic.name != kStop) return false;
    return topic.group.empty() || contains(options_.project.groups, topic.group);
}

// Late commands are not executed (docs/decisions/0117). Clocks of other computers say nothing here.
std::string Member::why_not(const Command& command) const {
    if (command.verb == kStop) return "";
    if (!command.epoch || !command.deadline) {
        return "it has no deadline; take one from the clock in this robot's state";
    }
    if (*command.epoch != options_.epoch) {
        return "the program of this robot has started again since; its clock is another one";
    }
    const int64_t late = clock() - *command.deadline;
    if (late > 0) return fmt::format("it came {} ms too late, and was not done", late);
    if (-late > kDeadlineAheadMax / 1ms) {
        return fmt::format("its deadline is {} ms ahead; {} are the most", -late,
                           kDeadlineAheadMax / 1ms);
    }
    return "";
}

Member::Told::iterator Member::remember(const std::string& id) {
    told_order_.push_back(id);
    if (told_order_.size() > kCommandsRemembered) {
        told_.erase(told_order_.front());
        told_order_.pop_front();
    }
    return told_.emplace(id, std::nullopt).first;
}

void Member::hear_command(const Topic& topic, const Command& command) {
    // Stop is for everybody, whoever has the name.
    const bool stops = command.verb == kStop;
    if (!is_for_us(topic) || (!stops && standing_ != Standing::Holding)) return;
    const auto before = told_.find(command.id);
    if (before != told_.end()) {
        if (before->second) publish_answer(command, *before->second);
        return;
    }
    const auto place = remember(command.id);
    const std::string why = why_not(command);
    if (why.empty()) return act(Obey{command});
    place->second = Answer{.id = command.id, .what = why};
    publish_answer(command, *place->second);
}

void Member::answer(const Command& command, Answer answer) {
    answer.id = command.id;
    const auto found = told_.find(command.id);
    if (found != told_.end()) found->second = answer;
    publish_answer(command, answer);
}

// An asker that hears nothing asks again: nothing is kept for it.
void Member::publish_answer(const Command& command, const Answer& answer) {
    if (standing_ == Standing::Holding) act(post_of(Kind::Answer, command.reply, answer));
}

// ---- what it shows ----

void Member::publish_description() {
    description_news_ = false;
    act(post_of(Kind::Description, "", options_.description));
}

void Member::publish_version() {
    if (version_) act(post_of(Kind::Version, "", *version_));
}

void Member::deployed(const Version& version) {
    version_ = version;
    if (standing_ == Standing::Holding) publish_version();
}

void Member::show(const Shown& shown, Time now) {
    now_ = now;
    if (shown == shown_) return;
    if (shown.state != shown_.state || shown.actor != shown_.actor) since_ = clock();
    if (shown.nodes != shown_.nodes) show_nodes(shown.nodes);
    shown_ = shown;
    state_news_ = true;
}

void Member::show_nodes(const std::vector<std::string>& nodes) {
    std::vector<std::string> names;
    for (const std::string& node : nodes) {
        const bool fits = names.size() < kNodesMax && is_name(node);
        if (fits && !contains(names, node)) names.push_back(node);
    }
    std::vector<std::string>& told = options_.description.nodes;
    description_news_ = description_news_ || names != told;
    told = std::move(names);
}

void Member::publish_state() {
    const Duration wait = state_news_ ? kStateEveryMin : kStateEveryMax;
    if (now_ < state_at_ + wait) return;
    // Nodes may come and go as often as a state may change.
    if (description_news_) publish_description();
    state_news_ = false;
    state_at_ = now_;
    act(post_of(Kind::State, "",
                State{.number = ++numbers_,
                      .epoch = options_.epoch,
                      .clock = clock(),
                      .state = shown_.state,
                      .since = since_,
                      .actor = shown_.actor,
                      .problems = problems(),
                      .left_out = static_cast<int64_t>(left_out())}));
}

void Member::changed(const std::string& node, const std::string& name,
                     std::vector<int16_t> values) {
    Telling& telling = telling_[{node, name}];
    telling.news = telling.news || values != telling.values;
    telling.values = std::move(values);
}

void Member::tell_again(const std::string& node, const std::string& name) {
    const auto found = telling_.find({node, name});
    if (found != telling_.end()) found->second.news = true;
}

void Member::publish_variables() {
    for (auto& [place, telling] : telling_) {
        if (!telling.news || now_ < telling.due) continue;
        telling.news = false;
        telling.due = now_ + kVariableEveryMin;
        Post post = post_of(Kind::Variable, place.second,
                            Variable{clock(), options_.epoch, telling.values});
        post.topic = text_of(options_.fleet, {.kind = Kind::Variable,
                                              .robot = options_.robot,
                                              .name = place.second,
                                              .node = place.first});
        act(std::move(post));
    }
}

// ---- time ----

void Member::tick(Time now) {
    now_ = now;
    tick_name();
    tick_alone();
    if (standing_ != Standing::Holding) return;
    send_events();
    publish_state();
    publish_variables();
}

Time Member::next_tick() const {
    Time next = Time::max();
    if (!alone_told_ && standing_ != Standing::Holding) next = apart_since_ + kBrokerLostAfter;
    if (standing_ == Standing::Asking) next = std::min(next, name_until_);
    if (standing_ == Standing::Out) next = std::min(next, ask_again_at_);
    if (standing_ != Standing::Holding) return next;
    next = state_at_ + (state_news_ ? kStateEveryMin : kStateEveryMax);
    if (!asked_by_.empty() && onlines_out_ == 0) return now_;
    next = std::min({next, wanted_until_.value_or(next), settled_at_.value_or(next)});
    for (const auto& [place, telling] : telling_) {
        if (telling.news) next = std::min(next, telling.due);
    }
    return next;
}

}  // namespace vagus::fleet
