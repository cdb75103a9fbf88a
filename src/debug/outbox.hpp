// What leaves a Network: frames for the bus and events for the caller, bounded, in order.
#pragma once

#include <utility>
#include <vector>

#include "debug/known_targets.hpp"
#include "debug/network.hpp"
#include "debug/turns.hpp"
#include "wire/messages.hpp"

namespace vagus::debug {

// A message of that kind for one node, all other fields zero.
template <typename Message>
Message message_to(NodeId id) {
    Message message{};
    message.dest = id;
    return message;
}

class Outbox {
public:
    Time now{};          // as receive() or tick() were told last
    Turns descriptions;  // of nodes that are asked what they are
    Turns requests;      // of nodes of which something is asked
    KnownTargets targets;

    template <typename Message>
    void send(const Message& message) {
        wire::Frame frame;
        const wire::Error failed = wire::encode_message(message, wire::kHostId, frame);
        assert(failed == wire::Error::None);  // sizes are checked before
        if (failed != wire::Error::None) return;
        send_frame(frame);
    }
    template <typename Message>
    void command(NodeId id) {
        send(message_to<Message>(id));
    }
    void send_frame(const wire::Frame& frame) {
        if (frames_.size() < kFramesMax) {
            frames_.push_back(frame);
        } else {
            dropped_++;
        }
    }
    void tell(NodeId node, Happening what) {
        if (events_.size() < kEventsMax) {
            events_.push_back({now, node, std::move(what)});
        } else {
            dropped_++;
        }
    }
    RequestId new_request() { return {++last_request_}; }

    std::vector<wire::Frame> take_frames() { return std::exchange(frames_, {}); }
    std::vector<Event> take_events() { return std::exchange(events_, {}); }
    uint64_t dropped() const { return dropped_; }

private:
    std::vector<wire::Frame> frames_;
    std::vector<Event> events_;
    uint64_t dropped_ = 0;
    uint32_t last_request_ = 0;
};

}  // namespace vagus::debug
