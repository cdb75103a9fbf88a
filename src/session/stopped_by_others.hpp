// Nodes of a running plan that another host has stopped, paused or reset, and that nobody lets run
// again. A plan whose actor or supervisor works elsewhere at that moment would not notice, and
// could wait for ever for what such a node is to say.
//
//     StoppedByOthers others(2s);
//     others.hear(event);                                    // each event of the network
//     for (const debug::NodeId node : others.take_due(now)) end_the_plan(node);
#pragma once

#include <map>
#include <set>
#include <vector>

#include "debug/event.hpp"

namespace vagus::session {

class StoppedByOthers {
public:
    // Stopped for so long, a node counts as due.
    explicit StoppedByOthers(Duration within) : within_(within) {}

    void hear(const debug::Event& event);
    // Somebody whom the plan waits for holds these nodes, and no others. Those that are stopped
    // when they are no longer held count from then on.
    void hold(std::set<debug::NodeId> nodes, Time now);
    // Each once for each time that it was stopped.
    std::vector<debug::NodeId> take_due(Time now);
    // When one is due next.
    Time next() const;

private:
    Duration within_;
    std::map<debug::NodeId, Time> stopped_;  // since when
    std::set<debug::NodeId> held_;
    // A node without a program was not stopped by anybody.
    std::set<debug::NodeId> ran_;
};

}  // namespace vagus::session
