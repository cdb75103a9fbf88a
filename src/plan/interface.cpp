#include "plan/interface.hpp"

namespace vagus::plan {

Interface interface_of(const Template& of) {
    return {of.inputs, of.outputs, of.outcomes};
}

Interface interface_of(const Plan& sub_plan) {
    Interface face;
    for (const Variable& variable : sub_plan.configuration) {
        if (!variable.access) continue;
        if (is_input(*variable.access)) {
            Input input{.name = variable.name, .type = variable.type};
            if (variable.initial && variable.type) input.fallback = initial_of(variable);
            if (variable.initial && !variable.type) input.fallback = variable.initial;
            face.inputs.push_back(std::move(input));
        }
        if (is_output(*variable.access)) {
            face.outputs.push_back({.name = variable.name, .type = variable.type});
        }
    }
    for (const std::string_view state : {kStateOk, kStateInterrupted, kStateError}) {
        face.outcomes.push_back({.name = std::string(state)});
    }
    return face;
}

Value initial_of(const Variable& variable) {
    const Type type = variable.type.value_or(Type::Int);
    if (!variable.initial) return default_of(type);
    const Result<Value> converted = convert(*variable.initial, type);
    return converted.ok() ? converted.value() : default_of(type);
}

}  // namespace vagus::plan
