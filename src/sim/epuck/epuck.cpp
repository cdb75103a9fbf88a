#include "sim/epuck/epuck.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "node/natives.hpp"

namespace vagus::sim::epuck {
namespace {

static_assert(sizeof(Layout) == 229 * kWord, "docs/spec 5.3: 229 words are described");

// Sizes in words (docs/spec, 5.3).
constexpr uint16_t kBytecodeSize = 1024;
constexpr uint16_t kStackSize = 32;
constexpr uint16_t kVariablesSize = 485;
constexpr int16_t kProductId = 2;
constexpr Duration kControlStep = std::chrono::milliseconds(30);
constexpr Duration kEnergyEvery = std::chrono::seconds(1);  // one unit is used up
constexpr double kColourMax = 100;
constexpr Colour kBorderColour = {0.9, 0.9, 0.9};

enum Event : uint8_t { kIrSensors, kCamera };
constexpr node::LocalEvent kEvents[] = {{"ir_sensors", "New values of the distance sensors"},
                                        {"camera", "A new picture of the camera"}};

Energy& energy_of(node::Node& node) {
    return *static_cast<Energy*>(Machine::robot_of(node));
}

// The one parameter of all three natives, or nullptr after a fault.
int16_t* amount_of(node::Node& node) {
    return vm::memory(node.vm, vm::pop(node.vm), 1);
}

void shift(uint16_t& from, uint16_t& to, uint16_t amount) {
    const uint16_t room = static_cast<uint16_t>(UINT16_MAX - to);
    const uint16_t moved = std::min({amount, from, room});
    from = static_cast<uint16_t>(from - moved);
    to = static_cast<uint16_t>(to + moved);
}

void energy_send(node::Node& node) {
    Energy& energy = energy_of(node);
    if (const int16_t* const amount = amount_of(node))
        shift(energy.own, energy.pool->amount, static_cast<uint16_t>(*amount));
}

void energy_receive(node::Node& node) {
    Energy& energy = energy_of(node);
    if (const int16_t* const amount = amount_of(node))
        shift(energy.pool->amount, energy.own, static_cast<uint16_t>(*amount));
}

void energy_amount(node::Node& node) {
    if (int16_t* const amount = amount_of(node))
        *amount = static_cast<int16_t>(energy_of(node).pool->amount);
}

constexpr node::Parameter kAmount[] = {{1, "amount"}};
constexpr node::Native kNatives[] = {
    {"energy.send", "Gives energy to the pool of all", kAmount, 1, energy_send},
    {"energy.receive", "Takes energy from the pool of all", kAmount, 1, energy_receive},
    {"energy.amount", "Tells how much energy is in the pool", kAmount, 1, energy_amount}};

node::Description describe(const char* name) {
    return {name,
            wire::kProtocolVersion,
            node::LocalEventSource::Kept,
            static_cast<uint16_t>(std::size(kVariables)),
            kVariables,
            static_cast<uint16_t>(std::size(kEvents)),
            kEvents,
            {{node::kStandardNatives, node::kStandardNativeCount},
             {kNatives, static_cast<uint16_t>(std::size(kNatives))}},
            0};
}

// "e-puckN" with N = id - 1, kept between 0 and 9 (docs/spec, 5.3).
std::string name_for(uint16_t node) {
    return "e-puck" + std::to_string(std::clamp(node - 1, 0, 9));
}

}  // namespace

#define VARIABLE_OF(field) machine_.variable(ADDRESS(field))

Epuck::Epuck(Arena& arena, const RobotDefinition& definition, EnergyPool& pool, uint64_t seed)
    : energy_{&pool},
      name_(name_for(definition.node)),
      description_(describe(name_.c_str())),
      machine_({.description = &description_,
                .id = definition.node,
                .bytecode_size = kBytecodeSize,
                .stack_size = kStackSize,
                .variables_size = kVariablesSize,
                .robot = &energy_}),
      body_(arena, {definition.at, definition.angle}),
      noise_(seed),
      paint_(definition.paint) {
    VARIABLE_OF(id) = static_cast<int16_t>(definition.node);
    VARIABLE_OF(product_id) = kProductId;
    VARIABLE_OF(energy) = static_cast<int16_t>(energy_.own);
}

void Epuck::sense(const Surroundings& around) {
    if (around.now % kEnergyEvery == Duration::zero() && energy_.own > 0) --energy_.own;
    if (around.now % kControlStep != Duration::zero()) return;
    VARIABLE_OF(energy) = static_cast<int16_t>(energy_.own);
    const auto seen = body_.look(around.arena, noise_);
    for (uint16_t i = 0; i < kProxCount; ++i)
        machine_.variable(static_cast<uint16_t>(ADDRESS(prox) + i)) = seen[i];
    see(around);
    machine_.raise(kIrSensors);
    machine_.raise(kCamera);
}

void Epuck::see(const Surroundings& around) {
    const auto columns = body_.look_ahead(around.arena);
    const auto part = [](double value) {
        return static_cast<int16_t>(std::floor(value * kColourMax + 0.5));
    };
    for (uint16_t i = 0; i < kCameraCount; ++i) {
        const BodyId body = columns[i].body;
        Colour colour;  // nothing to see: black
        if (body == kBorder) colour = kBorderColour;
        if (body.index < around.colours.size()) colour = around.colours[body.index];
        machine_.variable(static_cast<uint16_t>(ADDRESS(cam_red) + i)) = part(colour.r);
        machine_.variable(static_cast<uint16_t>(ADDRESS(cam_green) + i)) = part(colour.g);
        machine_.variable(static_cast<uint16_t>(ADDRESS(cam_blue) + i)) = part(colour.b);
    }
}

Time Epuck::next_due(Time now) {
    if (machine_.is_busy()) return now + kNodeStep;
    return std::min((now / kControlStep + 1) * kControlStep,
                    (now / kEnergyEvery + 1) * kEnergyEvery);
}

bool Epuck::drive(Arena& arena, Time) {
    return body_.drive(arena, VARIABLE_OF(speed_left), VARIABLE_OF(speed_right));
}

// The ring of light that the script sets; the paint while it is off.
Colour Epuck::colour() const {
    const auto part = [this](uint16_t address) {
        return std::clamp(machine_.variable(address) / kColourMax, 0.0, 1.0);
    };
    const Colour ring = {part(ADDRESS(color_red)), part(ADDRESS(color_green)),
                         part(ADDRESS(color_blue))};
    return ring == Colour{} ? paint_ : ring;
}

std::vector<Lamp> Epuck::lamps() const {
    const Colour shown = colour();
    return {{"color", {0, 0}, shown == paint_ ? Colour{} : shown}};
}

std::vector<Beam> Epuck::beams(const Arena& arena) const {
    return body_.beams(arena);
}

}  // namespace vagus::sim::epuck
