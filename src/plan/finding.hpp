// What the checker finds in a plan file (docs/plans.md, section 5).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"

namespace vagus::plan {

using vagus::Severity;

// A mistyped name and the one that was probably meant: for editors that offer to write it.
struct Meant {
    std::string typed;
    std::string name;
    bool is_key = false;  // of the member at the place of the finding; else in its value
};

// A member that the file lacks: of the element at the place of a finding, or of start.
struct Missing {
    std::string part;  // in, states, events; start
    std::string name;
};

struct Finding {
    Severity severity = Severity::Error;
    std::string rule;     // "P8", "W3"
    std::string file;     // path as it was opened
    std::string plan;     // the plan's name
    std::string element;  // innermost actor, supervisor or variable; may be empty
    int line = 0;
    std::string message;  // one sentence: what is wrong, what was expected, how to fix it
    int column = 0;       // from 1, in code points; 0: not known
    std::optional<Meant> meant = {};
    std::optional<Missing> missing = {};
};

using Findings = std::vector<Finding>;

inline bool has_error(const Findings& findings) {
    for (const Finding& finding : findings) {
        if (finding.severity == Severity::Error) return true;
    }
    return false;
}

// What was found, part by part, by line in each file: the file `first` before the others, which
// stay in the order in which they were met.
Findings sorted(const std::vector<Findings>& found, const std::string& first);

// For programs: section 5, `--json`.
std::string format_findings_json(const Findings& findings);

}  // namespace vagus::plan
