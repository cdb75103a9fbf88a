// What somebody tells the nodes of a robot of a world that follows real time: stop, start, pause,
// continue, write. Each is answered once, when the nodes have answered.
//
//     NodeCommands commands(*robot.session);
//     commands.stop(safe_stop, [](const std::vector<StopNode>& nodes) { … });
//     for (const debug::Event& event : robot.session->take_heard()) commands.hear(event);
//     commands.tick();                                   // both at each instant
//
// A node that does not answer Stop is asked again until it does, or is started: who waits for the
// answer is told that it is silent (design: safe stop, S9).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "session/sim_session.hpp"
#include "session/stopping.hpp"

namespace vagus::session {

constexpr Duration kStopReportWithin = std::chrono::seconds(1);  // then it is told as it is
constexpr Duration kStartReportWithin = std::chrono::seconds(5);

class NodeCommands {
public:
    using Stopped = std::function<void(const std::vector<StopNode>&)>;
    using Done = std::function<void(const std::string& why)>;  // why it was not done; empty: it was

    // Borrowed.
    explicit NodeCommands(SimSession& session) : session_(session) {}
    NodeCommands(const NodeCommands&) = delete;  // its safe stop is borrowed within
    NodeCommands& operator=(const NodeCommands&) = delete;

    // At once, before all else that is under way; no script is loaded from then on until start().
    void stop(const SafeStop& safe, Stopped done);
    // What does not run, or was told to stop, gets its script again and runs it from its beginning.
    void start(Done done);
    // Nodes that run keep their place, and what moves is made safe.
    void pause(const SafeStop& safe, Done done);
    void go_on(Done done);
    bool paused() const { return paused_; }
    bool any_runs() const { return !with_state(debug::ProgramState::Running).empty(); }
    void set(const std::string& node, const std::string& name, const std::vector<int16_t>& values,
             Done done);

    // Of the bus.
    void hear(const debug::Event& event);
    void tick();
    // The world begins again: nobody is asked any more, and who waits for an answer gets it now.
    void begin_again();

private:
    struct WaitsForStop {
        Stopped done;
        Time until{};
    };
    struct WaitsForStart {
        Done done;
        Time until{};
    };
    // Several nodes are asked one thing.
    struct Batch {
        std::vector<debug::RequestId> open;
        std::string why;
        Done done;
    };
    std::vector<debug::NodeId> nodes() const;
    std::vector<debug::NodeId> with_state(debug::ProgramState state) const;
    void begin(const SafeStop& safe, Stopping::How how);
    void answer_stops(bool anyway);
    void answer_starts(const std::string& anyway);
    std::string why_not_started() const;
    void wait_for(Batch batch);
    void finish(const debug::RequestDone& done);

    SimSession& session_;
    SafeStop safe_;
    Stopping stopping_;
    std::vector<WaitsForStop> stops_;
    std::vector<WaitsForStart> starts_;
    std::vector<Batch> batches_;
    bool paused_ = false;
    bool stopped_ = false;  // all were told to, and perhaps have not yet
};

}  // namespace vagus::session
