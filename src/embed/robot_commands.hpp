// What a fleet at a real broker tells a robot of a world, and what it sees of it: its nodes
// (session/node_commands.hpp) and the plan beside them, if it has one.
//
//     RobotCommands commands(robot, plan, {.begin_plan = …, .stopped = …, .plan_failed = …});
//     commands.obey(command, [](fleet::Answer answer) { … });   // then or later, once
//     commands.hear(event); commands.tick();                    // at each instant
//     const fleet::Shown now = commands.shown();
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "embed/robot_plan.hpp"
#include "fleet/member.hpp"
#include "plan/word_formula.hpp"
#include "session/node_commands.hpp"
#include "session/safe_stop.hpp"
#include "session/world_buses.hpp"

namespace vagus::embed {

class RobotCommands {
public:
    struct Calls {
        std::function<Status()> begin_plan;  // its nodes run by now
        // Somebody said stop, or the robot is no longer in its fleet.
        std::function<void()> stopped;
        std::function<void(const std::string& why)> plan_failed;  // and nobody had said stop
    };
    using Answered = std::function<void(fleet::Answer)>;
    using Done = std::function<void(const std::string& why)>;  // why it was not done; empty: it was

    // Borrowed; `plan` may become another one, or none.
    RobotCommands(session::RobotBus& robot, const std::unique_ptr<RobotPlan>& plan, Calls calls);

    void obey(const fleet::Command& command, Answered done);
    // Ends the plan and stops the nodes. `done` gets the state in which each node was last seen.
    void stop(session::NodeCommands::Stopped done);
    // Nodes run their scripts, and then the plan begins; what runs already is left alone.
    void start(Done done);

    // Another project is loaded by now; nothing of it runs.
    void project_changed();
    // Why its program does not run; empty: it does, or it is not to. Shown as a fault.
    void does_not_start(std::string why) { refused_ = std::move(why); }

    fleet::Shown shown() const;
    // The Error says why it has none.
    Result<std::vector<int16_t>> values(const fleet::Tells& variable) const;
    Result<plan::Value> read(const plan::WordFormula::Name& name) const;
    // Names of nodes that its scripts need and that are not there.
    std::vector<std::string> missing() const;

    // Each line of the trace of its plan, and each event of its bus.
    void see(const plan::TraceEvent& event);
    void hear(const debug::Event& event) { nodes_.hear(event); }
    void tick() { nodes_.tick(); }
    // The world begins again, and who waits for an answer gets it now.
    void begin_again() { nodes_.begin_again(); }

private:
    std::string emit(const std::string& event, const std::vector<int16_t>& values);
    void pause(Done done);
    void go_on(Done done);
    void raise(const fleet::Command& command, const Done& done);
    bool paused() const { return nodes_.paused() || (plan_runs() && plan_->paused()); }
    void set(const fleet::Command& command, Done done);
    const session::SafeStop& safe_stop() const {
        return own_safe_ ? *own_safe_ : session::shipped_safe_stop();
    }
    bool plan_runs() const { return plan_ != nullptr && !plan_->over(); }

    session::RobotBus& robot_;
    const std::unique_ptr<RobotPlan>& plan_;
    const Calls call_;
    std::optional<session::SafeStop> own_safe_;  // instead of the shipped one
    session::NodeCommands nodes_;
    std::string refused_, actor_, plan_error_;
    bool is_stopped_ = false;
};

}  // namespace vagus::embed
