// Node files (`--node`, `--describe`; docs/formats.md): a Target and the common definitions as
// JSON.
//
//     { "name": "rover", "protocolVersion": 5, "bytecodeSize": 600, "variablesSize": 200,
//       "stackSize": 32, "variables": [{ "name": "id", "size": 1 }],
//       "localEvents": [{ "name": "tick", "doc": "every 20 ms" }],
//       "events": [{ "name": "ping", "size": 0 }], "constants": [{ "name": "LIMIT", "value": 10 }],
//       "natives": [{ "name": "math.rand", "params": [{ "name": "dest", "size": -1 }] }] }
//
// Needed are `name`, the three sizes and `variables`. `doc` of events and natives is optional; an
// event without `size` takes arguments of any size (aesl-language.md, section 6, rule 5).
#pragma once

#include <string>
#include <string_view>

#include "aesl/target.hpp"
#include "base/result.hpp"

namespace vagus::aesl {

// A name travels on the bus with its length in one byte (aseba-wire-and-vm.md, section 2).
constexpr size_t kNameBytesMax = 255;
// An instruction has 12 bits for the number of a native function.
constexpr size_t kNativesMax = 4096;
// Local events count down from 0xfffe; 0x8000 is the lowest number that is not a user event.
constexpr size_t kLocalEventsMax = 0x7fff;
// A message carries its words behind the source and the type (aseba-wire-and-vm.md, section 2).
constexpr size_t kEventWordsMax = 258;

struct NodeFile {
    Target target;
    CommonDefinitions common;  // for scripts without a project; a project's own win
};

// `file` is the name for error sentences. The Error is the first of the file, with its line and
// column. That the variables fit the memory is for the compiler to say (BROKEN_TARGET).
Result<NodeFile> parse_node_file(std::string_view text, std::string_view file);

// The saved form (docs/formats.md, "How our JSON files look when saved"), with a final newline.
std::string format_node_file(const NodeFile& node);

}  // namespace vagus::aesl
