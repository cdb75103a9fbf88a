// Brings the nodes of a robot to rest, until it is certain: tells them to stop, writes what makes
// them safe, and reads back whether they are. A node that does not answer is asked again. Pure: it
// is told the time, and talks through the network that it is given.
//
//     Stopping stopping;
//     stopping.begin(network, safe_stop, Stopping::How::Stop, now);
//     stopping.hear(event); stopping.tick(now);          // the caller's loop
//     if (stopping.settled()) show(stopping.report());
//
// "Stopped" means read back: what was written is there, and what has to be 0 is 0. A node that the
// safe stop does not name has nothing to read; for it the answer to Stop counts.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "debug/network.hpp"
#include "session/safe_stop.hpp"
#include "session/stop_node.hpp"

namespace vagus::session {

constexpr Duration kStopAgain = std::chrono::seconds(1);  // who did not answer is asked again
constexpr Duration kMovesReadEvery = std::chrono::milliseconds(50);  // who moves is read again
// A script that runs on may still work off what it heard before it was made safe, and write over
// that: it is at rest when it reads so again after this.
constexpr Duration kRestHolds = std::chrono::milliseconds(150);

// "at rest: thymio-II (2), drive (3); did not answer: bumper (4)"; empty without nodes.
std::string describe(const std::vector<StopNode>& nodes);

// Who is to be stopped with a robot: every node that the network has met, also one that is away or
// said good-bye, for it may still move.
std::vector<debug::NodeId> all_nodes(const debug::Network& network);

class Stopping {
public:
    enum class How {
        Look,  // only reads
        Rest,  // writes what makes nodes safe; scripts run on, so it is read twice. Nodes that the
               // safe stop does not name are left out.
        Stop,  // the same behind Stop, for every node
    };
    // When a node is waited for no longer.
    enum class Until {
        Away,       // it is gone as soon as it is away, and asked again when it is back
        Forgotten,  // only forget() and acknowledge() end the asking, also of one that is away
    };
    struct Manner {
        How how = How::Stop;
        Until until = Until::Away;
        // False: nobody is there to be talked to. Then no node is gone, but silent.
        bool link = true;
        // Told to stop as well, if the network does not know them; nothing is heard of them.
        std::vector<debug::NodeId> strangers = {};
    };

    // The network and the safe stop are borrowed until the next begin(). With Stop also nodes that
    // said good-bye: they may still move.
    void begin(debug::Network& network, const SafeStop& safe, How how, Time now);
    // Only these nodes.
    void begin(debug::Network& network, const SafeStop& safe, const Manner& manner, Time now,
               const std::vector<debug::NodeId>& nodes);
    // Nothing is asked any more, and nothing is known.
    void end();

    // Every event of the network. Gives the node that has just answered that its program stopped.
    std::optional<debug::NodeId> hear(const debug::Event& event);
    void tick(Time now);
    Time next_tick() const;
    // From now on; at first kMovesReadEvery.
    void read_moving_every(Duration every) { moves_every_ = every; }

    // What the node does from now on is not what was asked for here.
    void forget(debug::NodeId node);
    // A person knows of those that are not at rest: they are asked no more.
    void acknowledge();
    // Those that move do so by their scripts, which may: what they write stays.
    void let_move();

    // All are at rest, or are not there any more; with Look: all have been read.
    bool settled() const;
    // As it is now. A node that has not answered by now is silent.
    std::vector<StopNode> report() const;
    // The same, but Asked for who may still answer.
    std::vector<StopNode> nodes() const;
    // Of a node that was asked, and is neither forgotten nor acknowledged.
    std::optional<StopNode::State> state_of(debug::NodeId node) const;
    // A node that has not answered at all by now is silent from here on.
    void note_silence();

private:
    struct Check {
        debug::VariableRange range;
        std::vector<int16_t> wanted;
        bool written = false;
        std::optional<debug::RequestId> asked = {};
        std::optional<bool> good = {};
    };
    struct Node {
        std::string name;
        StopNode::State state = StopNode::State::Asked;
        std::optional<debug::RequestId> stop;
        bool halted = false;  // it answered Stop, or need not
        bool knows_checks = false;
        std::vector<Check> checks;
        bool read_once = false;  // at rest
        Time next{};             // when it is asked or read again
        bool known_of = false;   // acknowledged
    };

    bool insists() const { return manner_.until == Until::Forgotten; }
    void ask(debug::NodeId id, Node& node);
    void make_safe(debug::NodeId id, Node& node);
    void read(debug::NodeId id, Node& node);
    void judge(debug::NodeId id, Node& node);
    void come_back(debug::NodeId id, Node& node);
    static void no_answer(Node& node);
    bool has_come_to_rest(const Node& node) const;
    bool is_asked_on(const Node& node) const;

    debug::Network* network_ = nullptr;
    const SafeStop* safe_ = nullptr;
    Manner manner_;
    Duration moves_every_ = kMovesReadEvery;
    std::map<debug::NodeId, Node> nodes_;
    Time now_{};
};

}  // namespace vagus::session
