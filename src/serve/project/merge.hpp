// Two texts that were made of one: what both changed together, as long as no line was touched by
// both.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vagus::serve {

// Nothing if both touch one line: somebody has to look. A line is one place: two people who each
// change a digit of a number have not agreed on a number.
std::optional<std::string> merged(std::string_view base, std::string_view mine,
                                  std::string_view theirs);

// Where both touch one line both stay, mine in front of theirs: somebody has chosen that.
std::string with_both(std::string_view base, std::string_view mine, std::string_view theirs);

}  // namespace vagus::serve
