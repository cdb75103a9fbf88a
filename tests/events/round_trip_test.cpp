// How long an event takes from one node to another and an answer back, and how many bytes that is:
// in virtual time, from the bit rates alone. The scripts take no time here; what a processor adds
// is its own. docs/events-and-polling.md has the figures.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hub/hub.hpp"
#include "session/live_node.hpp"
#include "session/standard_target.hpp"
#include "sim/can_bus.hpp"
#include "wire/messages.hpp"
#include "wire/reports.hpp"

namespace vagus {
namespace {

using namespace std::chrono_literals;

constexpr uint16_t kAsk = 1, kAnswer = 2;

// The way of frames between nodes.
class Way {
public:
    virtual ~Way() = default;
    virtual void send(size_t from, const wire::Frame& frame, Time at) = 0;
    // The next frame that arrives somewhere, with the place and the time; none if nothing is under
    // way.
    struct Arrival {
        size_t to = 0;
        Time at{};
        wire::Frame frame;
    };
    virtual std::optional<Arrival> next() = 0;
};

// Two nodes: 0 emits kAsk at time 0, 1 answers each kAsk by kAnswer with the same arguments.
class Pair {
public:
    explicit Pair(Way& way) : way_(way) {
        for (uint16_t i = 0; i < 2; i++) {
            session::LiveNodeOptions options;
            options.id = static_cast<uint16_t>(i + 1);
            options.transmit = [this, i](const wire::Frame& frame) {
                if (wire::is_user_event(frame.type)) way_.send(i, frame, now_);
            };
            nodes_[i] = std::move(
                session::LiveNode::make(session::standard_target("node"), std::move(options))
                    .value());
        }
    }

    // `arguments` words from address 2, where both keep the arguments of events (section 3.10).
    // Gives when the answer has arrived.
    Time round_trip(uint16_t arguments) {
        load(1, {3, kAsk, 3, emit(kAnswer), 2, arguments, 0});
        fill(0, arguments);
        load(0, {3, 0xffff, 3, emit(kAsk), 2, arguments, 0});
        while (const auto arrival = way_.next()) {
            now_ = arrival->at;
            if (arrival->to == 0 && arrival->frame.type == kAnswer) return now_;
            nodes_[arrival->to]->receive(arrival->frame);
        }
        return Time::max();
    }

private:
    static uint16_t emit(uint16_t event) { return static_cast<uint16_t>(0xb000 | event); }

    void fill(size_t node, uint16_t arguments) {
        const std::span<int16_t> variables = nodes_[node]->node().variables();
        for (size_t i = 0; i < arguments; i++) variables[2 + i] = 0x5555;
    }

    void load(size_t to, const std::vector<uint16_t>& program) {
        wire::Frame frame{};
        frame.type = static_cast<uint16_t>(wire::MessageType::SetBytecode);
        wire::add_argument(frame, static_cast<int16_t>(to + 1));
        wire::add_argument(frame, 0);
        for (const uint16_t word : program) wire::add_argument(frame, static_cast<int16_t>(word));
        nodes_[to]->receive(frame);
        wire::Frame run{};
        run.type = static_cast<uint16_t>(wire::MessageType::Run);
        wire::add_argument(run, static_cast<int16_t>(to + 1));
        nodes_[to]->receive(run);
    }

    Way& way_;
    Time now_{};
    std::array<std::unique_ptr<session::LiveNode>, 2> nodes_;
};

// ---- serial lines to a switch ----

// Each node has its own line, 8N1: 10 bits a byte. The switch hands on whole frames.
class SerialLines : public Way {
public:
    explicit SerialLines(int64_t baud) : baud_(baud) {
        for (hub::LinkId& link : links_) link = hub_.add({.name = "line"}).value();
    }
    void send(size_t from, const wire::Frame& frame, Time at) override {
        under_way_.push_back({.node = from, .up = true, .at = at + takes(frame), .frame = frame});
    }
    std::optional<Arrival> next() override {
        while (!under_way_.empty()) {
            const Hop hop = under_way_.front();
            under_way_.pop_front();
            if (!hop.up) return Arrival{hop.node, hop.at, hop.frame};
            hub_.receive(links_[hop.node], hop.frame);
            hand_on(hop.at);
        }
        return std::nullopt;
    }
    uint64_t bytes() const { return bytes_; }

private:
    struct Hop {
        size_t node = 0;
        bool up = false;  // to the switch
        Time at{};
        wire::Frame frame;
    };

    void hand_on(Time at) {
        wire::Frame frame;
        for (size_t i = 0; i < links_.size(); i++) {
            while (hub_.take(links_[i], frame))
                under_way_.push_back(
                    {.node = i, .up = false, .at = at + takes(frame), .frame = frame});
        }
    }
    // Up to the last bit; microseconds that have begun count.
    Duration takes(const wire::Frame& frame) {
        const int64_t bytes = wire::kHeaderSize + frame.size;
        bytes_ += static_cast<uint64_t>(bytes);
        return Duration((bytes * 10 * 1'000'000 + baud_ - 1) / baud_);
    }

    const int64_t baud_;
    hub::Hub hub_;
    std::array<hub::LinkId, 2> links_;
    std::deque<Hop> under_way_;
    uint64_t bytes_ = 0;
};

// 6 bytes of header and 2 of argument are 80 bits: 694.4 us, so 695. Up and down, there and back:
// four times.
TEST(EventToEvent, OverTwoSerialLinesAndTheSwitch) {
    SerialLines lines(115'200);
    EXPECT_EQ(Pair(lines).round_trip(1), 4 * 695us);
    EXPECT_EQ(lines.bytes(), 4u * 8);
}

// 6 + 64 bytes are 700 bits: 6076.4 us.
TEST(EventToEvent, With32ArgumentsOverTwoSerialLinesAndTheSwitch) {
    SerialLines lines(115'200);
    EXPECT_EQ(Pair(lines).round_trip(32), 4 * 6077us);
    EXPECT_EQ(lines.bytes(), 4u * 70);
}

// The translator of section 1.3: 80 bits at 921,600 are 86.8 us.
TEST(EventToEvent, OverFastSerialLines) {
    SerialLines lines(921'600);
    EXPECT_EQ(Pair(lines).round_trip(1), 4 * 87us);
}

// ---- one CAN bus ----

class OneCanBus : public Way {
public:
    OneCanBus() {
        for (sim::CanPort& port : ports_) port = bus_.join("node");
    }
    void send(size_t from, const wire::Frame& frame, Time at) override {
        ASSERT_EQ(bus_.send(ports_[from], frame, at), sim::CanSent::Queued);
    }
    std::optional<Arrival> next() override {
        for (Time end = now_ + 1s; now_ < end;) {
            now_ += 1us;
            bus_.advance(now_);
            if (const auto got = bus_.take()) return Arrival{1 - got->from.index, now_, got->frame};
        }
        return std::nullopt;
    }
    const sim::CanBus& bus() const { return bus_; }

private:
    sim::CanBus bus_;
    std::array<sim::CanPort, 2> ports_;
    Time now_{};
};

// Both events are one Small frame each, of 66 bits before stuffing (1 + 11 + 3 + 4 + 32 + 15) and
// 10 behind it. In brackets what stuffing adds; a row each for the header, the bytes, the CRC.
//     0x301, 01 00 55 55:
//         001100000[1]0010000100
//         000[1]00001 00000[1]000 01010101 01010101
//         101100110001010 (0x598a)
//     0x302, 02 00 55 55:
//         001100000[1]0100000[1]100
//         000[1]00010 0000[1]0000 0[1]1010101 01010101
//         110101110111000 (0x6bb8)
// With 3 stuffed bits the first takes 79 us, with 5 the second 81 us. Between them the bus rests
// for 3 us.
TEST(EventToEvent, OverACanBus) {
    OneCanBus bus;
    EXPECT_EQ(Pair(bus).round_trip(1), 79us + 3us + 81us);
    EXPECT_EQ(bus.bus().load().can_frames, 2u);
    EXPECT_EQ(bus.bus().load().bits, 79u + 3 + 81 + 3);
}

}  // namespace
}  // namespace vagus
