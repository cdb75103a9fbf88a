// Declarations and readings of inputs that several templates of Carbot share.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "plan/template.hpp"
#include "plan/value.hpp"
#include "run/code.hpp"

namespace vagus::toolbox::carbot {

inline plan::Input speed_input() {
    return {.name = "speed",
            .type = plan::Type::Float,
            .fallback = plan::Value(20.0),
            .unit = "cm/s",
            .help = "how fast",
            .low = 0.1,
            .high = 31};
}

inline plan::Input step_input() {
    return {.name = "step",
            .type = plan::Type::Float,
            .fallback = plan::Value(10.0),
            .unit = "deg",
            .help = "from one measurement to the next",
            .low = 1,
            .high = 90};
}

inline plan::Input side_input(std::string choices) {
    return {.name = "side",
            .type = plan::Type::String,
            .fallback = plan::Value(std::string("right")),
            .help = "where the wall is to be: " + std::move(choices)};
}

// A number of the input at `index`, within the declared range: outside of it is an internal error
// that names both, as for templates of toolbox files.
inline double input_of(const run::ActorContext& context, const plan::Template& of, size_t index) {
    const plan::Input& input = of.inputs[index];
    const plan::Value& value = context.in(index);
    const double number =
        input.type == plan::Type::Int ? static_cast<double>(value.integer()) : value.number();
    const double low = input.low.value_or(number);
    const double high = input.high.value_or(number);
    if (number >= low && number <= high) return number;
    throw run::CodeError(fmt::format("the input \"{}\" is {}, but must be from {} to {}",
                                     input.name, plan::text_of(number), plan::text_of(low),
                                     plan::text_of(high)));
}

}  // namespace vagus::toolbox::carbot
