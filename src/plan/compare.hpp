// How two values compare: for the templates `Compare` and `Watch`, and for debuggers.
#pragma once

#include <string_view>

#include "base/result.hpp"
#include "plan/value.hpp"

namespace vagus::plan {

// `op` is one of == != < <= > >=. Two strings by their bytes; objects only with each other, by ==
// and !=; all else as numbers (docs/plans.md, section 7, `Compare`). The Error says what does not
// compare; it names no place.
Result<bool> compare(const Value& left, std::string_view op, const Value& right);

}  // namespace vagus::plan
