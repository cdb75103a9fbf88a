// Somebody who looks at a fleet and tells its robots what to do: who is there, and what became of
// an order. A state machine, as Member is.
//
//     Operator desk({.fleet = "lab", .name = "desk-1"});
//     desk.begin({.command = {.verb = "stop"}, .to = {.all = true}}, now);
//     for (const LinkEvent& event : link.take()) desk.hear(event, now);
//     desk.tick(now);
//     if (desk.is_over()) for (const Outcome& one : desk.outcomes()) show(one);
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
    std::optional<Time> state_at = {};  // when it came; nothing: it was retained
};

// Whom an order is for.
struct Chosen {
    bool all = false;
    std::string group = {}, robot = {};
};
struct Order {
    Command command;
    Chosen to;
};

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
    };
    explicit Operator(Options options) : options_(std::move(options)) {}

    // One order, as soon as it is known who is there. Without an id it gets one.
    void begin(Order order, Time now);

    void hear(const LinkEvent& event, Time now);
    void tick(Time now);
    Time next_tick() const;
    std::vector<OperatorAction> take() { return std::exchange(actions_, {}); }

    // What was retained has come.
    bool knows_all() const { return knows_all_; }
    const std::map<std::string, Known>& robots() const { return robots_; }
    std::vector<std::string> chosen(const Chosen& to) const;
    // Every robot that is online has told its state since.
    bool all_are_fresh() const;
    static bool is_online(const Known& robot);

    // Everybody who was chosen has answered.
    bool is_over() const;
    // So far, by name.
    std::vector<Outcome> outcomes() const;

private:
    void on(const Connected&);
    void on(const Lost&) { knows_all_ = false; }
    void on(const Acknowledged&) {}
    void on(const Malformed&) {}
    void on(const Received& received);
    void hear_robot(const Topic& topic, const Message& message, bool retained);
    void hear_answer(const std::string& robot, const Answer& answer);
    void choose();
    void send();
    void send_stop();
    void send_to(const std::string& robot);
    bool stops() const { return order_ && order_->command.verb == "stop"; }
    void publish(const Topic& topic, const Message& message);

    const Options options_;
    std::vector<OperatorAction> actions_;
    Time now_{};
    bool knows_all_ = false;
    std::map<std::string, Known> robots_;
    std::optional<Order> order_;
    bool is_chosen_ = false;
    Time again_at_{};
    uint64_t orders_ = 0;
    struct Asked {
        bool sent = false;
        std::optional<Answer> answer;
    };
    std::map<std::string, Asked> asked_;
};

}  // namespace vagus::fleet
