// Which nodes of a live robot brake because of another one (safe stop, S4). Where a node is paused,
// stopped, reset, faulted or lost, a reflex is missing: the nodes that move are paused and made
// safe; those that only sense run on. When all that was missing runs again, exactly the nodes that
// were paused for it run again. Pure: it is told what happens, and says what is to be done.
//
//     Brake brake;
//     brake.begin(network);                              // those that run now belong to the robot
//     const Brake::Orders orders = brake.hear(network, safe_stop, event);   // each event
//     for (const debug::NodeId node : orders.pause) (void)network.pause_now(node);
//     for (const debug::NodeId node : orders.make_safe) make_safe(network, safe_stop, node);
//     for (const debug::NodeId node : orders.run) (void)network.run(node);
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "debug/network.hpp"
#include "session/safe_stop.hpp"

namespace vagus::session {

// It says itself that it ends what moves when its program does not run (safe stop, S2): its
// description has the local event `halted`.
bool halts_itself(const debug::NodeView& node);
// The safe stop names it, or it halts itself.
bool moves(const debug::NodeView& node, const SafeStop& safe);
// The safe stop does not name it, so nothing of it can be read, and its program runs: it is not
// known to be at rest. Nodes of Vagus (those with `_program`) that do not halt themselves only
// sense.
bool may_move_unread(const debug::NodeView& node, const SafeStop& safe);

// Writes what the safe stop says of the node, behind all that was sent to it before.
void make_safe(debug::Network& network, const SafeStop& safe, debug::NodeId node);

// Those of the network that move and run, but for `causes`.
std::vector<debug::NodeId> others_that_move(const debug::Network& network, const SafeStop& safe,
                                            const std::set<debug::NodeId>& causes);

class Brake {
public:
    struct Orders {
        std::optional<debug::NodeId> cause;  // why; each is told once
        std::vector<debug::NodeId> pause;
        std::vector<debug::NodeId> make_safe;  // behind the pause; the cause among them if it moves
        std::vector<debug::NodeId> run;        // nothing is missing any more
    };

    // Nothing is missing, and nobody was paused.
    void begin(const debug::Network& network);
    Orders hear(const debug::Network& network, const SafeStop& safe, const debug::Event& event);

    // Those that were paused and do not run again.
    const std::set<debug::NodeId>& braked() const { return braked_; }
    // Somebody looks for a mistake at a breakpoint: that may take long.
    bool at_breakpoint() const;

private:
    enum class Why { Stopped, Breakpoint, Lost };
    Orders miss(const debug::Network& network, const SafeStop& safe, debug::NodeId node, Why why);
    Orders there_again(debug::NodeId node);

    std::set<debug::NodeId> ran_;  // one without a program, or that never ran, is not missed
    std::map<debug::NodeId, Why> causes_;
    std::set<debug::NodeId> braked_;
};

// "bumper (4)"; "node 4" for one that has not told its name.
std::string name_with_id(const debug::Network& network, debug::NodeId node);

}  // namespace vagus::session
