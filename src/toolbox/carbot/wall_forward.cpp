// WallForward: along a wall, at a distance. While it drives the sensor looks to and fro between the
// wall and the lane ahead. What it has seen makes a map; of all curves that it could drive now it
// takes the one along which the distance to the map's nearest spot stays best.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/trig.hpp"
#include "toolbox/carbot/inputs.hpp"
#include "toolbox/carbot/rover.hpp"
#include "toolbox/carbot/templates.hpp"
#include "toolbox/carbot/wall_steering.hpp"
#include "toolbox/carbot/walls.hpp"

namespace vagus::toolbox::carbot {

namespace {

using plan::Type;
using plan::Value;

// Directions in which it looks, to and fro: the wall beside, and what comes ahead.
constexpr double kLookRightDeg = -105;
constexpr double kLookStepDeg = 15;
constexpr int kLooks = 10;

// Where nothing is seen at first, the wall may just have ended: there, from the robot's middle.
constexpr double kEndBehindCm = 12;
constexpr double kRememberedTurns = 0.65;  // of a circle around an end, before the wall is lost

constexpr double kDistanceMaxCm = kMapReachCm - kHalfWidthCm - 10;
constexpr double kLaneMarginCm = 3;  // beside the hull
constexpr double kMovedCm = 1;
constexpr double kTurnedDeg = 2;
constexpr Duration kPatience = std::chrono::seconds(3);  // while it does not move

enum State { kForwardSuccessful, kLaneNotFree, kWallLost };

struct Length {
    std::string name;
    std::string help;
    double fallback;
    double high;
};

plan::Input length_input(const Length& length) {
    return {.name = length.name,
            .type = Type::Float,
            .fallback = Value(length.fallback),
            .unit = "cm",
            .help = length.help,
            .low = 0,
            .high = length.high};
}

const plan::Template& declared() {
    static const plan::Template kDeclared{
        .name = "WallForward",
        .help = "Drives along a wall, around its corners too.",
        .icon = "M5 3v18M14 20V6M10 10l4-4l4 4",
        .inputs = {length_input({.name = "distance",
                                 .help = "to keep between the wall and the side of the hull",
                                 .fallback = 30,
                                 .high = kDistanceMaxCm}),
                   length_input({.name = "ahead",
                                 .help = "how much must be free ahead of the hull",
                                 .fallback = 30,
                                 .high = 100}),
                   {.name = "gain",
                    .type = Type::Float,
                    .fallback = Value(1.0),
                    .help = "how sharply it steers to keep the distance",
                    .low = 0.01,
                    .high = 20},
                   speed_input(),
                   length_input({.name = "length",
                                 .help = "how far to drive",
                                 .fallback = 100,
                                 .high = 1e6}),
                   side_input("right or left")},
        .outcomes = {{"ForwardSuccessful", "it has driven so far"},
                     {"LaneNotFree", "something is ahead"},
                     {"WallLost", "the wall has ended"}},
        .bus = Rover::bus_of(Rover::Needs::DriveAndRange)};
    return kDeclared;
}

double mirror_for(const std::string& side) {
    if (side == "right") return 1;
    if (side == "left") return -1;
    throw run::CodeError("the input \"side\" is \"" + side + "\", but must be right or left");
}

class WallForward final : public run::Actor {
public:
    explicit WallForward(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        distance_ = input_of(context, declared(), 0);
        ahead_ = input_of(context, declared(), 1);
        gain_ = input_of(context, declared(), 2);
        speed_ = input_of(context, declared(), 3);
        left_ = input_of(context, declared(), 4);
        mirror_ = mirror_for(context.in(5).string());
        Rover rover(context, parts_, Rover::Needs::DriveAndRange);
        stopping(rover, [&] {
            const State state = follow(context, rover);
            rover.halt();
            context.end(state);
        });
    }

private:
    State follow(run::ActorContext& context, Rover& rover) {
        const double around = distance_ + kHalfWidthCm;
        const AlongWall goal{.distance_cm = distance_, .speed_cm = speed_, .gain = gain_};
        WallMap map(kRememberedTurns * 2 * trig::kPi * around);
        Pose here = pose(rover);
        moved_to(here, context.now());
        for (bool to_left = true, first = true;; to_left = !to_left, first = false) {
            std::vector<Sounding> sweep;
            for (int i = 0; i < kLooks; ++i) {
                const Echo echo = look(rover, to_left ? i : kLooks - 1 - i);
                const Pose before = std::exchange(here, pose(rover));
                sweep.push_back({here, echo});
                left_ -= trig::hypot(here.x_cm - before.x_cm, here.y_cm - before.y_cm);
                if (left_ <= 0) return kForwardSuccessful;
                if (is_in_lane(echo) || !moves(here, context.now())) return kLaneNotFree;
                if (!first) steer(rover, steer_along(map, here, goal));
            }
            map.take(sweep);
            const bool sees = map.distances_from(here).right_cm < kMapReachCm;
            if (!sees && !first) return kWallLost;
            if (!sees) map.assume(placed(here, {-kEndBehindCm, -around}));
        }
    }

    // A wall at the left is one at the right in a mirror: all that comes and goes is mirrored.
    Echo look(Rover& rover, int number) const {
        Echo echo = rover.look(mirror_ * (kLookRightDeg + number * kLookStepDeg));
        echo.angle_deg *= mirror_;
        return echo;
    }

    Pose pose(Rover& rover) const {
        const Pose told = rover.pose();
        return {told.x_cm, mirror_ * told.y_cm, mirror_ * told.heading_deg};
    }

    void steer(Rover& rover, const Steering& steering) const {
        rover.steer({steering.speed_cm, mirror_ * steering.rate_deg});
    }

    bool is_in_lane(const Echo& echo) const {
        if (echo.distance_cm <= 0) return false;
        const double ahead = kSensorAheadCm + echo.distance_cm * cosine(echo.angle_deg);
        const double beside = echo.distance_cm * sine(echo.angle_deg);
        return ahead > 0 && ahead - kHalfLengthCm < ahead_ &&
               std::abs(beside) < kHalfWidthCm + kLaneMarginCm;
    }

    void moved_to(const Pose& pose, Time now) {
        moved_to_ = pose;
        moved_at_ = now;
    }

    // False if it has been told to drive for a while and does not get away.
    bool moves(const Pose& here, Time now) {
        const double way = trig::hypot(here.x_cm - moved_to_.x_cm, here.y_cm - moved_to_.y_cm);
        const double turn = normal_angle(here.heading_deg - moved_to_.heading_deg);
        if (way > kMovedCm || std::abs(turn) > kTurnedDeg) moved_to(here, now);
        return now - moved_at_ <= kPatience;
    }

    const Parts& parts_;
    double distance_ = 0;
    double ahead_ = 0;
    double gain_ = 0;
    double speed_ = 0;
    double left_ = 0;    // of the way
    double mirror_ = 1;  // -1: the wall is at the left
    Pose moved_to_;
    Time moved_at_{0};
};

}  // namespace

run::Coded wall_forward(const Parts& parts) {
    return {declared(), [&parts] { return std::make_unique<WallForward>(parts); }, {}};
}

}  // namespace vagus::toolbox::carbot
