// An event that a person raises by hand: JSON of a page made into what the debugger of the plan is
// asked for.
#pragma once

#include <nlohmann/json.hpp>

#include "run/debugger.hpp"
#include "serve/plan_value.hpp"

namespace vagus::serve {

inline run::RaiseEvent raised_event(const nlohmann::json& told) {
    run::RaiseEvent event{told["supervisor"], told["event"], {}};
    for (const auto& [name, value] : told["outputs"].items()) {
        event.outputs.emplace_back(name, plan_value(value));
    }
    return event;
}

}  // namespace vagus::serve
