// A generated plan beside the plan that it was generated from.
#pragma once

#include <span>
#include <string_view>

#include "embed/plan_code.hpp"

namespace vagus {

struct GeneratedCase {
    std::string_view name;  // "15-sub-plan-interrupted" of the golden plans, "random-7" of seed 7
    embed::MakePlan make;
};

// In four files, so that two cores can compile them.
std::span<const GeneratedCase> generated_batch0();
std::span<const GeneratedCase> generated_batch1();
std::span<const GeneratedCase> generated_batch2();
std::span<const GeneratedCase> generated_batch3();

}  // namespace vagus
