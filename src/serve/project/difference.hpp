// What makes one text of another.
#pragma once

#include <cstddef>
#include <string_view>

namespace vagus::serve {

// One replacement, of whole characters.
struct TextDifference {
    size_t from = 0, to = 0;  // bytes of the one before
    std::string_view insert;  // of the one after
};
TextDifference difference(std::string_view before, std::string_view after);

}  // namespace vagus::serve
