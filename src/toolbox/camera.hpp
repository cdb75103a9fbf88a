// What templates that look through a camera need of it. An owner of one (a simulated world, a
// driver) implements this and puts it into Parts.
//
//     class WorldCamera final : public toolbox::Camera {
//         toolbox::Image take() override { … }
//     };
#pragma once

#include <cstdint>
#include <vector>

namespace vagus::toolbox {

// How templates take the camera to be mounted: looking ahead, level, and so wide.
constexpr double kCameraFieldDeg = 60;
constexpr double kCameraEyeCm = 20;    // above the ground
constexpr double kCameraAheadCm = 16;  // of the middle of the robot

// Rows from the top, three bytes a pixel: red, green, blue.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgb = {};
};

class Camera {
public:
    virtual ~Camera() = default;
    // What it sees now. Called by the code of templates, on its thread; what it throws ends the
    // plan with an internal error (P27).
    virtual Image take() = 0;
};

}  // namespace vagus::toolbox
