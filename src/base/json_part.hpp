// Values in the saved form of docs/formats.md, for those who change a file in one place and leave
// the rest as it is.
#pragma once

#include <string>
#include <string_view>

#include "base/json.hpp"

namespace vagus {

// `depth` objects and arrays are around the value, `prefix` (its key) before it, `suffix` (a
// comma) behind it. Without indentation before the first line, without a newline at the end.
std::string format_json_part(const JsonValue& value, size_t depth, std::string_view prefix,
                             std::string_view suffix);

// All on one line: `{ "a": 1, "b": [2, 3] }`.
std::string format_json_line(const JsonValue& value);

}  // namespace vagus
