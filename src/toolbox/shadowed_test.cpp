#include "toolbox/shadowed.hpp"

#include <gtest/gtest.h>

namespace vagus::toolbox {
namespace {

plan::Template actor(std::string name, int line = 0) {
    return {.name = std::move(name), .line = line};
}

// "drive" is built in; "mine" is a file.
plan::Library library() {
    plan::Library all;
    all.add({.name = "drive", .templates = {actor("Forward"), actor("Turn")}});
    all.add({.name = "mine",
             .templates = {actor("Turn", 7),
                           actor("Jump", 9),
                           {.name = "Forward", .kind = plan::Kind::Supervisor, .line = 12}},
             .file = "mine.toolbox.json"});
    all.add({.name = "carbot", .templates = {actor("Turn")}});
    return all;
}

plan::Findings found(const std::vector<plan::ToolboxName>& listed) {
    plan::Plan one;
    one.file = "p.plan.json";
    one.name = "P";
    one.toolboxes = listed;
    return find_shadowed({one}, library());
}

// An actor and a supervisor of one name are two things.
TEST(Shadowed, WhatAnEarlierToolboxTakesAwayIsNamedWithBothPlaces) {
    const plan::Findings findings = found({{"drive", {3, 5}}, {"mine", {4, 5}}});
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].severity, plan::Severity::Warning);
    EXPECT_EQ(findings[0].line, 4);
    EXPECT_EQ(findings[0].message,
              "of the toolbox mine this plan can never use \"Turn\" (mine.toolbox.json:7; drive: "
              "built in), for drive is listed before it; change the order, or rename them");
    EXPECT_EQ(found({{"mine", {3, 5}}, {"drive", {4, 5}}}).size(), 1u);  // then it is that of drive
}

TEST(Shadowed, AToolboxThatIsListedAloneLosesNothing) {
    EXPECT_TRUE(found({{"mine", {3, 5}}}).empty());
    EXPECT_TRUE(found({{"mine", {3, 5}}, {"nobodys", {4, 5}}, {"mine", {5, 5}}}).empty());
}

// A plan of a beginner who takes what the palette offers first has both.
TEST(Shadowed, OfTwoToolboxesThatAreBuiltInNothingIsSaid) {
    EXPECT_TRUE(found({{"drive", {3, 5}}, {"carbot", {4, 5}}}).empty());
    EXPECT_EQ(found({{"carbot", {3, 5}}, {"mine", {4, 5}}}).size(), 1u);
}

}  // namespace
}  // namespace vagus::toolbox
