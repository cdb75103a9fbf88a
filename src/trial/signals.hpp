// The signals that the conditions of a test may use beside the variables of its plan
// (docs/testing.md): the one list from which conditions, values, help and completion come.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "plan/value.hpp"

namespace vagus::trial {

enum class SignalId : uint8_t { Actor, Event, Time, X, Y, Angle, Contact, Bus };

struct Signal {
    SignalId id;
    std::string_view name;
    plan::Type type;
    std::string_view unit;  // empty: a text
    bool of_world;          // there is none without a world
    std::string_view help;
};

std::span<const Signal> signals();
// nullptr if there is none of that name.
const Signal* find_signal(std::string_view name);

// The list as lines for people: name, unit, help, and how to write what is no plain name.
std::string describe_signals();

}  // namespace vagus::trial
