// The messages of a node as frames, for boards that send whole ones.
//
//     const node::Board kBoard = {
//         [](Node& node, uint16_t type) { self(node).maker.begin(node, type); },
//         [](Node& node, uint8_t byte) { self(node).maker.put(byte); },
//         [](Node& node) { self(node).send(self(node).maker.frame()); }, …, …};
#pragma once

#include "node/node.hpp"
#include "wire/frame.hpp"

namespace vagus {
namespace node {

class FrameMaker {
public:
    void begin(const Node& node, uint16_t type) {
        frame_.size = 0;
        frame_.source = node.vm.id;
        frame_.type = type;
    }
    void put(uint8_t byte) { frame_.payload[frame_.size++] = byte; }
    const wire::Frame& frame() const { return frame_; }

private:
    wire::Frame frame_;
};

}  // namespace node
}  // namespace vagus
