#include "sim/carbot/range_node.hpp"

#include "sim/carbot/node_parts.hpp"

namespace vagus::sim::carbot {
namespace {

#define VAGUS_VARIABLES "sim/carbot/range_variables.def"
#include "sim/node_variables.inl"
static_assert(sizeof(Layout) == 37 * kWord, "docs/carbot.md: 37 words are described");

enum Event : uint8_t { kReached, kEcho, kTickEvent };
constexpr node::LocalEvent kEvents[] = {{"reached", "The rotator stands where it was told"},
                                        {"echo", "sonar.distance has a new value"},
                                        {"tick", "Every 20 ms"}};

Sonar& sonar_of(node::Node& node) {
    return *static_cast<Sonar*>(Machine::robot_of(node));
}

void turn(node::Node& node) {
    sonar_of(node).turn(pop_word(node));
}

void ping(node::Node& node) {
    sonar_of(node).ping();
}

constexpr node::Parameter kTurnParameters[] = {{1, "angle"}};
constexpr node::Native kNatives[] = {
    {"rotator.turn", "Turns the rotator: 0.1 deg", kTurnParameters, 1, turn},
    {"sonar.ping", "Measures", nullptr, 0, ping}};

constexpr node::Description kDescription = describe({"range", kVariables, kEvents, kNatives});

}  // namespace

RangeNode::RangeNode(uint16_t id, uint64_t seed)
    : sonar_(seed), machine_(machine_of(kDescription, id, &sonar_)) {
    machine_.variable(ADDRESS(id)) = static_cast<int16_t>(id);
}

void RangeNode::sense(const Surroundings& around, BodyId body) {
    sonar_.step(around.arena, body, around.now);
    machine_.variable(ADDRESS(rotator_angle)) = sonar_.angle();
    machine_.variable(ADDRESS(sonar_angle)) = sonar_.heard_angle();
    machine_.variable(ADDRESS(sonar_distance)) = sonar_.distance();
    if (sonar_.take_reached()) machine_.raise(kReached);
    if (sonar_.take_echo()) machine_.raise(kEcho);
    if (around.now % kTick == Duration::zero()) machine_.raise(kTickEvent);
}

}  // namespace vagus::sim::carbot
