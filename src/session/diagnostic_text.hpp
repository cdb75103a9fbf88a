// What the compiler finds in a script, placed in the file that contains the script. As text
// (base/diagnostic.hpp):
//
//     explore.aesl:12:5: error: There is no speeed; did you mean speed? [VARIABLE_NOT_DEFINED]
//        12 | speeed = 3
//           | ^~~~~~
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "aesl/compile.hpp"
#include "base/diagnostic.hpp"

namespace vagus::session {

// Where a script's text comes from: its line 1 is `first_line` of `file`.
struct SourceText {
    std::string file;
    std::string_view source;  // borrowed for the call
    int first_line = 1;
};

// A diagnostic of the compiler in its file, with the line of the script and the marks under it; it
// has no source if it has no position.
Diagnostic in_file(const SourceText& text, const aesl::Diagnostic& diagnostic, Severity severity);

// All errors, then all warnings.
std::vector<Diagnostic> diagnostics_of(const SourceText& text, const aesl::Compilation& done);

}  // namespace vagus::session
