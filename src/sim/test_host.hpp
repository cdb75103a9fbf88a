// For tests: worlds, a host on the bus of one, and programs for its nodes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "hub/hub.hpp"
#include "sim/world.hpp"
#include "wire/messages.hpp"

namespace vagus::sim {

inline World make_world(const WorldDefinition& definition, WorldOptions options = {}) {
    Result<World> world = World::create(definition, std::move(options));
    EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().what);
    return std::move(world.value());
}

// A host on the bus of a world.
class Host {
public:
    explicit Host(hub::Hub& bus) : bus_(bus), link_(bus.add({.name = "host"}).value()) {}

    template <typename Message>
    void send(const Message& message) {
        wire::Frame frame;
        ASSERT_EQ(wire::encode_message(message, wire::kHostId, frame), wire::Error::None);
        bus_.receive(link_, frame);
    }
    template <typename Command>
    void command(uint16_t node) {
        Command message{};
        message.dest = node;
        send(message);
    }
    void load(uint16_t node, const std::vector<uint16_t>& program) {
        wire::SetBytecode load{};
        load.dest = node;
        load.words.count = static_cast<uint16_t>(program.size());
        for (size_t i = 0; i < program.size(); ++i)
            load.words.values[i] = static_cast<int16_t>(program[i]);
        send(load);
        command<wire::Run>(node);
    }
    void set(uint16_t node, uint16_t start, const std::vector<int16_t>& values) {
        wire::SetVariables message{};
        message.dest = node;
        message.start = start;
        message.values.count = static_cast<uint16_t>(values.size());
        std::copy(values.begin(), values.end(), message.values.values);
        send(message);
    }
    std::vector<wire::Frame> frames() {
        std::vector<wire::Frame> all;
        wire::Frame frame;
        while (bus_.take(link_, frame)) all.push_back(frame);
        return all;
    }

private:
    hub::Hub& bus_;
    hub::LinkId link_;
};

constexpr uint16_t id_of(uint16_t local_event) {
    return static_cast<uint16_t>(0xfffe - local_event);
}

// A program that adds 1 to variable 100 + i when the i-th of these local events happens.
inline std::vector<uint16_t> counting(const std::vector<uint16_t>& events) {
    const auto size = static_cast<uint16_t>(2 * events.size() + 1);
    std::vector<uint16_t> words = {size};
    for (size_t i = 0; i < events.size(); ++i) {
        words.push_back(id_of(events[i]));
        words.push_back(static_cast<uint16_t>(size + 5 * i));
    }
    for (size_t i = 0; i < events.size(); ++i) {
        const auto address = static_cast<uint16_t>(100 + i);
        words.insert(words.end(), {static_cast<uint16_t>(0x3000 | address), 0x1001, 0x8002,
                                   static_cast<uint16_t>(0x4000 | address), 0x0000});
    }
    return words;
}

}  // namespace vagus::sim
