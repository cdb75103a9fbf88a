#include "sim/carbot/range_node.hpp"

#include "sim/carbot/node_parts.hpp"

namespace vagus::sim::carbot {
namespace {

#define VAGUS_VARIABLES "sim/carbot/range_variables.def"
#include "sim/node_variables.inl"
static_assert(sizeof(Layout) == 39 * kWord, "docs/carbot.md: 39 words are described");

enum Event : uint8_t { kReached, kEcho, kTickEvent, kHalted };
constexpr node::LocalEvent kEvents[] = {{"reached", "The rotator is where it was told to go"},
                                        {"echo", "sonar.distance has a new value"},
                                        {"tick", "Every 20 ms"},
                                        {"halted", "The node itself has stopped the rotator"}};

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
    : sonar_(seed), machine_(machine_of(kDescription, id, &sonar_, [](void* sonar) {
          static_cast<Sonar*>(sonar)->hold();
      })) {
    machine_.variable(ADDRESS(id)) = static_cast<int16_t>(id);
}

void RangeNode::sense(const Surroundings& around, BodyId body) {
    if (gate_.shuts(machine_, around)) sonar_.hold();
    sonar_.step(around.arena, body, around.now);
    machine_.variable(ADDRESS(rotator_angle)) = sonar_.angle();
    machine_.variable(ADDRESS(sonar_angle)) = sonar_.heard_angle();
    machine_.variable(ADDRESS(sonar_distance)) = sonar_.distance();
    if (machine_.runs()) raise_endings();
    if (around.now % kTick == Duration::zero()) machine_.raise(kTickEvent);
}

// A program that does not run would miss them: they wait until it does.
void RangeNode::raise_endings() {
    if (sonar_.take_reached()) machine_.raise(kReached);
    if (sonar_.take_echo()) machine_.raise(kEcho);
    if (sonar_.take_halted()) machine_.raise(kHalted);
}

}  // namespace vagus::sim::carbot
