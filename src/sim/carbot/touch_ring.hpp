// The touch sensors around the hull of a Carbot: which of its sectors are pressed.
#pragma once

#include <array>
#include <span>

#include "base/time.hpp"
#include "sim/arena.hpp"

namespace vagus::sim::carbot {

constexpr size_t kSectors = 12;  // of 30 degrees; sector i looks to i x 30 degrees from ahead
constexpr Duration kSectorHolds = std::chrono::milliseconds(50);  // after the last contact

// The sector that a place on the hull lies in, as seen from the middle.
size_t sector_of(const Point& place);

class TouchRing {
public:
    // The contacts of this moment.
    void feel(std::span<const TouchedPart> parts, Time now);
    bool pressed(size_t sector) const { return pressed_[sector]; }
    size_t count() const;

private:
    std::array<bool, kSectors> pressed_{};
    std::array<Time, kSectors> last_{};
};

}  // namespace vagus::sim::carbot
