// A world beside a plan, on one clock: its robots run the scripts that the world file names for
// them, what the plan emits goes out on their bus as from a host, what they emit the plan hears.
//
//     toolbox::BusNodes nodes;                                  // templates ask it who is there
//     auto opened = PlanWorld::open({.path = "arena.world.json"}, nodes);
//     PlanWorld& world = *opened.value();
//     report(world.names().check(plans, library.templates()));
//     world.join(options);                                      // run::RunOptions
//     run::VirtualTime(graph, library, options).run();
//
// Time 0 of the run is that of the world's timeline; the scripts run by then (docs/decisions/0083).
// What is sent at one millisecond arrives at the next, both ways.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "run/options.hpp"
#include "run/surroundings.hpp"
#include "session/bus_ears.hpp"
#include "session/bus_names.hpp"
#include "session/sim_session.hpp"
#include "session/world_camera.hpp"
#include "toolbox/bus_talk.hpp"

namespace vagus::session {

struct PlanWorldOptions {
    std::string path = {};
    std::optional<uint64_t> seed = {};         // instead of that of the file
    std::vector<sim::RobotStart> starts = {};  // as sim::WorldOptions
    std::optional<unsigned> threads = {};      // likewise
    sim::Chaos chaos = {};                     // likewise
    bool traced = false;                       // keep lines for session().take_trace()
    std::string robot = {};  // of several that the plan could drive; empty: the only one
    std::vector<toolbox::NodeNames> needs = {};  // nodes that the plan works on, one of each list
    SafeStop guests = shipped_safe_stop();       // as SimOptions
};

class PlanWorld final : public run::Surroundings {
public:
    // Fails for a file that is wrong, and for scripts that are: the Error has the compiler's lines.
    // A plan is for one robot: fails too if the plan could drive several and none is named, or if
    // the named one lacks a node.
    static Result<std::unique_ptr<PlanWorld>> open(const PlanWorldOptions& options,
                                                   toolbox::BusNodes& nodes);

    const BusNames& names() const { return names_; }
    // Puts the world beside the run, and the run on its bus. Borrowed for the run.
    void join(run::RunOptions& options);
    // The robot that the plan drives; the first one of the world if the plan asks for no node.
    sim::RobotId robot() const { return robot_.value_or(sim::RobotId{1}); }
    // That of the robot, for toolbox::Parts; nullptr if it has none.
    toolbox::Camera* camera() { return camera_.exists() ? &camera_ : nullptr; }
    // From now on only these of what the plan emits go out: a robot that is being stopped is not
    // told to move again by what the plan says as it ends. From any thread.
    void close_but_for(std::set<std::string> events);
    // Is told of what the plan emits, before it leaves.
    void on_emit(std::function<void(Time, const run::BusEvent&)> told) {
        told_of_emit_ = std::move(told);
    }
    // Called at each instant, on the deciding thread, before anything of it happens: to pace the
    // run, to look at it, to act on the world.
    void before_each(std::function<void(Time)> act) { before_each_ = std::move(act); }

    SimSession& session() { return session_; }
    const SimSession& session() const { return session_; }

    // On the deciding thread: something that is no event of the bus, at the next instant.
    void bring(run::BusEvent event) { brought_.push_back(std::move(event)); }

    // ---- run::Surroundings ----
    Time next() const override { return session_.now() + sim::kNodeStep; }
    std::vector<run::BusEvent> begin() override;
    std::vector<run::BusEvent> arrived() override;
    void emit(Time at, const run::BusEvent& event) override;
    void end() override { session_.end_instant(); }

private:
    PlanWorld(SimSession session, BusNames names, toolbox::BusNodes& nodes,
              std::optional<sim::RobotId> robot);
    std::vector<run::BusEvent> hear();

    SimSession session_;
    std::optional<sim::RobotId> robot_;  // empty: what the plan emits is for all
    WorldCamera camera_;
    BusNames names_;
    BusEars ears_;
    std::vector<run::BusEvent> brought_;
    std::function<void(Time)> before_each_;
    std::function<void(Time, const run::BusEvent&)> told_of_emit_;
    std::mutex mutex_;  // guards what follows
    std::optional<std::set<std::string>> only_;
};

}  // namespace vagus::session
