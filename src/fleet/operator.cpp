#include "fleet/operator.hpp"

#include <algorithm>

#include "fleet/limits.hpp"
#include "fleet/robot_names.hpp"

namespace vagus::fleet {
namespace {

constexpr const char* kEchoId = "echo";       // id of a message of our own that comes back
constexpr uint64_t kEchoNumber = UINT64_MAX;  // of its post: unlike that of any order

}  // namespace

OrderNumber Operator::begin(Order order, Time now) {
    now_ = now;
    const OrderNumber number = ++orders_;
    order.command.reply = options_.name;
    if (order.command.id.empty()) order.command.id = options_.name + "-" + std::to_string(number);
    given_.emplace(number, Given{.order = std::move(order)});
    return number;
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
    if (options_.versions) filters.push_back({filter_of(options_.fleet, Kind::Version)});
    filters.push_back({filter_of(options_.fleet, Kind::Answer)});
    filters.push_back({filter_of_commands(options_.fleet, options_.name)});
    actions_.push_back(Subscribe{std::move(filters)});
    connected_ = true;
    send_echo();
}

// Again until it is back: what does not fit into the queue that a broker has for us is dropped.
void Operator::send_echo() {
    echo_at_ = now_ + kAskAgainEvery;
    publish({.kind = Kind::Command, .robot = options_.name, .name = "stop"},
            Command{.verb = "stop", .id = kEchoId, .reply = options_.name}, kEchoNumber);
}

// What was heard before says nothing of now.
void Operator::on(const Lost&) {
    connected_ = knows_all_ = answered_ = false;
    for (auto& [name, robot] : robots_) robot.state_at.reset();
}

void Operator::on(const Acknowledged& acknowledged) {
    if (acknowledged.number == kEchoNumber) {
        refused_ = acknowledged.refused;
        answered_ = true;
        return;
    }
    const auto found = given_.find(acknowledged.number);
    if (found != given_.end()) found->second.refused = acknowledged.refused;
}

// A robot that is forgotten takes back everything, its connection last.
void Operator::on(const TakenBack& taken) {
    if (taken.topic.kind == Kind::Connection) robots_.erase(taken.topic.robot);
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
                       topic.kind == Kind::State || topic.kind == Kind::Version;
    if (!tells) return;
    Known& robot = robots_[topic.robot];
    if (const auto* one = std::get_if<Connection>(&message)) robot.connection = *one;
    if (const auto* one = std::get_if<Description>(&message)) robot.description = *one;
    if (const auto* one = std::get_if<Version>(&message)) robot.version = *one;
    if (const auto* one = std::get_if<State>(&message)) {
        robot.state = *one;
        robot.state_at.reset();
        if (!retained) robot.state_at = now_;
    }
    send();
}

void Operator::hear_answer(const std::string& robot, const Answer& answer) {
    for (auto& [number, given] : given_) {
        if (answer.id != given.order.command.id) continue;
        // One that joined the group meanwhile obeyed, too.
        auto& asked = given.asked;
        if (asked.size() < kRobotsMax || asked.contains(robot)) asked[robot].answer = answer;
    }
}

bool Operator::is_online(const Known& robot) {
    return robot.connection && robot.connection->state == "online";
}

std::vector<std::string> Operator::chosen(const Chosen& to) const {
    if (!to.robots.empty()) return to.robots;
    std::vector<std::string> names;
    for (const auto& [name, robot] : robots_) {
        // Who said good-bye is not missed.
        if (!robot.connection || robot.connection->state == "offline") continue;
        const bool member = robot.description && contains(robot.description->groups, to.group);
        if (to.all || member) names.push_back(name);
    }
    std::ranges::sort(names, counted_before);
    return names;
}

std::vector<std::string> Operator::chosen_online_first(const Chosen& to) const {
    std::vector<std::string> names = chosen(to);
    std::stable_partition(names.begin(), names.end(),
                          [this](const std::string& name) { return is_online(name); });
    return names;
}

bool Operator::is_online(const std::string& robot) const {
    const auto found = robots_.find(robot);
    return found != robots_.end() && is_online(found->second);
}

bool Operator::all_are_fresh() const {
    return std::all_of(robots_.begin(), robots_.end(), [](const auto& one) {
        return !is_online(one.second) || one.second.state_at;
    });
}

void Operator::choose() {
    if (!knows_all_) return;
    for (auto& [number, given] : given_) {
        if (given.is_chosen) continue;
        given.is_chosen = true;
        for (const std::string& robot : chosen(given.order.to)) given.asked[robot];
        given.again_at = now_;
    }
    send();
}

void Operator::send() {
    for (auto& [number, given] : given_) {
        if (!given.is_chosen) continue;
        if (given.stops()) {
            send_stop(number, given);
            continue;
        }
        for (auto& [robot, asked] : given.asked) {
            if (!asked.sent) send_to(robot, number, given);
        }
    }
}

// Repeated until it is answered; it does no harm twice.
void Operator::send_stop(OrderNumber number, Given& given) {
    if (now_ < given.again_at || given.is_over()) return;
    given.again_at = now_ + kAskAgainEvery;
    const Order& order = given.order;
    Topic topic{.kind = Kind::Command, .group = order.to.group, .name = order.command.verb};
    if (order.to.robots.empty()) return publish(topic, order.command, number);
    for (const auto& [robot, asked] : given.asked) {
        topic.robot = robot;
        if (!asked.answer) publish(topic, order.command, number);
    }
}

// With a deadline in the robot's own clock, which its last state tells.
void Operator::send_to(const std::string& robot, OrderNumber number, Given& given) {
    const auto known = robots_.find(robot);
    if (known == robots_.end() || !known->second.state_at || !is_online(known->second)) return;
    const State& state = *known->second.state;
    Command command = given.order.command;
    command.epoch = state.epoch;
    command.deadline = state.clock + (now_ - *known->second.state_at) / 1ms + kCommandWithin / 1ms;
    given.asked[robot].sent = true;
    publish({.kind = Kind::Command, .robot = robot, .name = command.verb}, command, number);
}

void Operator::publish(const Topic& topic, const Message& message, uint64_t number) {
    actions_.push_back(Post{.topic = text_of(options_.fleet, topic),
                            .payload = payload_of(message),
                            .qos = info_of(topic.kind).qos,
                            .retained = info_of(topic.kind).retained,
                            .number = number});
}

void Operator::tick(Time now) {
    now_ = now;
    if (connected_ && !knows_all_ && now_ >= echo_at_) send_echo();
    choose();
    send();
}

Time Operator::next_tick() const {
    Time next = connected_ && !knows_all_ ? echo_at_ : Time::max();
    for (const auto& [number, given] : given_) {
        const bool repeats = given.stops() && given.is_chosen && !given.is_over();
        if (repeats) next = std::min(next, given.again_at);
    }
    return next;
}

bool Operator::Given::is_over() const {
    return is_chosen && (!refused.empty() || std::all_of(asked.begin(), asked.end(), [](auto& one) {
               return one.second.answer.has_value();
           }));
}

bool Operator::is_over(OrderNumber number) const {
    const auto found = given_.find(number);
    return found == given_.end() || found->second.is_over();
}

std::string Operator::refusal(OrderNumber number) const {
    const auto found = given_.find(number);
    return found == given_.end() ? "" : found->second.refused;
}

std::vector<Outcome> Operator::outcomes(OrderNumber number) const {
    std::vector<Outcome> list;
    const auto found = given_.find(number);
    if (found == given_.end()) return list;
    for (const auto& [robot, asked] : found->second.asked) {
        list.push_back({robot, asked.answer.has_value(), asked.answer.value_or(Answer{})});
    }
    return list;
}

}  // namespace vagus::fleet
