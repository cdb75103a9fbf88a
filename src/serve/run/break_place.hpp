// Whether a plan has what a breakpoint is set on: a name with a slip in it would never be met.
#pragma once

#include "plan/model.hpp"
#include "plan/template.hpp"
#include "serve/run/plan_breakpoints.hpp"

namespace vagus::serve {

// NotFound with what there is. States and events are those that the element has rules for, and
// those of its template, if the library knows that.
Status check_break_place(const PlanBreakpoint& wanted, const plan::Plan& plan,
                         const plan::Library& library);

// Whether the plan has the variables that its condition reads, if that is a formula. NotFound with
// what there is.
Status check_break_variables(const PlanBreakpoint& wanted, const plan::Plan& plan);

// Whether its condition is a formula, if it has one. The Error says at which column it is none.
Status check_break_condition(const PlanBreakpoint& wanted);

}  // namespace vagus::serve
