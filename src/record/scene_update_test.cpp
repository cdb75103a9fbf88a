#include "record/scene_update.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/rng.hpp"

namespace vagus::record {
namespace {

std::string text_of(double x) {
    const Shape shape{.id = "a", .pose = {.at = {x, 0}}, .colour = {0, 0, 0}};
    const std::string text = scene_update(std::vector<Shape>{shape}, Time{});
    const size_t from = text.find("\"x\":") + 4;
    return text.substr(from, text.find(',', from) - from);
}

TEST(SceneUpdate, IsWhatViewersOfMcapRead) {
    const Shape box{.id = "robot/r1",
                    .pose = {.at = {1.5, -0.25}, .angle = 0},
                    .height = 0.1,
                    .x = 0.2,
                    .y = 0.3,
                    .colour = {1, 0.5, 0}};
    EXPECT_EQ(
        scene_update(std::vector<Shape>{box}, std::chrono::milliseconds(2500)),
        R"({"deletions":[],"entities":[{"timestamp":{"sec":2,"nsec":500000000},)"
        R"("frame_id":"world","id":"robot/r1","lifetime":{"sec":0,"nsec":0},"frame_locked":false,)"
        R"("metadata":[],"cubes":[{"pose":{"position":{"x":1.500000,"y":-0.250000,"z":0.050},)"
        R"("orientation":{"x":0,"y":0,"z":0.000000,"w":1.000000}},)"
        R"("size":{"x":0.2000,"y":0.3000,"z":0.1000},)"
        R"("color":{"r":1.000,"g":0.500,"b":0.000,"a":1}}]}]})");
}

TEST(SceneUpdate, AWholeSceneDeletesWhatWasThere) {
    EXPECT_EQ(whole_scene({}, Time{}),
              R"({"deletions":[{"timestamp":{"sec":0,"nsec":0},"type":1,"id":""}],"entities":[]})");
}

// Rounding, signs and sizes at which a quick way could go wrong; halves go to the even digit.
TEST(SceneUpdate, PlacesAreRoundedExactly) {
    EXPECT_EQ(text_of(0), "0.000000");
    EXPECT_EQ(text_of(-0.0), "-0.000000");
    EXPECT_EQ(text_of(-1e-9), "-0.000000");
    EXPECT_EQ(text_of(0.9999996), "1.000000");
    EXPECT_EQ(text_of(1.0 / 128), "0.007812");  // 0.0078125
    EXPECT_EQ(text_of(3.0 / 128), "0.023438");  // 0.0234375
    EXPECT_EQ(text_of(0.0000005), "0.000000");  // as doubles, a little less than half
    EXPECT_EQ(text_of(0.0000015), "0.000002");  // and a little more
    EXPECT_EQ(text_of(-12345678.25), "-12345678.250000");
    EXPECT_EQ(text_of(std::numeric_limits<double>::max()),
              fmt::format("{:.6f}", std::numeric_limits<double>::max()));
}

TEST(SceneUpdate, PlacesAreWrittenAsByFmt) {
    SplitMix64 random(7);
    for (int i = 0; i < 20'000; ++i) {
        const double any = (random.unit() - 0.5) * std::pow(10.0, i % 12 - 4);
        const double on_grid = std::round(any * 1e6) / 1e6;
        const double tie = (std::floor(any * 1e6) + 0.5) / 1e6;
        for (const double x : {any, on_grid, tie, std::nextafter(tie, 0)}) {
            ASSERT_EQ(text_of(x), fmt::format("{:.6f}", x)) << i;
        }
    }
}

}  // namespace
}  // namespace vagus::record
