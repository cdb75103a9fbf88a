// A bus that others are on, for a plan in real time: a connection, the nodes on it, and the events,
// on a thread of its own while the plan runs.
//
//     auto opened = PlanBus::open({"tcp:127.0.0.1:33333", common, "arm.aesl", tell}, bus_nodes);
//     PlanBus& bus = *opened.value();
//     bus.join(options);
//     run::RealTime run(graph, library, options);
//     bus.start(run);
//     const run::Ended ended = run.run();          // meanwhile, from anywhere: stop_robot()
//     const auto nodes = bus.leave(session::Stopping::How::Rest);
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "aesl/target.hpp"
#include "base/result.hpp"
#include "embed/bus_tap.hpp"
#include "run/options.hpp"
#include "run/real_time.hpp"
#include "session/bus_names.hpp"
#include "session/stopping.hpp"
#include "toolbox/bus.hpp"
#include "toolbox/bus_talk.hpp"

namespace vagus::embed {

constexpr Duration kRestWithin = std::chrono::seconds(3);  // for nodes to be read back at rest
constexpr size_t kUnsentMax = 65'536;  // events that the plan emitted and that wait for the thread

struct PlanBusOptions {
    std::string target;
    aesl::CommonDefinitions common;  // names and numbers of events
    std::string project;             // where they come from, for sentences
    // When the connection is lost or there again, or another plan commands the same nodes: a
    // sentence, on the thread of the bus.
    std::function<void(const std::string&)> tell;
    uint64_t seed = 0;                      // of where tokens begin (session/rival_plans.hpp)
    std::vector<toolbox::NodeNames> needs;  // the nodes that the plan works on …
    std::set<std::string> starts;           // … and the events by which work begins there
    std::set<std::string> stops;            // those by which it ends
    bool works_anywhere = false;            // not only on `needs`: it sends events of its own
    session::SafeStop safe_stop = {};
};

class PlanBus {
public:
    // Connects, and waits until the nodes that are there have said who they are; from then on
    // `nodes` tells. The Error says who is not there, of which node that the plan needs there are
    // two (a robot has a bus of its own), or that the robot does not come to rest: if a node on
    // which the plan works moves, or does not say so, the robot is stopped first, for nobody knows
    // who drives it.
    // Scripts that were stopped or paused, by this or before, run again then. If an end is asked
    // for meanwhile (net/end_signal.hpp), nothing is waited for any more, and what has not begun is
    // left out: the run that follows is to be aborted.
    static Result<std::unique_ptr<PlanBus>> open(PlanBusOptions options, toolbox::BusNodes& nodes);
    // A plan that never began leaves the robot stopped, if scripts were let run for it.
    ~PlanBus();

    // The run emits on this bus, with tokens from a random place on. Borrowed for the run.
    void join(run::RunOptions& options);

    // Before start(). If another host stops, pauses or resets a node on which the plan works, and
    // nobody lets it run again soon, the run ends with an error. Not for a host that pauses nodes
    // itself and does not say so by hold_nodes().
    void end_when_stopped();
    // Before start(). If a node is paused, stopped, faulted or lost, the others that move are
    // paused and made safe until it runs again. Not for who shares the bus with a host that does.
    void brake_as_a_whole();
    // From any thread: these nodes, and no others, are held by somebody who debugs them. The plan
    // waits for them as long as that takes.
    void hold_nodes(std::set<debug::NodeId> nodes);
    // Before join(): is told of the frames from now on, of tokens and failures; nullptr: nobody is.
    void tap(BusTap* tap);
    // From now on the run hears each event of the bus. A lost connection is tried again, and its
    // nodes are gone meanwhile. Borrowed until leave().
    void start(run::RealTime& run);
    // From any thread, also before start(): every node is told to stop now, and made safe behind
    // that. Of what the plan emits from now on only its `stops` go out.
    void stop_robot();
    // The run is over. With Rest the nodes on which the plan works are brought to rest, and scripts
    // run on; with Stop, or after stop_robot(), all of the robot is stopped. Gives what was read
    // back, after kRestWithin at the latest.
    // What was emitted has left when this returns, if somebody takes it.
    std::vector<session::StopNode> leave(session::Stopping::How how);

private:
    class Insides;
    explicit PlanBus(std::unique_ptr<Insides> insides);
    std::unique_ptr<Insides> insides_;
};

}  // namespace vagus::embed
