// What brings a node to rest whose own safe state does not, and how a host knows that it is at
// rest: data of a project or of a toolbox file (docs/formats.md, "Safe stop").
//
//     SafeStop safe = read_safe_stop(in, complaints);      // the key "safe_stop" of that object
//     for (const auto& [name, values] : safe["thymio-II"].set) …
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/json_object.hpp"

namespace vagus::toolbox {

constexpr size_t kSafeStopNodesMax = 64;
constexpr size_t kSafeStopVariablesMax = 64;   // of a node, in `set`; the same in `read`
constexpr size_t kSafeStopValuesMax = 64;      // of a variable
constexpr size_t kSafeStopNameBytesMax = 255;  // of a node or variable

struct SafeStopNode {
    // Variables to write behind Stop and then to read back.
    std::vector<std::pair<std::string, std::vector<int16_t>>> set;
    // Variables that must read 0 before the node counts as stopped.
    std::vector<std::string> read;
    friend bool operator==(const SafeStopNode&, const SafeStopNode&) = default;
};
using SafeStop = std::map<std::string, SafeStopNode>;  // by the name of the node

// Reads the key "safe_stop" of `in`, which need not be there. What is wrong is complained of.
SafeStop read_safe_stop(JsonObject& in, Complaints& complaints);

// The entries of `stronger` take the place of those of the same node.
void overlay(SafeStop& safe, const SafeStop& stronger);

}  // namespace vagus::toolbox
