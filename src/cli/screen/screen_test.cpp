#include "cli/screen/screen.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/rng.hpp"
#include "cli/screen/page.hpp"
#include "cli/screen/theme.hpp"

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
    RobotPicture robot;
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

constexpr Look kPlain{Charset::Unicode, ColourDepth::None, Theme::Dark};
constexpr Look kLetters{Charset::Ascii, ColourDepth::None, Theme::Dark};

TEST(Screen, SaysWhatItShows) {
    View view = small_world();
    view.panel.bars = {{"prox", {0, 4500}, 4500}};
    view.panel.wheels = {{"left", "told", "does", 300, 298}};
    view.panel.variables = {{"state", {2}, false}};
    view.panel.events = {{"found", 7, {1, -2}, view.now}};
    view.listening = "tcp:127.0.0.1:40000";
    view.notice = "explore.aesl loaded";
    view.keys = {{"space", "pause"}, {"q", "quit"}};
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
    EXPECT_THAT(page, HasSubstr(" space pause  q quit\n"));
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

// Nothing of a sentence may be lost on a narrow screen: it is what fixes the mistake.
TEST(Screen, MistakesOfTheScriptAreBrokenAtSpacesAndShownWhole) {
    View view = small_world();
    view.problems = {
        {"explore.aesl:12:5: error: There is no variable called speeed; did you mean "
         "speed? [VARIABLE_NOT_DEFINED]",
         {"   12 | speeed = 3", "      | ^~~~~~"}}};
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

// Where the world is shown, by the glyphs of its upper left and lower right corner.
struct Frame {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

bool is_border(const Cell& cell, Rgb colour, const Look& look) {
    if (look.depth == ColourDepth::None) return cell.glyph == U'█';
    return cell.glyph == U'█' && cell.ink.fore == Colour(colour);
}

Frame frame_of(const Grid& page, Rgb colour, const Look& look) {
    Frame frame{page.size().columns, page.size().rows, -1, -1};
    for (int row = 0; row < page.size().rows; row++) {
        for (int column = 0; column < page.size().columns; column++) {
            if (!is_border(page.at(column, row), colour, look)) continue;
            frame.left = std::min(frame.left, column);
            frame.top = std::min(frame.top, row);
            frame.right = std::max(frame.right, column);
            frame.bottom = std::max(frame.bottom, row);
        }
    }
    return frame;
}

// Each edge once: a full column left and right, half a row above and below, floor inside.
void expect_four_edges(const Grid& page, Rgb colour, const Look& look) {
    const Frame at = frame_of(page, colour, look);
    ASSERT_LT(at.left + 2, at.right) << text_of(page);
    ASSERT_LT(at.top + 2, at.bottom) << text_of(page);
    for (int row = at.top; row <= at.bottom; row++) {
        EXPECT_TRUE(is_border(page.at(at.left, row), colour, look)) << text_of(page);
        EXPECT_TRUE(is_border(page.at(at.right, row), colour, look)) << text_of(page);
        EXPECT_EQ(page.at(at.left + 1, row).glyph, row == at.top      ? U'▀'
                                                   : row == at.bottom ? U'▄'
                                                                      : U' ');
    }
    for (int column = at.left + 1; column < at.right; column++) {
        ASSERT_EQ(page.at(column, at.top).glyph, U'▀') << text_of(page);
        ASSERT_EQ(page.at(column, at.top + 1).glyph, U' ') << text_of(page);
        ASSERT_EQ(page.at(column, at.bottom).glyph, U'▄') << text_of(page);
        ASSERT_EQ(page.at(column, at.bottom - 1).glyph, U' ') << text_of(page);
    }
}

TEST(Screen, ShowsAllFourWallsAroundTheWorldAtEverySize) {
    View view;
    view.border = Rgb{105, 85, 70};
    for (const Point metres : {Point{6, 4.5}, Point{2, 1}, Point{1, 1}, Point{1, 1.7}}) {
        view.width = metres.x;
        view.height = metres.y;
        for (int columns = 60; columns <= 160; columns += 9) {
            for (int rows = 16; rows <= 50; rows += 4) {
                SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
                for (const ColourDepth depth : {ColourDepth::None, ColourDepth::True}) {
                    const Look look{Charset::Unicode, depth, Theme::Dark};
                    expect_four_edges(draw(view, {columns, rows}, look), *view.border, look);
                    if (HasFatalFailure()) return;
                }
            }
        }
    }
}

TEST(Screen, AnOpenWorldHasNoWallsAround) {
    View view;
    EXPECT_THAT(text_of(draw(view, {80, 24}, kPlain)), testing::Not(HasSubstr("█")));
}

PlanPanelView long_plan() {
    PlanPanelView plan;
    plan.name = "Long";
    plan.state = "running";
    const auto name = [](const char* letter, int i) { return letter + std::to_string(i); };
    for (int i = 0; i < 20; i++) plan.actors.push_back({name("a", i), 0, i == 13, {}});
    for (int i = 0; i < 7; i++) plan.watching.push_back({name("w", i), "Seen", false});
    for (int i = 0; i < 8; i++) plan.variables.push_back({name("v", i), "1", "", false});
    for (int i = 0; i < 9; i++) plan.loads.push_back({name("n", i), 0.001});
    for (int i = 0; i < 30; i++) plan.happenings.push_back({{}, name("h", i), false});
    plan.forgotten = 1000;
    return plan;
}

// 60 x 20: the panel has 18 lines. The name, 2 of actors, three lists of a heading and 2 lines, a
// heading and 4 lines + the one that is left over of what happened: of 1030, 3 and how many more.
TEST(Screen, EachListOfAPlanSaysHowMuchOfItIsMissing) {
    View view;
    view.plan = long_plan();
    const std::string page = text_of(draw(view, {60, 20}, kPlain));
    EXPECT_THAT(page, HasSubstr("▶ a13"));
    EXPECT_THAT(page, HasSubstr("… 18 more"));    // actors
    EXPECT_THAT(page, HasSubstr("… 6 more"));     // watching
    EXPECT_THAT(page, HasSubstr("… 7 more"));     // variables
    EXPECT_THAT(page, HasSubstr("… 8 more"));     // the load of the bus
    EXPECT_THAT(page, HasSubstr("… 1027 more"));  // what happened
}

TEST(Screen, AListOfAPlanThatFitsIsWhole) {
    View view;
    view.plan = long_plan();
    view.plan->actors.resize(9);
    view.plan->watching.resize(5);
    view.plan->variables.resize(6);
    view.plan->loads.resize(6);
    view.plan->happenings.resize(4);
    view.plan->forgotten = 0;
    EXPECT_THAT(text_of(draw(view, {140, 40}, kPlain)), testing::Not(HasSubstr("more")));
}

TEST(Screen, EventsThatDoNotFitAreCounted) {
    View view = small_world();
    for (int i = 0; i < 40; i++) view.panel.events.push_back({"e" + std::to_string(i), 1, {}, {}});
    EXPECT_THAT(text_of(draw(view, kSizeMin, kPlain)), HasSubstr("… 3"));  // more than 30
}

TEST(Screen, APlanThatIsOverHasNoSpeed) {
    View view;
    view.plan = long_plan();
    view.plan->over = true;
    view.notice = "the plan is over: OK";
    view.speed = "x1";
    const Grid page = draw(view, {100, 30}, kPlain);
    EXPECT_THAT(page.row_text(0), HasSubstr("the plan is over: OK"));
    EXPECT_THAT(page.row_text(0), testing::Not(HasSubstr("x1")));
}

// The needed ones come first. A blank, three keys and their blanks take 33 columns of 60.
TEST(Screen, KeysThatDoNotFitWholeAreLeftOut) {
    View view;
    view.keys = {
        {"space", "pause"}, {"q", "quit"}, {"r", "restart"}, {"a", "xxxxxxxxxxxxxxxxxxxxxxxxx"}};
    EXPECT_EQ(draw(view, kSizeMin, kPlain).row_text(15),
              " space pause  q quit  r restart  a xxxxxxxxxxxxxxxxxxxxxxxxx");
    view.keys.back().does += "x";  // 61 columns
    EXPECT_EQ(draw(view, kSizeMin, kPlain).row_text(15), " space pause  q quit  r restart");
}

// "twenty letters of name" at the left and "-12345 ... 6789" at the right of 20 columns: the value
// needs 15 and may have 9 of the 19 beside a blank, the name then has 10.
TEST(Page, ALineOfANameAndAValueShortensBothInTheMiddle) {
    Grid grid({20, 4});
    Page page(grid, {0, 0, 20, 4}, Charset::Unicode);
    page.pair("abcdefghijklmnopqrst", {}, "-12345 678 6789", {});
    page.pair("abc", {}, "-12345 678 6789", {});
    page.pair("abcdefghijklmnopqrst", {}, "17", {});
    page.pair("abc", {}, "17", {});
    EXPECT_EQ(grid.row_text(0), "abcde…qrst -123…6789");
    EXPECT_EQ(grid.row_text(1), "abc  -12345 678 6789");
    EXPECT_EQ(grid.row_text(2), "abcdefgh…mnopqrst 17");
    EXPECT_EQ(grid.row_text(3), "abc               17");
}

TEST(Page, TextIsShortenedAtWholeCharacters) {
    EXPECT_EQ(shortened("Drehgeschwindigkeit", 9, Charset::Unicode), "Dreh…keit");
    EXPECT_EQ(shortened("Drehgeschwindigkeit", 8, Charset::Ascii), "Dreh~eit");
    EXPECT_EQ(shortened("größer", 6, Charset::Unicode), "größer");
    EXPECT_EQ(shortened("größer", 5, Charset::Unicode), "gr…er");
    EXPECT_EQ(shortened("äöüäöü", 4, Charset::Unicode), "äö…ü");
    EXPECT_EQ(shortened("abc", 2, Charset::Unicode), "ab");
    EXPECT_EQ(shortened("abc", 0, Charset::Unicode), "");
}

// A value that nobody can see is worse than one without its middle.
TEST(Screen, LongNamesHideNothing) {
    View view = small_world();
    const std::string name(200, 'n');
    view.title = name;
    view.panel.node_name = name;
    view.panel.variables = {{name, {-32768, 1, 2, 3, 4, 5, 32767}, false}};
    view.panel.events = {{name, 12, {1, -2}, {}}};
    view.notice = name;
    view.listening = "tcp:127.0.0.1:40000";
    const std::string page = text_of(draw(view, kSizeMin, kPlain));
    for (const char* part :
         {"12.3 s", "x1", "40000", "node 3", "running", "-32768", "32767", "1 -2", "×12"}) {
        EXPECT_THAT(page, HasSubstr(part));
    }
    view.plan = long_plan();
    view.plan->name = name;
    view.plan->actors = {{name, 0, true, std::chrono::seconds(1000000)}};
    view.plan->watching = {{name, "Hit", true}};
    view.plan->variables = {{name, "1.25", "cm", false}};
    const std::string other = text_of(draw(view, {60, 24}, kPlain));
    for (const char* part : {"running", "1000000.0 s", "always Hit", "1.25 cm"}) {
        EXPECT_THAT(other, HasSubstr(part));
    }
}

TEST(Screen, TheListOfWhatHappenedScrolls) {
    View view;
    view.plan = long_plan();
    const auto page = [&](size_t scrolled) {
        view.scrolled = scrolled;
        return text_of(draw(view, {100, 40}, kPlain));
    };
    EXPECT_THAT(page(0), HasSubstr("0.0 h0\n"));
    EXPECT_THAT(page(0), HasSubstr("─ what happened ─"));
    EXPECT_THAT(page(7), HasSubstr("what happened, 7 later"));
    EXPECT_THAT(page(7), HasSubstr("0.0 h7\n"));
    EXPECT_THAT(page(7), testing::Not(HasSubstr("0.0 h6\n")));
    EXPECT_THAT(page(1000), HasSubstr("0.0 h29\n"));
    EXPECT_THAT(page(1000), HasSubstr("… 1000 more"));
}

TEST(Screen, TheListOfEventsScrolls) {
    View view = small_world();
    for (int i = 0; i < 40; i++) view.panel.events.push_back({"e" + std::to_string(i), 1, {}, {}});
    view.scrolled = 12;
    const std::string page = text_of(draw(view, {80, 24}, kPlain));
    EXPECT_THAT(page, HasSubstr("events, 12 above"));
    EXPECT_THAT(page, HasSubstr("e12 "));
    EXPECT_THAT(page, testing::Not(HasSubstr("e11 ")));
}

// All text on the terminal's own background has a contrast of 4.5 to white at least.
TEST(Screen, OnALightTerminalAllTextCanBeRead) {
    View view = small_world();
    view.panel.wrong = true;
    view.panel.variables = {{"state", {2}, true}};
    view.keys = {{"q", "quit"}};
    view.problems = {{"a mistake", {}}};
    for (const bool plan : {false, true}) {
        if (plan) view.plan = long_plan();
        const Look look{Charset::Unicode, ColourDepth::True, Theme::Light};
        const Grid page = draw(view, {80, 24}, look);
        for (int row = 0; row < 24; row++) {
            for (int column = row == 23 ? 0 : 52; column < 80; column++) {
                const Ink& ink = page.at(column, row).ink;
                if (!ink.fore || ink.back) continue;
                EXPECT_EQ(readable(*ink.fore, Theme::Light), *ink.fore) << column << ", " << row;
            }
        }
    }
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
                        static_cast<ColourDepth>(random.below(4)),
                        static_cast<Theme>(random.below(2))};
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
