// What is wrong, or doubtful, with a file: as a value, until someone reads it. Compilers and
// checkers make diagnostics, verbs and views choose among their parts; text_of() is the one way in
// which they become a line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "base/text.hpp"

namespace vagus {

// The word of every message with a place: an Error keeps the file from being used.
enum class Severity { Error, Warning };

struct Diagnostic {
    Severity severity = Severity::Error;
    std::string file;      // empty: the sentence says itself where
    Place at;              // line 0: of the whole file
    std::string sentence;  // what was expected, what was found, how to fix it
    std::string code;      // of the rule or in the catalogue of the compiler; may be empty
    // The line of the file and the marks under it, for those who have room to show them.
    std::vector<std::string> source;
};

inline std::string_view name_of(Severity severity) {
    return severity == Severity::Error ? "error" : "warning";
}

// "explore.aesl:12:5: error: There is no speeed; did you mean speed? [VARIABLE_NOT_DEFINED]"
inline std::string text_of(const Diagnostic& diagnostic) {
    if (diagnostic.file.empty()) return visible(diagnostic.sentence);
    std::string line = at_file(diagnostic.file, diagnostic.at) + ": ";
    line += std::string(name_of(diagnostic.severity)) + ": " + diagnostic.sentence;
    return visible(diagnostic.code.empty() ? line : line + " [" + diagnostic.code + "]");
}

// The line and its source below, each with its newline.
inline std::string report_of(const Diagnostic& diagnostic) {
    std::string text = text_of(diagnostic) + "\n";
    for (const std::string& line : diagnostic.source) text += line + "\n";
    return text;
}

}  // namespace vagus
