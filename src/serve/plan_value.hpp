// Values of a plan as JSON: as they go to a page and come from one.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "plan/value.hpp"

namespace vagus::serve {

// An object has no form outside of the run that holds it: null.
nlohmann::json json_of(const plan::Value& value);

// A whole number is an int, any other a float; what is no value of a plan is an empty object.
plan::Value plan_value(const nlohmann::json& json);

}  // namespace vagus::serve
