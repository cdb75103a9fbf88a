#include "node/natives.hpp"

#include <stddef.h>

namespace vagus {
namespace node {

namespace {

constexpr int16_t A = -1;  // templates: all parameters of one letter have one length
constexpr int16_t B = -2;

#define PARAMETER_NAME(name) VAGUS_FLASH_TEXT(kParameter_##name, #name);
#include "node/natives.def"
#undef PARAMETER_NAME

#define P(name, size) {size, kParameter_##name},
#define NATIVE(function, name, doc, parameters) \
    VAGUS_FLASH_TEXT(kName_##function, name);   \
    VAGUS_FLASH_TEXT(kDoc_##function, doc);     \
    VAGUS_FLASH_TABLE(Parameter, kParameters_##function, ) = {parameters};
#include "node/natives.def"
#undef NATIVE
#undef P

constexpr uint16_t count(size_t table_bytes) {
    return static_cast<uint16_t>(table_bytes / sizeof(Parameter));
}

}  // namespace

// `extern` in the header: a constant is otherwise known in its own file only.
VAGUS_FLASH_TABLE(Native, kStandardNatives, kStandardNativeCount) = {
#define NATIVE(function, name, doc, parameters)                 \
    {kName_##function, kDoc_##function, kParameters_##function, \
     count(sizeof kParameters_##function), natives::function},
#include "node/natives.def"
#undef NATIVE
};

}  // namespace node
}  // namespace vagus
