// A Carbot's body: wheels, commands, odometry and touch, without its nodes' scripts.
#include <gtest/gtest.h>

#include <cmath>

#include "base/trig.hpp"
#include "sim/carbot/carbot.hpp"
#include "sim/carbot/chassis.hpp"
#include "sim/carbot/motion.hpp"
#include "sim/carbot/odometry.hpp"
#include "sim/carbot/touch_ring.hpp"

using namespace vagus;
using namespace vagus::sim;
using namespace vagus::sim::carbot;
using namespace std::chrono_literals;

namespace {

using trig::kDegree;

TEST(Steering, WheelsAtOppositeAnglesDriveACurveRoundTheMiddle) {
    // tan d = 0.13 / 0.13: both wheels at 45 degrees, the radius is their distance from the middle.
    // At 0.1 m/s the body turns by 0.1 / 0.13 rad/s, and the wheels roll 0.1 * sqrt(2).
    const WheelPair wheels = wheels_for(0.1, 0.1 / 0.13);
    EXPECT_NEAR(wheels.front.angle, 45 * kDegree, 1e-12);
    EXPECT_NEAR(wheels.rear.angle, -45 * kDegree, 1e-12);
    EXPECT_NEAR(wheels.front.speed, 0.141421356, 1e-9);
    EXPECT_NEAR(wheels.rear.speed, 0.141421356, 1e-9);
    const Twist twist = twist_of(wheels);
    EXPECT_NEAR(twist.ahead, 0.1, 1e-12);
    EXPECT_NEAR(twist.sideways, 0, 1e-12);
    EXPECT_NEAR(twist.turn, 0.769230769, 1e-9);
}

TEST(Steering, InPlaceBothStandAcrossAndRollAgainstEachOther) {
    const WheelPair wheels = wheels_for(0, -1);
    EXPECT_NEAR(wheels.front.angle, 90 * kDegree, 1e-12);
    EXPECT_NEAR(wheels.rear.angle, 90 * kDegree, 1e-12);
    EXPECT_NEAR(wheels.front.speed, -0.13, 1e-12);
    EXPECT_NEAR(wheels.rear.speed, 0.13, 1e-12);
}

TEST(Steering, BackwardsTheWheelsRollBackwardsInsteadOfLookingBack) {
    const WheelPair wheels = wheels_for(-0.1, 0);
    EXPECT_NEAR(wheels.front.angle, 0, 1e-12);
    EXPECT_NEAR(wheels.front.speed, -0.1, 1e-12);
}

TEST(Steering, WheelsThatDisagreeMoveTheBodyByTheMiddle) {
    // Front straight at 0.2, rear straight at 0.1: ahead by the mean, no turn.
    const Twist straight = twist_of({{0, 0.2}, {0, 0.1}});
    EXPECT_NEAR(straight.ahead, 0.15, 1e-12);
    EXPECT_NEAR(straight.turn, 0, 1e-12);
    // Both across, the same way: sideways.
    const Twist crab = twist_of({{90 * kDegree, 0.1}, {90 * kDegree, 0.1}});
    EXPECT_NEAR(crab.sideways, 0.1, 1e-12);
    EXPECT_NEAR(crab.turn, 0, 1e-12);
}

// A motion on wheels without slip: where it ends by its own count.
struct Ended {
    Pose pose;
    int steps = 0;
    double wheel_max = 0;  // the fastest that a wheel was, m/s
};
Ended ended(Motion& motion, Ending what, int steps_max = 10000) {
    Chassis chassis(1);
    Odometry odometry;
    Ended end;
    while (end.steps < steps_max && !motion.take(what)) {
        chassis.step(motion.step(chassis.counted()));
        odometry.add(twist_of(chassis.counted()), kArenaStep);
        end.wheel_max = std::max(end.wheel_max, std::fabs(chassis.counted().front.speed));
        ++end.steps;
    }
    end.pose = odometry.pose();
    return end;
}

TEST(Motion, OneMetreEndsAfterOneMetre) {
    Motion motion;
    motion.move(1, 0.2);
    EXPECT_EQ(motion.kind(), MotionKind::Move);
    EXPECT_EQ(motion.left(), 1);
    const Ended end = ended(motion, Ending::Arrived);
    EXPECT_NEAR(end.pose.at.x, 1, 0.002);
    EXPECT_NEAR(end.pose.at.y, 0, 1e-9);
    EXPECT_EQ(motion.state(), MotionState::AtRest);
    EXPECT_LE(end.wheel_max, 0.2 + 1e-9);
    // 5 s at full speed, and less than a second more for speeding up, slowing down and standing.
    EXPECT_GT(end.steps, 500);
    EXPECT_LT(end.steps, 600);
}

TEST(Motion, BackwardsTurnsAndCurvesEndWhereTheyShall) {
    Motion back;
    back.move(-0.5, 0.31);
    EXPECT_NEAR(ended(back, Ending::Arrived).pose.at.x, -0.5, 0.002);
    Motion turn;
    turn.turn(-90 * kDegree, 60 * kDegree);
    const Ended turned = ended(turn, Ending::Turned);
    EXPECT_NEAR(turned.pose.angle, -90 * kDegree, 0.5 * kDegree);
    EXPECT_NEAR(trig::hypot(turned.pose.at.x, turned.pose.at.y), 0, 0.001);
    // A quarter of a circle of half a metre to the left ends half a metre ahead and to the left.
    Motion curve;
    curve.curve(0.5, 90 * kDegree, 0.2);
    const Ended arc = ended(curve, Ending::Arrived);
    EXPECT_NEAR(arc.pose.at.x, 0.5, 0.005);
    EXPECT_NEAR(arc.pose.at.y, 0.5, 0.005);
    EXPECT_NEAR(arc.pose.angle, 90 * kDegree, 0.5 * kDegree);
    // Backwards, the heading still changes to the left: the middle lies on the right.
    Motion reversed;
    reversed.curve(0.5, 90 * kDegree, -0.2);
    const Ended behind = ended(reversed, Ending::Arrived);
    EXPECT_NEAR(behind.pose.angle, 90 * kDegree, 0.5 * kDegree);
    EXPECT_NEAR(behind.pose.at.x, -0.5, 0.005);
    EXPECT_NEAR(behind.pose.at.y, -0.5, 0.005);
}

TEST(Motion, ACurveOfHardlyAnyRadiusIsATurn) {
    Motion motion;
    motion.curve(0.001, 180 * kDegree, 0.31);
    const Ended end = ended(motion, Ending::Arrived);
    EXPECT_NEAR(std::fabs(end.pose.angle), 180 * kDegree, 0.5 * kDegree);
    EXPECT_LE(end.wheel_max, kSpeedMax + 1e-9);
}

TEST(Motion, APauseKeepsWhatIsLeft) {
    Motion motion;
    Chassis chassis(1);
    motion.move(1, 0.3);
    for (int i = 0; i < 200; ++i) chassis.step(motion.step(chassis.counted()));
    motion.pause();
    int steps = 0;
    while (!motion.take(Ending::Halted) && steps < 100) {
        chassis.step(motion.step(chassis.counted()));
        ++steps;
    }
    // From 0.3 to 0.001 m/s with a time constant of 30 ms: 30 ms * ln 300 = 171 ms.
    EXPECT_NEAR(steps, 18, 2);
    EXPECT_EQ(motion.state(), MotionState::Paused);
    EXPECT_EQ(motion.kind(), MotionKind::Move);
    const double left = motion.left();
    EXPECT_GT(left, 0.4);
    motion.resume();
    const Ended rest = ended(motion, Ending::Arrived);
    EXPECT_NEAR(rest.pose.at.x, left, 0.002);
}

TEST(Motion, ABrakeForgetsTheCommandAndAnswersAtOnceWhenNothingRolls) {
    Motion motion;
    motion.brake();
    Chassis chassis(1);
    chassis.step(motion.step(chassis.counted()));
    EXPECT_TRUE(motion.take(Ending::Halted));
    EXPECT_FALSE(motion.take(Ending::Halted));
    motion.resume();
    EXPECT_EQ(motion.state(), MotionState::AtRest);
}

TEST(Motion, SteeringGoesOnUntilAnotherCommand) {
    Motion motion;
    Chassis chassis(1);
    motion.steer(0.2, 20 * kDegree);
    for (int i = 0; i < 500; ++i) chassis.step(motion.step(chassis.counted()));
    Twist twist = twist_of(chassis.counted());
    EXPECT_NEAR(twist.ahead, 0.2, 1e-3);
    EXPECT_NEAR(twist.turn, 20 * kDegree, 1e-3);
    motion.steer(-0.1, 0);
    for (int i = 0; i < 500; ++i) chassis.step(motion.step(chassis.counted()));
    twist = twist_of(chassis.counted());
    EXPECT_NEAR(twist.ahead, -0.1, 1e-3);
    EXPECT_NEAR(twist.turn, 0, 1e-3);
    motion.steer(0, 0);
    for (int i = 0; i < 100; ++i) chassis.step(motion.step(chassis.counted()));
    EXPECT_NEAR(twist_of(chassis.counted()).ahead, 0, 1e-3);
}

TEST(TouchRing, ASectorLooksThirtyDegreesAndTheFirstIsAhead) {
    EXPECT_EQ(sector_of({0.2, 0}), 0u);
    EXPECT_EQ(sector_of({0.2, 0.05}), 0u);    // 14 degrees
    EXPECT_EQ(sector_of({0.2, 0.06}), 1u);    // 17 degrees
    EXPECT_EQ(sector_of({0, 0.175}), 3u);     // 90
    EXPECT_EQ(sector_of({-0.2, 0}), 6u);      // 180
    EXPECT_EQ(sector_of({-0.2, -0.01}), 6u);  // -177
    EXPECT_EQ(sector_of({0, -0.175}), 9u);    // -90
    EXPECT_EQ(sector_of({0.2, -0.06}), 11u);  // -17
}

TEST(TouchRing, AnEdgePressesAllSectorsOfItAndTheyHoldFiftyMilliseconds) {
    TouchRing ring;
    // The whole front: 36 degrees to both sides, sectors 11, 0 and 1.
    const std::vector<TouchedPart> front = {{{0.2, -0.145}, {0.2, 0.145}}};
    ring.feel(front, 1ms);
    EXPECT_TRUE(ring.pressed(11));
    EXPECT_TRUE(ring.pressed(0));
    EXPECT_TRUE(ring.pressed(1));
    EXPECT_EQ(ring.count(), 3u);
    ring.feel({}, 50ms);
    EXPECT_EQ(ring.count(), 3u);
    ring.feel({}, 51ms);
    EXPECT_EQ(ring.count(), 0u);
}

}  // namespace
