// Any bytes as a node file: no crash; what is accepted is written as a file that reads and writes
// the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "aesl/node_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    const auto parsed = vagus::aesl::parse_node_file(text, "input");
    if (!parsed.ok()) return 0;
    const std::string saved = vagus::aesl::format_node_file(parsed.value());
    const auto again = vagus::aesl::parse_node_file(saved, "saved");
    if (!again.ok() || vagus::aesl::format_node_file(again.value()) != saved) std::abort();
    return 0;
}
