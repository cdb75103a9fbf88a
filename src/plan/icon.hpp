// Icons of templates: SVG path data on a field of 24 x 24 (docs/formats.md), as in `d` of a path.
#pragma once

#include <cstddef>
#include <string_view>

namespace vagus::plan {

constexpr size_t kIconBytesMax = 4096;

// "M4 5h16M4 10h16": begins with M or m; each command with the numbers that it takes, or a multiple
// of them.
bool is_path_data(std::string_view text);

}  // namespace vagus::plan
