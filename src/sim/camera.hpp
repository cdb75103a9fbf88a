// What a robot's camera sees: a small renderer for worlds that are seen from above. Everything
// stands on the ground and is as wide above as below, so one line of sight for each column finds
// all there is, and the rows follow from the heights. No graphics library, the same bits
// everywhere.
//
//     const Picture picture = render({arena, ground, colours}, body, {{1.2, 0.8}, heading});
//
// The camera looks ahead, level, from kCameraEye above the ground. The ground and all bodies have a
// light texture that stays where they are, so that movement can be seen; faces are a little
// brighter or darker by their direction. Lamps, beacons and shadows are not drawn.
#pragma once

#include <span>

#include "sim/arena.hpp"
#include "sim/ground.hpp"

namespace vagus::sim {

constexpr uint32_t kCameraColumns = 160;
constexpr uint32_t kCameraRows = 120;
constexpr double kCameraEye = 0.2;  // m above the ground
// In pixels: half the columns by the tangent of half of 60 degrees.
constexpr double kCameraFocus = 80 * 1.7320508075688772;

// Borrowed for the call.
struct Scene {
    const Arena& arena;
    const Ground& ground;
    std::span<const Colour> colours;  // of bodies by index
};

// `self` is the body that carries the camera: not seen.
Picture render(const Scene& scene, BodyId self, const Pose& camera);

}  // namespace vagus::sim
