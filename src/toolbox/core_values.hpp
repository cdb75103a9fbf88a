// Arithmetic that the core templates share: times, comparisons, the words of a bus event.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "plan/value.hpp"

namespace vagus::toolbox {

// Seconds as whole microseconds: the product with 1e6 rounded half away from zero; a negative time
// is 0, one above 1e12 s is run::kNever (section 7).
Duration duration_of(double seconds);

// Throws run::CodeError for an operator that does not exist, or operands that cannot be compared.
bool compare(const plan::Value& left, std::string_view op, const plan::Value& right);

// "1 2 -3" as words of 16 bits; throws run::CodeError for anything else, and for more than eight.
std::vector<int16_t> words_of(std::string_view text);

}  // namespace vagus::toolbox
