// Phase 2: tokens to tree (docs/spec/aesl-language.md, chapters 2 and 3.2). Finds errors of syntax,
// names, declarations, constant expressions, loop bounds and arguments, recovers from each and goes
// on, without a second error for one mistake.
//
// In: text, node, common definitions. Out: the tree; complete and correct in names if no error was
// reported.
#pragma once

#include <string_view>

#include "aesl/diagnostics.hpp"
#include "aesl/options.hpp"
#include "aesl/target.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

Tree parse(std::string_view source, const Target& target, const CommonDefinitions& common,
           const Options& options, Diagnostics& diagnostics);

// The tree after all checks that need no code (phases 0 to 6), for tests and tools that work on
// trees. It is whole only if `errors` is empty.
struct CheckedTree {
    Tree tree;
    std::vector<Diagnostic> errors;  // by position
    size_t first = 0;                // among them: the one that section 3.2 selects
};
CheckedTree parse_and_check(std::string_view source, const Target& target,
                            const CommonDefinitions& common, const Options& options);

}  // namespace vagus::aesl
