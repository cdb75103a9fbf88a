// What a debugger sees of a machine that is between two decisions, and how the names that a
// person gives are found in it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "plan/machine.hpp"
#include "run/debug_values.hpp"

namespace vagus::run {

Where look(const plan::Machine& machine);

// In each case NotFound names what there is instead.
Result<plan::Value> evaluate(const plan::Machine& machine, int level, std::string_view expression);
Result<int> find_variable(const plan::Machine& machine, int level, const std::string& name);

struct Raised {
    plan::WatchId watch;
    plan::Given given;
};
// A supervisor that watches, from the outermost plan inwards, its event and its outputs.
Result<Raised> find_raised(const plan::Machine& machine, const std::string& supervisor,
                           const std::string& event,
                           const std::vector<std::pair<std::string, plan::Value>>& outputs);

}  // namespace vagus::run
