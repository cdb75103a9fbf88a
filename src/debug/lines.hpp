// Between program counters and source lines (language spec, 4.11).
#pragma once

#include <cstdint>

#include "aesl/compile.hpp"

namespace vagus::debug {

// The line of the word at `pc`; 0 for the event table and beyond the program.
int line_of(const aesl::Program& program, uint16_t pc);

// The first word, in address order, that has this line; -1 if the line has no code.
int pc_of(const aesl::Program& program, int line);

// The first line with code behind `line`, 0 if there is none: for "the next line with code is …".
int next_line_with_code(const aesl::Program& program, int line);

// The last line with code before `line`, 0 if there is none.
int previous_line_with_code(const aesl::Program& program, int line);

// True if an event's code begins at `pc`.
bool is_event_start(const aesl::Program& program, uint16_t pc);

}  // namespace vagus::debug
