// A node for tests: memories in vectors, frames kept as hex text in the notation of the
// specification.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "isa/isa.hpp"
#include "node/frame_maker.hpp"
#include "node/natives.hpp"
#include "node/node.hpp"
#include "wire/frame.hpp"

namespace vagus::node {

inline std::string hex(const wire::Frame& frame) {
    uint8_t bytes[wire::kFrameMax];
    const uint16_t size = wire::encode(frame, bytes);
    std::string text;
    for (uint16_t i = 0; i < size; ++i) {
        char digits[4];
        std::snprintf(digits, sizeof digits, "%s%02x", i == 0 ? "" : " ", bytes[i]);
        text += digits;
    }
    return text;
}

inline wire::Frame frame_of(const std::string& text) {
    std::vector<uint8_t> bytes;
    for (size_t at = 0; at + 1 < text.size(); at += 3) {
        bytes.push_back(static_cast<uint8_t>(std::stoul(text.substr(at, 2), nullptr, 16)));
    }
    wire::FrameReader reader;
    reader.feed(bytes.data(), static_cast<uint16_t>(bytes.size()));
    return reader.frame();
}

// The description of the examples of section 2.10: id, source, args[32].
inline const Variable kTestVariables[] = {{1, "id"}, {1, "source"}, {32, "args"}};
inline const LocalEvent kTestEvents[] = {{"timer", "tick of the clock"}, {"touched", ""}};
inline const Description kTestDescription = {
    "node",
    5,
    LocalEventSource::Kept,
    3,
    kTestVariables,
    2,
    kTestEvents,
    {{kStandardNatives, kStandardNativeCount}, {nullptr, 0}},
    0};

class TestNode {
public:
    explicit TestNode(const Description& description = kTestDescription, uint16_t id = 1)
        : variables(1060), stack(64), bytecode(512), config_(config(id)) {
        init(node, config_, description, kBoard, this);
    }
    TestNode(const TestNode&) = delete;
    TestNode& operator=(const TestNode&) = delete;

    // What the node answers to a frame, one frame a line.
    std::string ask(const std::string& text) {
        receive(node, frame_of(text));
        return take();
    }
    std::string take() {
        std::string all;
        for (const wire::Frame& frame : sent) all += (all.empty() ? "" : "\n") + hex(frame);
        sent.clear();
        return all;
    }

    std::vector<int16_t> variables, stack;
    std::vector<uint16_t> bytecode;
    std::vector<wire::Frame> sent;
    std::vector<vm::Notice> notices;
    Node node;

private:
    vm::Config config(uint16_t id) {
        return {id,
                static_cast<uint16_t>(bytecode.size()),
                static_cast<uint16_t>(variables.size()),
                static_cast<uint16_t>(stack.size()),
                32,
                bytecode.data(),
                variables.data(),
                stack.data(),
                breakpoints_,
                &kMachineHost,
                &node};
    }
    FrameMaker maker_;
    static TestNode& self(Node& node) { return *static_cast<TestNode*>(node.owner); }
    static constexpr Board kBoard = {
        [](Node& node, uint16_t type) { self(node).maker_.begin(node, type); },
        [](Node& node, uint8_t byte) { self(node).maker_.put(byte); },
        [](Node& node) { self(node).sent.push_back(self(node).maker_.frame()); },
        [](Node& node, vm::Notice notice) { self(node).notices.push_back(notice); },
        wire::kVariablesReplyWordsMax};

    uint16_t breakpoints_[vm::kBreakpointsMax];
    vm::Config config_;
};

}  // namespace vagus::node
