#include "sim/robot_grid.hpp"

#include <charconv>

namespace vagus::sim {
namespace {

constexpr std::string_view kRobots = "robots[";

// How many robots an entry stands for.
size_t robots_of(const JsonValue& entry) {
    const JsonValue* grid = entry.find("grid");
    if (grid == nullptr || grid->items.size() != 2) return 1;
    const double count = grid->items[0].number * grid->items[1].number;
    return count >= 1 ? static_cast<size_t>(count) : 1;
}

}  // namespace

std::vector<RobotDefinition> spread(const RobotDefinition& first, const RobotGrid& grid) {
    std::vector<RobotDefinition> robots;
    for (size_t i = 0; i < grid.columns * grid.rows; ++i) {
        RobotDefinition& robot = robots.emplace_back(first);
        robot.name += std::to_string(i + 1);
        robot.at.x += static_cast<double>(i % grid.columns) * grid.spacing.x;
        robot.at.y += static_cast<double>(i / grid.columns) * grid.spacing.y;
        if (!first.project.empty()) continue;
        robot.node = static_cast<uint16_t>(first.node + i * nodes_of(first.type));
    }
    return robots;
}

size_t entry_of_robot(const JsonValue& robots, size_t robot) {
    size_t before = 0;
    for (size_t entry = 0; entry < robots.items.size(); ++entry) {
        before += robots_of(robots.items[entry]);
        if (robot < before) return entry;
    }
    return robots.items.size();
}

std::string element_of_file(const JsonValue& world, const std::string& element) {
    const JsonValue* robots = world.find("robots");
    if (robots == nullptr || !element.starts_with(kRobots)) return element;
    size_t robot = 0;
    const char* const begin = element.data() + kRobots.size();
    const char* const end = element.data() + element.size();
    const auto read = std::from_chars(begin, end, robot);
    if (read.ec != std::errc()) return element;
    return std::string(kRobots) + std::to_string(entry_of_robot(*robots, robot)) +
           std::string(read.ptr, end);
}

}  // namespace vagus::sim
