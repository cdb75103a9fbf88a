#include "toolbox/carbot/object_eye.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "base/rng.hpp"

namespace vagus::toolbox::carbot {
namespace {

constexpr ObjectColour kRed = {1, 0, 0};
constexpr int kWidth = 160;
constexpr int kHeight = 120;

struct Part {
    int left, right, top, foot;  // both ends included
};

// A grey picture with things painted on it.
class Picture {
public:
    Picture() : image_{kWidth, kHeight, std::vector<uint8_t>(3 * kWidth * kHeight, 150)} {}

    Picture& paint(const Part& part, uint8_t red, uint8_t green, uint8_t blue) {
        for (int row = part.top; row <= part.foot; ++row)
            for (int column = part.left; column <= part.right; ++column)
                put(column, row, red, green, blue);
        return *this;
    }
    // Spots of 3 x 3 pixels, always the same ones in the frame of the part: a texture to follow.
    // `colour` 1: red ones; 0: grey ones.
    Picture& paint_spots(const Part& part, int colour) {
        for (int row = part.top; row <= part.foot; ++row) {
            for (int column = part.left; column <= part.right; ++column) {
                SplitMix64 random(
                    static_cast<uint64_t>((row - part.top) / 3 * 64 + (column - part.left) / 3));
                const auto light = static_cast<uint8_t>(120 + random.below(130));
                const auto rest = static_cast<uint8_t>(colour == 1 ? 0 : light);
                put(column, row, light, rest, rest);
            }
        }
        return *this;
    }
    const Image& image() const { return image_; }

private:
    void put(int column, int row, uint8_t red, uint8_t green, uint8_t blue) {
        if (column < 0 || column >= kWidth) return;
        uint8_t* const pixel = &image_.rgb[3 * static_cast<size_t>(row * kWidth + column)];
        pixel[0] = red;
        pixel[1] = green;
        pixel[2] = blue;
    }
    Image image_;
};

Image with_red(const Part& part) {
    return Picture().paint(part, 220, 10, 10).image();
}

// The focus is 80 / tan 30 degrees = 138.564 pixels. Columns 52 to 107 reach from 52.0 to 108.0,
// their middle is 80.0; the foot ends at row 88.0, 28 below the horizon: 20 * 138.564 / 28 = 98.97
// cm. The ends are atan (28 / 138.564) = 11.42 degrees to both sides.
TEST(ObjectEye, TellsWhereAnObjectIs) {
    ObjectEye eye(kRed);
    const auto seen = eye.find(with_red({52, 107, 46, 87}));
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->angle_deg, 0, 1e-9);
    EXPECT_NEAR(seen->distance_cm, 98.97, 0.01);
    EXPECT_NEAR(seen->width_deg, 22.85, 0.01);
    EXPECT_TRUE(seen->whole);
    EXPECT_FALSE(seen->by_flow);
}

// The middle of columns 20 to 39 is 30.0, 50 to the left: atan (50 / 138.564) = 19.84 degrees. Its
// foot is 20 * 138.564 / 28 = 98.97 cm deep, along the way 98.97 / cos 19.84 = 105.22.
TEST(ObjectEye, AnglesAreCounterClockwise) {
    ObjectEye eye(kRed);
    const auto seen = eye.find(with_red({20, 39, 46, 87}));
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->angle_deg, 19.84, 0.01);
    EXPECT_NEAR(seen->distance_cm, 105.22, 0.01);
    EXPECT_LT(eye.find(with_red({120, 139, 46, 87}))->angle_deg, 0);
}

TEST(ObjectEye, AFootBelowThePictureHasNoDistance) {
    ObjectEye eye(kRed);
    EXPECT_EQ(eye.find(with_red({52, 107, 46, 119}))->distance_cm, 0);
    EXPECT_FALSE(eye.find(with_red({0, 40, 46, 80}))->whole);
}

TEST(ObjectEye, SmallSpotsAreNothing) {
    ObjectEye eye(kRed);
    EXPECT_TRUE(eye.find(with_red({50, 59, 80, 81})));   // 20 pixels
    EXPECT_FALSE(eye.find(with_red({50, 68, 80, 80})));  // 19
}

TEST(ObjectEye, OtherColoursAndGreysAreNotTheObject) {
    ObjectEye eye(kRed);
    EXPECT_FALSE(eye.find(Picture().paint({50, 90, 60, 90}, 10, 220, 10).image()));
    EXPECT_FALSE(eye.find(Picture().paint({50, 90, 60, 90}, 220, 180, 180).image()));
    EXPECT_FALSE(eye.find(Picture().paint({50, 90, 60, 90}, 30, 5, 5).image()));  // too dark
    EXPECT_FALSE(eye.find(Picture().image()));
}

// Red lies at both ends of the circle of hues.
TEST(ObjectEye, RedIsRedOnBothSidesOfTheHueCircle) {
    ObjectEye eye({1, 0, 0.02});
    EXPECT_TRUE(eye.find(Picture().paint({50, 90, 60, 90}, 220, 25, 5).image()));
    EXPECT_TRUE(eye.find(Picture().paint({50, 90, 60, 90}, 220, 5, 25).image()));
}

TEST(ObjectEye, FindsTheLargest) {
    ObjectEye eye(kRed);
    const auto seen = eye.find(Picture()
                                   .paint({20, 29, 60, 80}, 220, 10, 10)
                                   .paint({100, 129, 60, 80}, 220, 10, 10)
                                   .image());
    ASSERT_TRUE(seen);
    EXPECT_LT(seen->angle_deg, 0);
}

TEST(ObjectEye, KeepsToTheOneThatItFollowsWhenALargerOneComes) {
    ObjectEye eye(kRed);
    ASSERT_TRUE(eye.find(Picture().paint_spots({20, 43, 60, 83}, 1).image()));
    for (int shift = 4; shift <= 40; shift += 4) {
        const auto seen = eye.follow(Picture()
                                         .paint_spots({20 + shift, 43 + shift, 60, 83}, 1)
                                         .paint({110, 155, 50, 100}, 220, 10, 10)
                                         .image());
        ASSERT_TRUE(seen) << shift;
        EXPECT_GT(seen->angle_deg, 0) << shift;
    }
}

// In grey light the colour is gone and the texture is not. The middle has moved from 72 to 78 after
// two pictures: atan (2 / 138.564) = 0.83 degrees.
TEST(ObjectEye, FollowsTheTextureWhileTheColourIsNotSeen) {
    ObjectEye eye(kRed);
    ASSERT_TRUE(eye.find(Picture().paint_spots({60, 83, 60, 83}, 1).image()));
    ASSERT_FALSE(eye.follow(Picture().paint_spots({63, 86, 60, 83}, 1).image())->by_flow);
    // Grey as bright as the red was: 0.299 of it. What is followed is brightness.
    const auto dim = [](int left) {
        Image image = Picture().paint_spots({left, left + 23, 60, 83}, 1).image();
        for (int row = 60; row <= 83; ++row) {
            for (int column = left; column <= left + 23; ++column) {
                uint8_t* const pixel = &image.rgb[3 * static_cast<size_t>(row * kWidth + column)];
                pixel[0] = pixel[1] = pixel[2] =
                    static_cast<uint8_t>((pixel[0] * 299 + 500) / 1000);
            }
        }
        return image;
    };
    const auto seen = eye.follow(dim(66));
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->by_flow);
    EXPECT_NEAR(seen->angle_deg, 0.83, 0.01);
    for (int picture = 2; picture <= kFlowPicturesMax; ++picture)
        EXPECT_TRUE(eye.follow(dim(66))) << picture;
    EXPECT_FALSE(eye.follow(dim(66)));
}

TEST(ObjectEye, AnObjectThatIsGoneIsLost) {
    ObjectEye eye(kRed);
    ASSERT_TRUE(eye.find(Picture().paint_spots({60, 83, 60, 83}, 1).image()));
    EXPECT_FALSE(eye.follow(Picture().image()));
}

TEST(ObjectEye, WhatIsNoImageShowsNothing) {
    ObjectEye eye(kRed);
    EXPECT_FALSE(eye.find({}));
    EXPECT_FALSE(eye.find({160, 120, std::vector<uint8_t>(160 * 120)}));
    EXPECT_FALSE(eye.find({-1, 120, {}}));
    EXPECT_FALSE(eye.find(
        {kImageSidePixelsMax + 1, 1, std::vector<uint8_t>(3 * (kImageSidePixelsMax + 1), 200)}));
}

TEST(ObjectEye, SaturationIsHowFarAColourIsFromGrey) {
    EXPECT_EQ(saturation({1, 0, 0}), 1);
    EXPECT_EQ(saturation({0.5, 0.5, 0.5}), 0);
    EXPECT_EQ(saturation({0, 0, 0}), 0);
    EXPECT_NEAR(saturation({0.8, 0.4, 0.6}), 0.5, 1e-12);
}

// The bits of a whole pursuit, for a second run as on an older processor (see CMakeLists.txt).
TEST(ObjectEye, TheGoldenPursuitIsTheSameToTheLastBit) {
    ObjectEye eye({0.9, 0.1, 0.1});
    uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (int step = 0; step < 40; ++step) {
        const int left = 20 + 2 * step;
        const int colour = step % 10 < 7 ? 1 : 0;
        const auto seen = eye.follow(
            Picture().paint_spots({left, left + 20 + step / 2, 55, 75 + step / 2}, colour).image());
        const double values[] = {seen ? seen->angle_deg : -1, seen ? seen->distance_cm : -1,
                                 seen ? seen->width_deg : -1};
        for (const double value : values) {
            uint64_t bits;
            std::memcpy(&bits, &value, sizeof bits);
            hash = (hash ^ bits) * 1099511628211u;
        }
    }
    EXPECT_EQ(hash, 844991189099272060u);
}

}  // namespace
}  // namespace vagus::toolbox::carbot
