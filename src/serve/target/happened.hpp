// What people see of what the bus tells: an item of the topic happenings, and of the history. Made
// in one way, by whoever hears the bus: the server for a robot, the process of a run for its world.
//
//     if (auto happened = happened_of(event, name)) tell(*happened);
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "debug/event.hpp"

namespace vagus::serve {

constexpr const char* kHostName = "main";  // the source of what hosts send: a plan, a person

struct Happened {
    double t = 0;     // of the run
    double wall = 0;  // milliseconds since 1970; 0: not known, it is of a run that is run again
    std::string kind = {};
    uint16_t node = 0;
    std::string source = {}, name = {}, text = {};
    std::vector<int16_t> args = {};
    uint32_t line = 0;  // of a state: where the node is paused
    bool operator==(const Happened&) const = default;
};

// Without its time. Nothing: it is none that people are told of. `source` is the name of its node.
std::optional<Happened> happened_of(const debug::Event& event, const std::string& source);

// How people see the event: its name, or "event 7" where no definition is its.
std::string shown_name(const debug::UserEvent& event);

// Its program has been loaded.
Happened loaded_now(uint16_t node, const std::string& source);

// Happening of the protocol, but for its number and run.
nlohmann::json happening_json(const Happened& happened);

}  // namespace vagus::serve
