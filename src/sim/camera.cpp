#include "sim/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/trig.hpp"
#include "sim/texture.hpp"

namespace vagus::sim {
namespace {

constexpr double kMiddleColumn = kCameraColumns / 2.0;
constexpr double kHorizon = kCameraRows / 2.0;
constexpr std::array<double, 3> kFloorGrains = {0.03, 0.12, 0.5};  // m
constexpr std::array<double, 2> kBodyGrains = {0.015, 0.05};
constexpr double kFloorContrast = 0.14;  // of each size: what a dark grain is darker
constexpr double kBodyContrast = 0.12;
constexpr double kShade = 0.22;        // what the darkest face is darker
constexpr Point kLight = {-0.6, 0.8};  // the direction that the light comes from, length 1
constexpr Colour kBorderColour = {0.9, 0.9, 0.9};
constexpr Colour kCeilingLow = {0.80, 0.86, 0.92};
constexpr Colour kCeilingHigh = {0.55, 0.68, 0.86};
constexpr double kTopLight = 0.95;  // of faces that look up

// The rows of the floor are the same in each column: their depth, and which grains show.
struct FloorRow {
    double depth = 0;
    std::array<double, kFloorGrains.size()> visible{};
};

class Painter {
public:
    Painter(const Scene& scene, const Pose& camera);
    Picture paint(BodyId self);

private:
    void paint_column(uint32_t column, std::span<const Slice> slices);
    void paint_floor(uint32_t column, int from, int end);
    void paint_side(uint32_t column, const Slice& slice, int from, int end);
    void paint_top(uint32_t column, const Slice& slice, int from, int end);
    void paint_ceiling(uint32_t column, int end);
    Colour colour_of(BodyId body) const;
    void put(uint32_t column, int row, const Colour& colour, double light);

    const Scene& scene_;
    Pose camera_;
    double cosine_;
    double sine_;
    std::array<double, kCameraColumns> tangents_;  // of columns from the right, ascending
    std::array<FloorRow, kCameraRows> floor_;
    Picture picture_;
};

// The tangent of the direction of a column, to the left positive. Columns count from the left.
constexpr double tangent_of(uint32_t column) {
    return (kMiddleColumn - (column + 0.5)) / kCameraFocus;
}

// The first row whose middle is not above a point at that depth and height.
int row_of(double depth, double height) {
    const double row = kHorizon + kCameraFocus * (kCameraEye - height) / depth;
    return static_cast<int>(std::ceil(std::clamp(row, 0.0, double{kCameraRows}) - 0.5));
}

// How far below the eye a row looks, for each metre of depth.
constexpr double fall_of(int row) {
    return (row + 0.5 - kHorizon) / kCameraFocus;
}

Painter::Painter(const Scene& scene, const Pose& camera)
    : scene_(scene),
      camera_(camera),
      cosine_(trig::cos(camera.angle)),
      sine_(trig::sin(camera.angle)),
      picture_{kCameraColumns, kCameraRows,
               std::vector<uint8_t>(size_t{3} * kCameraColumns * kCameraRows)} {
    for (uint32_t i = 0; i < kCameraColumns; ++i) tangents_[i] = tangent_of(kCameraColumns - 1 - i);
    for (int row = static_cast<int>(kHorizon); row < static_cast<int>(kCameraRows); ++row) {
        FloorRow& floor = floor_[static_cast<size_t>(row)];
        floor.depth = kCameraEye / fall_of(row);
        // A pixel of the floor is longer than it is wide.
        const double footprint = floor.depth * floor.depth / (kCameraFocus * kCameraEye);
        for (size_t k = 0; k < kFloorGrains.size(); ++k)
            floor.visible[k] = kFloorContrast * visibility(kFloorGrains[k], footprint);
    }
}

Picture Painter::paint(BodyId self) {
    std::vector<Slice> slices;
    scene_.arena.slice(self, camera_, tangents_, slices);
    size_t next = 0;
    for (uint32_t i = 0; i < kCameraColumns; ++i) {
        const size_t first = next;
        while (next < slices.size() && slices[next].column == i) ++next;
        paint_column(kCameraColumns - 1 - i, std::span(slices).subspan(first, next - first));
    }
    return std::move(picture_);
}

// From the near to the far, which is from below to above: `free` is the end of the rows that
// nothing nearer has taken.
void Painter::paint_column(uint32_t column, std::span<const Slice> slices) {
    int free = kCameraRows;
    for (const Slice& slice : slices) {
        const int foot = std::min(free, row_of(slice.enter, 0));
        const int edge = std::min(foot, row_of(slice.enter, slice.height));
        const int back = std::min(edge, row_of(slice.leave, slice.height));
        paint_floor(column, foot, free);
        paint_side(column, slice, edge, foot);
        paint_top(column, slice, back, edge);
        free = back;
    }
    const int horizon = std::min(free, static_cast<int>(kHorizon));
    paint_floor(column, horizon, free);
    paint_ceiling(column, horizon);
}

void Painter::paint_floor(uint32_t column, int from, int end) {
    const double tangent = tangent_of(column);
    const Point way = {cosine_ - sine_ * tangent, sine_ + cosine_ * tangent};
    for (int row = from; row < end; ++row) {
        const FloorRow& floor = floor_[static_cast<size_t>(row)];
        const Point at = {camera_.at.x + floor.depth * way.x, camera_.at.y + floor.depth * way.y};
        double light = 1;
        for (size_t k = 0; k < kFloorGrains.size(); ++k) {
            if (floor.visible[k] == 0) continue;
            light -= floor.visible[k] * grains_at(at.x / kFloorGrains[k], at.y / kFloorGrains[k],
                                                  static_cast<int32_t>(k));
        }
        put(column, row, scene_.ground.colour_at(at), light);
    }
}

namespace {

// The grains of one size along a line that goes straight up: those of the two levels around the
// last height are kept, for the next height is a pixel away.
class UprightGrains {
public:
    UprightGrains(double size, const Point& at) : size_(size), x_(at.x / size), y_(at.y / size) {}

    double at(double height) {
        const double place = height / size_;
        const double low = std::floor(place);
        const auto level = static_cast<int32_t>(low);
        if (level != level_) {
            below_ = grains_at(x_, y_, level);
            above_ = grains_at(x_, y_, level + 1);
            level_ = level;
        }
        return below_ + (place - low) * (above_ - below_);
    }

private:
    double size_, x_, y_;
    int32_t level_ = INT32_MIN;
    double below_ = 0;
    double above_ = 0;
};

}  // namespace

void Painter::paint_side(uint32_t column, const Slice& slice, int from, int end) {
    const Colour colour = colour_of(slice.body);
    const double facing = slice.normal.x * kLight.x + slice.normal.y * kLight.y;
    const double shade = 1 - kShade * (1 - facing) / 2;
    const double footprint = slice.enter / kCameraFocus;
    std::array<double, kBodyGrains.size()> visible;
    std::array<UprightGrains, kBodyGrains.size()> grains = {
        UprightGrains(kBodyGrains[0], slice.on_body), UprightGrains(kBodyGrains[1], slice.on_body)};
    for (size_t k = 0; k < visible.size(); ++k)
        visible[k] = kBodyContrast * visibility(kBodyGrains[k], footprint);
    for (int row = from; row < end; ++row) {
        const double height = kCameraEye - fall_of(row) * slice.enter;
        double light = 1;
        for (size_t k = 0; k < visible.size(); ++k)
            if (visible[k] > 0) light -= visible[k] * grains[k].at(height);
        put(column, row, colour, light * shade);
    }
}

// What is lower than the eye shows its upper side.
void Painter::paint_top(uint32_t column, const Slice& slice, int from, int end) {
    const Colour colour = colour_of(slice.body);
    for (int row = from; row < end; ++row) put(column, row, colour, kTopLight);
}

void Painter::paint_ceiling(uint32_t column, int end) {
    for (int row = 0; row < end; ++row) {
        const double up = 1 - (row + 0.5) / kHorizon;
        put(column, row,
            {kCeilingLow.r + up * (kCeilingHigh.r - kCeilingLow.r),
             kCeilingLow.g + up * (kCeilingHigh.g - kCeilingLow.g),
             kCeilingLow.b + up * (kCeilingHigh.b - kCeilingLow.b)},
            1);
    }
}

Colour Painter::colour_of(BodyId body) const {
    return body.index < scene_.colours.size() ? scene_.colours[body.index] : kBorderColour;
}

void Painter::put(uint32_t column, int row, const Colour& colour, double light) {
    uint8_t* const pixel =
        &picture_.pixels[3 * (static_cast<size_t>(row) * kCameraColumns + column)];
    const auto part = [light](double value) {
        return static_cast<uint8_t>(std::clamp(value * light, 0.0, 1.0) * 255 + 0.5);
    };
    pixel[0] = part(colour.r);
    pixel[1] = part(colour.g);
    pixel[2] = part(colour.b);
}

}  // namespace

Picture render(const Scene& scene, BodyId self, const Pose& camera) {
    return Painter(scene, camera).paint(self);
}

}  // namespace vagus::sim
