// A world beside a plan, on one clock: its robots run the scripts that the world file names for
// them, what the plan emits goes out on their bus as from a host, what they emit the plan hears.
//
//     toolbox::BusNodes nodes;                                  // templates ask it who is there
//     auto opened = PlanWorld::open({.path = "arena.world.json"}, nodes);
//     PlanWorld& world = *opened.value();
//     report(world.names().check(plans));
//     world.join(options);                                      // run::RunOptions
//     run::VirtualTime(graph, library, options).run();
//
// Time 0 of the run is that of the world's timeline; the scripts run by then (docs/decisions/0083).
// What is sent at one millisecond arrives at the next, both ways.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "run/options.hpp"
#include "run/surroundings.hpp"
#include "session/bus_ears.hpp"
#include "session/bus_names.hpp"
#include "session/sim_session.hpp"
#include "session/world_camera.hpp"

namespace vagus::session {

struct PlanWorldOptions {
    std::string path = {};
    std::optional<uint64_t> seed = {};  // instead of that of the file
    bool traced = false;                // keep lines for session().take_trace()
};

class PlanWorld final : public run::Surroundings {
public:
    // Fails for a file that is wrong, and for scripts that are: the Error has the compiler's lines.
    static Result<std::unique_ptr<PlanWorld>> open(const PlanWorldOptions& options,
                                                   toolbox::BusNodes& nodes);

    const BusNames& names() const { return names_; }
    // Puts the world beside the run, and the run on its bus. Borrowed for the run.
    void join(run::RunOptions& options);
    // That of the first robot that has one, for toolbox::Parts; nullptr if none has.
    toolbox::Camera* camera() { return camera_.exists() ? &camera_ : nullptr; }
    // Called at each instant, on the deciding thread, before anything of it happens: to pace the
    // run, to look at it, to act on the world.
    void before_each(std::function<void(Time)> act) { before_each_ = std::move(act); }

    SimSession& session() { return session_; }
    const SimSession& session() const { return session_; }

    // ---- run::Surroundings ----
    Time next() const override { return session_.now() + sim::kNodeStep; }
    std::vector<run::BusEvent> begin() override;
    void emit(Time at, const run::BusEvent& event) override;
    void end() override { session_.end_instant(); }

private:
    PlanWorld(SimSession session, BusNames names, toolbox::BusNodes& nodes);
    std::vector<run::BusEvent> hear();

    SimSession session_;
    WorldCamera camera_;
    BusNames names_;
    BusEars ears_;
    std::function<void(Time)> before_each_;
};

}  // namespace vagus::session
