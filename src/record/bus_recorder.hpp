// What is recorded of a real bus: each frame with its number, user events by their names, what
// nodes say of their variables, and how they describe themselves. It asks nothing and sends
// nothing: the variables are those that somebody asks for.
//
//     BusRecorder bus(*tape);
//     bus.begin(network.common());
//     bus.described(at, *network.node(3));
//     const uint32_t number = bus.frame(at, {.frame = frame});
//
// On one thread. Nothing of it waits for the disk (file_tape.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "debug/network.hpp"
#include "record/bus_messages.hpp"
#include "record/file_tape.hpp"

namespace vagus::record {

// Descriptions of nodes are attached there: nodes/NAME.json.
constexpr std::string_view kNodesFolder = "nodes/";
constexpr size_t kNodesRecordedMax = 1024;  // whose descriptions and variables are kept

class BusRecorder {
public:
    // Borrowed.
    explicit BusRecorder(FileTape& tape);

    void begin(aesl::CommonDefinitions common) { common_ = std::move(common); }
    void described(Time at, const debug::NodeView& node);
    // What the network has to tell: recorded is that a node that had described itself has left or
    // fallen silent, and that it is there again.
    void happened(Time at, const debug::Event& event);

    struct Passed {
        const wire::Frame& frame;
        uint32_t cause = 0;        // number of a frame
        std::string_view by = {};  // element of the plan
    };
    // Gives its number, from 1 on.
    uint32_t frame(Time at, const Passed& passed);

private:
    struct Node {
        std::string name = {};
        uint16_t topic = 0;
        RecordedVariables variables = {};
        std::vector<int16_t> words = {};
        std::vector<bool> known = {};  // of the words: the node has told it
    };
    void variables(Time at, const wire::Frame& frame);

    FileTape& tape_;
    aesl::CommonDefinitions common_;
    uint16_t frames_ = 0;
    uint16_t events_ = 0;
    uint16_t described_ = 0;
    uint32_t last_ = 0;
    std::map<debug::NodeId, Node> nodes_;
    std::set<std::string> attached_;          // files
    std::string text_;                        // of the message that is being made
    std::map<std::string, uint16_t> topics_;  // by name
};

}  // namespace vagus::record
