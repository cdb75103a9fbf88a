// Finds an object of one colour in pictures, and keeps to it from one picture to the next: by its
// colour, and by optical flow where colour alone does not tell which one it is, or fails. OpenCV
// does the work and does not show (docs/decisions/0105).
//
//     ObjectEye eye({1, 0, 0});
//     if (const auto seen = eye.find(camera.take())) turn_by(seen->angle_deg);
//     const auto again = eye.follow(camera.take());   // the same one, a moment later
//
// The same pictures give the same bits on every amd64 machine: one thread, no code by processor.
#pragma once

#include <memory>
#include <optional>

#include "toolbox/camera.hpp"

namespace vagus::toolbox::carbot {

constexpr int kObjectPixelsMin = 20;      // smaller ones are not told from nothing
constexpr double kColourFullness = 0.45;  // saturation that a colour needs to be told from walls
constexpr int kImageSidePixelsMax = 4096;
constexpr int kFlowPicturesMax = 10;  // so many in a row without the colour; then it is lost

// Red, green, blue from 0 to 1.
struct ObjectColour {
    double red = 0;
    double green = 0;
    double blue = 0;
};

struct Sighting {
    double angle_deg = 0;    // of its middle, counter-clockwise from ahead
    double distance_cm = 0;  // to its foot on the ground; 0 if that is below the picture
    double width_deg = 0;    // from its left to its right end
    bool whole = false;      // both ends are in the picture
    bool by_flow = false;    // its colour was not seen, the flow of its points was
};

// How full the colour is, 0 (grey) to 1.
double saturation(const ObjectColour& colour);

class ObjectEye {
public:
    // The colour's saturation is at least kColourFullness.
    explicit ObjectEye(const ObjectColour& colour);
    ~ObjectEye();
    ObjectEye(const ObjectEye&) = delete;
    ObjectEye& operator=(const ObjectEye&) = delete;

    // The largest of that colour. An image that is none, or too large, shows nothing.
    std::optional<Sighting> find(const Image& image);
    // The one that was seen last, where it is now; the largest if none was, or it is gone for good.
    std::optional<Sighting> follow(const Image& image);

private:
    struct Insides;
    std::unique_ptr<Insides> insides_;
};

}  // namespace vagus::toolbox::carbot
