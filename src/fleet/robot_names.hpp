// Names of many robots as people count them: "t1" to "t30", and "t2" before "t10".
//
//     for (const std::string& name : names_in("t1..t30")) …
//     std::ranges::sort(names, counted_before);
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vagus::fleet {

constexpr size_t kNamesInRangeMax = 1000;

// "t1..t30": thirty names. Anything else is one name, itself.
std::vector<std::string> names_in(const std::string& text);

// Why a text with ".." is no range of names: a sentence.
std::string no_range(const std::string& text);

// As the texts, but numbers at their ends count as numbers.
bool counted_before(std::string_view one, std::string_view other);

}  // namespace vagus::fleet
