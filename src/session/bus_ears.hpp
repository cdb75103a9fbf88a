// What a plan hears of a bus: user events by their names, which nodes are there, and whose programs
// were stopped.
//
//     BusEars ears(nodes);                                // toolbox::BusNodes
//     for (const debug::Event& event : network.take_events()) {
//         if (auto heard = ears.hear(event)) run.hear(std::move(*heard));
//     }
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "debug/event.hpp"
#include "run/code.hpp"
#include "toolbox/bus.hpp"

namespace vagus::session {

class BusEars {
public:
    // `nodes` is kept as the bus says; borrowed. With `only`, other nodes are as if they were not
    // there: of events, those of these nodes and of hosts are heard.
    explicit BusEars(toolbox::BusNodes& nodes, std::set<debug::NodeId> only = {})
        : nodes_(nodes), only_(std::move(only)) {}
    // Its nodes are no longer known to be there.
    ~BusEars();
    BusEars(const BusEars&) = delete;
    BusEars& operator=(const BusEars&) = delete;

    // Nothing for what is not for plans: numbers without a name, and all that debuggers hear.
    std::optional<run::BusEvent> hear(const debug::Event& event);
    // Somebody whom the plan waits for holds these nodes, and no others: while one is held, the
    // plan does not hear that it was stopped. Gives what it hears now.
    std::vector<run::BusEvent> hold(std::set<debug::NodeId> nodes);

private:
    struct Known {
        std::string name;
        bool there = false;
        bool ran = false;
        bool stopped = false;
        bool told_stopped = false;
    };
    void there(debug::NodeId node);
    std::optional<run::BusEvent> gone(debug::NodeId node);
    std::optional<run::BusEvent> hear_state(debug::NodeId node, const debug::StateChanged& changed);
    std::optional<run::BusEvent> tell_stopped(debug::NodeId node, Known& known);

    toolbox::BusNodes& nodes_;
    std::set<debug::NodeId> only_;  // empty: all
    std::set<debug::NodeId> held_;
    std::map<debug::NodeId, Known> known_;  // without a name until they have described themselves
};

}  // namespace vagus::session
