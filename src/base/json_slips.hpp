// What people get wrong when they write JSON by hand: a missing comma, a comma too many, comments,
// single or typographic quotes, keys without quotes, True, a bracket that is not closed. Asked only
// about text that the reader has refused, for a sentence that helps more than the reader's.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vagus {

struct JsonSlip {
    size_t offset = 0;  // where reading cannot go on
    std::string what;   // what is wrong and how to fix it
};

// The first slip in the text. `text` is UTF-8.
std::optional<JsonSlip> find_json_slip(std::string_view text);

}  // namespace vagus
