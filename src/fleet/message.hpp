// What the members of a fleet say to each other, as values; read() is the border at which bytes
// from a broker become them.
//
//     const auto heard = read("lab", topic, payload);
//     if (!heard.ok()) return complain(heard.error());
//     if (const auto* event = std::get_if<Event>(&heard.value().message)) tell(event->args);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/json.hpp"
#include "base/result.hpp"
#include "fleet/topic.hpp"
#include "keeper/keeper.hpp"

namespace vagus::fleet {

// Of each: the fields are explained in kind.cpp.
struct Connection {
    std::string state, instance;
    int64_t epoch = 0;
    friend bool operator==(const Connection&, const Connection&) = default;
};
struct Description {
    std::string project = {}, vagus = {}, plan = {}, studio = {};
    std::vector<std::string> groups = {}, nodes = {}, send = {}, hear = {};
    friend bool operator==(const Description&, const Description&) = default;
};
struct State {
    int64_t number = 0, epoch = 0, clock = 0;
    std::string state = "stopped";
    int64_t since = 0;
    std::string actor = {};
    std::vector<std::string> problems = {};
    int64_t left_out = 0;
    friend bool operator==(const State&, const State&) = default;
};
struct Variable {
    int64_t clock = 0, epoch = 0;
    std::vector<int16_t> values;
    friend bool operator==(const Variable&, const Variable&) = default;
};
struct Event {
    int64_t number = 0, epoch = 0;
    std::vector<std::string> groups;
    std::vector<int16_t> args;
    friend bool operator==(const Event&, const Event&) = default;
};
struct Ask {
    std::string instance;
    friend bool operator==(const Ask&, const Ask&) = default;
};
struct Answer {
    std::string id = {};
    bool done = false;
    std::string what = {}, instance = {};
    std::vector<std::string> silent = {};
    friend bool operator==(const Answer&, const Answer&) = default;
};
struct Command {
    std::string verb = {}, id = {}, reply = {};
    std::optional<int64_t> epoch = {}, deadline = {};
    // Of set, raise, emit.
    std::string node = {}, name = {}, supervisor = {}, event = {};
    std::vector<int16_t> values = {};  // `args` of emit, too
    friend bool operator==(const Command&, const Command&) = default;
};

// To the keeper, and its reply: `epoch` is that of the robot, `number` that of the question.
struct Question {
    int64_t epoch = 0;
    uint64_t number = 0;
    keeper::Request request;
    friend bool operator==(const Question&, const Question&) = default;
};
struct Reply {
    int64_t epoch = 0;
    uint64_t number = 0;
    keeper::Reply reply;
    friend bool operator==(const Reply&, const Reply&) = default;
};

struct Want {
    int64_t number = 0;
    std::string sha256 = {}, address = {};
    bool back = false;
    friend bool operator==(const Want&, const Want&) = default;
};
struct Version {
    int64_t number = 0;
    std::string sha256 = {}, result = {}, why = {};
    std::string healthy = {};
    friend bool operator==(const Version&, const Version&) = default;
};

// Kind::Task and Kind::Shared are records of the keeper, Kind::Beat its sign of life.
using Message = std::variant<Connection, Description, State, Variable, Event, Ask, Answer, Command,
                             Question, Reply, keeper::Record, keeper::Beat, Want, Version>;

struct Heard {
    Topic topic;
    Message message;
};

// The Error says what is wrong with it; Code::NotFound: the topic is none that we know.
Result<Heard> read(std::string_view fleet, std::string_view topic, std::string_view payload);

// Groups, events: is it one of them?
bool contains(const std::vector<std::string>& names, const std::string& name);

// The topic of a record, and of a question.
Topic topic_of(const keeper::Record& record);
Topic topic_of(const std::string& robot, const keeper::Request& request);

// The payload of a message of that fleet; its name matters to a reply alone, which names a topic.
std::string payload_of(const Message& message, std::string_view fleet = "");

}  // namespace vagus::fleet
