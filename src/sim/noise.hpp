// The noise of sensors: seeded, the same on every machine.
#pragma once

#include "base/rng.hpp"

namespace vagus::sim {

class Noise {
public:
    explicit Noise(uint64_t seed) : random_(seed) {}
    void reseed(uint64_t seed) { random_ = SplitMix64(seed); }

    // About normal, mean 0, standard deviation 1, never beyond 3.5: the sum of four numbers of 16
    // bits, moved and scaled (Irwin and Hall; the variance of one is 65536^2 / 12).
    double next() {
        const uint64_t bits = random_.next();
        const uint64_t sum =
            (bits & 0xffff) + (bits >> 16 & 0xffff) + (bits >> 32 & 0xffff) + (bits >> 48);
        constexpr double kMean = 4 * 65535 / 2.0;
        constexpr double kDeviation = 65536 / 1.7320508075688772;
        return (static_cast<double>(sum) - kMean) / kDeviation;
    }

private:
    SplitMix64 random_;
};

}  // namespace vagus::sim
