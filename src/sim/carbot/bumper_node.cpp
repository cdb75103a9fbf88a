#include "sim/carbot/bumper_node.hpp"

#include "sim/carbot/node_parts.hpp"

namespace vagus::sim::carbot {
namespace {

#define VAGUS_VARIABLES "sim/carbot/bumper_variables.def"
#include "sim/node_variables.inl"
static_assert(sizeof(Layout) == 50 * kWord, "docs/carbot.md: 50 words are described");
static_assert(sizeof(Layout::touch_sectors) == kSectors * kWord, "one word for each sector");

enum Event : uint8_t { kTouch, kButton, kTickEvent };
constexpr node::LocalEvent kEvents[] = {{"touch", "A sector was pressed or released"},
                                        {"button", "The escape button was pressed or released"},
                                        {"tick", "Every 20 ms"}};

constexpr node::Description kDescription = describe({"bumper", kVariables, kEvents, {}});

}  // namespace

BumperNode::BumperNode(uint16_t id) : machine_(machine_of(kDescription, id, nullptr)) {
    machine_.variable(ADDRESS(id)) = static_cast<int16_t>(id);
}

void BumperNode::sense(const Surroundings& around, BodyId body) {
    parts_.clear();
    around.arena.touched_parts(body, parts_);
    ring_.feel(parts_, around.now);
    bool changed = false;
    for (size_t i = 0; i < kSectors; ++i) {
        int16_t& sector = machine_.variable(static_cast<uint16_t>(ADDRESS(touch_sectors) + i));
        const int16_t value = ring_.pressed(i) ? 1 : 0;
        changed = changed || sector != value;
        sector = value;
    }
    machine_.variable(ADDRESS(touch_count)) = static_cast<int16_t>(ring_.count());
    if (changed) machine_.raise(kTouch);
    if (around.now % kTick == Duration::zero()) machine_.raise(kTickEvent);
}

void BumperNode::set_escape(bool pressed) {
    int16_t& button = machine_.variable(ADDRESS(button_escape));
    const int16_t value = pressed ? 1 : 0;
    if (button == value) return;
    button = value;
    machine_.raise(kButton);
}

}  // namespace vagus::sim::carbot
