#include "fleet/operator.hpp"

#include <algorithm>

#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

constexpr const char* kEcho = "echo";  // id of a message of our own that comes back

}  // namespace

void Operator::begin(Order order, Time now) {
    now_ = now;
    order_ = std::move(order);
    order_->command.reply = options_.name;
    std::string& id = order_->command.id;
    if (id.empty()) id = options_.name + "-" + std::to_string(++orders_);
    is_chosen_ = false;
    asked_.clear();
}

void Operator::hear(const LinkEvent& event, Time now) {
    now_ = now;
    std::visit([this](const auto& one) { on(one); }, event);
}

// What comes back behind our own stop, which is for nobody, has come behind all that was retained.
// Whoever may say stop may do that.
void Operator::on(const Connected&) {
    std::vector<Filter> filters;
    for (const Kind kind : {Kind::Connection, Kind::Description, Kind::State}) {
        filters.push_back({filter_of(options_.fleet, kind)});
    }
    if (options_.events) filters.push_back({filter_of(options_.fleet, Kind::Event)});
    if (options_.variables) filters.push_back({filter_of(options_.fleet, Kind::Variable)});
    filters.push_back({filter_of(options_.fleet, Kind::Answer)});
    filters.push_back({filter_of_commands(options_.fleet, options_.name)});
    actions_.push_back(Subscribe{std::move(filters)});
    publish({.kind = Kind::Command, .robot = options_.name, .name = "stop"},
            Command{.verb = "stop", .id = kEcho, .reply = options_.name});
}

void Operator::on(const Received& received) {
    const Topic& topic = received.heard.topic;
    const Message& message = received.heard.message;
    if (topic.kind == Kind::Command && topic.robot == options_.name) {
        knows_all_ = true;
        return choose();
    }
    if (const auto* answer = std::get_if<Answer>(&message)) {
        if (topic.name == options_.name) hear_answer(topic.robot, *answer);
        return;
    }
    hear_robot(topic, message, received.retained);
}

void Operator::hear_robot(const Topic& topic, const Message& message, bool retained) {
    if (topic.robot.empty()) return;
    if (robots_.size() >= kRobotsMax && !robots_.contains(topic.robot)) return;
    const bool tells = topic.kind == Kind::Connection || topic.kind == Kind::Description ||
                       topic.kind == Kind::State;
    if (!tells) return;
    Known& robot = robots_[topic.robot];
    if (const auto* one = std::get_if<Connection>(&message)) robot.connection = *one;
    if (const auto* one = std::get_if<Description>(&message)) robot.description = *one;
    if (const auto* one = std::get_if<State>(&message)) {
        robot.state = *one;
        robot.state_at.reset();
        if (!retained) robot.state_at = now_;
    }
    send();
}

void Operator::hear_answer(const std::string& robot, const Answer& answer) {
    if (!order_ || answer.id != order_->command.id) return;
    // One that joined the group meanwhile obeyed, too.
    if (asked_.size() < kRobotsMax || asked_.contains(robot)) asked_[robot].answer = answer;
}

bool Operator::is_online(const Known& robot) {
    return robot.connection && robot.connection->state == "online";
}

std::vector<std::string> Operator::chosen(const Chosen& to) const {
    if (!to.robot.empty()) return {to.robot};
    std::vector<std::string> names;
    for (const auto& [name, robot] : robots_) {
        // Who said good-bye is not missed.
        if (!robot.connection || robot.connection->state == "offline") continue;
        const bool member = robot.description && contains(robot.description->groups, to.group);
        if (to.all || member) names.push_back(name);
    }
    return names;
}

bool Operator::all_are_fresh() const {
    return std::all_of(robots_.begin(), robots_.end(), [](const auto& one) {
        return !is_online(one.second) || one.second.state_at;
    });
}

void Operator::choose() {
    if (!order_ || !knows_all_ || is_chosen_) return;
    is_chosen_ = true;
    for (const std::string& robot : chosen(order_->to)) asked_[robot];
    again_at_ = now_;
    send();
}

void Operator::send() {
    if (!order_ || !is_chosen_) return;
    if (stops()) return send_stop();
    for (auto& [robot, asked] : asked_) {
        if (!asked.sent) send_to(robot);
    }
}

// Repeated until it is answered; it does no harm twice.
void Operator::send_stop() {
    if (now_ < again_at_ || is_over()) return;
    again_at_ = now_ + kAskAgainEvery;
    publish({.kind = Kind::Command,
             .robot = order_->to.robot,
             .group = order_->to.group,
             .name = order_->command.verb},
            order_->command);
}

// With a deadline in the robot's own clock, which its last state tells.
void Operator::send_to(const std::string& robot) {
    const auto known = robots_.find(robot);
    if (known == robots_.end() || !known->second.state_at || !is_online(known->second)) return;
    const State& state = *known->second.state;
    Command command = order_->command;
    command.epoch = state.epoch;
    command.deadline = state.clock + (now_ - *known->second.state_at) / 1ms + kCommandWithin / 1ms;
    asked_[robot].sent = true;
    publish({.kind = Kind::Command, .robot = robot, .name = command.verb}, command);
}

void Operator::publish(const Topic& topic, const Message& message) {
    actions_.push_back(Post{.topic = text_of(options_.fleet, topic),
                            .payload = payload_of(message),
                            .qos = info_of(topic.kind).qos,
                            .retained = info_of(topic.kind).retained});
}

void Operator::tick(Time now) {
    now_ = now;
    choose();
    send();
}

Time Operator::next_tick() const {
    return stops() && is_chosen_ && !is_over() ? again_at_ : Time::max();
}

bool Operator::is_over() const {
    return is_chosen_ && std::all_of(asked_.begin(), asked_.end(),
                                     [](const auto& one) { return one.second.answer; });
}

std::vector<Outcome> Operator::outcomes() const {
    std::vector<Outcome> list;
    for (const auto& [robot, asked] : asked_) {
        list.push_back({robot, asked.answer.has_value(), asked.answer.value_or(Answer{})});
    }
    return list;
}

}  // namespace vagus::fleet
