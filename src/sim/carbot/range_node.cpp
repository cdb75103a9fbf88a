#include "sim/carbot/range_node.hpp"

#include "sim/carbot/node_parts.hpp"

namespace vagus::sim::carbot {
namespace {

constexpr size_t kWord = sizeof(int16_t);

// Addresses are offsets in here; the memory itself is that of the machine.
struct Layout {
#define VARIABLE(field, name, words) int16_t field[words];
#include "sim/carbot/range_variables.def"
#undef VARIABLE
};
static_assert(sizeof(Layout) == 37 * kWord, "docs/carbot.md: 37 words are described");
#define ADDRESS(field) static_cast<uint16_t>(offsetof(Layout, field) / kWord)

constexpr node::Variable kVariables[] = {
#define VARIABLE(field, name, words) {words, name},
#include "sim/carbot/range_variables.def"
#undef VARIABLE
};

enum Event : uint8_t { kReached, kEcho, kTickEvent };
constexpr node::LocalEvent kEvents[] = {{"reached", "The rotator stands where it was told"},
                                        {"echo", "sonar.distance has a new value"},
                                        {"tick", "Every 20 ms"}};

constexpr node::Description kDescription = describe({"range", kVariables, kEvents, {}});

}  // namespace

RangeNode::RangeNode(uint16_t id) : machine_(machine_of(kDescription, id, nullptr)) {
    machine_.variable(ADDRESS(id)) = static_cast<int16_t>(id);
}

void RangeNode::sense(const Surroundings& around) {
    if (around.now % kTick == Duration::zero()) machine_.raise(kTickEvent);
}

}  // namespace vagus::sim::carbot
