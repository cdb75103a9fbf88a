// The keys of our JSON formats in the order of saving: where a new member goes, and how a new
// object is written (docs/formats.md).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vagus::serve {

using KeyOrder = std::span<const std::string_view>;

// Of the object that these keys and indices lead to ("[]" for every index), in a file of that
// language ("plan", "world", "toolbox", "project"); empty where names are free or nothing is known.
KeyOrder key_order(std::string_view language, const std::vector<std::string>& path);

}  // namespace vagus::serve
