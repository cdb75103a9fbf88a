// Do two nodes share one id? A host cannot see links; but a node answers ListNodes once, and has
// one name. Who answers more often than was asked, in two rounds, or has two names within
// kNamesWithin, is two nodes. One round proves nothing: the answer may belong to a question that
// another host asked before we listened.
#pragma once

#include <deque>
#include <map>
#include <string>

#include "base/time.hpp"
#include "debug/event.hpp"

namespace vagus::debug {

constexpr Duration kNamesWithin = std::chrono::milliseconds(1000);
constexpr Duration kAnswersWithin = std::chrono::milliseconds(1000);  // of a node that is new

class Presences {
public:
    // Somebody asked who is there: one more answer of each node is in order.
    void asked(Time now);
    // True if it is certain now, and was not before.
    bool answered(NodeId id, Time now);
    // A header of a description came. The other name if it is certain now, and was not before.
    std::string named(NodeId id, const std::string& name, Time now);
    void forget(NodeId id) { nodes_.erase(id); }
    // A node answered twice in one round: another would tell more.
    bool doubtful() const { return doubtful_; }

private:
    struct Presence {
        int due = 1;         // answers that are in order
        int surplus = 0;     // rounds with more
        uint32_t round = 0;  // the last of them
        bool certain = false;
        std::string name;
        Time named_at{};
    };

    std::map<NodeId, Presence> nodes_;  // of those that are known: at most kNodesMax
    std::deque<Time> questions_;        // the last ones: a node that is new answers them, too
    uint32_t round_ = 1;
    bool doubtful_ = false;
};

}  // namespace vagus::debug
