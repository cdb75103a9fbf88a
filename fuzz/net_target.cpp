// Any text as a target: no crash; what is accepted is written in a form that means the same place.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "net/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    const auto target = vagus::net::parse_target(text);
    if (!target.ok()) {
        if (target.error().what.empty()) std::abort();
        return 0;
    }
    (void)vagus::net::to_string(target.value());
    return 0;
}
