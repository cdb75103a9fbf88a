#include "session/member_fleet.hpp"

#include <gtest/gtest.h>

namespace vagus::session {
namespace {

using namespace std::chrono_literals;

fleet::LinkEvent heard(fleet::Topic topic, fleet::Message message) {
    return fleet::Received{{std::move(topic), std::move(message)}, true};
}

fleet::LinkEvent connection(const std::string& robot, const std::string& state) {
    return heard({.kind = fleet::Kind::Connection, .robot = robot},
                 fleet::Connection{state, "i", 1});
}

fleet::LinkEvent shared(const std::string& value, keeper::Term version) {
    return heard({.kind = fleet::Kind::Shared, .name = "key"},
                 keeper::Record(keeper::Shared{"key", version, value}));
}

TEST(MemberFleet, RobotsAreInTheOrderOfTheirNumbers) {
    MemberFleet fleet({.fleet = "lab", .robot = "r2", .epoch = 1});
    EXPECT_EQ(fleet.online(), std::vector<std::string>{"r2"});
    for (const char* robot : {"r10", "r1", "r9"}) fleet.hear(connection(robot, "online"), 0s);
    EXPECT_EQ(fleet.online(), (std::vector<std::string>{"r1", "r2", "r9", "r10"}));
    EXPECT_TRUE(fleet.take_news());
    EXPECT_FALSE(fleet.take_news());
    fleet.hear(connection("r9", "lost"), 0s);
    EXPECT_EQ(fleet.online(), (std::vector<std::string>{"r1", "r2", "r10"}));
}

TEST(MemberFleet, AnOlderVersionThatComesLateIsNotTaken) {
    MemberFleet fleet({.fleet = "lab", .robot = "r1", .epoch = 1});
    EXPECT_FALSE(fleet.shared("key"));
    fleet.hear(shared("\"b\"", {1, 2}), 0s);
    fleet.hear(shared("\"a\"", {1, 1}), 0s);
    EXPECT_EQ(fleet.shared("key")->value, "\"b\"");
    EXPECT_EQ(fleet.shared("key")->version, (keeper::Term{1, 2}));
}

TEST(MemberFleet, AnAnswerIsGivenOnceAndALeaseEndsByItsOwnClock) {
    MemberFleet fleet({.fleet = "lab", .robot = "r1", .epoch = 7});
    fleet.tick(1s);
    const uint64_t number = fleet.ask(keeper::Take{"pick", 10s});
    fleet.tick(1s);
    EXPECT_EQ(fleet.take().size(), 1u);
    const keeper::Lease lease{"r1", {1, 2}, 10s};
    const keeper::Task task{"pick", "a", {1, 1}, "1", keeper::Work::Leased, lease, ""};
    fleet.hear(heard({.kind = fleet::Kind::Reply, .robot = "r1"},
                     fleet::Reply{7, number, {keeper::Outcome::Done, "", 1, task}}),
               2s);
    fleet.tick(2s);
    EXPECT_TRUE(fleet.take_news());
    const auto over = fleet.answer(number);
    ASSERT_TRUE(over && over->reply);
    EXPECT_FALSE(fleet.answer(number));
    EXPECT_TRUE(fleet.holds({1, 2}));
    // It counts from when the question was sent, and nobody renews it.
    fleet.tick(10999ms);
    EXPECT_TRUE(fleet.holds({1, 2}));
    fleet.tick(11s);
    EXPECT_FALSE(fleet.holds({1, 2}));
}

TEST(MemberFleet, NoMoreIsToldThanThereIsRoomFor) {
    MemberFleet fleet({.fleet = "lab", .robot = "r1", .epoch = 1});
    for (size_t i = 0; i < kToldMax + 1; ++i) fleet.tell("n", {1});
    EXPECT_EQ(fleet.take_told().size(), kToldMax);
    EXPECT_TRUE(fleet.take_told().empty());
}

}  // namespace
}  // namespace vagus::session
