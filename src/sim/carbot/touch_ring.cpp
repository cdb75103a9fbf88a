#include "sim/carbot/touch_ring.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"

namespace vagus::sim::carbot {
namespace {

constexpr double kSectorAngle = 2 * trig::kPi / kSectors;

}  // namespace

size_t sector_of(const Point& place) {
    const double angle = trig::atan2(place.y, place.x);
    const int sector = static_cast<int>(std::floor(angle / kSectorAngle + 0.5));
    return static_cast<size_t>(sector + static_cast<int>(kSectors)) % kSectors;
}

// An edge that lies against something presses all sectors from one end of the contact to the other,
// the shorter way around.
void TouchRing::feel(std::span<const TouchedPart> parts, Time now) {
    std::array<bool, kSectors> touched{};
    for (const auto& [from, to] : parts) {
        const size_t first = sector_of(from);
        const size_t way = (sector_of(to) + kSectors - first) % kSectors;
        const bool left = way <= kSectors / 2;
        const size_t steps = left ? way : kSectors - way;
        for (size_t i = 0; i <= steps; ++i)
            touched[(left ? first + i : first + kSectors - i) % kSectors] = true;
    }
    for (size_t i = 0; i < kSectors; ++i) {
        if (touched[i]) last_[i] = now;
        pressed_[i] = touched[i] || (pressed_[i] && now - last_[i] < kSectorHolds);
    }
}

size_t TouchRing::count() const {
    return static_cast<size_t>(std::count(pressed_.begin(), pressed_.end(), true));
}

}  // namespace vagus::sim::carbot
