#include "sim/camera.hpp"

#include <gtest/gtest.h>

#include "base/trig.hpp"

using namespace vagus;
using namespace vagus::sim;

namespace {

constexpr Colour kRed = {1, 0, 0};
constexpr Colour kGreen = {0, 1, 0};
constexpr Colour kBlue = {0, 0, 1};

// A camera at (1, 5) of a field of 10 by 10 m, looking along x, with a white floor.
class Camera : public testing::Test {
protected:
    Camera() : arena_({.width = 10, .height = 10, .open = true}), ground_(10, 10, {1, 1, 1}) {
        self_ = arena_.add_robot({{}, 0.1}, at_, {.height = 0.22});
        colours_.push_back({1, 1, 0});
    }

    void add(const ObjectDefinition& object) {
        arena_.add_object(object);
        colours_.push_back(object.colour);
    }
    // A box whose front is across the view at this depth.
    void add_box(double depth, double width, double height, const Colour& colour, double left = 0) {
        add({.kind = ObjectKind::Box,
             .at = {1 + depth + 0.1, 5 + left},
             .width = 0.2,
             .length = width,
             .height = height,
             .colour = colour});
    }
    Picture take() { return render({arena_, ground_, colours_}, self_, at_); }

    Pose at_ = {{1, 5}, 0};
    Arena arena_;
    Ground ground_;
    std::vector<Colour> colours_;
    BodyId self_;
};

struct Pixel {
    int r, g, b;
};

Pixel pixel(const Picture& picture, uint32_t column, uint32_t row) {
    const uint8_t* const at = &picture.pixels[3 * (size_t{row} * picture.width + column)];
    return {at[0], at[1], at[2]};
}

// Red whatever the light: green and blue parts are 0 only there.
bool is_red(const Pixel& p) {
    return p.r > 100 && p.g == 0 && p.b == 0;
}
bool is_green(const Pixel& p) {
    return p.r == 0 && p.g > 100 && p.b == 0;
}

// Columns and rows that hold a pixel like that, both ends included.
struct Area {
    uint32_t left = 1000, right = 0, top = 1000, foot = 0, count = 0;
};
template <typename Like>
Area area_of(const Picture& picture, const Like& like) {
    Area area;
    for (uint32_t row = 0; row < picture.height; ++row) {
        for (uint32_t column = 0; column < picture.width; ++column) {
            if (!like(pixel(picture, column, row))) continue;
            area.left = std::min(area.left, column);
            area.right = std::max(area.right, column);
            area.top = std::min(area.top, row);
            area.foot = std::max(area.foot, row);
            ++area.count;
        }
    }
    return area;
}

TEST_F(Camera, PictureHasItsSize) {
    const Picture picture = take();
    EXPECT_EQ(picture.width, 160u);
    EXPECT_EQ(picture.height, 120u);
    EXPECT_EQ(picture.pixels.size(), 160u * 120 * 3);
}

// The focus is 80 / tan 30 degrees = 138.564 pixels. A box 0.4 m wide and 0.3 m high, 1 m ahead:
//     columns 80 -+ 0.2 * 138.564 = 52.29 to 107.71: middles from 52.5 to 107.5
//     rows    60 - 0.1 * 138.564 = 46.14 to 60 + 0.2 * 138.564 = 87.71: middles 46.5 to 87.5
TEST_F(Camera, ABoxCoversTheColumnsAndRowsOfItsSizeAndDistance) {
    add_box(1, 0.4, 0.3, kRed);
    const Area area = area_of(take(), is_red);
    EXPECT_EQ(area.left, 52u);
    EXPECT_EQ(area.right, 107u);
    EXPECT_EQ(area.top, 46u);
    EXPECT_EQ(area.foot, 87u);
    EXPECT_EQ(area.count, 56u * 42);
}

// 2 m ahead and 0.5 m to the left: columns 80 - (0.5 -+ 0.2) * 69.282 = 31.50 to 59.22; its left
// flank is hidden, and so is its right one only where its front is. The right flank, 0.2 m deep:
// its far end is at 80 - 0.3 / 2.2 * 138.564 = 61.1.
TEST_F(Camera, WhatIsToTheLeftIsOnTheLeft) {
    add_box(2, 0.4, 0.3, kRed, 0.5);
    const Area area = area_of(take(), is_red);
    EXPECT_EQ(area.left, 32u);
    EXPECT_EQ(area.right, 60u);
}

// Half a right angle to the left of its robot: the same box is in the middle.
TEST_F(Camera, TurnsWithItsRobot) {
    at_.angle = trig::kPi / 4;
    add({.kind = ObjectKind::Cylinder, .at = {2, 6}, .radius = 0.1, .height = 0.3, .colour = kRed});
    const Area area = area_of(take(), is_red);
    EXPECT_EQ(area.left + area.right, 159u);
}

// A disc of radius 0.2 with its middle 2 m ahead. The tangents to it have the sine 0.1, so the
// tangent 0.1005: columns 80 -+ 13.93, middles 66.5 to 93.5. Its nearest point, 1.8 m away, has its
// foot at 60 + 0.2 / 1.8 * 138.564 = 75.40: the last middle is 74.5.
TEST_F(Camera, ACylinderCoversItsTangents) {
    add({.kind = ObjectKind::Cylinder, .at = {3, 5}, .radius = 0.2, .height = 0.3, .colour = kRed});
    const Area area = area_of(take(), is_red);
    EXPECT_EQ(area.left, 66u);
    EXPECT_EQ(area.right, 93u);
    EXPECT_EQ(area.foot, 74u);
}

// 0.1 m high, 1 m ahead, 0.2 m deep: its front from 60 + 0.1 * 138.564 = 73.86 down, and its upper
// side from its far edge, 60 + 0.1 / 1.2 * 138.564 = 71.55, the middle 71.5 being above it.
TEST_F(Camera, ALowBoxShowsItsUpperSide) {
    add_box(1, 0.4, 0.1, kRed);
    const Area area = area_of(take(), is_red);
    EXPECT_EQ(area.top, 72u);
    EXPECT_EQ(area.foot, 87u);
}

// The floor between two boxes is seen over the near one, the far one above that.
TEST_F(Camera, ANearBodyHidesAFarOneAsFarAsItReaches) {
    add_box(1, 0.4, 0.1, kRed);
    add_box(3, 2.0, 0.4, kGreen);
    const Picture picture = take();
    // Column 80: red from 72 to 87. The green box reaches from 60 - 0.2 / 3 * 138.564 = 50.76 down
    // to 60 + 0.2 / 3 * 138.564 = 69.24, and the floor shows in rows 69 to 71.
    EXPECT_TRUE(is_green(pixel(picture, 80, 51)));
    EXPECT_TRUE(is_green(pixel(picture, 80, 68)));
    EXPECT_FALSE(is_green(pixel(picture, 80, 69)));
    EXPECT_FALSE(is_red(pixel(picture, 80, 71)));
    EXPECT_TRUE(is_red(pixel(picture, 80, 72)));
}

TEST_F(Camera, ATallNearBodyHidesAllBehindIt) {
    add_box(1, 0.4, 0.3, kRed);
    add_box(2, 0.4, 0.3, kGreen);
    EXPECT_EQ(area_of(take(), is_green).count, 0u);
}

// A robot does not see itself; another one is seen in its colour.
TEST_F(Camera, SeesOtherRobotsOnly) {
    const auto is_yellow = [](const Pixel& p) { return p.r > 100 && p.g > 100 && p.b == 0; };
    EXPECT_EQ(area_of(take(), is_yellow).count, 0u);
    arena_.add_robot({{}, 0.1}, {{2, 5}, 0}, {.height = 0.22});
    colours_.push_back(kRed);
    EXPECT_GT(area_of(take(), is_red).count, 0u);
}

// A patch 0.41 m wide from 1.0 to 1.2 m ahead: rows 60 + 27.71 / 1.2 = 83.09 to 87.71, middles 83.5
// to 87.5.
TEST_F(Camera, PatchesLieOnTheFloor) {
    ground_.set_patches({{.kind = ObjectKind::Patch,
                          .at = {2.1, 5},
                          .width = 0.2,
                          .length = 0.41,
                          .colour = kRed}});
    const Area area = area_of(take(), is_red);
    EXPECT_EQ(area.top, 83u);
    EXPECT_EQ(area.foot, 87u);
    // In the lowest row, where it is 1.0077 m away: 80 - 0.205 / 1.0077 * 138.564 = 51.81.
    EXPECT_EQ(area.left, 52u);
}

// The walls around a world are kBorderHeight high: 9 m ahead their top is at
// 60 - 0.1 / 9 * 138.564 = 58.46 and their foot at 60 + 0.2 / 9 * 138.564 = 63.08.
TEST_F(Camera, SeesTheWallsAround) {
    Arena walled({.width = 10, .height = 10});
    const BodyId self = walled.add_robot({{}, 0.1}, at_, {.height = 0.22});
    const Ground black(10, 10, {0, 0, 0});
    const Picture picture = render({walled, black, colours_}, self, at_);
    const auto is_grey = [](const Pixel& p) { return p.r == p.g && p.g == p.b && p.r > 100; };
    for (uint32_t row = 0; row < picture.height; ++row)
        EXPECT_EQ(is_grey(pixel(picture, 80, row)), row >= 58 && row <= 62) << row;
}

// The floor has grains: in the lower part of the picture neighbouring rows are not alike, so that
// movement can be seen. They stay on the floor: 0.2 m ahead, what was at 0.8 m is at 0.6 m.
TEST_F(Camera, TheTextureStaysOnTheFloor) {
    const Picture before = take();
    const double depth = 0.2 / ((100.5 - 60) / 138.564064605510);  // of row 100
    at_.at.x += depth - 0.2 / ((110.5 - 60) / 138.564064605510);   // that of row 110
    const Picture after = take();
    int different = 0;
    for (uint32_t column = 79; column <= 80; ++column) {
        const Pixel far = pixel(before, column, 100);
        const Pixel near = pixel(after, column, 110);
        EXPECT_NEAR(far.r, near.r, 6) << column;  // a grain weighs more when it is near
    }
    for (uint32_t column = 20; column < 140; ++column)
        different += pixel(before, column, 100).r != pixel(after, column, 100).r ? 1 : 0;
    EXPECT_GT(different, 60);
}

TEST_F(Camera, TheSamePictureTwice) {
    add_box(1, 0.4, 0.1, kBlue);
    EXPECT_EQ(take().pixels, take().pixels);
}

}  // namespace
