// `vagus replay FILE --jumps LIST`: what state there is at each of these instants, in their order,
// back and forth (record/keyframes.hpp).
//
//     exit_code = tell_jumps(reader, {.list = "-", .json = true});
#pragma once

#include <cstddef>
#include <string>

#include "mcap/reader.hpp"

namespace vagus::cli {

constexpr size_t kJumpLineMax = 1000;  // bytes of a line of the list

struct JumpsOptions {
    std::string list;  // a file of instants, one a line; "-": the standard input
    bool json = false;
};

// Reads a line, answers it, and reads on. A line that is no instant of the run is complained of.
// Gives the exit code.
int tell_jumps(const mcap::Reader& reader, const JumpsOptions& options);

}  // namespace vagus::cli
