// "Did you mean …?": the known word that a mistyped one was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vagus {

// The word of `known` with the fewest changes (insert, delete, replace, swap of neighbours) from
// `typed`, the first of equals; a word that `typed` begins counts as one change. Empty if all need
// more than a third of their length, at least one: then a guess would only mislead.
std::string nearest(std::string_view typed, const std::vector<std::string>& known);
std::string nearest(std::string_view typed, const std::vector<std::string_view>& known);

// How a sentence about an unknown word ends: "did you mean say?", else "there are: a, b" (the first
// twelve "and 3 more") or "there is none".
std::string known_instead(std::string_view typed, const std::vector<std::string>& known);

}  // namespace vagus
