// What a person gives a plan by hand: JSON of a page made into what its debugger is asked for.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "run/debugger.hpp"

namespace vagus::serve {

inline plan::Value value_of(const nlohmann::json& json) {
    if (json.is_boolean()) return plan::Value(json.get<bool>());
    if (json.is_number_integer()) return plan::Value(json.get<int64_t>());
    if (json.is_number()) return plan::Value(json.get<double>());
    return plan::Value(json.is_string() ? json.get<std::string>() : json.dump());
}

// An event as if its supervisor had raised it.
inline run::RaiseEvent raised_event(const nlohmann::json& told) {
    run::RaiseEvent event{told["supervisor"], told["event"], {}};
    for (const auto& [name, value] : told["outputs"].items()) {
        event.outputs.emplace_back(name, value_of(value));
    }
    return event;
}

}  // namespace vagus::serve
