// A chain of causes as people read it, in a terminal and at a prompt.
#pragma once

#include <string>
#include <string_view>

#include "record/why.hpp"

namespace vagus::cli {

constexpr size_t kLinksShown = 20;  // of a long chain, before the last

// A line each. Of a long chain only the newest and the beginning, if `more` says how the others
// are shown; empty: all of it.
std::string chain_text(const record::Chain& chain, std::string_view more);

}  // namespace vagus::cli
