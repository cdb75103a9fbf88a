// What a robot that drives along a wall knows of the things around it: what its sensor sees now,
// and, of what has got out of its sight, what it saw last.
//
//     WallMap map(200);
//     map.take(sweep);
//     const double gap = map.distances_from(pose).right_cm - kHalfWidthCm;
#pragma once

#include <vector>

#include "toolbox/carbot/spots.hpp"

namespace vagus::toolbox::carbot {

constexpr double kMapReachCm = 110;   // from the sensor; what is farther does not matter
constexpr size_t kMapSpotsMax = 500;  // then the oldest go

// What is ahead counts as at the right, where a wall to go along is, or will be. kMapReachCm:
// nothing is there.
struct Sides {
    double right_cm = kMapReachCm;
    double left_cm = kMapReachCm;
};

class WallMap {
public:
    // A spot is forgotten when it was seen last so much driving ago.
    explicit WallMap(double remembered_cm) : remembered_cm_(remembered_cm) {}

    // A whole sweep, of the directions between that of its first sounding and that of its last.
    void take(const std::vector<Sounding>& sweep);

    // A spot that nobody has seen, to be remembered as others: where the wall may be.
    void assume(const Spot& spot) { spots_.push_back({spot, driven_cm_}); }

    size_t size() const { return spots_.size(); }
    // From the middle of a robot there to the nearest spot of each side.
    Sides distances_from(const Pose& pose) const;

private:
    struct Kept {
        Spot spot;
        double seen_at_cm;  // of the way driven
    };

    void forget(const std::vector<Sounding>& sweep);

    double remembered_cm_;
    std::vector<Kept> spots_;  // oldest first
    Pose last_;
    double driven_cm_ = 0;
};

}  // namespace vagus::toolbox::carbot
