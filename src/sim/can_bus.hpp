// A CAN bus of 1 Mbit/s with the frames of Aseba on it (docs/spec, section 1.6): one sender at a
// time, the lowest identifier first, every bit counted. It is told the time, and knows no world.
//
//     CanBus bus;
//     const CanPort host = bus.join("main");
//     const CanPort bumper = bus.join("bumper");
//     if (bus.send(bumper, frame, now) != CanSent::Queued) count_the_loss();
//     bus.advance(now + 1ms);                         // what has ended by then …
//     while (const auto got = bus.take()) pass_on(got->frame);    // … reaches all but its sender
//     show(bus.load(bumper).share_of_last_second);
//
// A frame becomes 1 to 65 CAN frames (wire/can.hpp), each of which competes for the bus by itself.
// Its bits are exact: the stuffing is that of its content and its CRC, not the worst case. A bit
// lasts a microsecond. What the model leaves out: errors and repetitions, and the microseconds that
// a controller takes from its queue to its pin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "wire/can.hpp"

namespace vagus::sim {

constexpr int64_t kCanBitsPerSecond = 1'000'000;
// CAN frames that wait at a port; what comes then is dropped. A description is 300 to 700.
constexpr size_t kCanQueueMax = 1024;
constexpr size_t kCanPortsMax = 256;     // as many as there are sources
constexpr size_t kLatenciesKept = 4096;  // of a port: its median and p99 are those of the latest
constexpr size_t kLoadBins = 100;        // the last second in parts of 10 ms

// The bits of one frame on the wire, from its start to the end of its end-of-frame field.
uint32_t can_bits(const wire::CanFrame& frame);
// After each, before the next may begin: the intermission.
constexpr uint32_t kCanIntermissionBits = 3;

// A place on the bus, by the order of joining.
struct CanPort {
    uint32_t index = 0;
    auto operator<=>(const CanPort&) const = default;
};

enum class CanSent : uint8_t {
    Queued,
    Dropped,  // the queue has no room for the whole of it
    Unfit,    // its source is above 255 and fits no identifier
};

// A whole frame that has crossed the bus.
struct CanDelivery {
    CanPort from;
    Time queued{};
    Time received{};
    wire::Frame frame;
};

// What one port has put on the bus, what is under way included. Bits count with their intermission:
// while it lasts nobody else can send.
struct CanLoad {
    std::string name;
    uint64_t frames = 0;      // whole ones
    uint64_t can_frames = 0;  // their pieces
    uint64_t bits = 0;
    uint64_t dropped = 0;             // frames that found the queue full, or did not fit
    double share_of_last_second = 0;  // of the bus, 0 to 1
    double share_of_all = 0;          // since the start
    size_t waiting = 0;               // CAN frames in the queue now
    size_t waiting_most = 0;          // ever
    Duration latency_median{};        // from queued to received, of the latest kLatenciesKept
    Duration latency_p99{};
    Duration latency_worst{};  // of all
};

class CanBus {
public:
    // At most kCanPortsMax.
    CanPort join(std::string name);

    // At `at`, which is not before the end of the last advance(). All or nothing.
    [[nodiscard]] CanSent send(CanPort from, const wire::Frame& frame, Time at);
    // How many CAN frames the queue of a port still takes.
    size_t room(CanPort port) const;
    // Lets the bus work until `to`.
    void advance(Time to);
    // The oldest frame that has crossed by now. What is not taken before the next advance() is
    // gone.
    std::optional<CanDelivery> take();

    // Of one port; of all together, without a name.
    CanLoad load(CanPort port) const;
    CanLoad load() const;
    size_t ports() const { return ports_.size(); }

    // Nothing waits, nothing was ever counted, time 0; the ports stay.
    void reset();

private:
    struct Packet {
        wire::Frame frame;
        Time queued{};
        std::vector<wire::CanFrame> parts;
        size_t sent = 0;  // of the parts
    };
    struct Counts {
        uint64_t frames = 0;
        uint64_t can_frames = 0;
        uint64_t bits = 0;
        uint64_t dropped = 0;
        size_t waiting_most = 0;
        Duration worst{};
        std::array<uint32_t, kLoadBins> bins{};  // bits that ended in each 10 ms
        std::vector<Duration> latencies;         // a ring once it is full
    };
    struct Port {
        std::string name;
        std::deque<Packet> queue;
        size_t waiting = 0;
        Counts counts;
    };

    std::optional<Time> next_start() const;
    CanPort winner(Time start) const;
    void transmit(CanPort from, Time start);
    void receive(CanPort from, Time end);
    void empty_bins(Time to);
    CanLoad describe(std::span<const Port> of) const;

    std::vector<Port> ports_;
    std::deque<CanDelivery> delivered_;
    Time now_{};
    Time free_at_{};     // the last intermission is over
    Time counted_to_{};  // which second the bins are of
};

}  // namespace vagus::sim
