// Any bytes as a project file: no crash; what is accepted is written as a file that reads and
// writes the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "aesl/project.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string_view xml(reinterpret_cast<const char*>(bytes), size);
    const auto parsed = vagus::aesl::parse_project(xml, "input");
    if (!parsed.ok()) return 0;
    const std::string saved = vagus::aesl::format_project(parsed.value());
    const auto again = vagus::aesl::parse_project(saved, "saved");
    if (!again.ok() || vagus::aesl::format_project(again.value()) != saved) std::abort();
    return 0;
}
