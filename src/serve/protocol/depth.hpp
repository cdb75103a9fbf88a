// How deep a JSON text nests, known before it is read: readers and writers of JSON go down as deep.
#pragma once

#include <cstddef>
#include <string_view>

namespace vagus::serve {

// Brackets inside each other, those in strings not counted.
size_t depth_of(std::string_view text);

}  // namespace vagus::serve
