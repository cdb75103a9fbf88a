// The nodes of a world on one CAN bus, and the hub with all hosts as one more place on it, called
// "main": as the main computer of a robot is the one that passes on what others want of it.
#pragma once

#include <vector>

#include "hub/hub.hpp"
#include "hub/output_queue.hpp"
#include "sim/can_bus.hpp"
#include "sim/world.hpp"

namespace vagus::sim {

// CAN frames of hosts that wait at the port of "main"; what is behind them waits in the hub, where
// Stop passes it. When many wait there, hosts leave a part of the bus to the nodes: these have the
// higher identifiers, and would never get to answer.
constexpr size_t kCanAhead = 64;
constexpr size_t kCanAheadInCrowd = 5;
constexpr size_t kCrowdBytes = 1024;

class NodeBus {
public:
    // `link` is ours on the hub, which must outlive this.
    NodeBus(hub::Hub& hub, hub::LinkId link) : hub_(hub), link_(link), main_(can_.join("main")) {}

    // The next node; they are counted from 0 by their order here. At most kCanSourceMax of them.
    void join(uint16_t node, std::string name);
    size_t size() const { return places_.size(); }

    // What hosts have sent is queued at `now`, as much as there is room for.
    void accept(Time now);
    // What has crossed by `now` reaches the nodes and the hosts.
    void advance(Time now);
    bool has_frames(size_t place) const { return places_[place].inbox.bytes() > 0; }
    // What has reached a node, the oldest first.
    bool take(size_t place, wire::Frame& frame) { return places_[place].inbox.pop(frame); }
    // A frame of a node.
    void send(size_t place, const wire::Frame& frame, Time now);

    // While time is stopped: past the bus, uncounted.
    void accept_at_once();
    void send_at_once(size_t place, const wire::Frame& frame);

    BusLoad load() const;
    // Nothing waits anywhere, nothing was counted, time 0.
    void reset();

private:
    struct Place {
        uint16_t node = 0;
        CanPort port;
        hub::OutputQueue inbox;  // bounded; a node takes as many frames as the bus can bring
    };

    void hand_out(CanPort from, const wire::Frame& frame);

    hub::Hub& hub_;
    hub::LinkId link_;
    CanBus can_;
    CanPort main_;
    std::vector<Place> places_;
};

}  // namespace vagus::sim
