#include "sim/definitions.hpp"

#include <array>

#include "base/nearest.hpp"

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
        case RobotType::Carbot:
            return "carbot";
    }
    return "";
}

uint16_t nodes_of(RobotType type) {
    return type == RobotType::Carbot ? 4 : 1;
}

bool feels_knocks(RobotType type) {
    return type == RobotType::Thymio2;
}

bool sees_colours(RobotType type) {
    return type != RobotType::Thymio2;
}

std::span<const std::string_view> buttons_of(RobotType type) {
    // Variables and local events of a Thymio are in this order (docs/spec, section 5.2).
    static constexpr std::array<std::string_view, 5> kThymio2 = {"backward", "left", "center",
                                                                 "forward", "right"};
    static constexpr std::array<std::string_view, 1> kCarbot = {"escape"};
    switch (type) {
        case RobotType::Thymio2:
            return kThymio2;
        case RobotType::Epuck:
            return {};
        case RobotType::Carbot:
            return kCarbot;
    }
    return {};
}

std::string no_robot(const WorldDefinition& world, const std::string& name,
                     std::string_view where) {
    std::vector<std::string> known;
    for (const RobotDefinition& robot : world.robots) known.push_back(robot.name);
    return "there is no robot \"" + name + "\"" + std::string(where) + "; " +
           known_instead(name, known);
}

}  // namespace vagus::sim
