// The plan of one robot among several of a world, with what it has around it: its bus, its camera.
// It is stepped from outside (run/virtual_time.hpp), by its owner in the order of all plans.
//
//     auto plan = TRY(RobotPlan::load(robot));           // a RobotBus whose project has a plan
//     TRY(plan->begin(seed, heard, told));               // its scripts run by now
//     plan->hear(std::move(event));                      // of the bus, for the next instant
//     while (!plan->over() && plan->now() <= at) plan->step();
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "debug/event.hpp"
#include "embed/loaded_plan.hpp"
#include "run/surroundings.hpp"
#include "run/virtual_time.hpp"
#include "session/bus_ears.hpp"
#include "session/bus_names.hpp"
#include "session/world_buses.hpp"
#include "session/world_camera.hpp"
#include "toolbox/bus.hpp"
#include "toolbox/parts.hpp"

namespace vagus::embed {

// Plans that are interrupted stop within the grace times of their actors; more than so much
// simulated time is not waited for.
constexpr Duration kPlansEndWithin = std::chrono::seconds(60);

class RobotPlan final : private run::Surroundings {
public:
    // Called with what happens in the plan, on the thread that steps it.
    struct Told {
        std::function<void(const plan::TraceEvent&)> line;
        // What a supervisor raises, before it is taken. True: it is passed over. Empty: none is.
        std::function<bool(const run::Raising&)> passes_over = {};
        // It has sent an event to the bus. May be empty.
        std::function<void(const run::BusEvent&)> sent = {};
    };

    // `robot` and its world are borrowed. The Error has the findings of the plan, or says what is
    // wrong with the values that the project gives its variables.
    static Result<std::unique_ptr<RobotPlan>> load(session::RobotBus& robot);
    ~RobotPlan() override;

    // A run from that time of the world on; `before` tells who is on the bus. The Error names
    // events that the robot's scripts do not have.
    Status begin(uint64_t seed, const std::vector<debug::Event>& before, Told told, Time at = {});
    // Whether a template of it asks the fleet.
    bool needs_fleet() const;
    // Before its first step: what its templates ask of the fleet; nullptr: there is none. The Error
    // says which template needs one. Borrowed.
    Status join(toolbox::Fleet* fleet);
    // Both are for the plan's next instant.
    void hear(const debug::Event& event);
    void hear(run::BusEvent event);

    bool over() const { return ended_.has_value() || !run_; }
    // Of the world.
    Time now() const { return began_at_ + run_->now(); }
    // It has something to do at that time of the world, or before.
    bool is_due(Time at) const { return !over() && !paused_at_ && now() <= at; }
    void step();
    // Goes on by itself if it is paused, to its end.
    void abort();

    // From that time of the world on it does nothing, its clock stops, and events wait for it, at
    // most run::kHeldEventsMax.
    void pause(Time at);
    void go_on(Time at);
    bool paused() const { return paused_at_.has_value(); }
    // As if a supervisor, which must watch now, had raised the event. The Error names those that
    // do.
    Status raise(const std::string& supervisor, const std::string& event);
    // From now on what is random in its code is drawn from that seed.
    void reseed(uint64_t seed) {
        if (!over()) run_->reseed(seed);
    }
    // Variables of the outermost plan, while it runs; a value is converted to the type.
    Result<plan::Value> variable(const std::string& name) const;
    Status set(const std::string& name, const plan::Value& value);
    // How it has ended; nothing while it runs.
    const std::optional<run::Ended>& ended() const { return ended_; }
    const std::string& name() const { return plan_->graph().plans.front().name; }
    const LoadedPlan& loaded() const { return *plan_; }

private:
    explicit RobotPlan(session::RobotBus& robot);
    Result<int> slot_of(const std::string& name) const;

    // ---- run::Surroundings ----
    Time next() const override { return begun_ + sim::kNodeStep; }
    std::vector<run::BusEvent> begin() override;
    void emit(Time at, const run::BusEvent& event) override;
    void end() override {}

    session::RobotBus& robot_;
    toolbox::BusNodes nodes_;
    session::WorldCamera camera_;
    toolbox::Parts parts_;
    run::CodeLibrary library_;
    std::optional<LoadedPlan> plan_;
    run::RunOptions options_;
    std::function<void(const run::BusEvent&)> told_of_sent_;
    std::optional<session::BusNames> names_;
    std::optional<session::BusEars> ears_;
    std::optional<run::VirtualTime> run_;
    std::optional<run::Ended> ended_;
    std::optional<std::set<std::string>> only_;  // what goes out once it is being stopped
    std::vector<run::BusEvent> heard_;
    Time began_at_{};                // its own time 0, later by as long as it was paused
    Time begun_{};                   // of its own time, the last instant
    std::optional<Time> paused_at_;  // of the world
};

}  // namespace vagus::embed
