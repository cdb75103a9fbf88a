// Runs a sample plan in a world, in virtual time, and keeps what a judge needs: where the robot
// was, how near the walls were, what it touched, how the plan ended.
//
//     const auto ran = run_sample({.plan = "WallFollow.plan.json", .world = "hall.world.json",
//                                  .seed = 7},
//                                 [](const Moment& now) { return now.at < 60s; });
//     for (const Moment& moment : ran.value().way) …
//
// One robot is watched: the first of the world. The seed is that of the world (noise, slip) and of
// the plan.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/rng.hpp"
#include "plan/value.hpp"
#include "run/options.hpp"
#include "sim/world.hpp"

namespace vagus::samples {

constexpr Duration kLookEvery = std::chrono::milliseconds(50);
constexpr double kTouchingMetres = 0.005;  // the solver keeps bodies a little apart

struct Start {
    std::string plan;   // path
    std::string world;  // path
    uint64_t seed = 1;
    std::optional<sim::Pose> at = {};  // empty: as the world file says
    Duration at_most = std::chrono::minutes(10);
    bool traced = false;                                        // keep the lines of both traces
    std::vector<std::pair<std::string, plan::Value>> set = {};  // variables of the plan
};

// The robot at one of the instants at which it is looked at.
struct Moment {
    Time at{};
    sim::Pose pose;
    double gap = 0;  // m: from the hull to the nearest thing
    // The innermost that runs; valid as long as the Ran is, wherever it is moved.
    std::string_view actor;
    std::vector<sim::Pose> others = {};  // of the other robots, in the order of the world file
};

// The hull was on something, without a pause.
struct Contact {
    Time from{};
    Duration length{};
};

struct Ran {
    run::Ended ended;
    bool called_off = false;  // by the look
    std::vector<Moment> way;
    std::vector<Contact> contacts;
    std::vector<std::string> states;  // "actor: State" or "actor! Event", in their order
    std::string trace;
    std::set<std::string, std::less<>> names;  // of the actors in `way`
};

// `look` sees each moment; false calls the run off. Fails for files that are wrong.
Result<Ran> run_sample(const Start& start, const std::function<bool(const Moment&)>& look = {});

// A pose at which the hull of the world's first robot is at least `clear` metres from everything.
Result<sim::Pose> free_pose(const std::string& world, double clear, SplitMix64& random);

}  // namespace vagus::samples
