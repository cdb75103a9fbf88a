// What the four nodes of a Carbot have in common: sizes, and how a description is put together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>

#include "node/natives.hpp"
#include "sim/machine.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

// Sizes in words, and the rate of their local event `tick` (docs/carbot.md).
constexpr uint16_t kBytecodeSize = 2048;
constexpr uint16_t kStackSize = 32;
constexpr uint16_t kVariablesSize = 640;
constexpr Duration kTick = std::chrono::milliseconds(20);

// The places of the nodes: their ids count from that of the first.
enum Place : uint16_t { kDrive, kBumper, kRange, kHead, kPlaces };

struct NodeTexts {
    const char* name;
    std::span<const node::Variable> variables;
    std::span<const node::LocalEvent> events;
    std::span<const node::Native> natives;
};

// The last of the variables is `_program`.
constexpr node::Description describe(const NodeTexts& texts) {
    uint16_t words = 0;
    for (const node::Variable& variable : texts.variables) words += variable.size;
    return {texts.name,
            wire::kProtocolVersion,
            node::LocalEventSource::OwnId,
            static_cast<uint16_t>(texts.variables.size()),
            texts.variables.data(),
            static_cast<uint16_t>(texts.events.size()),
            texts.events.data(),
            {{node::kStandardNatives, node::kStandardNativeCount},
             {texts.natives.data(), static_cast<uint16_t>(texts.natives.size())}},
            static_cast<uint16_t>(words - texts.variables.back().size)};
}

// `robot` is what the natives of the node get from Machine::robot_of(), and `broken_off`.
inline MachineDefinition machine_of(const node::Description& description, uint16_t id, void* robot,
                                    void (*broken_off)(void* robot) = nullptr) {
    return {.description = &description,
            .id = id,
            .bytecode_size = kBytecodeSize,
            .stack_size = kStackSize,
            .variables_size = kVariablesSize,
            .robot = robot,
            .broken_off = broken_off};
}

// The value of a native's parameter of one word, 0 after a fault; pops its address.
inline int16_t pop_word(node::Node& node) {
    const int16_t* const word = vm::memory(node.vm, vm::pop(node.vm), 1);
    return word == nullptr ? int16_t{0} : *word;
}

}  // namespace vagus::sim::carbot
