#include "serve/workbench/log_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "serve/workbench/test_other_end.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

// The other end is a script: what vagus answers is tested in log_host_test.cpp.
class LogDeskTest : public OtherEndTest {
protected:
    LogDeskTest() {
        write("two.aesl", kTwoNodes);
        enter();
        scripts.reread();
    }
    LogDesk& desk_with(const std::string& script, bool has_run = true) {
        logs.emplace(desk, scripts, other_end(script), shown_run(has_run));
        return *logs;
    }
    void hear(int number, const std::string& doc = "two.aesl#2") {
        tell("log.ask", {{"number", number}, {"doc", doc}, {"line", 3}, {"values", "y"}});
    }
    std::string refused() {
        return OtherEndTest::refused([this](Time at) { logs->tick(at); });
    }

    std::optional<LogDesk> logs;
};

TEST_F(LogDeskTest, AProcessThatDiesIsTold) {
    desk_with("exit 7");
    hear(1);
    EXPECT_THAT(refused(), HasSubstr("the run could not be run again: its process"));
}

TEST_F(LogDeskTest, ARunThatTakesTooLongIsNotWaitedFor) {
    LogDesk& one = desk_with("exec sleep 1000");
    hear(1);
    one.tick(now);
    EXPECT_EQ(answered(), nullptr);
    now += kLogWithin;
    EXPECT_THAT(refused(), HasSubstr("takes longer than 120 s"));
    EXPECT_EQ(one.next_tick(), Time::max());
}

TEST_F(LogDeskTest, AtMostTwoAreAskedAtOnceAndACancelledOneMakesRoom) {
    LogDesk& one = desk_with("exec sleep 1000");
    hear(1);
    hear(2);
    EXPECT_EQ(answered(), nullptr);
    hear(3);
    EXPECT_THAT(refused(), HasSubstr("2 questions are being answered; wait for them"));
    got.clear();
    tell("log.cancel", {{"number", 1}});
    std::vector<std::string> told;
    for (const Json& answer : got) told.push_back(answer.dump());
    EXPECT_THAT(told, testing::Contains(HasSubstr("the question was cancelled")));
    got.clear();
    hear(3);
    EXPECT_EQ(answered(), nullptr);
    EXPECT_NE(one.next_tick(), Time::max());
}

// Before its process is there.
TEST_F(LogDeskTest, WhatIsCancelledWhileTheRunWritesIsNeverAsked) {
    LogDesk& one = desk_with("exec sleep 1000");
    holds = true;
    hear(1);
    tell("log.cancel", {{"number", 1}});
    ASSERT_EQ(held.size(), 1u);
    held[0]();
    EXPECT_EQ(one.next_tick(), Time::max());
}

TEST_F(LogDeskTest, WhatIsNoPlaceOrHasNotRunIsRefused) {
    desk_with("exit 0");
    hear(1, "gone.aesl#1");
    EXPECT_THAT(refused(), HasSubstr("gone.aesl#1: there is no script"));
    got.clear();
    tell("log.ask", {{"number", 1}, {"doc", "P.plan.json"}, {"values", "y"}});
    EXPECT_THAT(refused(), HasSubstr("expected a line of a script"));
    got.clear();
    desk_with("exit 0", false);
    hear(1);
    EXPECT_THAT(refused(), HasSubstr("nothing has run yet"));
}

}  // namespace
}  // namespace vagus::serve
