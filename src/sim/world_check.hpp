// What a world must keep to, as one list of checks for worlds from files and from programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/definitions.hpp"

namespace vagus::sim {

// What is wrong, and with which element: "objects[3].mass", for a sentence or to look its place up.
constexpr size_t kHintsMax = 10;

struct Problem {
    std::string element;
    // "expected a number from 0 to 1000 (kg), found -1; write 0 for what never moves".
    std::string what;
};

// The first problem in the order of the file.
std::optional<Problem> find_problem(const WorldDefinition& world);
// What is allowed, but looks like a slip of the pen; at most kHintsMax.
std::vector<Problem> find_hints(const WorldDefinition& world);
// Of one object by itself; `element` is its own name in the sentence.
std::optional<Problem> find_problem(const ObjectDefinition& object, const std::string& element);

}  // namespace vagus::sim
