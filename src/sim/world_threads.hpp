// Chooses the threads of a world while it runs, unless their number was given. The code that steps
// the world has a clock and tells when each piece begins and ends.
//
//     WorldThreads threads(world, options.threads.has_value());
//     threads.begin(clock);                                // read only where there is a choice
//     world.step(std::chrono::milliseconds(10));
//     threads.end(clock, std::chrono::milliseconds(10));
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

    template <typename Clock>
    void begin(const Clock& clock) {
        if (chooses_) began_ = clock();
    }
    // So much simulated time has passed since begin(); without one nothing is counted.
    template <typename Clock>
    void end(const Clock& clock, Duration simulated) {
        if (!began_) return;
        choice_.took(simulated, clock() - *std::exchange(began_, std::nullopt));
        world_.use_one_thread(choice_.one());
    }

private:
    World& world_;
    const bool chooses_;
    ThreadChoice choice_;
    std::optional<Time> began_;
};

}  // namespace vagus::sim
