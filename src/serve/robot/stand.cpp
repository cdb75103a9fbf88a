#include "serve/robot/stand.hpp"

#include <algorithm>

namespace vagus::serve {

namespace {

// Thymio II and its playground; the e-puck (docs/spec/aseba-wire-and-vm.md, 5.2 and 5.3).
const std::vector<std::vector<std::string>> kWheels = {
    {"motor.left.target", "motor.right.target"},
    {"speed.left", "speed.right"},
};

}  // namespace

std::vector<std::string> driving_variables(const aesl::Target& node) {
    const auto has = [&](const std::string& name) {
        return std::any_of(node.variables.begin(), node.variables.end(),
                           [&](const auto& variable) { return variable.name == name; });
    };
    for (const auto& wheels : kWheels) {
        if (std::all_of(wheels.begin(), wheels.end(), has)) return wheels;
    }
    return {};
}

}  // namespace vagus::serve
