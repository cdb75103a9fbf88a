// Commands that are printed for people to copy: a path in them is one word of the shell.
//
//     print("vagus replay " + shell_word("my tests/a.mcap"));   // vagus replay 'my tests/a.mcap'
#pragma once

#include <string>
#include <string_view>

namespace vagus {

// The text itself, in quotes if it needs them.
std::string shell_word(std::string_view text);

}  // namespace vagus
