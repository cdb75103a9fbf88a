// What a Machine keeps of the plans that run. Only machine.cpp and machine_change.cpp include this.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plan/machine.hpp"

namespace vagus::plan {

// Whether a global supervisor watches (P23).
enum class Rest : uint8_t {
    No,
    Remedy,  // its event has been taken, or only computations have followed: what comes next is
             // its remedy
    Resting  // an actor that is no computation is active; it starts again with the activation after
};

// What follows when an activation has been stopped.
struct Machine::After {
    int target = kTargetTerminate;  // of the newest version
    bool failed = false;
    std::string message = {};
};

// A plan as one of its versions says, and the variables that its slots mean.
struct Machine::Version {
    const GraphPlan* plan = nullptr;
    // Owners: the versions of this plan and of those that share the variable. One that is gone in
    // the newest version lives on for what was started before (P31).
    std::vector<std::shared_ptr<Value>> cells;
};

struct Machine::Watch {
    WatchId id = 0;  // 0: does not watch
    Rest rest = Rest::No;
    int level = 0;
    bool global = false;
    int index = 0;                            // of a global one: in the newest version
    const GraphSupervisor* of = nullptr;      // as it was started
    const GraphSupervisor* newest = nullptr;  // whose targets count (P31)
    std::shared_ptr<const Version> version;   // of `of`; owners: as Level::begun
};

// One plan that runs: the outermost, or one inside an actor of the level below.
struct Machine::Level {
    std::string path;
    std::shared_ptr<const Version> now;  // the newest
    std::vector<Watch> globals;          // in the order of the newest

    // The activation.
    const GraphActor* active = nullptr;  // as it was started; nullptr: none yet
    const GraphActor* newest = nullptr;  // whose targets count (P31)
    // That it was started with. Owners: the level, and the supervisors that were started with it.
    std::shared_ptr<const Version> begun;
    ActivationId activation = 0;
    Phase phase = Phase::None;
    std::vector<Watch> own;
    bool interrupted = false;  // and this from then on:
    Time interrupted_at{};
    After after;

    // What the plan inside gave, from its end to end_sub_plan().
    PlanResult sub_result = PlanResult::Ok;
    std::vector<std::optional<Value>> sub_outputs;
};

}  // namespace vagus::plan
