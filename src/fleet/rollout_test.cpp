#include "fleet/rollout.hpp"

#include <gtest/gtest.h>

#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

using Steps = std::vector<size_t>;
using Texts = std::vector<std::string>;

TEST(Steps, AreNumbersOrPercentAndEndWithAll) {
    EXPECT_EQ(read_steps("1,10%,100%", 30).value(), (Steps{1, 3, 30}));
    EXPECT_EQ(read_steps("1,10%,100%", 1).value(), (Steps{1}));
    EXPECT_EQ(read_steps("5", 7).value(), (Steps{5, 7}));
    EXPECT_EQ(read_steps("10%", 11).value(), (Steps{2, 11}));
    for (const char* const text : {"", "0", "101%", "x", "1,,2", "-1", "1 %"}) {
        EXPECT_FALSE(read_steps(text, 7).ok()) << text;
    }
}

class RolloutCase {
public:
    RolloutCase() : RolloutCase(Rollout({"lab", kWant, {"r1", "r2", "r3"}, {1, 3}, 60s})) {}
    explicit RolloutCase(Rollout made) : rollout(std::move(made)) { pass(0s); }

    static inline const Want kWant{7, "ab", "https://desk/x", false};

    Texts wanted() {
        Texts robots;
        for (const Post& post : rollout.take()) {
            const auto heard = read("lab", post.topic, post.payload);
            EXPECT_TRUE(heard.ok() && post.retained);
            robots.push_back(heard.value().topic.robot);
        }
        return robots;
    }
    void pass(Duration time) { rollout.tick(now += time); }
    void tells(const std::string& robot, const std::string& result, int64_t number = 7) {
        const Topic topic{.kind = Kind::Version, .robot = robot};
        rollout.hear(Received{{topic, Version{number, "ab", result, "why"}}, false}, now);
        pass(0s);
    }
    void lacks(const std::string& robot, const std::string& healthy, const std::string& why = "") {
        const Topic topic{.kind = Kind::Version, .robot = robot};
        rollout.hear(Received{{topic, Version{7, "ab", "started", why, healthy}}, false}, now);
        pass(0s);
    }
    void is(const std::string& robot, const std::string& state) {
        const Topic topic{.kind = Kind::State, .robot = robot};
        rollout.hear(Received{{topic, State{.state = state, .problems = {"stuck"}}}, false}, now);
        pass(0s);
    }
    std::string line(size_t robot) { return text_of(rollout.table()[robot]); }

    Rollout rollout;
    Time now{};
};

TEST(Rollout, TheNextStepFollowsWhenTheFirstIsWell) {
    RolloutCase c;
    EXPECT_EQ(c.wanted(), Texts{"r1"});
    c.tells("r1", "taken");
    c.tells("r1", "started");
    c.pass(kHealthyFor - 1us);
    EXPECT_EQ(c.wanted(), Texts{});
    c.pass(1us);
    EXPECT_EQ(c.wanted(), (Texts{"r2", "r3"}));
    c.tells("r2", "started");
    c.tells("r3", "started");
    EXPECT_FALSE(c.rollout.is_over());
    c.pass(kHealthyFor);
    EXPECT_TRUE(c.rollout.is_over());
    EXPECT_TRUE(c.rollout.all_are_well());
}

TEST(Rollout, TheFirstThatIsNotWellStopsIt) {
    for (const auto& [result, said] :
         {std::pair("refused", "refused"), std::pair("rolled_back", "rolled back"),
          std::pair("waiting", "waiting"), std::pair("stopped", "stopped")}) {
        RolloutCase c;
        c.tells("r1", result);
        EXPECT_TRUE(c.rollout.is_over());
        EXPECT_EQ(c.line(0), "failed: " + std::string(said) + ": why");
        EXPECT_EQ(c.line(1), "as it was");
        EXPECT_EQ(c.wanted(), Texts{"r1"});
    }
}

TEST(Rollout, AFaultWithinThreeSecondsIsNotWell) {
    RolloutCase c;
    c.tells("r1", "started");
    c.is("r1", "running");
    c.is("r1", "fault");
    c.pass(kHealthyFor);
    EXPECT_TRUE(c.rollout.is_over());
    EXPECT_EQ(c.line(0), "failed: a fault: stuck");
}

TEST(Rollout, WhoDoesNotAnswerStopsItToo) {
    RolloutCase c;
    c.pass(60s - 1us);
    EXPECT_FALSE(c.rollout.is_over());
    c.pass(1us);
    EXPECT_TRUE(c.rollout.is_over());
    EXPECT_EQ(c.line(0), "failed: did not answer; it finds it when it is back");
}

TEST(Rollout, WhoIsBackLaterIsWellAndTheRolloutStaysOver) {
    RolloutCase c;
    c.pass(60s);
    EXPECT_TRUE(c.rollout.is_over());
    EXPECT_EQ(c.wanted(), Texts{"r1"});
    c.rollout.hear(Connected{}, c.now);
    EXPECT_EQ(c.wanted(), Texts{"r1"}) << "the link was lost: it may not have arrived";
    c.tells("r1", "started");
    EXPECT_TRUE(c.rollout.table()[0].has);
    c.pass(kHealthyFor);
    EXPECT_EQ(c.line(0), "well");
    EXPECT_TRUE(c.rollout.is_over());
    EXPECT_EQ(c.wanted(), Texts{}) << "nobody else gets it";
}

TEST(Rollout, OneThatIsStoppedGoesToNobodyElse) {
    RolloutCase c;
    EXPECT_EQ(c.wanted(), Texts{"r1"});
    c.rollout.stop();
    c.tells("r1", "started");
    c.pass(kHealthyFor);
    EXPECT_EQ(c.line(0), "well");
    EXPECT_TRUE(c.rollout.is_over());
    EXPECT_EQ(c.wanted(), Texts{});
}

TEST(Rollout, WhoRefusedItDoesNotHaveIt) {
    for (const auto& [result, has] : {std::pair("refused", false), std::pair("rolled_back", false),
                                      std::pair("waiting", true), std::pair("stopped", true)}) {
        RolloutCase c;
        c.tells("r1", result);
        EXPECT_EQ(c.rollout.table()[0].has, has) << result;
    }
}

TEST(Rollout, ARobotWhoseConditionIsNotTrueYetIsWaitedFor) {
    RolloutCase c;
    c.pass(20s);
    c.lacks("r1", "not_yet", "battery = 12");
    EXPECT_EQ(c.line(0), "started: battery = 12");
    c.pass(60s - 1us);  // of its start
    EXPECT_EQ(c.wanted(), Texts{"r1"});
    c.lacks("r1", "well");
    EXPECT_EQ(c.line(0), "well");
    EXPECT_EQ(c.wanted(), (Texts{"r2", "r3"}));
}

TEST(Rollout, AConditionThatIsTrueAtOnceDoesNotShortenTheThreeSeconds) {
    RolloutCase c;
    c.lacks("r1", "not_yet", "not looked at");
    c.lacks("r1", "well");
    c.pass(kHealthyFor - 1us);
    EXPECT_EQ(c.line(0), "started");
    c.pass(1us);
    EXPECT_EQ(c.line(0), "well");
}

TEST(Rollout, ARobotWhoseConditionIsNotTrueInTimeStopsIt) {
    RolloutCase c;
    c.lacks("r1", "not_yet", "battery = 12");
    c.lacks("r1", "not_yet", "battery = 13");
    EXPECT_EQ(c.rollout.next_tick(), 60s);
    c.pass(60s - 1us);
    EXPECT_FALSE(c.rollout.is_over());
    c.pass(1us);
    EXPECT_TRUE(c.rollout.is_over());
    EXPECT_EQ(c.line(0), "failed: not well within 60 s of its start: battery = 13");
    c.lacks("r1", "well");
    EXPECT_EQ(c.rollout.table()[0].place, Rollout::Place::Failed) << "too late";
}

TEST(Rollout, AFaultCountsWhateverTheConditionSays) {
    RolloutCase c;
    c.lacks("r1", "not_yet", "battery = 12");
    c.is("r1", "fault");
    EXPECT_EQ(c.line(0), "failed: a fault: stuck");
}

// A studio was killed: nobody knows when its robots started, and nobody gets it any more.
TEST(Rollout, OfOneThatWasLeftItIsHeardWhatBecomesOfItsRobots) {
    using Place = Rollout::Place;
    const std::vector<Rollout::Line> left = {{"r1", Place::Started, "battery = 12", true},
                                             {"r2", Place::Wanted, "", false},
                                             {"r3", Place::Well, "", true}};
    RolloutCase c(Rollout(7, left));
    EXPECT_EQ(c.rollout.table(), left);
    c.rollout.hear(Connected{}, c.now);
    c.pass(1000s);
    EXPECT_EQ(c.wanted(), Texts{});
    EXPECT_EQ(c.rollout.table(), left);
    c.lacks("r1", "not_yet", "battery = 15");
    c.pass(1000s);
    EXPECT_EQ(c.line(0), "started: battery = 15");
    c.lacks("r1", "well", "battery = 21");
    c.tells("r2", "started");
    c.pass(kHealthyFor);
    EXPECT_EQ(c.line(0), "well");
    EXPECT_EQ(c.line(1), "well");
    EXPECT_TRUE(c.rollout.table()[1].has);
    c.is("r3", "fault");
    EXPECT_EQ(c.line(2), "failed: a fault: stuck");
}

// Two people who roll out at once.
TEST(Rollout, WhoWasGivenAnotherVersionSinceDoesNotHaveThisOne) {
    RolloutCase c;
    c.tells("r1", "started");
    c.pass(kHealthyFor);
    c.tells("r1", "refused", 9);  // what it has goes on
    EXPECT_EQ(c.line(0), "well");
    c.tells("r1", "started", 9);
    EXPECT_EQ(c.line(0), "failed: somebody has given it another version since");
    EXPECT_FALSE(c.rollout.table()[0].has);
    EXPECT_FALSE(c.rollout.all_are_well());
}

TEST(Rollout, WhatCameOfAnotherOneSaysNothing) {
    RolloutCase c;
    c.tells("r1", "started", 6);
    c.pass(kHealthyFor);
    EXPECT_EQ(c.line(0), "wanted");
}

}  // namespace
}  // namespace vagus::fleet
