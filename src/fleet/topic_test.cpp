#include "fleet/topic.hpp"

#include <gtest/gtest.h>

#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

TEST(Topic, NamesAreEscapedAsTheDesignSays) {
    EXPECT_EQ(escape("r1_A.b-c"), "r1_A.b-c");
    EXPECT_EQ(escape("a/b +#"), "a%2Fb%20%2B%23");
    EXPECT_EQ(escape("\xc3\xa9"), "%C3%A9");
    EXPECT_EQ(unescape("a%2Fb"), "a/b");
}

TEST(Topic, OneNameHasOneSpelling) {
    for (const char* const level : {"", "%", "%2", "%2f", "%41", "a b", "+", "%00", "%FF"}) {
        EXPECT_EQ(unescape(level), std::nullopt) << level;
    }
}

TEST(Topic, NamesHaveALimit) {
    EXPECT_TRUE(is_name(std::string(kNameBytesMax, 'a')));
    EXPECT_FALSE(is_name(std::string(kNameBytesMax + 1, 'a')));
    EXPECT_FALSE(is_name(""));
    EXPECT_FALSE(is_name("a\nb"));
    EXPECT_TRUE(is_robot_name("r1"));
    EXPECT_FALSE(is_robot_name("all"));
    EXPECT_FALSE(is_robot_name("group"));
}

TEST(Topic, EveryKindIsReadAsItIsWritten) {
    const Topic topics[] = {
        {.kind = Kind::Connection, .robot = "r1"},
        {.kind = Kind::State, .robot = "a/b"},
        {.kind = Kind::Variable, .robot = "r1", .name = "odometry.x", .node = "drive"},
        {.kind = Kind::Event, .robot = "r1", .name = "alarm"},
        {.kind = Kind::Command, .robot = "r1", .name = "start"},
        {.kind = Kind::Command, .group = "red", .name = "stop"},
        {.kind = Kind::Command, .name = "stop"},
        {.kind = Kind::Ask, .robot = "r1", .name = "name"},
        {.kind = Kind::Question, .robot = "r1", .name = "take"},
        {.kind = Kind::Reply, .robot = "r1"},
        {.kind = Kind::Task, .name = "t/1", .queue = "pick"},
        {.kind = Kind::Shared, .name = "aisle 3"},
        {.kind = Kind::Beat},
    };
    const char* const texts[] = {"vagus/1/lab/robot/r1/connection",
                                 "vagus/1/lab/robot/a%2Fb/state",
                                 "vagus/1/lab/robot/r1/var/drive/odometry.x",
                                 "vagus/1/lab/robot/r1/event/alarm",
                                 "vagus/1/lab/cmd/r1/start",
                                 "vagus/1/lab/cmd/group/red/stop",
                                 "vagus/1/lab/cmd/all/stop",
                                 "vagus/1/lab/robot/r1/ask/name",
                                 "vagus/1/lab/robot/r1/ask/take",
                                 "vagus/1/lab/keeper/answer/r1",
                                 "vagus/1/lab/task/pick/t%2F1",
                                 "vagus/1/lab/shared/aisle%203",
                                 "vagus/1/lab/keeper/beat"};
    for (size_t i = 0; i < std::size(topics); ++i) {
        EXPECT_EQ(text_of("lab", topics[i]), texts[i]);
        const auto read = parse_topic("lab", texts[i]);
        ASSERT_TRUE(read) << texts[i];
        EXPECT_EQ(read->kind, topics[i].kind);
        EXPECT_EQ(read->robot, topics[i].robot);
        EXPECT_EQ(read->group, topics[i].group);
        EXPECT_EQ(read->name, topics[i].name);
        EXPECT_EQ(read->node, topics[i].node);
        EXPECT_EQ(read->queue, topics[i].queue);
    }
}

TEST(Topic, WhatIsNoneOfOursIsNothing) {
    for (const char* const text :
         {"", "vagus/1/lab", "vagus/1/other/robot/r1/state", "vagus/1/lab/robot/r1",
          "vagus/1/lab/robot/r1/state/x", "vagus/1/lab/robot/all/state", "vagus/1/lab/robot/r1/new",
          "vagus/1/lab/robot//state", "vagus/1/lab/cmd/r1/stop/x", "vagus/1/lab/shared/key/x",
          "vagus/1/lab/task/pick", "vagus/1/lab/task/pick/t1/x", "vagus/1/lab/keeper/beat/x",
          "vagus/1/lab/keeper/answer/all", "vagus/1/lab/keeper", "vagus/2/lab/robot/r1/state",
          "vagus/1/lab/robot/r%2f/state"}) {
        EXPECT_FALSE(parse_topic("lab", text)) << text;
    }
    const std::string event = "vagus/1/lab/robot/r1/event/";
    EXPECT_TRUE(parse_topic("lab", event + std::string(kNameBytesMax, 'a')));
    EXPECT_FALSE(parse_topic("lab", event + std::string(kTopicBytesMax, 'a')));
}

TEST(Topic, APlusStandsForOneLevel) {
    EXPECT_TRUE(matches_filter("a/b/c", "a/b/c"));
    EXPECT_TRUE(matches_filter("a/+/c", "a/b/c"));
    EXPECT_TRUE(matches_filter("a/b/+", "a/b/c"));
    EXPECT_TRUE(matches_filter("+", "a"));
    EXPECT_FALSE(matches_filter("a/b", "a/b/c"));
    EXPECT_FALSE(matches_filter("a/b/c", "a/b"));
    EXPECT_FALSE(matches_filter("a/+", "a/b/c"));
    EXPECT_FALSE(matches_filter("a/+/c", "a/b/d"));
    EXPECT_FALSE(matches_filter("a/b", "a/bc"));
    EXPECT_FALSE(matches_filter("a/bc", "a/b"));
    EXPECT_TRUE(matches_filter("a/+/c", "a//c"));
}

}  // namespace
}  // namespace vagus::fleet
