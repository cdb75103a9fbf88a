// What robots have beside bodies: the memory card, the ground under them, energy; and the worlds
// that users open first.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "base/json.hpp"
#include "base/test_folder.hpp"
#include "base/test_places.hpp"
#include "sim/ground.hpp"
#include "sim/png.hpp"
#include "sim/sd_card.hpp"
#include "sim/world.hpp"
#include "sim/world_file.hpp"

using namespace vagus;
using namespace vagus::sim;
using namespace std::chrono_literals;

namespace {

// Each test has a folder of its own: tests run side by side.
class Card : public testing::Test {
protected:
    std::string folder() const { return folder_.string(); }
    static constexpr int16_t kNumber = 31415;
    std::string path() const { return folder() + "/U31415.DAT"; }

private:
    const test::Folder folder_;
};

TEST_F(Card, WhatIsWrittenIsReadAgainAndLiesInTheFileLowByteFirst) {
    SdCard card(folder());
    ASSERT_TRUE(card.open(kNumber));
    const std::array<int16_t, 3> words = {1, -2, 0x1234};
    EXPECT_EQ(card.write(words), 3);
    EXPECT_TRUE(card.seek(2));
    std::array<int16_t, 3> back = {7, 7, 7};
    EXPECT_EQ(card.read(back), 2);  // two words are left
    EXPECT_EQ(back, (std::array<int16_t, 3>{-2, 0x1234, 7}));
    EXPECT_TRUE(card.open(-1));
    EXPECT_EQ(card.read(back), 0);  // nothing is open
    EXPECT_EQ(card.write(words), 0);
    EXPECT_FALSE(card.seek(0));
    EXPECT_EQ(read_file(path()).value(), std::string("\x01\0\xfe\xff\x34\x12", 6));
}

TEST_F(Card, AnEmptySlotAndWrongNumbersFail) {
    SdCard empty("");
    EXPECT_FALSE(empty.present());
    EXPECT_FALSE(empty.open(kNumber));
    EXPECT_TRUE(empty.open(-1));
    SdCard card(folder());
    EXPECT_FALSE(card.open(-2));
    SdCard nowhere(folder() + "/there/is/no/such/folder");
    EXPECT_FALSE(nowhere.open(kNumber));
}

TEST_F(Card, AFileEndsAtItsLimit) {
    SdCard card(folder());
    ASSERT_TRUE(card.open(kNumber));
    const std::vector<int16_t> most(kCardFileBytesMax / 2 / 32, 5);
    for (int i = 0; i < 32; ++i) {
        ASSERT_EQ(card.write(most), static_cast<int16_t>(most.size()));
    }
    const std::array<int16_t, 1> one_more = {1};
    EXPECT_EQ(card.write(one_more), 0);
    EXPECT_TRUE(card.seek(0));
    EXPECT_EQ(card.write(one_more), 1);
}

TEST(Ground, LaterPatchesLieOnEarlierOnesAndTurnWithTheirAngle) {
    Ground ground(2, 2, {1, 1, 1});
    const Colour red = {1, 0, 0};
    const Colour blue = {0, 0, 1};
    ground.set_patches({{.kind = ObjectKind::Patch, .at = {1, 1}, .radius = 0.3, .colour = red},
                        // 0.4 by 0.02 m, turned by 45 degrees.
                        {.kind = ObjectKind::Patch,
                         .at = {1, 1},
                         .angle = 0.7853981633974483,
                         .width = 0.4,
                         .length = 0.02,
                         .colour = blue}});
    EXPECT_EQ(ground.colour_at({1, 1}), blue);
    EXPECT_EQ(ground.colour_at({1.1, 1.1}), blue);
    EXPECT_EQ(ground.colour_at({1.1, 1}), red);
    EXPECT_EQ(ground.colour_at({1.31, 1}), (Colour{1, 1, 1}));
    EXPECT_EQ(ground.colour_at({-5, 50}), (Colour{1, 1, 1}));
}

// The picture is red and green in its upper row, blue and white in its lower one.
TEST(Ground, APictureIsStretchedOverTheWorldWithItsFirstRowOnTop) {
    const std::string path = test::testdata("fuzz/sim_png/rgb");
    Result<Picture> picture = read_png(read_file(path).value(), "rgb");
    ASSERT_TRUE(picture.ok()) << picture.error().what;
    Ground ground(4, 2, {1, 1, 1});
    ground.set_picture(std::move(picture.value()));
    EXPECT_EQ(ground.colour_at({1.9, 1.1}), (Colour{1, 0, 0}));
    EXPECT_EQ(ground.colour_at({2.1, 1.1}), (Colour{0, 1, 0}));
    EXPECT_EQ(ground.colour_at({1.9, 0.9}), (Colour{0, 0, 1}));
    EXPECT_EQ(ground.colour_at({2.1, 0.9}), (Colour{1, 1, 1}));
    EXPECT_EQ(ground.colour_at({-1, 9}), (Colour{1, 0, 0}));  // beyond: the nearest pixel
}

TEST(Ground, WhatIsNoPngIsRefusedWithItsName) {
    const Result<Picture> picture = read_png("GIF89a", "floor.png");
    ASSERT_FALSE(picture.ok());
    EXPECT_EQ(picture.error().what.substr(0, 10), "floor.png:");
}

TEST(Ground, APictureIsReadAsItWasWritten) {
    const Picture picture{.width = 3,
                          .height = 2,
                          .pixels = {255, 0, 0, 0, 255, 0, 0, 0, 255,  //
                                     1, 2, 3, 4, 5, 6, 7, 8, 9}};
    const Result<Picture> read = read_png(write_png(picture), "written");
    ASSERT_TRUE(read.ok()) << read.error().what;
    EXPECT_EQ(read.value().width, 3u);
    EXPECT_EQ(read.value().height, 2u);
    EXPECT_EQ(read.value().pixels, picture.pixels);
}

TEST(Ground, APictureWithOnePixelTooManyIsRefused) {
    const std::string folder = test::testdata("fuzz/sim_png/");
    EXPECT_TRUE(read_png(read_file(folder + "widest").value(), "widest.png").ok());
    const Result<Picture> picture = read_png(read_file(folder + "wide").value(), "wide.png");
    ASSERT_FALSE(picture.ok());
    EXPECT_NE(picture.error().what.find("8193 x 1 pixels"), std::string::npos);
}

TEST(Epuck, EnergyIsSpentEachSecondAndSharedThroughThePool) {
    WorldDefinition definition;
    definition.robots = {{.name = "a", .type = RobotType::Epuck, .at = {0.3, 0.5}, .node = 1},
                         {.name = "b", .type = RobotType::Epuck, .at = {0.7, 0.5}, .node = 2}};
    World world = std::move(World::create(definition).value());
    const auto energy = [&world](uint32_t robot) { return world.variables({robot})[228]; };
    EXPECT_EQ(energy(1), 10);
    world.step(3s);
    EXPECT_EQ(energy(1), 7);
    EXPECT_EQ(energy(2), 7);
    world.step(20s);
    EXPECT_EQ(energy(1), 0);
}

// docs/formats.md: what opening and saving without a change leaves as it is.
TEST(Examples, EveryWorldCanBeOpenedAndIsInTheSavedForm) {
    for (const char* name :
         {"thymio/arena.world.json", "thymio/line.world.json", "epuck/colours.world.json"}) {
        const std::string path = test::examples(name);
        const std::string text = read_file(path).value();
        const Result<WorldDefinition> world = read_world(text, name);
        ASSERT_TRUE(world.ok()) << world.error().what;
        EXPECT_EQ(format_json(parse_json(text, name).value()), text) << name;
        for (const RobotDefinition& robot : world.value().robots) {
            const std::string folder = path.substr(0, path.rfind('/') + 1);
            EXPECT_TRUE(read_file(folder + robot.script).ok()) << robot.script;
        }
    }
}

}  // namespace
