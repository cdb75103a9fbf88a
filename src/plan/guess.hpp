// What a name that does not exist was probably meant to be: as the end of a sentence for people,
// and as a value for programs. Internal to the module.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plan/finding.hpp"

namespace vagus::plan {

// Among more a guess takes too long when thousands of names are wrong.
constexpr size_t kGuessAmongMax = 1000;

// "; did you mean "x"?", or what there is, or nothing.
std::string hint(std::string_view word, const std::vector<std::string_view>& known);

// For a formula that is refused because a unit follows the number, as in "50 cm" with the unit cm;
// empty for another mistake. `error` is that of parse_formula().
std::string unit_hint(std::string_view error, std::string_view unit);

// What hint() guesses; of a key of the file, of anything else.
std::optional<Meant> key_meant_by(std::string_view key, const std::vector<std::string_view>& known);
std::optional<Meant> meant_by(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace vagus::plan
