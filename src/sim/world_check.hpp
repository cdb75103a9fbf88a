// What a world must keep to, as one list of checks for worlds from files and from programs.
#pragma once

#include <optional>
#include <string>

#include "sim/definitions.hpp"

namespace vagus::sim {

// What is wrong, and with which element: "objects[3].mass", for a sentence or to look its place up.
struct Problem {
    std::string element;
    std::string
        what;  // "expected a number from 0 to 1000 (kg), found -1; write 0 for what never moves"
};

// The first problem in the order of the file.
std::optional<Problem> find_problem(const WorldDefinition& world);
// Of one object by itself; `element` is its own name in the sentence.
std::optional<Problem> find_problem(const ObjectDefinition& object, const std::string& element);

}  // namespace vagus::sim
