// Carbot's body and motion as its templates reckon with them, in centimetres and in degrees
// counter-clockwise from ahead.
#pragma once

namespace vagus::toolbox::carbot {

// docs/carbot.md
constexpr double kHalfWidthCm = 17.5;
constexpr double kHalfLengthCm = 20;
constexpr double kSensorAheadCm = 18;  // the distance sensor, of the middle

// Of the middle of the hull.
struct Pose {
    double x_cm = 0;
    double y_cm = 0;
    double heading_deg = 0;
};

struct Steering {
    double speed_cm = 0;  // a second
    double rate_deg = 0;  // a second
};

}  // namespace vagus::toolbox::carbot
