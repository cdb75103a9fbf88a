// Any bytes as JSON: no crash; what is accepted is formatted to a text that reads and formats to
// the same text.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/json.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    const auto parsed = vagus::parse_json(text, "input");
    if (!parsed.ok()) return 0;
    const std::string saved = vagus::format_json(parsed.value());
    const auto again = vagus::parse_json(saved, "saved");
    if (!again.ok() || vagus::format_json(again.value()) != saved) std::abort();
    return 0;
}
