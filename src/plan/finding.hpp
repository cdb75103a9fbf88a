// What the checker finds in a plan file (docs/plans.md, section 5).
#pragma once

#include <string>
#include <vector>

namespace vagus::plan {

enum class Severity { Error, Warning };

struct Finding {
    Severity severity = Severity::Error;
    std::string rule;     // "P8", "W3"
    std::string file;     // path as it was opened
    std::string plan;     // the plan's name
    std::string element;  // innermost actor, supervisor or variable; may be empty
    int line = 0;
    std::string message;  // one sentence: what is wrong, what was expected, how to mend it
};

using Findings = std::vector<Finding>;

inline bool has_error(const Findings& findings) {
    for (const Finding& finding : findings) {
        if (finding.severity == Severity::Error) return true;
    }
    return false;
}

}  // namespace vagus::plan
