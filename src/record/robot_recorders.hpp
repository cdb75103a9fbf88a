// What is recorded of robots that have projects of their own, beside what a Recorder records of
// their world: of each its bus, its nodes, its plan, and a check of them each second, in channels
// below /robot/NAME.
//
//     Recorder recorder(tape, format_run(about));
//     recorder.follow(run.buses().common());
//     RobotRecorders robots(tape, run);                  // before run.start()
//     …
//     recorder.end(at);
//     robots.end(at);
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "embed/robots_run.hpp"
#include "record/recorder.hpp"

namespace vagus::record {

// A file has 65,535 channels, and a robot a handful and one for each of its nodes.
constexpr size_t kRobotsRecordedMax = 1000;

class RobotRecorders {
public:
    // Both borrowed. A run of robots without projects has nothing to record here.
    RobotRecorders(Tape& tape, embed::RobotsRun& run);
    ~RobotRecorders();
    RobotRecorders(const RobotRecorders&) = delete;
    RobotRecorders& operator=(const RobotRecorders&) = delete;

    // The last check of each.
    void end(Time at);
    // What their checks say that are made now: a member of JSON, "robots", with one for each.
    std::string check_member(Time at) const;

private:
    class Below;
    struct OfRobot {
        std::unique_ptr<Below> tape;
        std::unique_ptr<Recorder> recorder;
    };

    embed::RobotsRun& run_;
    std::vector<OfRobot> robots_;  // as in run.buses().robots()
};

// The robots of a run that have projects, by name. The Error says how many can be recorded.
Result<std::vector<std::string>> recorded_robots(embed::RobotsRun& run);

}  // namespace vagus::record
