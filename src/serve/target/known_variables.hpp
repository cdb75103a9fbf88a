// What the variables of known robots are: nodes tell names and sizes alone.
#pragma once

#include <string_view>

namespace vagus::serve {

struct KnownVariable {
    std::string_view node;  // name of the node
    std::string_view name;
    bool writable = false;  // writing it has an effect; all others are written by the node
    std::string_view unit;
    std::string_view help;
};

// nullptr: nothing is known of it.
const KnownVariable* known_variable(std::string_view node, std::string_view name);

}  // namespace vagus::serve
