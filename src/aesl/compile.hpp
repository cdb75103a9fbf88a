// The AESL compiler: source text in, program or diagnostics out (docs/spec/aesl-language.md). Pure:
// no files, no clock.
//
//     const Compilation done = compile("var n\nonevent tick\nn++", target, common, {});
//     if (!done.ok()) for (const Diagnostic& d : done.errors) print(d);
//     else load(done.program.bytecode);
#pragma once

#include <string_view>
#include <vector>

#include "aesl/diagnostic.hpp"
#include "aesl/options.hpp"
#include "aesl/program.hpp"
#include "aesl/target.hpp"

namespace vagus::aesl {

// With errors the program is empty. Errors are in the order of the text, never two for one
// mistake; warnings too.
struct Compilation {
    Program program;
    std::vector<Diagnostic> errors;
    size_t first = 0;  // among the errors: the one that section 3.2 selects
    std::vector<Diagnostic> warnings;

    bool ok() const { return errors.empty(); }
    // There must be an error.
    const Diagnostic& first_error() const { return errors[first]; }
};

Compilation compile(std::string_view source, const Target& target, const CommonDefinitions& common,
                    const Options& options);

}  // namespace vagus::aesl
