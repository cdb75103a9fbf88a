// What a person types, from the bytes of a terminal.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vagus::cli {

enum class Key {
    Pause,
    Reset,
    Faster,
    Slower,
    NextRobot,
    LastRobot,
    Centre,  // a button of the robot, as the next four
    Forward,
    Backward,
    Left,
    Right,
    Tap,
    Escape,  // the robot's button of that name
    Quit,
    Redraw
};

// Keys in the order typed; sequences that mean nothing here are dropped. An escape sequence may be
// cut between two reads: `rest` keeps its beginning (at most kSequenceMax bytes, then it is
// dropped). Escape alone is no key.
constexpr size_t kSequenceMax = 16;
std::vector<Key> keys_of(std::string_view bytes, std::string& rest);

}  // namespace vagus::cli
