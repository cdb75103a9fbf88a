// Which program does a node run? Nodes of Vagus tell a checksum of it in their last variable,
// `_program` (docs/vm.md, "Which program is it?"); others do not tell.
//
//     network.ask_program(node);  // also asked by itself when a node was described or came back
//     // … ProgramTold comes; then
//     const bool same = view->told_program == mark_of(compiled.program.bytecode);
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "aesl/target.hpp"

namespace vagus::debug {

// What a node tells that got these words, one behind the other from address 0: the CRC-32 of IEEE
// 802.3 over them, low byte first; 0 for no program.
uint32_t mark_of(std::span<const uint16_t> bytecode);

// The address of `_program` if the node has it: the last variable, of two words, low word first.
std::optional<uint16_t> mark_address(const aesl::Target& target);

}  // namespace vagus::debug
