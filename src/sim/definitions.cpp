#include "sim/definitions.hpp"

#include <array>

namespace vagus::sim {

std::string_view name_of(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::Wall:
            return "wall";
        case ObjectKind::Box:
            return "box";
        case ObjectKind::Cylinder:
            return "cylinder";
        case ObjectKind::Patch:
            return "patch";
        case ObjectKind::Light:
            return "light";
        case ObjectKind::Infrared:
            return "infrared";
    }
    return "";
}

std::string_view name_of(RobotType type) {
    switch (type) {
        case RobotType::Thymio2:
            return "thymio2";
        case RobotType::Epuck:
            return "epuck";
    }
    return "";
}

uint16_t nodes_of(RobotType type) {
    (void)type;
    return 1;
}

std::span<const std::string_view> buttons_of(RobotType type) {
    // Variables and local events of a Thymio stand in this order (docs/spec, section 5.2).
    static constexpr std::array<std::string_view, 5> kThymio2 = {"backward", "left", "center",
                                                                 "forward", "right"};
    return type == RobotType::Thymio2 ? kThymio2 : std::span<const std::string_view>{};
}

}  // namespace vagus::sim
