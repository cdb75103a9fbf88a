// Suggestions for misspelt names (docs/spec/aesl-language.md, section 3.3).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vagus::aesl {

// The candidate with the smallest edit distance to `name`, of distance 1 or 2; the first in
// code-point order on a tie; empty if there is none.
std::string_view closest(std::string_view name, std::span<const std::string_view> candidates);

// The candidate that differs from `name` in ASCII capitals only; the first in code-point order if
// there are more; empty if there is none.
std::string_view same_letters(std::string_view name, std::span<const std::string_view> candidates);

// ASCII capitals made small.
std::string in_small_letters(std::string_view text);

}  // namespace vagus::aesl
