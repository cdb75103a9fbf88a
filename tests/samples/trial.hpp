// A sample plan in a world, again and again: each seed gives the robot another start, a little off
// that of the world file, and other noise.
//
//     Worst off("end, cm");
//     try_seeds({.plan = example("patterns/Square.plan.json"),
//                .world = example("patterns/carbot.world.json")},
//               [&](const Trial& trial) { EXPECT_LT(off.note(trial.end().at.x * 100), 5); });
//
// A failure says which seed it was.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "sample_run.hpp"

namespace vagus::samples {

constexpr uint64_t kSeeds = 20;

std::string example(const std::string& path);     // in examples/
std::string test_world(const std::string& name);  // in tests/samples/worlds/

struct TrialOptions {
    std::string plan;
    std::string world;
    double off_metres = 0.05;  // of the start, along x and along y, at most
    double off_radians = 0.1;
    Duration at_most = std::chrono::minutes(10);
    std::vector<std::pair<std::string, plan::Value>> set = {};
    bool traced = false;
};

struct Trial {
    uint64_t seed = 0;
    sim::Pose begin;
    Ran ran;

    // As seen from where it began: x ahead, y to the left.
    sim::Pose from_begin(const sim::Pose& pose) const;
    sim::Pose end() const { return from_begin(ran.way.back().pose); }
    Duration longest_contact() const;
};

// Judges each of kSeeds runs; a run that cannot begin is a failure of the test.
void try_seeds(const TrialOptions& options, const std::function<void(const Trial&)>& judge);

// The largest of the figures of a test, printed when it is over.
class Worst {
public:
    explicit Worst(std::string_view what) : what_(what) {}
    ~Worst();
    Worst(const Worst&) = delete;
    Worst& operator=(const Worst&) = delete;

    double note(double figure);  // gives it back

private:
    std::string what_;
    double worst_ = 0;
    int noted_ = 0;
};

double metres_between(const sim::Point& one, const sim::Point& other);
double degrees_off(double radians, double wanted_radians);  // 0 to 180
double seconds(Duration duration);

}  // namespace vagus::samples
