// The 30 standard native functions (docs/spec/aseba-wire-and-vm.md, section 4.2). The list of them
// is natives.def; here is what is made from it. Every one pops all its arguments and checks
// every address.
#pragma once

#include "isa/flash.hpp"
#include "node/description.hpp"

namespace vagus {
namespace node {

namespace natives {
#define NATIVE(function, name, doc, parameters) void function(Node& node);
#include "node/natives.def"
#undef NATIVE
}  // namespace natives

constexpr uint16_t kStandardNativeCount = 0
#define NATIVE(function, name, doc, parameters) +1
#include "node/natives.def"
#undef NATIVE
    ;

// In flash on an AVR: read an entry by flash_read().
extern const Native kStandardNatives[kStandardNativeCount];

}  // namespace node
}  // namespace vagus
