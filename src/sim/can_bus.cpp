#include "sim/can_bus.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace vagus::sim {
namespace {

constexpr Duration kBit = std::chrono::microseconds(1'000'000 / kCanBitsPerSecond);
constexpr Duration kBin = std::chrono::milliseconds(10);
static_assert(kLoadBins * kBin == std::chrono::seconds(1));
constexpr uint16_t kCrcPolynomial = 0x4599;  // x15 + x14 + x10 + x8 + x7 + x4 + x3 + 1
constexpr int kCrcBits = 15;
// The delimiter of the CRC, the acknowledgement with its delimiter, and the end of frame: 1 + 2 + 7
// bits, which are never stuffed.
constexpr uint32_t kTailBits = 10;

size_t bin_of(Time at) {
    return static_cast<size_t>(at / kBin) % kLoadBins;
}

// Takes bits in the order of the wire; counts them with the bits that stuffing adds.
class Wire {
public:
    void put(uint32_t value, int bits) {
        for (int i = bits - 1; i >= 0; --i) put_bit(value >> i & 1);
    }
    void put_crc() { put(crc_, kCrcBits); }
    uint32_t count() const { return count_; }

private:
    // After five equal bits the sender adds one of the other kind, which begins a run of its own.
    void put_bit(uint32_t bit) {
        ++count_;
        const bool divide = bit != (crc_ >> (kCrcBits - 1) & 1U);
        crc_ = static_cast<uint16_t>(crc_ << 1 & 0x7fff);
        if (divide) crc_ ^= kCrcPolynomial;
        run_ = bit == last_ ? run_ + 1 : 1;
        last_ = bit;
        if (run_ < 5) return;
        ++count_;
        last_ = 1 - bit;
        run_ = 1;
    }

    uint32_t count_ = 0;
    uint32_t last_ = 2;  // neither 0 nor 1
    int run_ = 0;
    uint16_t crc_ = 0;
};

}  // namespace

// start 1 | identifier 11 | remote 1 | extended 1 | reserved 1 | size 4 | bytes | CRC 15 | tail
uint32_t can_bits(const wire::CanFrame& frame) {
    Wire wire;
    wire.put(0, 1);
    wire.put(frame.identifier, 11);
    wire.put(0, 3);
    wire.put(frame.size, 4);
    for (uint8_t i = 0; i < frame.size; ++i) wire.put(frame.bytes[i], 8);
    wire.put_crc();
    return wire.count() + kTailBits;
}

CanPort CanBus::join(std::string name) {
    assert(ports_.size() < kCanPortsMax);
    ports_.push_back({.name = std::move(name), .queue = {}, .waiting = 0, .counts = {}});
    return {static_cast<uint32_t>(ports_.size() - 1)};
}

size_t CanBus::room(CanPort port) const {
    return kCanQueueMax - ports_[port.index].waiting;
}

CanSent CanBus::send(CanPort from, const wire::Frame& frame, Time at) {
    assert(at >= now_);
    Port& port = ports_[from.index];
    std::array<wire::CanFrame, wire::kCanFramesMax> parts;
    const uint8_t count = wire::can_fragment(frame, parts.data());
    if (count == 0 || count > room(from)) {
        ++port.counts.dropped;
        return count == 0 ? CanSent::Unfit : CanSent::Dropped;
    }
    port.queue.push_back({frame, at, {parts.begin(), parts.begin() + count}, 0});
    port.waiting += count;
    port.counts.waiting_most = std::max(port.counts.waiting_most, port.waiting);
    return CanSent::Queued;
}

// ---- the bus at work ----

void CanBus::advance(Time to) {
    assert(to >= now_);
    while (!delivered_.empty() && delivered_.front().received <= now_) delivered_.pop_front();
    // A transmission that would begin at `to` itself waits for what is sent at `to`.
    for (auto start = next_start(); start && *start < to; start = next_start())
        transmit(winner(*start), *start);
    empty_bins(to);
    now_ = to;
}

// When the bus is free and somebody has something to send.
std::optional<Time> CanBus::next_start() const {
    std::optional<Time> first;
    for (const Port& port : ports_) {
        if (port.queue.empty()) continue;
        const Time queued = port.queue.front().queued;
        if (!first || queued < *first) first = queued;
    }
    return first ? std::optional(std::max(*first, free_at_)) : std::nullopt;
}

// Of those who have something to send at `start`, the one with the lowest identifier: a 0 overrides
// a 1 on the wire. Equal identifiers are an error on a real bus; here the older port comes first.
CanPort CanBus::winner(Time start) const {
    CanPort best;
    uint16_t lowest = UINT16_MAX;
    for (uint32_t i = 0; i < ports_.size(); ++i) {
        if (ports_[i].queue.empty() || ports_[i].queue.front().queued > start) continue;
        const Packet& packet = ports_[i].queue.front();
        const uint16_t identifier = packet.parts[packet.sent].identifier;
        if (identifier >= lowest) continue;
        lowest = identifier;
        best = {i};
    }
    return best;
}

void CanBus::transmit(CanPort from, Time start) {
    Port& port = ports_[from.index];
    Packet& packet = port.queue.front();
    const uint32_t bits = can_bits(packet.parts[packet.sent]);
    const Time end = start + bits * kBit;
    free_at_ = end + kCanIntermissionBits * kBit;
    empty_bins(end);
    Counts& counts = port.counts;
    ++counts.can_frames;
    counts.bits += bits + kCanIntermissionBits;
    counts.bins[bin_of(end)] += bits + kCanIntermissionBits;
    --port.waiting;
    if (++packet.sent == packet.parts.size()) receive(from, end);
}

void CanBus::receive(CanPort from, Time end) {
    Port& port = ports_[from.index];
    const Packet packet = std::move(port.queue.front());
    port.queue.pop_front();
    Counts& counts = port.counts;
    const Duration latency = end - packet.queued;
    if (counts.latencies.size() < kLatenciesKept) {
        counts.latencies.push_back(latency);
    } else {
        counts.latencies[counts.frames % kLatenciesKept] = latency;
    }
    ++counts.frames;
    counts.worst = std::max(counts.worst, latency);
    delivered_.push_back({from, packet.queued, end, packet.frame});
}

std::optional<CanDelivery> CanBus::take() {
    if (delivered_.empty() || delivered_.front().received > now_) return std::nullopt;
    const CanDelivery oldest = delivered_.front();
    delivered_.pop_front();
    return oldest;
}

// ---- counting ----

// What the bins that begin between the last time and this one held is more than a second old.
void CanBus::empty_bins(Time to) {
    if (to <= counted_to_) return;
    const int64_t begun = std::min<int64_t>(to / kBin - counted_to_ / kBin, kLoadBins);
    for (int64_t i = 0; i < begun; ++i)
        for (Port& port : ports_) port.counts.bins[bin_of(to - i * kBin)] = 0;
    counted_to_ = to;
}

namespace {

double share(uint64_t bits, Duration of) {
    if (of <= Duration::zero()) return 0;
    return std::min(1.0, static_cast<double>(bits) / static_cast<double>(of / kBit));
}

// The one that `part` of them do not pass; 0 if there is none.
Duration percentile(std::vector<Duration>& all, double part) {
    if (all.empty()) return {};
    const auto last = static_cast<double>(all.size() - 1);
    const auto at = all.begin() + static_cast<ptrdiff_t>(last * part + 0.5);
    std::nth_element(all.begin(), at, all.end());
    return *at;
}

}  // namespace

CanLoad CanBus::load(CanPort port) const {
    CanLoad load = describe({&ports_[port.index], 1});
    load.name = ports_[port.index].name;
    return load;
}

CanLoad CanBus::load() const {
    return describe(ports_);
}

CanLoad CanBus::describe(std::span<const Port> of) const {
    CanLoad load;
    uint64_t recent = 0;
    std::vector<Duration> latencies;
    for (const Port& port : of) {
        const Counts& counts = port.counts;
        load.frames += counts.frames;
        load.can_frames += counts.can_frames;
        load.bits += counts.bits;
        load.dropped += counts.dropped;
        load.waiting += port.waiting;
        load.waiting_most = std::max(load.waiting_most, counts.waiting_most);
        load.latency_worst = std::max(load.latency_worst, counts.worst);
        recent = std::accumulate(counts.bins.begin(), counts.bins.end(), recent);
        latencies.insert(latencies.end(), counts.latencies.begin(), counts.latencies.end());
    }
    // The bin that has begun is one of them.
    const Time until = std::max(now_, counted_to_);
    const Duration counted = (kLoadBins - 1) * kBin + until % kBin;
    load.share_of_last_second = share(recent, std::min<Duration>(until, counted));
    load.share_of_all = share(load.bits, now_);
    load.latency_median = percentile(latencies, 0.5);
    load.latency_p99 = percentile(latencies, 0.99);
    return load;
}

void CanBus::reset() {
    for (Port& port : ports_) port = {.name = port.name, .queue = {}, .waiting = 0, .counts = {}};
    delivered_.clear();
    now_ = free_at_ = counted_to_ = Time{};
}

}  // namespace vagus::sim
