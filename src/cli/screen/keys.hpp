// What a person types, from the bytes of a terminal.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vagus::cli {

enum class Key {
    Pause,
    Restart,
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
    Escape,   // the robot's button of that name
    Earlier,  // in the list of events: further back
    Later,
    Quit,
    Redraw,
    Other  // a character that means nothing here
};

// Keys in the order typed; sequences that mean nothing here, and late answers of the terminal, are
// dropped. An escape sequence may be cut between two reads: `rest` keeps its beginning (at most
// kSequenceMax bytes, then it is dropped). Escape alone is no key.
constexpr size_t kSequenceMax = 64;
std::vector<Key> keys_of(std::string_view bytes, std::string& rest);

// Bytes of the escape sequence at the front, 0 if its end is not there yet: ESC [ … letter,
// ESC O letter, ESC ] digit … BEL or ESC \, ESC letter.
size_t sequence_length(std::string_view bytes);

}  // namespace vagus::cli
