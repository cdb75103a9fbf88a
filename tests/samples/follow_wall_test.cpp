// The paper's plan of following a wall, examples/follow-wall, judged by what the robot did.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "base/test_places.hpp"
#include "trial.hpp"

namespace vagus::samples {
namespace {

using namespace std::chrono_literals;
using Seconds = std::chrono::duration<double>;

const std::string kPlan = test::examples("follow-wall/WallFollow.plan.json");
const std::string kHall = test::examples("follow-wall/hall.world.json");
constexpr double kWallDistance = 0.3;  // m: `walldist` of the plan
constexpr double kOffMax = 0.1;        // m, on average
constexpr double kFollowMetres = 10;
constexpr auto kContactMax = 2s;
constexpr Duration kAtMost = 300s;
constexpr double kStartClear = 0.45;  // m around the hull

constexpr double kSpotMetres = 0.5;
constexpr double kSpotSecondsMax = 60;  // on one spot; a corner takes up to 25 s

// How long the robot stays on one spot at most.
class Staying {
public:
    void look(const Moment& now) {
        const bool away = std::abs(now.pose.at.x - spot_.x) >= kSpotMetres ||
                          std::abs(now.pose.at.y - spot_.y) >= kSpotMetres;
        if (away || !begun_) {
            begun_ = true;
            spot_ = now.pose.at;
            since_ = now.at;
        }
        longest_ = std::max(longest_, now.at - since_);
    }
    double longest_seconds() const { return Seconds(longest_).count(); }

private:
    bool begun_ = false;
    sim::Point spot_;
    Time since_{};
    Duration longest_{};
};

// From the first moment of WallForward on, whatever the plan does then.
class Following {
public:
    // False when the robot has followed far enough.
    bool look(const Moment& now) {
        begun_ = begun_ || now.actor == "followWall";
        if (!begun_) return true;
        if (now.actor == "followWall" && moments_ > 0) {
            metres_ += std::hypot(now.pose.at.x - last_.x, now.pose.at.y - last_.y);
        }
        last_ = now.pose.at;
        off_ += std::abs(now.gap - kWallDistance);
        ++moments_;
        return metres_ < kFollowMetres;
    }

    double metres() const { return metres_; }
    double off() const { return moments_ > 0 ? off_ / static_cast<double>(moments_) : 0; }

private:
    bool begun_ = false;
    sim::Point last_;
    double metres_ = 0;  // driven in WallForward
    double off_ = 0;     // sum over all moments
    size_t moments_ = 0;
};

struct Judged {
    bool well = false;
    double off = 0;
    std::string what;  // for people
};

Judged judge(const std::string& world, uint64_t seed) {
    SplitMix64 random(seed);
    const auto at = free_pose(world, kStartClear, random);
    if (!at.ok()) return {.what = at.error().what};
    Following following;
    const auto ran = run_sample(
        {.plan = kPlan, .world = world, .seed = seed, .at = at.value(), .at_most = kAtMost},
        [&following](const Moment& now) { return following.look(now); });
    if (!ran.ok()) return {.what = ran.error().what};
    Duration longest{};
    for (const Contact& contact : ran.value().contacts) longest = std::max(longest, contact.length);
    Judged judged;
    judged.off = following.off();
    judged.well =
        following.metres() >= kFollowMetres && judged.off <= kOffMax && longest <= kContactMax;
    char text[200];
    std::snprintf(text, sizeof text,
                  "seed %llu: %.1f m followed, %.1f cm off on average, longest contact %.1f s %s",
                  static_cast<unsigned long long>(seed), following.metres(), 100 * judged.off,
                  Seconds(longest).count(), ran.value().ended.message.c_str());
    judged.what = text;
    return judged;
}

struct Room {
    std::string name;  // worlds/NAME.world.json
    uint64_t starts;
    uint64_t least;  // so many must be well
};

void PrintTo(const Room& room, std::ostream* out) {
    *out << room.name;
}

class FollowWall : public testing::TestWithParam<Room> {};

// From any free place, looking anywhere; start and noise are those of the seed.
TEST_P(FollowWall, FromRandomStarts) {
    const Room& room = GetParam();
    const std::string world = test::sample_worlds(room.name + ".world.json");
    uint64_t well = 0;
    double off = 0;
    for (uint64_t seed = 1; seed <= room.starts; ++seed) {
        const Judged judged = judge(world, seed);
        well += judged.well ? 1 : 0;
        off += judged.off / static_cast<double>(room.starts);
        if (!judged.well) std::printf("%s\n", judged.what.c_str());
    }
    std::printf(
        "figure: a wall followed for 10 m in the %s room from %llu of %llu starts (seeds 1 to "
        "%llu), %.1f cm off the distance on average\n",
        room.name.c_str(), static_cast<unsigned long long>(well),
        static_cast<unsigned long long>(room.starts), static_cast<unsigned long long>(room.starts),
        100 * off);
    EXPECT_GE(well, room.least);
}

INSTANTIATE_TEST_SUITE_P(Rooms, FollowWall,
                         testing::Values(Room{"rectangular", 100, 99}, Room{"corners", 100, 99},
                                         Room{"slanted", 100, 99}, Room{"unknown", 20, 19},
                                         Room{"niches", 20, 20}, Room{"dead_ends", 20, 20}),
                         [](const auto& of) { return of.param.name; });

// From the depth of a niche, where the world file puts the robot, looking anywhere.
class FollowWallOutOfANiche : public testing::TestWithParam<const char*> {};

TEST_P(FollowWallOutOfANiche, ItNoticesThatItMakesNoWay) {
    const std::string world = test_world(std::string(GetParam()) + ".world.json");
    Worst stays("longest on one spot, s"), contact("longest contact of the hull, s");
    try_seeds({.plan = kPlan,
               .world = world,
               .off_metres = 0.05,
               .off_radians = 3.14,
               .at_most = kAtMost},
              [&](const Trial& trial) {
                  Following following;
                  Staying staying;
                  for (const Moment& moment : trial.ran.way) {
                      (void)following.look(moment);
                      staying.look(moment);
                  }
                  EXPECT_GE(following.metres(), kFollowMetres);
                  EXPECT_LE(stays.note(staying.longest_seconds()), kSpotSecondsMax);
                  EXPECT_LE(contact.note(seconds(trial.longest_contact())), 2);
              });
}

INSTANTIATE_TEST_SUITE_P(Rooms, FollowWallOutOfANiche, testing::Values("niches", "dead_ends"),
                         [](const auto& of) { return std::string(of.param); });

// The hall of the example, as a user sees it, with other noise for each seed. After 52 s a box
// stands before the robot: it goes around it. From 80 s to 92 s a plank lies there that its sensor
// cannot see: it bumps, and backs off. After 120 s the button is pressed.
TEST(FollowWallInTheHall, WhatIsPutInItsWayIsPassedAndTheButtonEndsIt) {
    constexpr Time kPlankGone = 92s;
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        Following following;
        double after = 0;
        sim::Point last;
        const auto look = [&](const Moment& now) {
            (void)following.look(now);
            if (now.at > kPlankGone) {
                after += std::hypot(now.pose.at.x - last.x, now.pose.at.y - last.y);
            }
            last = now.pose.at;
            return true;
        };
        const auto tried =
            run_sample({.plan = kPlan, .world = kHall, .seed = seed, .at_most = kAtMost}, look);
        ASSERT_TRUE(tried.ok()) << tried.error().what;
        const Ran& ran = tried.value();
        EXPECT_EQ(ran.ended.result, plan::PlanResult::Interrupted);
        EXPECT_FALSE(ran.ended.timed_out);
        EXPECT_THAT(ran.states, testing::Contains("followWall! TouchSensorPressed"));
        EXPECT_THAT(ran.states.back(), testing::EndsWith("! EscapeButtonPressed"));
        EXPECT_GE(ran.way.back().at, Time(120s));
        EXPECT_LE(ran.way.back().at, Time(120s) + 500ms);  // the wheels come to rest
        EXPECT_LE(following.off(), kOffMax);
        EXPECT_GE(after, 3);
        for (const Contact& contact : ran.contacts) EXPECT_LE(contact.length, kContactMax);
    }
}

TEST(FollowWallInTheHall, TheSameRunTwiceGivesTheSameBytes) {
    const Start start{.plan = kPlan, .world = kHall, .seed = 3, .at_most = kAtMost, .traced = true};
    const auto one = run_sample(start);
    const auto other = run_sample(start);
    ASSERT_TRUE(one.ok() && other.ok());
    EXPECT_GT(one.value().trace.size(), 100'000u);
    EXPECT_TRUE(one.value().trace == other.value().trace);
}

}  // namespace
}  // namespace vagus::samples
