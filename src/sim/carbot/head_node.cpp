#include "sim/carbot/head_node.hpp"

#include <algorithm>

#include "sim/carbot/head_senses.hpp"
#include "sim/carbot/node_parts.hpp"

namespace vagus::sim::carbot {
namespace {

constexpr Duration kSenseEvery = std::chrono::milliseconds(50);
constexpr int kLightMax = 32;
constexpr Point kLightPlace = {-0.08, 0};

#define VAGUS_VARIABLES "sim/carbot/head_variables.def"
#include "sim/node_variables.inl"
static_assert(sizeof(Layout) == 42 * kWord, "docs/carbot.md: 42 words are described");

enum Event : uint8_t { kInfrared, kColour, kTickEvent };
constexpr node::LocalEvent kEvents[] = {{"infrared", "New values of the infrared sensor"},
                                        {"colour", "New values of the colour sensor"},
                                        {"tick", "Every 20 ms"}};

double level_of(int16_t value) {
    return std::clamp<int>(value, 0, kLightMax) / double{kLightMax};
}

void set_light(node::Node& node) {
    const int16_t red = pop_word(node);
    const int16_t green = pop_word(node);
    const int16_t blue = pop_word(node);
    *static_cast<Colour*>(Machine::robot_of(node)) = {level_of(red), level_of(green),
                                                      level_of(blue)};
}

constexpr node::Parameter kLightParameters[] = {{1, "red"}, {1, "green"}, {1, "blue"}};
constexpr node::Native kNatives[] = {
    {"leds.top", "Sets the light on top: 0 to 32 each", kLightParameters, 3, set_light}};

constexpr node::Description kDescription = describe({"head", kVariables, kEvents, kNatives});

}  // namespace

HeadNode::HeadNode(uint16_t id, uint64_t seed)
    : noise_(seed), machine_(machine_of(kDescription, id, &light_)) {
    machine_.variable(ADDRESS(id)) = static_cast<int16_t>(id);
}

void HeadNode::sense(const Surroundings& around, BodyId body) {
    if (around.now % kSenseEvery == Duration::zero()) perceive(around, body);
    if (around.now % kTick == Duration::zero()) machine_.raise(kTickEvent);
}

void HeadNode::perceive(const Surroundings& around, BodyId body) {
    const InfraredReading beacon = look_for_beacon(around.arena, body, around.beacons, noise_);
    machine_.variable(ADDRESS(infrared_direction)) = beacon.direction;
    machine_.variable(ADDRESS(infrared_intensity)) = beacon.intensity;
    const ColourReading seen = look_at_colour(around.arena, body, around.colours);
    machine_.variable(ADDRESS(colour_near)) = seen.near;
    for (uint16_t i = 0; i < seen.rgb.size(); ++i)
        machine_.variable(static_cast<uint16_t>(ADDRESS(colour_rgb) + i)) = seen.rgb[i];
    machine_.raise(kInfrared);
    machine_.raise(kColour);
}

Lamp HeadNode::lamp() const {
    return {"leds.top", kLightPlace, light_};
}

}  // namespace vagus::sim::carbot
