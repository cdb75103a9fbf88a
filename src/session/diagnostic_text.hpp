// Diagnostics as people read them, the same on stderr and on the screen:
//
//     explore.aesl:12:5: error: There is no speeed; did you mean speed? [VARIABLE_NOT_DEFINED]
//        12 | speeed = 3
//           | ^~~~~~
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "aesl/compile.hpp"

namespace vagus::session {

// Where a script's text comes from: its line 1 stands on `first_line` of `file`.
struct SourceText {
    std::string file;
    std::string_view source;  // borrowed for the call
    int first_line = 1;
};

enum class Severity { Error, Warning };

// "FILE:LINE:COL: error: sentence [CODE]"; without LINE:COL if the diagnostic has no position.
std::string diagnostic_line(const SourceText& text, const aesl::Diagnostic& diagnostic,
                            Severity severity);

// The line of the script and the marks under it, without newlines; empty if there is no position.
std::vector<std::string> marked_source(const SourceText& text, const aesl::Diagnostic& diagnostic);

// Both, for all errors and then all warnings.
std::vector<std::string> diagnostic_report(const SourceText& text, const aesl::Compilation& done);

}  // namespace vagus::session
