// `vagus serve`: one project, run and served where the robot is, without anybody watching.
#pragma once

#include <functional>
#include <string>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/field/fleet_robot.hpp"
#include "serve/workbench/door.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kFiguresEvery = 1s;  // /metrics is made again

struct ServiceOptions {
    std::string project = {};  // a path
    bool start = false;        // runs as soon as the nodes are there
    bool stop_only = false;    // stops the robot and ends
    std::string target = {};   // instead of the project's own
    DoorOptions door = {};
    FleetOptions fleet = {};
    std::string data = {}, config = {};  // folders; empty: the user's
};

struct ServiceTalk {
    std::function<void(const std::string& line)> print;  // results: the address
    // One line for the log: a note, a warning, an error.
    std::function<void(const std::string& kind, const std::string& text)> log;
};

// Serves until a signal comes, unless it only stops the robot; the robot is stopped then. The Error
// says why it cannot begin.
Status run_service(const ServiceOptions& options, const ServiceTalk& talk);

}  // namespace vagus::serve
