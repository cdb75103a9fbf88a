// A sensor with a fault: what its robot senses goes through it, on its way to the variables that
// scripts read.
//
//     SensorChaos sensor(fault, 35, 1, seed);     // the variable at address 35, one word
//     sensor.give_back(machine);                  // before the robot senses: as it was sensed
//     robot.sense(around);
//     sensor.spoil(machine, now);                 // after it: as the fault makes it
#pragma once

#include <cstdint>
#include <vector>

#include "base/rng.hpp"
#include "sim/chaos.hpp"
#include "sim/machine.hpp"

namespace vagus::sim {

// Noise is drawn again for each new value, and after this time.
constexpr Duration kNoiseLasts = std::chrono::milliseconds(100);

class SensorChaos {
public:
    // Of Stuck, Noisy or Dead; borrowed.
    SensorChaos(const ChaosFault& fault, uint16_t address, uint16_t words, uint64_t seed)
        : fault_(&fault), address_(address), sensed_(words), shown_(words), random_(seed) {}

    const ChaosFault& fault() const { return *fault_; }
    void reseed(uint64_t seed) { random_ = SplitMix64(seed); }
    // Words that somebody has written since stay.
    void give_back(Machine& machine) const;
    void spoil(Machine& machine, Time now);

private:
    int16_t spoilt(int16_t value);

    const ChaosFault* fault_;
    uint16_t address_;
    std::vector<int16_t> sensed_;
    std::vector<int16_t> shown_;
    bool begun_ = false;
    Time drawn_{};
    SplitMix64 random_;
};

}  // namespace vagus::sim
