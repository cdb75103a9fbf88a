// Procedural textures: grains of several sizes whose brightness is a hash of their place. The same
// bits on every machine; nothing is stored.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vagus::sim {

// 0 to 1, for a corner of the lattice.
inline double grain(int32_t x, int32_t y, int32_t z) {
    // The multipliers are those of MurmurHash3's finaliser and of FNV: any odd numbers would do.
    uint32_t h = static_cast<uint32_t>(x) * 0x85ebca6bu ^ static_cast<uint32_t>(y) * 0xc2b2ae35u ^
                 static_cast<uint32_t>(z) * 0x01000193u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return static_cast<double>(h >> 15 & 0xffff) * (1.0 / 65535);
}

// Between the four corners around (x, y) on level z, linearly. Lengths in grains.
inline double grains_at(double x, double y, int32_t z) {
    const double left = std::floor(x);
    const double low = std::floor(y);
    const auto i = static_cast<int32_t>(left);
    const auto j = static_cast<int32_t>(low);
    const double u = x - left;
    const double v = y - low;
    const double below = grain(i, j, z) + u * (grain(i + 1, j, z) - grain(i, j, z));
    const double above = grain(i, j + 1, z) + u * (grain(i + 1, j + 1, z) - grain(i, j + 1, z));
    return below + v * (above - below);
}

// How much of a grain is left to see when a pixel covers `footprint` of it: all of one that covers
// two pixels, nothing of one that covers one, so that nothing flickers in the distance.
inline double visibility(double size, double footprint) {
    return std::clamp(size / footprint - 1, 0.0, 1.0);
}

}  // namespace vagus::sim
