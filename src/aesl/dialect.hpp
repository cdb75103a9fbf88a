// Which AESL a text is written in: modern, or that of 2007 (docs/spec/aesl-language.md, section 6).
#pragma once

#include <string_view>

#include "aesl/options.hpp"
#include "aesl/target.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

constexpr std::string_view kOntimer = "ontimer";

// With Dialect::Auto a look at the tokens of the whole text decides: a colon behind a header, or an
// `ontimer` header. It has to come before the parser, because what it switches on is above the
// headers.
bool is_year_2007(const Tree& tree, const Target& target, const CommonDefinitions& common,
                  Dialect dialect);

}  // namespace vagus::aesl
