// Places in a text as pages count them: JavaScript's strings have offsets in UTF-16 units, ours in
// bytes of UTF-8.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace vagus::serve {

// The byte at which `units` UTF-16 units of the text have passed; nothing if the text is shorter or
// that lies inside a character.
std::optional<size_t> byte_of_unit(std::string_view text, size_t units);
// How many units the first `bytes` bytes are.
size_t units_of(std::string_view text, size_t bytes);

}  // namespace vagus::serve
