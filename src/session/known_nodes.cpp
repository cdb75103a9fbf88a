#include "session/known_nodes.hpp"

#include <cassert>
#include <iterator>

#include "session/sim_session.hpp"
#include "session/standard_target.hpp"

namespace vagus::session {
namespace {

constexpr Duration kAnswerWithin = std::chrono::seconds(5);  // simulated

// A robot says what it is when it is asked over the bus: it is not written elsewhere.
aesl::Target describe(sim::RobotType type, uint16_t place) {
    sim::WorldDefinition world;
    sim::RobotDefinition& robot_definition = world.robots.emplace_back();
    robot_definition.name = "robot";
    robot_definition.type = type;
    robot_definition.at = {0.5, 0.5};
    auto made = sim::World::create(world);
    assert(made.ok());  // nothing in it comes from outside
    SimSession session(std::move(made.value()), {});
    const auto node = static_cast<uint16_t>(world.robots.front().node + place);
    while (session.target(node) == nullptr && session.now() < kAnswerWithin) {
        session.step(sim::kNodeStep);
    }
    assert(session.target(node) != nullptr);
    return *session.target(node);
}

constexpr std::string_view kCarbotNodes[] = {"drive", "bumper", "range", "head"};

}  // namespace

aesl::Target known_node(std::string_view name) {
    if (name == "thymio-II") return describe(sim::RobotType::Thymio2, 0);
    if (name.starts_with("e-puck")) return describe(sim::RobotType::Epuck, 0);
    for (uint16_t place = 0; place < std::size(kCarbotNodes); place++) {
        if (name == kCarbotNodes[place]) return describe(sim::RobotType::Carbot, place);
    }
    return standard_target(name.empty() ? "dummynode-0" : std::string(name));
}

}  // namespace vagus::session
