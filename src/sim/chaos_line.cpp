#include "sim/chaos_line.hpp"

#include <algorithm>

#include "base/rng.hpp"
#include "base/seconds.hpp"

namespace vagus::sim {

void ChaosLine::begin(const ChaosFault& fault, uint64_t seed) {
    acting_.push_back({&fault, seed});
    if (fault.kind == ChaosKind::Unplugged || fault.kind == ChaosKind::Hung) waiting_.clear();
}

void ChaosLine::end(const ChaosFault& fault) {
    std::erase_if(acting_, [&fault](const Acting& one) { return one.fault == &fault; });
}

void ChaosLine::reseed(uint64_t seed, uint64_t stream) {
    for (Acting& one : acting_) one.seed = chaos_seed(*one.fault, seed, stream);
}

void ChaosLine::reset() {
    acting_.clear();
    waiting_.clear();
    latest_ = put_at_ = {};
    of_instant_ = 0;
}

// Chance hangs on the instant and the frame's place in it, not on what came before: a fault that
// begins later does the same to the frames that are left to it.
ChaosLine::Fate ChaosLine::decide(Time now) {
    of_instant_ = now == put_at_ ? of_instant_ + 1 : 0;
    put_at_ = now;
    SplitMix64 place(static_cast<uint64_t>(now.count()) << 16 | (of_instant_ & 0xffff));
    const uint64_t drawn = place.next();
    Fate fate;
    for (const Acting& one : acting_) {
        const ChaosFault& fault = *one.fault;
        SplitMix64 random(one.seed ^ drawn);
        const bool hit = random.unit() < fault.chance;
        switch (fault.kind) {
            case ChaosKind::Lost:
                if (hit) fate.copies = 0;
                break;
            case ChaosKind::Hung:
            case ChaosKind::Unplugged:
                fate.copies = 0;
                break;
            case ChaosKind::Doubled:
                if (hit && fate.copies > 0) ++fate.copies;
                break;
            case ChaosKind::Delayed:
            case ChaosKind::Slow:
                fate.late += from_seconds(fault.by);
                break;
            case ChaosKind::Reordered:
                if (!hit) break;
                fate.late += from_seconds(fault.by * random.unit());
                fate.held_back = true;
                break;
            case ChaosKind::Reset:
            case ChaosKind::Stuck:
            case ChaosKind::Noisy:
            case ChaosKind::Dead:
                break;
        }
    }
    return fate;
}

void ChaosLine::put(const wire::Frame& frame, Time now) {
    const Fate fate = decide(now);
    Time due = now + fate.late;
    // What is only late keeps its place, also behind one that was later when a delay ended.
    if (!fate.held_back) due = latest_ = std::max(due, latest_);
    for (int i = 0; i < fate.copies && waiting_.size() < kChaosWaitingMax; ++i) {
        const auto behind = std::ranges::upper_bound(waiting_, due, {}, &Waiting::due);
        waiting_.insert(behind, {due, frame});
    }
}

bool ChaosLine::take(wire::Frame& frame, Time now) {
    if (waiting_.empty() || waiting_.front().due > now) return false;
    frame = waiting_.front().frame;
    waiting_.pop_front();
    return true;
}

}  // namespace vagus::sim
