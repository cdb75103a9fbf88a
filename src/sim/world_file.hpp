// Reads a world file: text in, a WorldDefinition out, or an Error that says
// "arena.world.json:12:14: objects[3].mass: expected a number from 0 to 1000, found -1; …".
// Everything that docs/formats.md says about the file is checked here and nowhere else: keys,
// kinds, ranges, double ids, and that the timeline speaks of what exists. `robots[].script` and
// `ground.image` stay as they are written; they are paths from the folder of the world file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "sim/definitions.hpp"

namespace vagus::sim {

// `file` is for the sentences of errors.
Result<WorldDefinition> read_world(std::string_view text, std::string_view file);

// Everything that keeps the text from being read, in the order of the file: the first is the Error
// of read_world(). Empty: it can be read.
std::vector<Error> mistakes_of_world(std::string_view text, std::string_view file);

// What is allowed, but looks like a slip (an angle in degrees): "FILE:LINE:COL: warning: sentence".
// `text` was read without an error.
std::vector<std::string> hints_of_world(std::string_view text, std::string_view file);

// An error that was found after reading, with its place before it: its sentence begins with the
// element ("robots[0].script: …"). `text` was read without an error.
Error error_in_world(const Error& error, std::string_view text, std::string_view file);

// The entry of the file's list "robots" that a robot of its WorldDefinition comes from: the robots
// of a grid have one. `text` was read without an error.
size_t entry_of_robot(std::string_view text, std::string_view file, size_t robot);

// The checks that need no file: sizes, numbers of things, names that differ. World::create() makes
// them, too.
Status check_world(const WorldDefinition& world);

}  // namespace vagus::sim
