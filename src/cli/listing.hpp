// The output of `compile --format listing`: the script, and under each line the instructions it
// became.
//
//     12 | when speed > 50 do
//             16  3024       Load speed
//             17  1032       SmallImm 50
//             18  a10c 0009  Branch when >, else to 27
#pragma once

#include <string>
#include <string_view>

#include "aesl/compile.hpp"

namespace vagus::cli {

struct Listed {
    const aesl::Program& program;
    const aesl::Target& target;
    const aesl::CommonDefinitions& common;
    std::string_view source;
    int first_line = 1;  // of the file
};

// Any words are listed, also those that are no program.
std::string listing(const Listed& listed);

}  // namespace vagus::cli
