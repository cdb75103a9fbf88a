// For tests: a Network on scripted time whose frames
// are written and read as the hex dumps of the wire spec (2.10).
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "debug/network.hpp"
#include "wire/messages.hpp"

namespace vagus::debug {

using std::chrono::milliseconds;

// Frames of the wire spec, 2.10, from and for node 1.
inline constexpr const char* kPresent1 = "02 00 01 00 0c 90 05 00";
inline constexpr const char* kRun = "02 00 00 00 03 a0 01 00";
inline constexpr const char* kGetState = "02 00 00 00 07 a0 01 00";
inline constexpr const char* kClearAll = "02 00 00 00 0a a0 01 00";

class ScriptedBus {
public:
    Network network;
    Time now{};
    std::vector<Event> events;

    // A whole stream frame, "02 00 01 00 0c 90 05 00".
    void node_says(const std::string& hex) {
        std::istringstream text(hex);
        std::vector<uint8_t> bytes;
        for (int byte = 0; text >> std::hex >> byte;) bytes.push_back(static_cast<uint8_t>(byte));
        wire::FrameReader reader;
        ASSERT_EQ(reader.feed(bytes.data(), static_cast<uint16_t>(bytes.size())), bytes.size());
        ASSERT_TRUE(reader.complete()) << hex;
        network.receive(now, reader.frame());
        collect();
    }
    template <typename Message>
    void node_sends(NodeId id, const Message& message) {
        wire::Frame frame;
        ASSERT_EQ(wire::encode_message(message, id, frame), wire::Error::None);
        network.receive(now, frame);
        collect();
    }
    void state(NodeId id, uint16_t pc, uint16_t flags) {
        wire::ExecutionStateChanged message{};
        message.pc = pc;
        message.flags = flags;
        node_sends(id, message);
    }

    // Time passes in one leap.
    void pass(Time duration) {
        now += duration;
        network.tick(now);
        collect();
    }

    // Frames since the last call, one string each; without ListNodes and GetDescription, which
    // only keep time.
    std::vector<std::string> sent() {
        std::vector<std::string> dumps;
        for (const wire::Frame& frame : network.take_frames()) {
            if (frame.type != 0xa011 && frame.type != 0xa000) dumps.push_back(dump(frame));
        }
        return dumps;
    }
    std::vector<std::string> sent_all() {
        std::vector<std::string> dumps;
        for (const wire::Frame& frame : network.take_frames()) dumps.push_back(dump(frame));
        return dumps;
    }

    // Events of that kind since the last call of forget().
    template <typename Kind>
    std::vector<Kind> told() {
        collect();
        std::vector<Kind> found;
        for (const Event& event : events) {
            if (const auto* kind = std::get_if<Kind>(&event.what)) found.push_back(*kind);
        }
        return found;
    }
    void forget() {
        collect();
        events.clear();
        network.take_frames();
    }

    // Node `id`, named "robot": 3000 words of program, 3 variables on 34 words of 800, one event
    // "tick".
    // Ends described and, as freshly started nodes are, running with pc 0.
    void meet_robot(NodeId id) {
        wire::NodePresent present{};
        present.version = 5;
        node_sends(id, present);
        describe_robot(id);
        state(id, 0, 0);
        forget();
    }
    void describe_robot(NodeId id, uint16_t bytecode_size = 3000) {
        wire::Description header{};
        header.name = {"robot", 5};
        header.protocol_version = 5;
        header.bytecode_size = bytecode_size;
        header.stack_size = 32;
        header.variables_size = 800;
        header.variable_count = 3;
        header.local_event_count = 1;
        node_sends(id, header);
        variable(id, "id", 1);
        variable(id, "source", 1);
        variable(id, "args", 32);
        wire::LocalEventDescription event{};
        event.name = {"tick", 4};
        event.doc = {"each second", 11};
        node_sends(id, event);
    }
    void variable(NodeId id, const std::string& name, uint16_t size) {
        wire::NamedVariableDescription message{};
        message.size = size;
        message.name = {name.data(), static_cast<uint8_t>(name.size())};
        node_sends(id, message);
    }

private:
    void collect() {
        for (Event& event : network.take_events()) events.push_back(std::move(event));
    }
    static std::string dump(const wire::Frame& frame) {
        uint8_t bytes[wire::kFrameMax];
        const uint16_t size = wire::encode(frame, bytes);
        std::string text;
        for (uint16_t i = 0; i < size; i++) {
            const char* digits = "0123456789abcdef";
            text +=
                (i > 0 ? " " : "") + std::string(1, digits[bytes[i] >> 4]) + digits[bytes[i] & 15];
        }
        return text;
    }
};

using Dumps = std::vector<std::string>;

}  // namespace vagus::debug
