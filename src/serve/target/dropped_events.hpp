// How many events a node has dropped while it is paused at a line of its script: a machine that is
// paused inside an event takes no other (docs/spec/aseba-wire-and-vm.md, 3.6), and nobody tells it
// again. Nodes do not count them, so a host counts what comes over the bus for a node that it knows
// to pause, and whose program it knows.
//
//     DroppedEvents dropped;
//     dropped.state(2, ProgramState::Paused);
//     dropped.came(2, handles(program, event));
//     dropped.of(2);                               // 1
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "aesl/program.hpp"
#include "debug/event.hpp"

namespace vagus::serve {

// Whether the program has a handler for the user event, by its table of events (spec, 3.1).
bool handles(const aesl::Program& program, uint16_t event);

class DroppedEvents {
public:
    // From one line to the next it is still paused: what it has dropped is counted on.
    void state(uint16_t node, debug::ProgramState state);
    // An event came that the node did not emit itself; `handled` by its script, if that is known.
    void came(uint16_t node, std::optional<bool> handled);
    // Since it paused; nothing: it is not paused, or nobody knows what its script handles.
    std::optional<uint64_t> of(uint16_t node) const;
    bool is_paused(uint16_t node) const { return counts_.contains(node); }
    void forget() { counts_.clear(); }

private:
    struct Count {
        uint64_t dropped = 0;
        bool known = true;
    };
    std::map<uint16_t, Count> counts_;  // of paused nodes
};

}  // namespace vagus::serve
