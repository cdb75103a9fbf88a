// The link of a main computer to its bus, with the faults of a run that are done to it.
//
//     HostChaos chaos(world.chaos(), "main", world.chaos_seed());
//     chaos.reseed(world.chaos_seed());            // at each instant, and then
//     chaos.advance(world.now());
//     chaos.to_bus().put(frame, world.now());      // what it says …
//     while (chaos.to_bus().take(frame, world.now())) bus.receive(link, frame);
#pragma once

#include <string_view>
#include <vector>

#include "sim/chaos_clock.hpp"
#include "sim/chaos_line.hpp"

namespace vagus::sim {

class HostChaos {
public:
    // Those that are done to the computer of that name: kMainComputer, or "ROBOT/main".
    HostChaos(const std::vector<ChaosFault>& faults, std::string_view name, uint64_t seed);
    HostChaos(const HostChaos&) = delete;
    HostChaos& operator=(const HostChaos&) = delete;

    bool empty() const { return faults_.empty(); }
    void advance(Time now);
    // What the world's chaos_seed() is by now: see World::reseed().
    void reseed(uint64_t seed);
    void restart();
    ChaosLine& to_bus() { return to_bus_; }
    ChaosLine& from_bus() { return from_bus_; }

private:
    static std::vector<ChaosFault> of(const std::vector<ChaosFault>& faults, std::string_view name);

    const std::vector<ChaosFault> faults_;
    uint64_t seed_;
    uint64_t first_seed_;  // before any reseed()
    ChaosClock clock_;
    ChaosLine to_bus_, from_bus_;
};

}  // namespace vagus::sim
