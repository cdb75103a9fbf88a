// WallForward: along a wall, at a distance. The sensor looks at the wall in two directions, which
// give its distance and direction, and then ahead; after each round the steering is set anew.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/trig.hpp"
#include "toolbox/carbot/inputs.hpp"
#include "toolbox/carbot/rover.hpp"
#include "toolbox/carbot/templates.hpp"
#include "toolbox/carbot/walls.hpp"

namespace vagus::toolbox::carbot {

namespace {

using plan::Type;
using plan::Value;

constexpr double kBesideDeg = 90;     // the first look at the wall
constexpr double kSlantDeg = 55;      // the second
constexpr double kLostFactor = 2.5;   // a wall so many times too far away is lost
constexpr double kApproachDeg = 30;   // steepest way to the wall and from it
constexpr double kSettleSeconds = 1;  // a wrong heading is to be right after that
constexpr double kRateMaxDeg = 40;    // a second

enum State { kForwardSuccessful, kLaneNotFree, kWallLost };

plan::Input length_input(std::string name, std::string help) {
    return {.name = std::move(name),
            .type = Type::Float,
            .unit = "cm",
            .help = std::move(help),
            .low = 0,
            .high = 1e6};
}

plan::Input with_default(plan::Input input, double value) {
    input.fallback = Value(value);
    return input;
}

const plan::Template& declared() {
    static const plan::Template kDeclared{
        .name = "WallForward",
        .help = "Drives along the wall at the right, or else at the left.",
        .icon = "M5 3v18M14 20V6M10 10l4-4l4 4",
        .inputs = {with_default(length_input("distance", "to keep from the wall"), 30),
                   with_default(length_input("ahead", "how much must be free ahead"), 30),
                   {.name = "gain",
                    .type = Type::Float,
                    .fallback = Value(1.0),
                    .unit = "deg/cm",
                    .help = "how steeply it goes to the right distance",
                    .low = 0.01,
                    .high = 20},
                   speed_input(),
                   with_default(length_input("length", "how far to drive"), 100)},
        .outcomes = {{"ForwardSuccessful", "it has driven so far"},
                     {"LaneNotFree", "something is ahead"},
                     {"WallLost", "the wall has ended"}},
        .bus_events = Rover::events_of(Rover::Needs::DriveAndRange)};
    return kDeclared;
}

class WallForward final : public run::Actor {
public:
    explicit WallForward(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        distance_ = input_of(context, declared(), 0);
        ahead_ = input_of(context, declared(), 1);
        gain_ = input_of(context, declared(), 2);
        speed_ = input_of(context, declared(), 3);
        length_ = input_of(context, declared(), 4);
        Rover rover(context, parts_, Rover::Needs::DriveAndRange);
        try {
            const State state = follow(rover);
            rover.halt();
            context.end(state);
        } catch (const run::Stop&) {
            rover.stop();
            throw;
        }
    }

private:
    State follow(Rover& rover) {
        if (is_blocked(rover)) return kLaneNotFree;
        side_ = side_of_wall(rover);
        Pose last = rover.pose();
        for (double driven = 0; driven < length_;) {
            const Echo beside = rover.look(side_ * kBesideDeg);
            const Echo slant = rover.look(side_ * kSlantDeg);
            const std::optional<Wall> wall = fit_wall({beside, slant});
            if (!wall || wall->distance_cm > kLostFactor * distance_) return kWallLost;
            rover.steer({speed_, rate_for(*wall)});
            if (is_blocked(rover)) return kLaneNotFree;
            const Pose here = rover.pose();
            driven += trig::hypot(here.x_cm - last.x_cm, here.y_cm - last.y_cm);
            last = here;
        }
        return kForwardSuccessful;
    }

    bool is_blocked(Rover& rover) const {
        const double free = rover.look(0).distance_cm;
        return free > 0 && free < ahead_;
    }

    // -1: the wall is at the right, as it is for SearchWall; 1: at the left, if nothing is there.
    double side_of_wall(Rover& rover) const {
        const double right = rover.look(-kBesideDeg).distance_cm;
        return right > 0 && right <= kLostFactor * distance_ ? -1 : 1;
    }

    // So that the robot becomes parallel to the wall when it is at the right distance, and goes
    // there at an angle otherwise.
    double rate_for(const Wall& wall) const {
        const double too_far = wall.distance_cm - distance_;
        const double approach = std::clamp(gain_ * too_far, -kApproachDeg, kApproachDeg);
        const double parallel =
            side_ > 0 ? wall.turn_to_have_it_left() : wall.turn_to_have_it_right();
        const double turn = parallel + side_ * approach;
        return std::clamp(turn / kSettleSeconds, -kRateMaxDeg, kRateMaxDeg);
    }

    const Parts& parts_;
    double distance_ = 0;
    double ahead_ = 0;
    double gain_ = 0;
    double speed_ = 0;
    double length_ = 0;
    double side_ = 1;
};

}  // namespace

run::Coded wall_forward(const Parts& parts) {
    return {declared(), [&parts] { return std::make_unique<WallForward>(parts); }, {}};
}

}  // namespace vagus::toolbox::carbot
