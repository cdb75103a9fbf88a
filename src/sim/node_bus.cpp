#include "sim/node_bus.hpp"

#include <array>

namespace vagus::sim {

void NodeBus::join(uint16_t node, std::string name) {
    places_.push_back({node, can_.join(std::move(name)), {}});
}

// What waits in the hub is dropped by the hub's rule, which spares commands.
void NodeBus::accept(Time now) {
    static_assert(kCanAhead + wire::kCanFramesMax <= kCanQueueMax);
    const size_t most = hub_.waiting(link_) > kCrowdBytes ? kCanAheadInCrowd : kCanAhead;
    wire::Frame frame;
    while (kCanQueueMax - can_.room(main_) < most && hub_.take(link_, frame))
        (void)can_.send(main_, frame, now);  // a source that fits no identifier is counted there
}

void NodeBus::send(size_t place, const wire::Frame& frame, Time now) {
    (void)can_.send(places_[place].port, frame, now);  // what is dropped is counted there
}

void NodeBus::advance(Time now) {
    can_.advance(now);
    while (const auto delivery = can_.take()) hand_out(delivery->from, delivery->frame);
}

// To all but the sender, as far as they would look at it.
void NodeBus::hand_out(CanPort from, const wire::Frame& frame) {
    std::array<uint8_t, wire::kFrameMax> bytes;
    const std::span<const uint8_t> encoded(bytes.data(), wire::encode(frame, bytes.data()));
    for (Place& place : places_)
        if (place.port != from && hub::is_for_node(frame, place.node)) place.inbox.push(encoded);
    if (from != main_) hub_.receive(link_, frame);
}

void NodeBus::accept_at_once() {
    wire::Frame frame;
    while (hub_.take(link_, frame)) hand_out(main_, frame);
}

void NodeBus::send_at_once(size_t place, const wire::Frame& frame) {
    hand_out(places_[place].port, frame);
}

BusLoad NodeBus::load() const {
    BusLoad load{can_.load(), {{0, can_.load(main_)}}};
    for (const Place& place : places_) load.nodes.push_back({place.node, can_.load(place.port)});
    return load;
}

void NodeBus::reset() {
    can_.reset();
    for (Place& place : places_) place.inbox = {};
    wire::Frame frame;
    while (hub_.take(link_, frame)) {
    }
}

}  // namespace vagus::sim
