// How a script is read, where its text leaves a choice (docs/spec/aesl-language.md, section 6).
#pragma once

#include <cstdint>
#include <string>

namespace vagus::aesl {

enum class Dialect : uint8_t { Auto, Modern, Year2007 };  // Auto: the look at the tokens

struct Options {
    Dialect dialect = Dialect::Auto;
    // Name of the local event that `ontimer` means; empty: the rule of section 6.
    std::string ontimer = {};
    // The line of the file on which the script begins: sentences that name another line of the
    // script count as the file does. Positions of diagnostics stay those of the script.
    int first_line = 1;
};

}  // namespace vagus::aesl
