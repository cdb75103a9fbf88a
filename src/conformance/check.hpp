// One thing that a node must do, and what came of looking whether it does.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conformance/bench.hpp"

namespace vagus::conformance {

struct Check {
    std::string group;    // "messages", "opcodes" …
    std::string name;     // what is promised: one line, unlike any other
    std::string section;  // of docs/spec/aseba-wire-and-vm.md, where it is promised
    // Defects of the reference (section 8) for which a node like it fails: "D3 D4". Empty: none.
    std::string defects;
    // Begins with a node without a program, that waits for events.
    std::function<Status(Bench&)> look;
};

enum class Verdict {
    Passed,
    Failed,
    Skipped,  // by its description the node cannot be asked that
    NotRun,   // the node was lost before
};

struct Row {
    Check check;
    Verdict verdict = Verdict::NotRun;
    std::string found;  // Failed: what; Skipped and NotRun: why
};

using Checks = std::vector<Check>;

}  // namespace vagus::conformance
