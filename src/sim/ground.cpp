#include "sim/ground.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"

namespace vagus::sim {

constexpr double kLampReach = 1;  // m

Ground::Ground(double width, double height, const Colour& colour)
    : width_(width), height_(height), colour_(colour), grid_(width, height) {}

void Ground::set_patches(std::vector<ObjectDefinition> patches) {
    patches_.clear();
    std::vector<Box> boxes;
    for (ObjectDefinition& object : patches) {
        const double bound =
            object.radius > 0 ? object.radius : trig::hypot(object.width / 2, object.length / 2);
        const Point at = object.at;
        boxes.push_back({at.x - bound, at.y - bound, at.x + bound, at.y + bound});
        const double angle = object.angle;
        patches_.push_back({std::move(object), trig::cos(angle), trig::sin(angle)});
    }
    grid_.build(boxes);
}

Colour Ground::picture_at(const Point& at) const {
    const auto pixel = [](double share, uint32_t count) {
        const double place = share * count;
        if (!(place > 0)) return 0u;
        return place >= count ? count - 1 : static_cast<uint32_t>(place);
    };
    const uint32_t column = pixel(at.x / width_, picture_.width);
    const uint32_t row = pixel(1 - at.y / height_, picture_.height);
    const uint8_t* const part = &picture_.pixels[3 * (size_t{row} * picture_.width + column)];
    return {part[0] / 255.0, part[1] / 255.0, part[2] / 255.0};
}

Colour Ground::colour_at(const Point& at) const {
    uint32_t top = UINT32_MAX;
    grid_.visit({at.x, at.y, at.x, at.y}, [&](uint32_t number) {
        if (top != UINT32_MAX && number < top) return;
        const auto& [object, cosine, sine] = patches_[number];
        const double mx = at.x - object.at.x;
        const double my = at.y - object.at.y;
        const double x = cosine * mx + sine * my;
        const double y = cosine * my - sine * mx;
        const bool inside = object.radius > 0 ? x * x + y * y <= object.radius * object.radius
                                              : std::fabs(x) <= object.width / 2 &&
                                                    std::fabs(y) <= object.length / 2;
        if (inside) top = number;
    });
    if (top != UINT32_MAX) return patches_[top].object.colour;
    return picture_.pixels.empty() ? colour_ : picture_at(at);
}

double Ground::light_at(const Point& at) const {
    double light = 0;
    for (const Point& lamp : lamps_)
        light = std::max(light, 1 - trig::hypot(lamp.x - at.x, lamp.y - at.y) / kLampReach);
    return light;
}

}  // namespace vagus::sim
