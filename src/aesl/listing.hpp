// A program for people: each source line with the instructions made from it, names instead of
// numbers.
//
//        4 | n += 1
//     5  3028       Load       n
//     6  1001       SmallImm   1
//     7  8002       Binary     +
//     8  4028       Store      n
#pragma once

#include <string>
#include <string_view>

#include "aesl/compile.hpp"

namespace vagus::aesl {

// `source`, `target` and `common` are those that the program was compiled from; `first_line` is the
// number to show for the first line of the source, which may stand inside a project file. Any words
// can be listed: what is no instruction is shown as a number.
std::string listing(const Program& program, std::string_view source, const Target& target,
                    const CommonDefinitions& common, int first_line = 1);

}  // namespace vagus::aesl
