// A robot as a member of a fleet: who has its name, what is sent and heard, which commands count,
// and what becomes of it when the broker is gone. A state machine: it takes what happens and the
// time, and gives what is to be done, in this order. No sockets, no nodes, no clock.
//
//     Member member({.fleet = "lab", .robot = "r1", .instance = …, .epoch = …}, now);
//     for (const fleet::LinkEvent& event : link.take()) member.hear(event, now);
//     member.tick(now);
//     for (const fleet::MemberAction& action : member.take()) perform(action);
//
// Nothing that keeps a robot safe depends on it: it can only add a reason to stop.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/time.hpp"
#include "fleet/counters.hpp"
#include "fleet/limits.hpp"
#include "fleet/link.hpp"
#include "fleet/outbox.hpp"
#include "fleet/project_part.hpp"

namespace vagus::fleet {

struct MemberOptions {
    std::string fleet = {}, robot = {};
    std::string instance = {};  // of this program, unlike that of any other
    int64_t epoch = 0;          // of `now` and of numbers; another one after each start
    ProjectPart project = {};
    Description description = {};
};

// What a robot says of the project of that name, with that plan. Its program adds the rest.
Description description_of(const ProjectPart& part, std::string_view project,
                           std::string_view plan);

// What is shown of the robot: its state without what the member itself adds, and its nodes, which
// its description tells. Those of names that no message can have, and of more than kNodesMax nodes,
// are left out.
struct Shown {
    std::string state = "stopped", actor = {};
    std::vector<std::string> problems = {}, nodes = {};
    friend bool operator==(const Shown&, const Shown&) = default;
};

// ---- what is to be done ----

struct Subscribe {
    std::vector<Filter> filters;
};
// An event of the fleet is one of the bus.
struct EmitOnBus {
    std::string event;
    std::vector<int16_t> args;
    std::string from;    // the robot that sent it
    int64_t number = 0;  // of the event, among those of that robot
};
// answer() follows.
struct Obey {
    Command command;
};
// The broker is gone, and the project says that the robot does not go on without it.
struct StopAlone {
    std::string why;
};
// Another version is wanted; deployed() follows. It comes again at each connection.
struct Fetch {
    Want want;
};
struct Say {
    std::string kind, text;  // "note", "warning"
};
using MemberAction = std::variant<Subscribe, Post, EmitOnBus, Obey, StopAlone, Fetch, Say>;

class Member {
public:
    // Apart: there is no connection. Asking: whether another has the name. Out: it has.
    enum class Standing { Apart, Asking, Holding, Out };

    Member(MemberOptions options, Time now);

    // The message that a broker is to publish when it misses this member.
    Post will() const { return connection("lost"); }

    void hear(const LinkEvent& event, Time now);
    // A script of the robot has emitted it. What came from the fleet is not told here. The number
    // that it has in the fleet; 0: it is not sent.
    int64_t emitted(const std::string& event, const std::vector<int16_t>& args, Time now);
    // As it is now; told when it changes, and the state from time to time.
    void show(const Shown& shown, Time now);
    // A variable that the project lists under `tell` has these values.
    void changed(const std::string& node, const std::string& name, std::vector<int16_t> values);
    // Somebody asks for it: it is told also if it was told before.
    void tell_again(const std::string& node, const std::string& name);
    // Of a command that was to be obeyed; once for each.
    void answer(const Command& command, Answer answer);
    // What became of the version that was wanted; the last one is told at each connection.
    void deployed(const Version& version);
    // The program ends: the robot says that it is offline.
    void leave();
    void tick(Time now);
    Time next_tick() const;
    std::vector<MemberAction> take() { return std::exchange(actions_, {}); }

    Standing standing() const { return standing_; }
    // Events that were too many, too old, or did not fit, and messages that were none.
    uint64_t left_out() const { return left_out_ + outbox_.dropped(); }

private:
    using Told = std::map<std::string, std::optional<Answer>>;
    struct Telling {
        std::vector<int16_t> values;
        bool news = true;
        Time due{};
    };

    // ---- member_name.cpp: who has the name ----
    void on(const Connected&);
    void on(const Lost& lost);
    void hear_connection(const Connection& said);
    void hear_connection_of_other(const Connection& said);
    void hear_question(const Ask& ask);
    void hear_answer(const Answer& answer);
    void ask_for_name();
    void claim();
    void say_online();
    void hear_rival(const Connection& said);
    void answer_who_wants_it();
    void tell_who_wants_it();
    std::vector<std::string> problems() const;
    void settle();
    void stay_out(const std::string& why);
    void tick_name();
    void tick_alone();
    std::vector<Filter> filters_of_name() const;
    std::vector<Filter> filters_of_work() const;
    Post connection(const std::string& state) const;

    // ---- member.cpp ----
    void on(const Received& received);
    void on(const Acknowledged& acknowledged);
    void on(const TakenBack&) {}
    void on(const Malformed&) { ++left_out_; }
    void hear_event(const Topic& topic, const Event& event);
    void hear_early_events();
    bool hears(const std::string& event, const std::vector<std::string>& groups) const;
    void hear_command(const Topic& topic, const Command& command);
    bool is_for_us(const Topic& topic) const;
    std::string why_not(const Command& command) const;
    Told::iterator remember(const std::string& id);
    void publish_answer(const Command& command, const Answer& answer);
    void publish_description();
    void publish_version();
    void show_nodes(const std::vector<std::string>& nodes);
    void publish_state();
    void publish_variables();
    void send_events();
    Post post_of(Kind kind, const std::string& name, const Message& message) const;
    void say(const std::string& kind, const std::string& text) { act(Say{kind, text}); }
    void act(MemberAction action) { actions_.push_back(std::move(action)); }
    int64_t clock() const { return now_.count() / 1000; }

    MemberOptions options_;  // but for the nodes in its description, as they were given
    std::vector<MemberAction> actions_;
    Time now_{};

    Standing standing_ = Standing::Apart;
    Time apart_since_{};
    bool alone_told_ = false;
    std::string lost_told_;
    Time name_until_{};                 // Asking: when the question was long enough ago
    bool asked_ = false;                // our question came back: what was retained is known
    std::optional<Connection> holder_;  // who is said to have the name
    int onlines_out_ = 0;               // Holding: of ours, that have not come back yet
    std::deque<std::string> asked_by_;  // Holding: instances that are to be answered
    Time ask_again_at_{};               // Out: who has the name shall know that it is wanted
    std::optional<Time> wanted_until_;  // Holding: somebody else wants the name
    std::optional<Time> settled_at_;    // Holding: who claimed it before us says no more

    Outbox outbox_;
    int64_t numbers_ = 0;  // of events and states
    Numbers heard_;
    Rates sent_rates_{1s};
    Rates heard_rates_{kEventAgeMax};  // what waited while the link was cut comes at once
    uint64_t left_out_ = 0;

    Shown shown_;
    int64_t since_ = 0;
    bool state_news_ = true, description_news_ = false;
    Time state_at_{};  // when it was told last
    std::map<std::pair<std::string, std::string>, Telling> telling_;
    // Heard before the name was ours: the broker gives what waited for us as soon as we are there.
    struct Early {
        Topic topic;
        Event event;
        Time at{};
    };
    std::deque<Early> early_;
    std::optional<Version> version_;
    Told told_;  // answers by id of their command
    std::deque<std::string> told_order_;
};

}  // namespace vagus::fleet
