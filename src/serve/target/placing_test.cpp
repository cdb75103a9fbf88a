// Breakpoints stay with their lines while the text changes and the node still runs the old one.
#include <gmock/gmock.h>

#include "serve/target/test_target.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;
using Type = wire::MessageType;

struct PlacingTest : TargetTest {
    static constexpr const char* kDoc = "robot.aesl#2";
    static constexpr const char* kText = "var n\nonevent tick\n  n = n + 1\n";

    PlacingTest() {
        files.on_change([this](const std::string& path) {
            scripts.changed(path);
            target.script_changed(path);
        });
    }
    void type(const std::string& text) {
        ASSERT_TRUE(files.replace(kDoc, text, "page").ok());
        pass(50ms);
    }
    void set(int line) {
        ask("break.set", {{"doc", kDoc}, {"line", line}});
        pass(50ms);
    }
    std::vector<int> lines() const {
        std::vector<int> lines;
        for (const ScriptBreakpoint& one : breakpoints.all()) lines.push_back(one.line);
        return lines;
    }
};

TEST_F(PlacingTest, OnePutAboveItIsLeftAloneOnTheNode) {
    run();
    set(3);
    EXPECT_TRUE(breakpoints.all()[0].set);
    bus.sent.clear();
    type("# one\n" + std::string(kText));
    EXPECT_EQ(lines(), std::vector<int>{4});
    EXPECT_EQ(count_sent(kBumper, Type::BreakpointSet), 0u);
    EXPECT_EQ(count_sent(kBumper, Type::BreakpointClear), 0u);
    // A hit of the old text counts for the line as it is called now.
    ask("node.run", {{"node", kBumper}});
    pass(100ms);
    EXPECT_GE(breakpoints.all()[0].hits, 2u);
}

TEST_F(PlacingTest, AfterAnotherTextNoGhostPausesTheProgram) {
    run();
    set(3);
    bus.sent.clear();
    type("call something else entirely\n");
    EXPECT_EQ(lines(), std::vector<int>{});
    EXPECT_EQ(count_sent(kBumper, Type::BreakpointClear), 1u);
    // It runs on, and is paused no more.
    ask("node.run", {{"node", kBumper}});
    pass(300ms);
    EXPECT_TRUE(runs(kBumper));
}

TEST_F(PlacingTest, ALineThatTheNodeDoesNotHaveIsSaidAndSetWithItsScript) {
    run();
    type("var n\nonevent tick\n  n = n + 1\n  n = n + 2\n");
    set(4);
    EXPECT_FALSE(breakpoints.all()[0].set);
    EXPECT_THAT(breakpoints.all()[0].why, HasSubstr("the node runs an older text"));
    target.load_changed(true, [](auto) {});
    pass(500ms);
    EXPECT_EQ(lines(), std::vector<int>{4});
    EXPECT_TRUE(breakpoints.all()[0].set);
}

// In the numbers of the older text the next line with code may be anywhere.
TEST_F(PlacingTest, WhichLineOfTheOlderTextHasNoCodeIsNotSaid) {
    run();
    type("n = 1\nonevent tick\n  n = n + 1\n");
    set(1);
    EXPECT_FALSE(breakpoints.all()[0].set);
    EXPECT_THAT(breakpoints.all()[0].why, HasSubstr("the node runs an older text"));
}

TEST_F(PlacingTest, WhatTheProjectHasKeptStaysWithItsLinesToo) {
    const Json kept = {{"doc", kDoc}, {"line", 3u}};
    breakpoints.from_json(Json::array({kept}));
    target.follow_breakpoints();
    type("# one\n# two\n" + std::string(kText));
    EXPECT_EQ(lines(), std::vector<int>{5});
}

TEST_F(PlacingTest, AConditionThatDoesNotParseIsRefusedWhereItIsTyped) {
    const Json answer = say("break.set", {{"doc", kDoc}, {"line", 3}, {"condition", "n >"}});
    EXPECT_EQ(answer["error"]["code"], "bad_input");
    EXPECT_THAT(answer["error"]["what"].get<std::string>(), HasSubstr("in.condition: "));
    EXPECT_EQ(lines(), std::vector<int>{});
    ask("break.set", {{"doc", kDoc}, {"line", 3}, {"condition", "n > 2"}});
    EXPECT_EQ(lines(), std::vector<int>{3});
    // Also while the script does not compile, when nobody knows its names.
    type("var n\nonevent tick\n  n = n +\n");
    const Json again = say("break.set", {{"doc", kDoc}, {"line", 3}, {"condition", "m >"}});
    EXPECT_EQ(again["error"]["code"], "bad_input");
    EXPECT_THAT(again["error"]["what"].get<std::string>(), HasSubstr("expression, column 4"));
    ask("break.set", {{"doc", kDoc}, {"line", 3}, {"condition", "m > 2"}});
}

// The next event is begun behind the fault, and waits at its first line.
TEST_F(PlacingTest, AFaultIsShownAtItsLine) {
    type("var n\nonevent tick\n  n = 0\n  n = 5 / n\n");
    connect();
    target.load_changed(true, [](auto) {});
    pass(800ms);
    const Json node = node_document(kBumper);
    EXPECT_EQ(node["why"], "fault");
    EXPECT_EQ(node["at"]["line"], 4);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);  // it was never let run
}

// Else the clock of a simulation runs on, and the page says Running beside a node that is paused.
TEST_F(PlacingTest, AFaultPausesTheClockAsABreakpointDoes) {
    int paused = 0;
    TargetHints hints;
    hints.stopped_at_breakpoint = [&paused] { ++paused; };
    target.set_hints(hints);
    type("var n\nonevent tick\n  n = 0\n  n = 5 / n\n");
    connect();
    target.load_changed(true, [](auto) {});
    pass(800ms);
    EXPECT_EQ(node_document(kBumper)["why"], "fault");
    EXPECT_EQ(paused, 1);
}

}  // namespace
}  // namespace vagus::serve
