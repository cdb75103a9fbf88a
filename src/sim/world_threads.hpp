// Chooses the threads of a world while it runs, unless somebody has said how many: whoever steps it
// has a clock, and tells when each piece begins and ends.
//
//     WorldThreads threads(world, options.threads.has_value());
//     threads.begin(clock());
//     world.step(std::chrono::milliseconds(10));
//     threads.end(clock(), std::chrono::milliseconds(10));
#pragma once

#include <optional>
#include <utility>

#include "sim/thread_choice.hpp"
#include "sim/world.hpp"

namespace vagus::sim {

class WorldThreads {
public:
    // The world is borrowed.
    WorldThreads(World& world, bool said) : world_(world), chooses_(!said && world.threads() > 1) {}

    void begin(Time real) { began_ = real; }
    // So much simulated time has passed since begin(); without one nothing is counted.
    void end(Time real, Duration simulated) {
        if (!chooses_ || !began_) return;
        choice_.took(simulated, real - *std::exchange(began_, std::nullopt));
        world_.use_one_thread(choice_.one());
    }

private:
    World& world_;
    const bool chooses_;
    ThreadChoice choice_;
    std::optional<Time> began_;
};

}  // namespace vagus::sim
