#include "cli/screen/screen.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/rng.hpp"

namespace vagus::cli {
namespace {

using testing::HasSubstr;

Outline rectangle(double left, double bottom, double right, double top) {
    return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, {}, 0};
}

// Two metres wide, one high; a robot in the middle that looks up, a wall at the left, a dark patch
// at the right.
View small_world() {
    View view;
    view.title = "yard";
    view.width = 2;
    view.height = 1;
    view.shapes.push_back({ShapeKind::Solid, rectangle(0, 0, 0.1, 1), {90, 70, 60}});
    view.shapes.push_back({ShapeKind::Patch, rectangle(1.6, 0.2, 1.9, 0.8), {20, 20, 20}});
    RobotView robot;
    robot.name = "thymio";
    robot.at = {1, 0.5};
    robot.angle = std::acos(0.0);
    robot.outline = rectangle(0.95, 0.45, 1.05, 0.55);
    robot.paint = {240, 240, 240};
    view.robots.push_back(robot);
    view.panel.node_name = "thymio-II";
    view.panel.node_id = 3;
    view.panel.state = "running";
    view.now = std::chrono::milliseconds(12345);
    view.speed = "x1";
    return view;
}

std::string text_of(const Grid& page) {
    std::string text;
    for (int row = 0; row < page.size().rows; row++) text += page.row_text(row) + "\n";
    return text;
}

constexpr Look kPlain{Charset::Unicode, ColourDepth::None};
constexpr Look kLetters{Charset::Ascii, ColourDepth::None};

TEST(Screen, SaysWhatItShows) {
    View view = small_world();
    view.panel.bars = {{"prox", {0, 4500}, 4500}};
    view.panel.wheels = {{"left", "told", "does", 300, 298}};
    view.panel.variables = {{"state", {2}, false}};
    view.panel.events = {{"found", 7, {1, -2}, view.now}};
    view.listening = "tcp:127.0.0.1:40000";
    view.notice = "explore.aesl loaded";
    const std::string page = text_of(draw(view, {120, 24}, kPlain));
    EXPECT_THAT(page, HasSubstr("yard  12.3 s  x1  explore.aesl loaded"));
    EXPECT_THAT(page, HasSubstr("tcp:127.0.0.1:40000"));
    EXPECT_THAT(page, HasSubstr("thymio-II  node 3"));
    EXPECT_THAT(page, HasSubstr("at 1.00, 0.50 m  90°"));
    EXPECT_THAT(page, HasSubstr("prox ▁█ 0 4500"));
    EXPECT_THAT(page, HasSubstr("told 300   does 298"));
    EXPECT_THAT(page, HasSubstr("state"));
    EXPECT_THAT(page, HasSubstr("found 1 -2"));
    EXPECT_THAT(page, HasSubstr("×7"));
    EXPECT_THAT(page, HasSubstr("q quit"));
}

// Without colour and UTF-8 the picture is made of letters. The arena is twice as wide as high, and
// so is a cell of text turned round: in a 60 x 16 page the world takes 32 columns and 8 rows.
TEST(Screen, DrawsWithLettersWhereBlocksWouldNotShow) {
    const Grid page = draw(small_world(), kSizeMin, kLetters);
    const std::string text = text_of(page);
    for (const char c : text) EXPECT_GE(c, 0) << "only ASCII: " << text;
    EXPECT_THAT(text, HasSubstr("#"));  // the wall
    EXPECT_THAT(text, HasSubstr(":"));  // the dark patch
    EXPECT_THAT(text, HasSubstr("^"));  // the robot looks up
    EXPECT_LT(page.row_text(7).find('#'), page.row_text(7).find(':')) << text;
}

TEST(Screen, BelowTheSmallestSizeItSaysWhatItNeeds) {
    const View view = small_world();
    EXPECT_THAT(text_of(draw(view, kSizeMin, kPlain)), HasSubstr("thymio-II"));
    for (const Size size : {Size{59, 16}, Size{60, 15}}) {
        const std::string page = text_of(draw(view, size, kPlain));
        EXPECT_THAT(page, HasSubstr("this view needs 60 x 16"));
        EXPECT_THAT(page, testing::Not(HasSubstr("thymio-II")));
    }
}

// Nothing of a sentence may be lost on a narrow screen: it is what mends the mistake.
TEST(Screen, MistakesOfTheScriptAreBrokenAtSpacesAndShownWhole) {
    View view = small_world();
    view.problems = {
        "explore.aesl:12:5: error: There is no variable called speeed; did you mean "
        "speed? [VARIABLE_NOT_DEFINED]",
        "   12 | speeed = 3", "      | ^~~~~~"};
    const std::string page = text_of(draw(view, kSizeMin, kPlain));
    EXPECT_THAT(page, HasSubstr("explore.aesl:12:5: error: There is no variable called"));
    EXPECT_THAT(page, HasSubstr("   speeed; did you mean speed? [VARIABLE_NOT_DEFINED]"));
    EXPECT_THAT(page, HasSubstr("   12 | speeed = 3\n       | ^~~~~~"));
    EXPECT_THAT(page, HasSubstr("thymio-II"));
}

TEST(Screen, AListThatDoesNotFitSaysHowMuchIsMissing) {
    View view = small_world();
    for (int i = 0; i < 40; i++)
        view.panel.variables.push_back({"v" + std::to_string(i), {1}, false});
    EXPECT_THAT(text_of(draw(view, kSizeMin, kPlain)), HasSubstr("more"));
    EXPECT_THAT(text_of(draw(view, {80, 60}, kPlain)), HasSubstr("v39"));
}

// Robots leave an open world, files hold odd sizes: whatever the values, the page is drawn.
TEST(Screen, NoValueBreaksThePage) {
    const uint64_t seed = 20;
    SplitMix64 random(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double odd[] = {0, 1e-9, 0.5, -1, 100, 1e9, -1e9};
    const auto any = [&] { return odd[random.below(std::size(odd))]; };
    for (int round = 0; round < 300; round++) {
        View view = small_world();
        view.width = std::max(0.2, std::min(any(), 100.0));
        view.height = std::max(0.2, std::min(any(), 100.0));
        view.robots[0].at = {any(), any()};
        view.robots[0].angle = any();
        view.robots[0].outline = {{}, {any(), any()}, any()};
        view.robots[0].rays = {{{any(), any()}, {any(), any()}, true}};
        view.robots[0].trail = {{any(), any()}};
        view.shapes[0].outline = rectangle(any(), any(), any(), any());
        view.selected = random.below(3);
        const Size size{static_cast<int>(random.below(200)), static_cast<int>(random.below(60))};
        const Look look{random.below(2) == 0 ? Charset::Unicode : Charset::Ascii,
                        static_cast<ColourDepth>(random.below(4))};
        const Grid page = draw(view, size, look);
        EXPECT_FALSE(repaint(nullptr, page, look.depth).empty());
    }
}

TEST(Look, FollowsTheEnvironment) {
    const auto depth = [](Environment environment) { return look_for(environment).depth; };
    EXPECT_EQ(depth({.term = "xterm", .colorterm = "truecolor"}), ColourDepth::True);
    EXPECT_EQ(depth({.term = "screen-256color"}), ColourDepth::Indexed);
    EXPECT_EQ(depth({.term = "xterm"}), ColourDepth::Basic);
    EXPECT_EQ(depth({.term = "dumb", .colorterm = "truecolor"}), ColourDepth::None);
    EXPECT_EQ(depth({.term = "xterm-256color", .no_color = "1"}), ColourDepth::None);
    const auto charset = [](Environment environment) { return look_for(environment).charset; };
    EXPECT_EQ(charset({.term = "xterm", .locale = "de_DE.UTF-8"}), Charset::Unicode);
    EXPECT_EQ(charset({.term = "xterm"}), Charset::Unicode);
    EXPECT_EQ(charset({.term = "xterm", .locale = "C"}), Charset::Ascii);
    EXPECT_EQ(charset({.term = "linux", .locale = "en_US.utf8"}), Charset::Ascii);
}

}  // namespace
}  // namespace vagus::cli
