// Do two nodes share one id? A host cannot see links; but a node has one name, and answers a
// question once. An id with two names within kNamesWithin is two nodes. One that tells more often
// that it is there than was asked gives rise to a doubt, no more: it may be slow, and still answer
// what other hosts asked before we listened. Then it is asked for words of its memory, some that
// nobody else asks for, twice: an id that answers each of these more than once is two nodes.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <string>

#include "base/time.hpp"
#include "debug/event.hpp"

namespace vagus::debug {

constexpr Duration kNamesWithin = std::chrono::milliseconds(1000);
constexpr Duration kAnswersWithin = std::chrono::milliseconds(1000);  // of a node that is new

// Words of a node's memory to ask for.
struct Probe {
    uint16_t start = 0;
    uint16_t count = 0;  // 0: none
    friend bool operator==(const Probe&, const Probe&) = default;
};
using Probes = std::array<Probe, 2>;

class Presences {
public:
    // Somebody asked who is there: one more answer of each node is in order.
    void asked(Time now);
    // It said that it is there.
    void answered(NodeId id, Time now);
    // A header of a description came. The other name if it is certain now, and was not before.
    std::string named(NodeId id, const std::string& name, Time now);
    void forget(NodeId id) { nodes_.erase(id); }

    // Nodes in doubt are to be asked.
    bool doubtful() const;
    bool doubts(NodeId id) const;
    // What to ask a node in doubt, whose memory has so many words, at least 2; the answers settle
    // the doubt.
    Probes settle(NodeId id, uint16_t words, Time now);
    // Doubts about nodes that could not be asked are over; they come again if there is reason.
    void drop_doubts();
    // Words of its memory came. True if it is certain now, and was not before.
    bool told(NodeId id, const Probe& range);
    // Some that were asked have not answered yet.
    bool waits() const;

private:
    struct Presence {
        int due = 1;  // answers that are in order
        bool doubted = false;
        bool certain = false;
        Probes probes = {};
        std::array<int, 2> answers = {};
        std::string name;
        Time named_at{};
    };

    std::map<NodeId, Presence> nodes_;  // of those that are known: at most kNodesMax
    std::deque<Time> questions_;        // the last ones: a node that is new answers them, too
    uint32_t probed_ = 0;
};

}  // namespace vagus::debug
