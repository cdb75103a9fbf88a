// Somebody who looks at a fleet and tells its robots what to do: who is there, and what became of
// each order. A state machine, as Member is.
//
//     Operator desk({.fleet = "lab", .name = "desk-1"});
//     const OrderNumber order = desk.begin({.command = {.verb = "stop"}, .to = {.all = true}}, t);
//     for (const LinkEvent& event : link.take()) desk.hear(event, t);
//     desk.tick(t);
//     if (desk.is_over(order)) for (const Outcome& one : desk.outcomes(order)) show(one);
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/time.hpp"
#include "fleet/link.hpp"
#include "fleet/member.hpp"

namespace vagus::fleet {

constexpr size_t kRobotsMax = 10'000;  // that an operator knows

// A robot as its messages have it.
struct Known {
    std::optional<Connection> connection = {};
    std::optional<Description> description = {};
    std::optional<State> state = {};
    std::optional<Version> version = {};  // if the operator asks for versions
    std::optional<Time> state_at = {};    // when it came; nothing: it was retained
};

// Whom an order is for: all, those of a group, or robots by their names.
struct Chosen {
    bool all = false;
    std::string group = {};
    std::vector<std::string> robots = {};
};
struct Order {
    Command command;
    Chosen to;
};
using OrderNumber = uint64_t;  // of one operator; from 1

struct Outcome {
    std::string robot;
    bool answered = false;
    Answer answer = {};
};

using OperatorAction = std::variant<Subscribe, Post>;

class Operator {
public:
    struct Options {
        std::string fleet = {};
        std::string name = {};   // unlike that of any other operator, and of any robot
        bool events = false;     // events are of interest
        bool variables = false;  // so are variables
        bool versions = false;   // what came of roll-outs
    };
    explicit Operator(Options options) : options_(std::move(options)) {}

    // An order, given as soon as it is known who is there, beside others that are under way.
    // Without an id it gets one. It is repeated, or waits for a robot, until end().
    OrderNumber begin(Order order, Time now);

    void hear(const LinkEvent& event, Time now);
    void tick(Time now);
    Time next_tick() const;
    std::vector<OperatorAction> take() { return std::exchange(actions_, {}); }

    // What was retained has come.
    bool knows_all() const { return knows_all_; }
    const std::map<std::string, Known>& robots() const { return robots_; }
    std::vector<std::string> chosen(const Chosen& to) const;
    // The same, those that are online first.
    std::vector<std::string> chosen_online_first(const Chosen& to) const;
    bool is_online(const std::string& robot) const;
    // Every robot that is online has told its state since.
    bool all_are_fresh() const;
    static bool is_online(const Known& robot);

    // Everybody who was chosen has answered, or the broker does not pass it on.
    bool is_over(OrderNumber number) const;
    // So far, by name.
    std::vector<Outcome> outcomes(OrderNumber number) const;
    // Why the broker does not pass it on; empty: it does.
    std::string refusal(OrderNumber number) const;
    // Nobody waits for it any more.
    void end(OrderNumber number) { given_.erase(number); }
    // Why nothing is known: the broker does not pass on what this operator says.
    const std::string& refused() const { return refused_; }
    // The broker has said, since the connection was made, whether it passes that on.
    bool is_answered() const { return answered_; }

private:
    struct Asked {
        bool sent = false;
        std::optional<Answer> answer;
    };
    struct Given {
        Order order;
        bool is_chosen = false;
        Time again_at{};
        std::map<std::string, Asked> asked = {};
        std::string refused = {};

        bool stops() const { return order.command.verb == "stop"; }
        bool is_over() const;
    };

    void on(const Connected&);
    void on(const Lost&);
    void on(const Acknowledged& acknowledged);
    void on(const Malformed&) {}
    void on(const TakenBack& taken);
    void on(const Received& received);
    void hear_robot(const Topic& topic, const Message& message, bool retained);
    void hear_answer(const std::string& robot, const Answer& answer);
    void send_echo();
    void choose();
    void send();
    void send_stop(OrderNumber number, Given& given);
    void send_to(const std::string& robot, OrderNumber number, Given& given);
    void publish(const Topic& topic, const Message& message, uint64_t number);

    const Options options_;
    std::vector<OperatorAction> actions_;
    Time now_{};
    bool connected_ = false, knows_all_ = false, answered_ = false;
    Time echo_at_{};
    std::string refused_;
    std::map<std::string, Known> robots_;
    std::map<OrderNumber, Given> given_;
    OrderNumber orders_ = 0;
};

}  // namespace vagus::fleet
