// Any bytes as an object file: no crash; what is accepted holds the program it says.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "aesl/abo.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string_view file(reinterpret_cast<const char*>(bytes), size);
    const auto parsed = vagus::aesl::parse_abo(file, "input");
    if (parsed.ok() && 22 + 2 * parsed.value().bytecode.size() != size) std::abort();
    return 0;
}
