// What makes one text of another: in one piece, or in as many as there are places.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace vagus::serve {

constexpr size_t kDifferencesMax = 1000;  // places; more are told as one

// One replacement, of whole characters.
struct TextDifference {
    size_t from = 0, to = 0;  // bytes of the one before
    std::string_view insert;  // of the one after
};
TextDifference difference(std::string_view before, std::string_view after);

// The same by places, in their order, none touching another: what is between them stays.
std::vector<TextDifference> differences(std::string_view before, std::string_view after);

// Lines [from, to) of one text that became lines [at, end) of the other; counted from 0.
struct LineDifference {
    size_t from = 0, to = 0;
    size_t at = 0, end = 0;
};
// The lines of a text, each with its line end.
std::vector<std::string_view> lines_of(std::string_view text);
std::vector<LineDifference> line_differences(const std::vector<std::string_view>& before,
                                             const std::vector<std::string_view>& after);

}  // namespace vagus::serve
