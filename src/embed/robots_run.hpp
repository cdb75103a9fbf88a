// A world in which robots have projects of their own, run on one clock: the scripts of each on its
// own bus, its plan beside it, and between them the fleet that their projects name.
//
//     auto opened = RobotsRun::open({.world = "class.world.json"});
//     RobotsRun& run = *opened.value();
//     TRY(run.start());                        // scripts run, plans begin: time 0
//     run.step(std::chrono::seconds(20));
//     print(run.buses().take_trace());
//     run.end();                               // plans that still run are interrupted
//
// At each instant: the timeline, deliveries and nodes of all buses, the fleet, the plans in the
// order of the file, the bodies. Between two instants the plan that is due first is first. The
// same world and seed give the same bytes. A world without projects runs as a SimSession does.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "debug/event.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/robot_commands.hpp"
#include "embed/robot_plan.hpp"
#include "embed/robots_watcher.hpp"
#include "plan/trace.hpp"
#include "session/sim_session.hpp"
#include "session/world_buses.hpp"
#include "session/world_fleet.hpp"

namespace vagus::embed {

struct RobotsOptions {
    std::string world = {};
    session::SimOptions sim = {};
    // Robots with a project are members at a real broker, in real time.
    std::optional<session::WorldFleet::Door> door = {};
};

class RobotsRun {
public:
    // Reads the world, the projects, their plans. The Error says what is wrong with which file.
    static Result<std::unique_ptr<RobotsRun>> open(const RobotsOptions& options);
    ~RobotsRun();

    session::WorldBuses& buses() { return *buses_; }
    // Whether there are robots with projects.
    bool has_projects() const { return !buses_->robots().empty(); }

    // Is told of each line of the trace of each plan, with the place of its robot in
    // buses().robots().
    using Listener = std::function<void(size_t robot, const plan::TraceEvent&)>;
    void listen(Listener told) { told_ = std::move(told); }
    // Before start(): is told what `vagus why` needs beside the trace. Borrowed; nullptr: nobody.
    void watch(RobotsWatcher* watcher) { watcher_ = watcher; }
    // From now on all that is random is drawn from that seed: in the world, in plans, on the ways
    // of the fleet.
    void reseed(uint64_t seed);
    // That of the robot at that place of buses().robots(); nullptr without one.
    const LoadedPlan* plan(size_t robot) const;

    // At time 0, once all scripts are there (WorldBuses::settle(), which this calls): plans begin,
    // robots join their fleets. The Error names a robot whose plan or name does not fit.
    Status start();
    // Lets `span` pass: whole milliseconds, the rest is kept.
    void step(Duration span);
    // Plans that still run are interrupted, as at the end of a run (P28); time passes until all are
    // over.
    void end();
    // Time 0 again. The Error as of start().
    Status restart();

    // Whether a plan has ended with an error.
    bool has_failed() const;

    // ---- with a door: other versions of what robots run (serve/field/world_versions.hpp) ----
    struct Deployer {
        // Another version is wanted of it; it comes again at each connection. Within step().
        std::function<void(size_t robot, const fleet::Want& want)> want;
        // Somebody said stop, or it is no longer in its fleet: nothing starts by itself any more.
        std::function<void(size_t robot)> stopped;
        std::function<void(size_t robot, const std::string& why)> plan_failed;
    };
    void deploy_by(Deployer deployer) { deployer_ = std::move(deployer); }
    // Of the robot at that place of buses().robots().
    RobotCommands& commands(size_t robot) { return *commands_[robot]; }
    // Between two steps, of a robot that was stopped: from then on it has that folder as project,
    // in the fleet where it is. Nothing of it runs before it is started. The Error says what is
    // wrong with which file.
    Status open_project(size_t robot, const std::string& folder);
    // What became of a version, for all who watch the fleet.
    void deployed(size_t robot, const fleet::Version& version);
    // How its plan is: "its plan runs"; empty: there is none.
    std::string how_plan_is(size_t robot) const;
    // A note of the run.
    void say(size_t robot, const std::string& text) { say(buses_->robots()[robot], text); }

private:
    explicit RobotsRun(std::unique_ptr<session::WorldBuses> buses);
    Status add_plan(session::RobotBus& robot);
    Status begin(size_t index);
    void instant();
    void run_plans_before(Time at);
    void hear(size_t index, Time at);
    void tell_fleet(const session::RobotBus& robot, const debug::Event& event, Time at);
    session::WorldFleet::Ears ears_of(size_t index);
    void hear_of_fleet(size_t index, const fleet::EmitOnBus& event, uint32_t frame);
    void hear_news(size_t index, const std::vector<session::FleetNews>& news);
    void add_ears_of_watcher(session::WorldFleet::Ears& ears, size_t index);
    uint32_t number_of_message(uint32_t cause);
    void add_ears_of_broker(session::WorldFleet::Ears& ears, size_t index);
    void add_commands(size_t index);
    RobotPlan::Told told_by_plan(size_t index);
    bool asks_fleet(size_t index) const;
    Status begin_plan_again(size_t index);
    void tell_version(size_t index);
    void see(size_t index, const plan::TraceEvent& event);
    void say(session::RobotBus& robot, const std::string& text);

    std::unique_ptr<session::WorldBuses> buses_;
    std::vector<std::unique_ptr<RobotPlan>> plans_;  // by place in buses().robots(); may be nullptr
    std::vector<std::unique_ptr<RobotCommands>> commands_;  // the same
    std::vector<std::optional<fleet::Version>> versions_;   // the same: what was told of them
    Deployer deployer_;
    std::unique_ptr<session::WorldFleet> fleet_;  // nullptr until start()
    std::optional<session::WorldFleet::Door> door_;
    Listener told_;
    RobotsWatcher* watcher_ = nullptr;
    bool traced_ = false;
    uint64_t seed_ = 1;
    Duration rest_{};
};

}  // namespace vagus::embed
