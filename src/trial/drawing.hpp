// A plan as a drawing (SVG), coloured by what a set of runs went through: green with a count what
// was taken, red and dashed what was not.
//
//     TRY(write_file("WallFollow.svg", draw_coverage(plan, coverage.plans.at(plan.file))));
#pragma once

#include <string>

#include "plan/model.hpp"
#include "trial/coverage.hpp"

namespace vagus::trial {

constexpr std::string_view kDrawingBegins = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=";
std::string draw_coverage(const plan::Plan& plan, const PlanCoverage& coverage);

}  // namespace vagus::trial
