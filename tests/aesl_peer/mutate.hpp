// Programs with mistakes, made from sound ones: tokens and lines deleted, doubled, exchanged,
// replaced, numbers moved to their limits, names misspelt, brackets lost.
#pragma once

#include <string>

#include "reference/generate_expression.hpp"

namespace vagus::aesl {

// `source` after one to three such changes. Many of the results are wrong programs, some are sound
// ones that do something else.
std::string mutate(const std::string& source, Dice& dice);

}  // namespace vagus::aesl
