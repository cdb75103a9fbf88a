// A world with all its buses on one clock: the common one, and that of each robot which has a
// project of its own. Scripts are loaded on each; what happens is told together, in one order.
//
//     auto opened = WorldBuses::open("class.world.json", {});
//     WorldBuses& buses = *opened.value();
//     buses.settle();                                    // where a robot has a project
//     buses.begin_instant();                             // plans have their turns between the two
//     buses.end_instant();
//     for (const Note& note : buses.take_notes()) show(note.text);
//
// At an instant, in the order of docs/ARCHITECTURE.md: the timeline, deliveries and nodes of all
// buses, then what is between the two calls, then the bodies. Of several buses the common one is
// told first, then the robots in the order of the file.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "session/project_file.hpp"
#include "session/sim_session.hpp"

namespace vagus::session {

// A robot with its project, and the session of its bus.
struct RobotBus {
    sim::RobotId id;
    std::string name;
    ProjectFile project;
    std::unique_ptr<SimSession> session;
};

class WorldBuses {
public:
    // The Error names the place in the world file, or in the project that it names.
    static Result<std::unique_ptr<WorldBuses>> open(const std::string& path,
                                                    const SimOptions& options);

    const sim::World& world() const { return common_.world(); }
    sim::World& world() { return common_.world(); }
    SimSession& common() { return common_; }
    const SimSession& common() const { return common_; }
    // In the order of the file; empty in a world without projects.
    std::vector<RobotBus>& robots() { return robots_; }
    // The session of the bus that the robot is on.
    const SimSession& of(sim::RobotId robot) const;
    // All sessions: that of the common bus, then those of the robots.
    template <typename Do>
    void each(const Do& look) const {
        look(common_);
        for (const RobotBus& robot : robots_) look(std::as_const(*robot.session));
    }
    // A file that was loaded on any of the buses has another text now.
    void reload(const std::string& path, const std::string& text);
    std::vector<std::string> script_paths() const;

    // At time 0, while time is stopped, as SimSession::settle().
    bool settle();
    bool settled() const;
    Time now() const { return common_.now(); }

    void begin_instant();
    void end_instant();
    // Time 0 again, the same scripts are sent again.
    void reset();

    // Of all buses since the last call.
    std::vector<Note> take_notes();
    std::string take_trace();
    // Adds lines of other code, in their place among those of the buses.
    void trace(const std::string& lines);
    std::vector<Diagnostic> mistakes() const;
    std::vector<std::string> without_script() const;

private:
    WorldBuses(SimSession common, bool traced) : common_(std::move(common)), traced_(traced) {}
    template <typename Do>
    void each(const Do& act) {
        act(common_);
        for (RobotBus& robot : robots_) act(*robot.session);
    }
    void gather();

    SimSession common_;
    std::vector<RobotBus> robots_;
    std::vector<const SimSession*> of_;  // by robot
    const bool traced_;
    std::string trace_;
};

}  // namespace vagus::session
