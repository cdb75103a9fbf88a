// Which program the node has: a checksum of the words that hosts loaded, told as the variable
// `_program` (docs/vm.md, "Which program is it?").
#pragma once

#include "node/node.hpp"

namespace vagus {
namespace node {

// A SetBytecode is about to be obeyed: `start`, and `count` words.
void note_piece(Node& node, uint16_t start, uint16_t count);
// Counts the next words. Nothing of the program may have run meanwhile: `when` leaves its memory in
// the bytecode.
void count_words(Node& node);
// Writes `_program`, if the node has it.
void tell_program(Node& node);

}  // namespace node
}  // namespace vagus
