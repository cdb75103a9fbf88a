// One run of `vagus sim`: passes the time, moves the bytes of the bus, watches the script files,
// shows what happens.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aesl/compile.hpp"
#include "base/result.hpp"
#include "serve/broker/fleet_options.hpp"

namespace vagus::cli {

constexpr double kSpeedMax = 1000;
constexpr double kSpeedMin = 0.01;

struct SimRunOptions {
    std::string world;
    std::vector<std::string> loads;
    bool watch = false;
    bool headless = false;
    double speed = 1;                // 0: as fast as it goes
    std::optional<double> duration;  // simulated seconds
    std::optional<uint64_t> seed;
    std::vector<std::string> poses;   // where robots begin, as of `plan run`
    std::optional<unsigned> threads;  // empty: by the number of robots
    std::string listen;
    std::string trace;
    std::string chaos;   // what breaks, as of `plan run`; empty: nothing
    std::string record;  // a file for the recording; empty: none
    bool record_camera = false;
    std::string sd_folder;
    serve::FleetOptions fleet = {};  // robots with projects are members there
    std::string logins;              // a folder with NAME.login for each
    std::string theme;               // "dark", "light"; empty: found out
    aesl::Options compile;
};

// To the end of the run. Gives the exit code.
int run_sim(const SimRunOptions& options);

}  // namespace vagus::cli
