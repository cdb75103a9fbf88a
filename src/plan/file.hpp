// Plan files (`NAME.plan.json`; docs/plans.md, section 2; docs/formats.md).
//
//     const PlanFile file = parse_plan(text, "WallFollow.plan.json");
//     if (!file.readable) show(file.findings);      // a P0 finding: nothing else was checked
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "plan/finding.hpp"
#include "plan/model.hpp"

namespace vagus::plan {

struct PlanFile {
    Plan plan;
    Findings findings;      // P0 and P1
    bool readable = false;  // no P0 finding: the plan is complete enough to be checked further
};

PlanFile parse_plan(std::string_view text, std::string_view path);

// The saved form: keys in the format's order, names in theirs. Fails where parse_plan would find a
// P0.
Result<std::string> format_plan(std::string_view text, std::string_view path);

}  // namespace vagus::plan
