// Names and topics of a fleet: which topic means what. Pure text.
//
//     show(text_of("lab", {.kind = Kind::State, .robot = "r1"}));  // vagus/1/lab/robot/r1/state
//     const auto topic = parse_topic("lab", text);
//     if (topic && topic->kind == Kind::Event) hear(topic->robot, topic->name);
//
// Levels of a topic are names; whatever is not a letter, digit, `_`, `.` or `-` is %XX in them. So
// no name can add a level, or be a wildcard.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fleet/kind.hpp"

namespace vagus::fleet {

// 1 to kNameBytesMax bytes of UTF-8 without control characters.
bool is_name(std::string_view text);
// Of a robot: `all` and `group` mean many.
bool is_robot_name(std::string_view text);

std::string escape(std::string_view name);
// Nothing, if it is not what escape() gives.
std::optional<std::string> unescape(std::string_view level);

struct Topic {
    Kind kind = Kind::State;
    std::string robot = {};  // whose; of a command: to whom, empty: to many
    std::string group = {};  // of a command to a group
    std::string name = {};   // event, verb, question, variable, key, id of a task
    std::string node = {};   // of a variable
    std::string queue = {};  // of a task
};

// What a topic below vagus/1/FLEET/ means; nothing for one that is none of ours, or not known yet.
std::optional<Topic> parse_topic(std::string_view fleet, std::string_view text);
// The text of a topic. Kind::Command without a robot: to the group, or to all.
std::string text_of(std::string_view fleet, const Topic& topic);

// What to subscribe to: all topics of that kind, with any name.
std::string filter_of(std::string_view fleet, Kind kind);
// Events of that name, of all robots.
std::string filter_of_event(std::string_view fleet, std::string_view event);
// Commands to one robot.
std::string filter_of_commands(std::string_view fleet, std::string_view robot);

// Whether a topic is one of those that the filter means: `+` stands for one level.
bool matches_filter(std::string_view filter, std::string_view topic);

}  // namespace vagus::fleet
