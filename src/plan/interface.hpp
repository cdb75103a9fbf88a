// What an actor shows to the outside, whether it is a template or a sub-plan: the
// checker and the graph see both alike. Internal to the module.
#pragma once

#include <vector>

#include "plan/check.hpp"

namespace vagus::plan {

struct Interface {
    std::vector<Input> inputs;
    std::vector<OutputDeclaration> outputs;
    std::vector<Outcome> outcomes;
};

Interface interface_of(const Template& of);
// The variables with access `in`, `out` and `inout`; states OK, Interrupted and Error (P5, P5a).
Interface interface_of(const Plan& sub_plan);

inline constexpr std::string_view kStateOk = "OK";
inline constexpr std::string_view kStateInterrupted = "Interrupted";
inline constexpr std::string_view kStateError = "Error";

// Of the type of the variable, as it is there before anything wrote it (P6).
Value initial_of(const Variable& variable);

// Warnings of section 5, for plans without an error.
void warn(const Checked& checked, const Plan& plan, Findings& findings);

}  // namespace vagus::plan
