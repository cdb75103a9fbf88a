// What conditions read, as it is now in a run, and when they are asked: after each line of the
// trace, and each kAskedEvery; from when the first actor of the plan starts to the plan's end. In a
// world without a plan from its beginning, and at each user event of the robot's bus.
//
//     Readings readings(graph, read_world_of(world));    // world: nullptr without one
//     readings.line(event);                          // each line of the trace
//     if (readings.are_asked()) ask(readings.values(condition));
//     readings.instant();                            // at the end of each instant of the world
//     if (readings.are_asked_now()) ask(readings.values(condition));
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plan/trace.hpp"
#include "run/traced_variables.hpp"
#include "session/plan_world.hpp"
#include "session/world_buses.hpp"
#include "trial/condition.hpp"

namespace vagus::trial {

constexpr Duration kAskedEvery = std::chrono::milliseconds(20);

// The world of a run, and the robot in it that signals are about. Borrowed; nullptr: there is none.
struct ReadWorld {
    session::SimSession* session = nullptr;
    sim::RobotId robot = {};
    const session::WorldBuses* buses = nullptr;  // of the other robots, if these have their own
};
ReadWorld read_world_of(session::PlanWorld* world);

// `told` of each user event that this bus hears from here on, where no plan raises any.
void hear_events(session::SimSession& session,
                 const std::function<void(Time, const std::string& name)>& told);

class Readings {
public:
    // Both are borrowed. A graph whose plan has no actors is that of a world without a plan.
    Readings(const plan::Graph& graph, const ReadWorld& world)
        : variables_(graph),
          world_(world),
          has_plan_(!graph.plans.front().actors.empty()),
          started_(!has_plan_) {}

    void line(const plan::TraceEvent& event);
    // A user event, where no plan raises any.
    void event(Time at, std::string_view name);
    // The line of an event is over; bodies have moved.
    void instant();

    Time now() const { return now_; }
    // Before its first actor a plan takes the values that it was given.
    bool are_asked() const { return started_ && !over_; }
    bool are_asked_now() const { return are_asked() && now_ % kAskedEvery == Duration::zero(); }
    // The plan is, and its variables are gone with it.
    bool over() const { return over_; }
    // Whether there is a plan, whose actors run.
    bool has_plan() const { return has_plan_; }
    // Of all names of a condition, in their order.
    Result<std::vector<plan::Value>> values(const Condition& condition) const;
    // Only once the plan has started. The Error says why there is none.
    Result<plan::Value> value(const Condition::Name& name) const;
    // Whether the node and its word are there. The Error names what is not, and what is.
    Status check(const Condition::Name& name) const;

private:
    plan::Value signal(SignalId id) const;
    plan::Value of_robot(SignalId id) const;
    double bus_percent() const;
    Result<int16_t> word(const Condition::Name& name) const;
    static Result<int16_t> word_of(const Condition::Name& name, const session::SimSession& on,
                                   const session::NodeState& node);
    session::SimSession& session() const { return *world_.session; }

    run::TracedVariables variables_;
    ReadWorld world_;
    Time now_{};
    std::vector<std::string> actors_;  // that run, the outermost first; empty text: between two
    std::string event_;
    Duration contact_{};
    bool has_plan_;
    bool started_;
    bool over_ = false;
};

}  // namespace vagus::trial
