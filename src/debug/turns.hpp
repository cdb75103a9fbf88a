// Who may speak now: only so many nodes are talked to at a time, the others wait for their turn. A
// network may have a thousand nodes, and asking all of them at once fills every queue on the
// way with answers (docs/decisions/0062-a-host-asks-in-turns.md).
//
//     if (turns.enter(id, now)) ask(id);                     // at once, or in its turn:
//     while (const auto next = turns.next(now)) ask(*next);  // whenever something has happened
//     turns.leave(id);                                       // it has answered, or is gone
//
// A node that does not answer loses its turn: after kTurnFor if others that were asked later have
// answered, for then it is the node that is slow and not the network; else after kTurnForMax.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "base/time.hpp"
#include "debug/event.hpp"

namespace vagus::debug {

// Programs on their way at a time fill half of a queue of the hub, descriptions as well.
constexpr size_t kTurnsAtOnce = 32;
constexpr Duration kTurnFor = std::chrono::milliseconds(250);
constexpr Duration kTurnForMax = std::chrono::milliseconds(1000);

class Turns {
public:
    // True: it is its turn. False: next() will give it; one that waits already waits on.
    bool enter(NodeId id, Time now) {
        free_late(now);
        if (waiting_.empty() && busy_.size() < kTurnsAtOnce) {
            busy_.push_back({id, now, ++asked_});
            return true;
        }
        if (std::find(waiting_.begin(), waiting_.end(), id) == waiting_.end()) {
            waiting_.push_back(id);
        }
        return false;
    }
    // It has answered, and is asked on.
    void progress(NodeId id, Time now) {
        for (Busy& each : busy_) {
            if (each.id != id) continue;
            each.since = now;
            answered_ = std::max(answered_, each.turn);
        }
    }
    // Its turn is over, or it waits no longer.
    void leave(NodeId id) {
        std::erase_if(busy_, [this, id](const Busy& each) {
            if (each.id == id) answered_ = std::max(answered_, each.turn);
            return each.id == id;
        });
        std::erase(waiting_, id);
    }
    // Whose turn it is from now on; none if nobody waits or enough are busy.
    std::optional<NodeId> next(Time now) {
        if (waiting_.empty()) return std::nullopt;
        free_late(now);
        if (busy_.size() >= kTurnsAtOnce) return std::nullopt;
        const NodeId id = waiting_.front();
        waiting_.pop_front();
        busy_.push_back({id, now, ++asked_});
        return id;
    }
    // When next() may give somebody, if nobody answers until then; Time::max() if nobody waits.
    Time next_tick() const {
        Time first = Time::max();
        if (waiting_.empty()) return first;
        for (const Busy& each : busy_) first = std::min(first, end_of(each));
        return first;
    }

private:
    struct Busy {
        NodeId id = 0;
        Time since{};
        uint64_t turn = 0;
    };
    Time end_of(const Busy& each) const {
        return each.since + (each.turn < answered_ ? kTurnFor : kTurnForMax);
    }
    void free_late(Time now) {
        std::erase_if(busy_, [this, now](const Busy& each) { return now >= end_of(each); });
    }

    std::vector<Busy> busy_;      // at most kTurnsAtOnce
    uint64_t asked_ = 0;          // turns given so far
    uint64_t answered_ = 0;       // the latest of them that brought an answer
    std::deque<NodeId> waiting_;  // at most as many as there are nodes
};

}  // namespace vagus::debug
