// A program for people: each source line with the instructions made from it, names instead of
// numbers.
//
//        4 | n += 1
//     5  3028       Load       n
//     6  1001       SmallImm   1
//     7  8002       Binary     +
//     8  4028       Store      n
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/program.hpp"
#include "aesl/target.hpp"

namespace vagus::aesl {

// `source`, `target` and `common` are those that the program was compiled from; `first_line` is the
// number to show for the first line of the source, which may be inside a project file. Any words
// can be listed: what is no instruction is shown as a number.
std::string listing(const Program& program, std::string_view source, const Target& target,
                    const CommonDefinitions& common, int first_line = 1);

// The same as values: the entries of the event table (line 0), then instruction by instruction.
struct ListedInstruction {
    int line = 0;  // of the source; 0: none
    uint16_t address = 0;
    uint16_t words = 1;
    std::string text;  // "Load n"
};
std::vector<ListedInstruction> instructions(const Program& program, const Target& target,
                                            const CommonDefinitions& common);

// What of a program runs by itself: its initialisation, handlers and subs, by address.
struct Part {
    enum class Kind { Init, Event, Sub };
    Kind kind = Kind::Init;
    std::string name;  // of the event or sub
    uint16_t address = 0;
    uint16_t words = 0;
};
std::vector<Part> parts_of(const Program& program, const Target& target,
                           const CommonDefinitions& common);

}  // namespace vagus::aesl
