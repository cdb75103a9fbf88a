#include "serve/field/starter.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

// A robot whose nodes come and whose starts are answered when the test says so.
class StarterTest : public testing::Test {
protected:
    Starter starter{{.missing = [this] { return missing; },
                     .start = [this](auto done) { starts.push_back(std::move(done)); },
                     .log = [this](auto& kind, auto& text) { log.push_back(kind + ": " + text); }}};
    std::vector<std::string> missing;
    std::vector<std::function<void(const std::string&)>> starts;
    std::vector<std::string> log;
};

TEST_F(StarterTest, StartsAtOnceWhereAllNodesAreThere) {
    EXPECT_EQ(starter.next_tick(), Time::max());
    starter.begin(5s);
    EXPECT_EQ(starter.next_tick(), Time(5s));
    starter.tick(5s);
    ASSERT_EQ(starts.size(), 1u);
    EXPECT_EQ(starter.state(), Starter::State::Starting);
    starts[0]("");
    EXPECT_EQ(starter.state(), Starter::State::Started);
    EXPECT_EQ(starter.next_tick(), Time::max());
    EXPECT_TRUE(log.empty());
}

TEST_F(StarterTest, WaitsForNodesAndSaysSoOnce) {
    missing = {"left", "right"};
    starter.begin(0s);
    for (Time now = 0s; now < 60s; now += kLookForNodesEvery) starter.tick(now);
    EXPECT_TRUE(starts.empty());
    EXPECT_EQ(log, std::vector<std::string>{
                       "note: waiting for nodes that are not there yet: left, right"});
    missing = {"right"};
    starter.tick(60s);
    EXPECT_EQ(log.back(), "note: waiting for nodes that are not there yet: right");
    missing.clear();
    starter.tick(60s);  // not due yet
    EXPECT_TRUE(starts.empty());
    starter.tick(60s + kLookForNodesEvery);
    EXPECT_EQ(starts.size(), 1u);
}

TEST_F(StarterTest, StartsAgainAfterAFailure) {
    starter.begin(0s);
    starter.tick(0s);
    starts[0]("the plan has an error");
    EXPECT_EQ(starter.state(), Starter::State::Waiting);
    EXPECT_EQ(starter.why(), "it does not start: the plan has an error");
    EXPECT_EQ(starter.refused(), "it does not start: the plan has an error");
    starter.tick(kStartAgainAfter - 1us);
    EXPECT_EQ(starts.size(), 1u);
    starter.tick(kStartAgainAfter);
    ASSERT_EQ(starts.size(), 2u);
    starts[1]("the plan has an error");
    EXPECT_EQ(log, std::vector<std::string>{"error: it does not start: the plan has an error"});
}

TEST_F(StarterTest, WhatIsGivenUpStartsNothing) {
    starter.begin(0s);
    starter.tick(0s);
    starter.give_up();
    starts[0]("");  // an answer that comes too late
    EXPECT_EQ(starter.state(), Starter::State::Idle);
    EXPECT_EQ(starter.why(), "it was stopped");
    starter.tick(100s);
    EXPECT_EQ(starts.size(), 1u);
}

TEST_F(StarterTest, StartsAgainWhenItsRunHasDied) {
    starter.begin(0s);
    starter.tick(0s);
    starts[0]("");
    starter.died(10s);
    EXPECT_EQ(starter.state(), Starter::State::Waiting);
    EXPECT_EQ(log, std::vector<std::string>{"warning: its run died; it starts again"});
    starter.tick(11s - 1us);
    EXPECT_EQ(starts.size(), 1u);
    starter.tick(11s);
    ASSERT_EQ(starts.size(), 2u);
    starts[1]("");
    EXPECT_EQ(starter.state(), Starter::State::Started);
}

TEST_F(StarterTest, StandsWhenItsRunDiesForTheFifthTimeWithinAMinute) {
    starter.begin(0s);
    for (int death = 0; death < 5; ++death) {
        starter.tick(15s * death);
        starts.back()("");
        starter.died(15s * death + 14s);  // 14, 29, 44, 59, 74 s: 60 s from the first to the last
    }
    EXPECT_EQ(starter.state(), Starter::State::Idle);
    EXPECT_EQ(log.back(),
              "error: its run died 5 times within 60 s; it is stopped until somebody starts it");
    starter.tick(1000s);
    EXPECT_EQ(starts.size(), 5u);
}

TEST_F(StarterTest, GoesOnStartingWhenTheFifthDeathIsLater) {
    starter.begin(0s);
    for (int death = 0; death < 20; ++death) {
        starter.tick(16s * death);
        starts.back()("");
        starter.died(16s * death + 15s);  // four intervals of 16 s are more than a minute
    }
    EXPECT_EQ(starter.state(), Starter::State::Waiting);
}

TEST_F(StarterTest, APlanThatFailedIsNotStartedAgain) {
    starter.failed("too early");
    EXPECT_EQ(starter.state(), Starter::State::Idle);
    starter.begin(0s);
    starter.tick(0s);
    starts[0]("");
    starter.failed("go: it is broken");
    EXPECT_EQ(starter.state(), Starter::State::Failed);
    EXPECT_EQ(starter.why(), "its plan ended in an error: go: it is broken");
    EXPECT_EQ(starter.next_tick(), Time::max());
    starter.tick(100s);
    EXPECT_EQ(starts.size(), 1u);
    starter.begin(100s);  // somebody sends another version
    starter.tick(100s);
    EXPECT_EQ(starts.size(), 2u);
}

TEST_F(StarterTest, ARunThatSomebodyElseStartedIsNotStartedAgain) {
    starter.died(5s);
    starter.tick(100s);
    EXPECT_TRUE(starts.empty());
}

}  // namespace
}  // namespace vagus::serve
