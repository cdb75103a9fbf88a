#include "fleet/modelled_broker.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "fleet/member.hpp"

namespace vagus::fleet {
namespace {

// Members of one fleet on a modelled broker, and what they heard.
class Class {
public:
    explicit Class(WayModel model, uint64_t seed = 1) : broker_(model, seed) {}

    size_t add(const std::string& name, const std::vector<std::string>& groups = {}) {
        MemberOptions options{
            .fleet = "class",
            .robot = name,
            .instance = name,
            .epoch = 1,
            .project = {.groups = groups, .send = {"alarm"}, .hear = {{"alarm", ""}}},
            .description = {}};
        robots_.push_back(std::make_unique<Robot>(Robot{Member(options, now_)}));
        robots_.back()->way = &broker_.add("class", robots_.back()->member.will());
        broker_.connect(*robots_.back()->way);
        return robots_.size() - 1;
    }
    // "r1" and "r2", and what is said as they join has passed.
    void add_two() {
        add("r1");
        add("r2");
        pass(100ms);
    }
    void pass(Duration span) {
        for (const Time end = now_ + span; now_ < end;) {
            now_ += 1ms;
            broker_.pass(now_);
            for (const auto& robot : robots_) turn(*robot);
        }
    }
    void emit(size_t robot, int16_t number) {
        robots_[robot]->member.emitted("alarm", {number}, now_);
    }
    void cut(size_t robot) { broker_.cut(*robots_[robot]->way); }
    void restore(size_t robot) { broker_.restore(*robots_[robot]->way); }
    // "r1:5 at 20 ms" for each event that the robot heard.
    const std::vector<std::string>& heard(size_t robot) const { return robots_[robot]->heard; }
    bool stopped(size_t robot) const { return robots_[robot]->stopped; }
    Member::Standing standing(size_t robot) const { return robots_[robot]->member.standing(); }
    uint64_t lost() const { return broker_.lost(); }

private:
    struct Robot {
        Member member;
        ModelledBroker::Way* way = nullptr;
        std::vector<std::string> heard = {};
        bool stopped = false;
    };

    void turn(Robot& robot) {
        for (const LinkEvent& event : robot.way->take()) robot.member.hear(event, now_);
        robot.member.tick(now_);
        for (const MemberAction& action : robot.member.take()) {
            if (const auto* one = std::get_if<Subscribe>(&action))
                robot.way->subscribe(one->filters);
            if (const auto* post = std::get_if<Post>(&action)) robot.way->publish(*post);
            if (std::holds_alternative<StopAlone>(action)) robot.stopped = true;
            if (const auto* event = std::get_if<EmitOnBus>(&action)) {
                robot.heard.push_back(event->from + ":" + std::to_string(event->args.at(0)) +
                                      " at " + std::to_string(now_ / 1ms) + " ms");
            }
        }
    }

    Time now_{};
    ModelledBroker broker_;
    std::vector<std::unique_ptr<Robot>> robots_;
};

using Texts = std::vector<std::string>;

constexpr Duration kSession = std::chrono::seconds(kSessionSeconds);

// A question and its echo are 10 ms, the subscription to events 5 ms more: by 100 ms all are there.
TEST(ModelledBroker, AnEventTakesTheLatencyOfBothWays) {
    Class all({.latency = 5ms});
    all.add("r1");
    all.add("r2");
    all.add("r3");
    all.pass(100ms);
    all.emit(0, 7);
    all.pass(100ms);
    EXPECT_EQ(all.heard(0), Texts{});
    // Said at 100 ms, it leaves with the next turn at the latest: 10 ms on its way.
    EXPECT_EQ(all.heard(1), Texts{"r1:7 at 111 ms"});
    EXPECT_EQ(all.heard(2), Texts{"r1:7 at 111 ms"});
}

TEST(ModelledBroker, WhatIsLostComesLaterInItsOrderAndWhatComesTwiceIsHeardOnce) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Class all({.latency = 5ms, .jitter = 20ms, .loss = 0.3, .twice = 0.3}, seed);
        all.add("r1");
        all.add("r2");
        all.pass(5s);
        for (int16_t number = 0; number < 10; ++number) {
            all.emit(0, number);
            all.pass(100ms);
        }
        all.pass(10s);
        ASSERT_EQ(all.heard(1).size(), 10u);
        for (size_t i = 0; i < 10; ++i) {
            const std::string front = "r1:" + std::to_string(i) + " ";
            EXPECT_TRUE(all.heard(1)[i].starts_with(front)) << all.heard(1)[i];
        }
    }
}

TEST(ModelledBroker, AShortCutDelaysAndLosesNothing) {
    Class all({.latency = 5ms});
    all.add_two();
    all.cut(1);
    all.emit(0, 1);
    all.pass(kMissedAfter - 1ms);
    EXPECT_EQ(all.heard(1), Texts{});
    EXPECT_EQ(all.standing(1), Member::Standing::Holding);
    all.restore(1);
    all.pass(20ms);
    EXPECT_EQ(all.heard(1).size(), 1u);
}

TEST(ModelledBroker, ALongCutEndsTheConnectionAndTheRobotStopsAlone) {
    Class all({.latency = 5ms});
    all.add_two();
    all.cut(1);
    all.pass(kMissedAfter);
    EXPECT_EQ(all.standing(1), Member::Standing::Apart);
    EXPECT_FALSE(all.stopped(1));
    all.emit(0, 1);  // while it is away, for longer than the broker keeps it
    all.pass(kSession);
    EXPECT_TRUE(all.stopped(1));
    EXPECT_FALSE(all.stopped(0));
    all.restore(1);
    all.pass(1s);
    EXPECT_EQ(all.standing(1), Member::Standing::Holding);
    all.emit(0, 2);
    all.pass(100ms);
    ASSERT_EQ(all.heard(1).size(), 1u);
    EXPECT_TRUE(all.heard(1)[0].starts_with("r1:2 ")) << all.heard(1)[0];
}

// The first is on its way when the way is cut: it is never acknowledged. The second comes when the
// broker has missed the robot. Both wait there for ten seconds, and no longer.
TEST(ModelledBroker, WhatComesForARobotThatIsAwayWaitsTenSeconds) {
    Class all({.latency = 5ms});
    all.add_two();
    all.emit(0, 1);
    all.cut(1);
    all.pass(kMissedAfter);
    EXPECT_EQ(all.standing(1), Member::Standing::Apart);
    all.emit(0, 2);
    all.pass(2s);
    all.restore(1);
    all.pass(1s);
    ASSERT_EQ(all.heard(1).size(), 2u);
    EXPECT_TRUE(all.heard(1)[0].starts_with("r1:1 ")) << all.heard(1)[0];
    EXPECT_TRUE(all.heard(1)[1].starts_with("r1:2 ")) << all.heard(1)[1];
}

// It is 11 s old when the robot is back; the connection was lost only 3.5 s before.
TEST(ModelledBroker, AnEventThatIsTooOldIsNotPassedOn) {
    Class all({.latency = 5ms});
    all.add_two();
    all.emit(0, 1);
    all.cut(1);
    all.pass(11s);
    all.restore(1);
    all.pass(1s);
    EXPECT_EQ(all.standing(1), Member::Standing::Holding);
    EXPECT_EQ(all.heard(1), Texts{});
}

// What the robot itself said while it was apart is said when it is back (Outbox).
TEST(ModelledBroker, WhatARobotSaidApartComesWhenItIsBack) {
    Class all({.latency = 5ms});
    all.add_two();
    all.cut(0);
    all.pass(kMissedAfter);
    all.emit(0, 3);
    all.pass(1s);
    all.restore(0);
    all.pass(1s);
    ASSERT_EQ(all.heard(1).size(), 1u);
    EXPECT_TRUE(all.heard(1)[0].starts_with("r1:3 ")) << all.heard(1)[0];
}

TEST(ModelledBroker, ASeedGivesTheSameRun) {
    const auto run = [](uint64_t seed) {
        Class all({.latency = 5ms, .jitter = 50ms, .loss = 0.2, .twice = 0.2}, seed);
        for (int i = 0; i < 5; ++i) all.add("r" + std::to_string(i));
        all.pass(5s);
        for (int16_t number = 0; number < 5; ++number) {
            all.emit(static_cast<size_t>(number), number);
            all.pass(70ms);
        }
        all.pass(5s);
        Texts texts;
        for (size_t i = 0; i < 5; ++i) {
            texts.insert(texts.end(), all.heard(i).begin(), all.heard(i).end());
        }
        return texts;
    };
    EXPECT_EQ(run(1), run(1));
    EXPECT_NE(run(1), run(2));
    EXPECT_EQ(run(1).size(), 20u);
}

}  // namespace
}  // namespace vagus::fleet
