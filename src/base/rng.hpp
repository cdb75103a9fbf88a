// A seeded generator with the same sequence on every machine. Everything random in Vagus comes from
// one of these.
#pragma once

#include <cstdint>

namespace vagus {

// splitmix64 (Steele, Lea, Flood 2014: "Fast splittable pseudorandom number generators").
class SplitMix64 {
public:
    explicit SplitMix64(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    // Uniform in [0, 1): 53 random bits.
    double unit() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

    // In [0, bound), bound > 0. The bias of the remainder is below 2^-32 for bounds below 2^32.
    uint64_t below(uint64_t bound) { return next() % bound; }

private:
    uint64_t state_;
};

}  // namespace vagus
