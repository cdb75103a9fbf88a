// What a world must keep to, as one list of checks for worlds from files and from programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/definitions.hpp"

namespace vagus::sim {

constexpr size_t kHintsMax = 10;
constexpr size_t kProblemsMax = 1000;

// "objects[3]"
std::string numbered(std::string_view list, size_t index);

// What is wrong, and with which element: "objects[3].mass", for a sentence or to look its place up.
struct Problem {
    std::string element;
    // "expected a number from 0 to 1000 (kg), found -1; write 0 for what never moves".
    std::string what;
};

// The first problem of each object, robot and entry in the order of the file, at most kProblemsMax.
std::vector<Problem> find_problems(const WorldDefinition& world);
// The first problem in the order of the file.
std::optional<Problem> find_problem(const WorldDefinition& world);
// What is allowed, but looks like a slip of the pen; at most kHintsMax.
std::vector<Problem> find_hints(const WorldDefinition& world);
// Of one object by itself; `element` is its own name in the sentence.
std::optional<Problem> find_problem(const ObjectDefinition& object, const std::string& element);

}  // namespace vagus::sim
