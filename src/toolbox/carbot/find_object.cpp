// FindObject: the robot turns until the camera sees the object, then until it is straight ahead.
#include <algorithm>
#include <cmath>
#include <memory>

#include "toolbox/carbot/inputs.hpp"
#include "toolbox/carbot/looker.hpp"
#include "toolbox/carbot/rover.hpp"
#include "toolbox/carbot/templates.hpp"
#include "toolbox/carbot/walls.hpp"

namespace vagus::toolbox::carbot {

namespace {

using plan::Type;
using plan::Value;

constexpr Duration kLookEvery = std::chrono::milliseconds(100);
constexpr double kAheadDeg = 2;        // so far off is straight ahead
constexpr double kAheadLooseDeg = 5;   // after the wheels have come to rest
constexpr double kTurnSlowestDeg = 6;  // a second
constexpr double kTurnGain = 1.5;      // degrees a second for each degree that it is off
constexpr int kLooksMax = 100;         // to bring it straight ahead

enum State { kObjectFound, kNoObjectFound };

const plan::Template& declared() {
    static const plan::Template kDeclared = [] {
        plan::Template of{
            .name = "FindObject",
            .help = "Turns until the camera sees an object of this colour straight ahead.",
            .icon = "M3 8V4h4M17 4h4v4M21 16v4h-4M7 20H3v-4M12 8a4 4 0 1 0 .1 0",
            .inputs = colour_inputs(),
            .outputs = {{.name = "angle",
                         .type = Type::Float,
                         .unit = "deg",
                         .help = "where it is, from ahead"},
                        {.name = "distance",
                         .type = Type::Float,
                         .unit = "cm",
                         .help = "from the front of the robot to its foot; 0 if that is too near "
                                 "to be in the picture"}},
            .outcomes = {{"ObjectFound", "it is straight ahead"},
                         {"NoObjectFound", "it was not seen"}},
            .bus = Rover::bus_of(Rover::Needs::Drive)};
        of.inputs.push_back({.name = "turn",
                             .type = Type::Float,
                             .fallback = Value(360.0),
                             .unit = "deg",
                             .help = "how far to turn for it: to the left, or if negative to the "
                                     "right",
                             .low = -3600,
                             .high = 3600});
        of.inputs.push_back({.name = "speed",
                             .type = Type::Float,
                             .fallback = Value(45.0),
                             .unit = "deg/s",
                             .help = "how fast to turn",
                             .low = 1,
                             .high = 136});
        return of;
    }();
    return kDeclared;
}

class FindObject final : public run::Actor {
public:
    explicit FindObject(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        turn_ = input_of(context, declared(), 3);
        speed_ = input_of(context, declared(), 4);
        Looker looker(context, parts_, declared());
        Rover rover(context, parts_, Rover::Needs::Drive);
        stopping(rover, [&] {
            const std::optional<Sighting> seen = search(rover, looker);
            context.end(seen ? kObjectFound : kNoObjectFound);
            if (!seen) return;
            const double front = seen->distance_cm - kFrontCm;
            context.out(0, Value(seen->angle_deg));
            context.out(1, Value(seen->distance_cm > 0 ? std::max(front, 0.0) : 0.0));
        });
    }

private:
    static constexpr double kFrontCm = 20 - kCameraAheadCm;  // before the camera

    std::optional<Sighting> search(Rover& rover, Looker& looker) {
        double heading = rover.pose().heading_deg;
        for (double turned = 0;;) {
            if (looker.find()) {
                if (const auto seen = turn_to_it(rover, looker)) return seen;
                heading = rover.pose().heading_deg;
            }
            if (turned >= std::fabs(turn_)) break;
            rover.steer({0, turn_ < 0 ? -speed_ : speed_});
            rover.wait(kLookEvery);
            const double now = rover.pose().heading_deg;
            turned += std::fabs(normal_angle(now - heading));
            heading = now;
        }
        rover.halt();
        return std::nullopt;
    }

    // Nothing if it is lost from sight, or will not stay ahead.
    std::optional<Sighting> turn_to_it(Rover& rover, Looker& looker) const {
        for (int looks = 0; looks < kLooksMax; ++looks) {
            const std::optional<Sighting> seen = looker.follow();
            if (!seen) return std::nullopt;
            if (std::fabs(seen->angle_deg) <= kAheadDeg) {
                rover.halt();
                const std::optional<Sighting> still = looker.follow();
                if (still && std::fabs(still->angle_deg) <= kAheadLooseDeg) return still;
                continue;
            }
            rover.steer({0, rate_for(seen->angle_deg)});
            rover.wait(kLookEvery);
        }
        return std::nullopt;
    }

    double rate_for(double angle) const {
        const double most = std::max(speed_, kTurnSlowestDeg);
        const double rate = std::clamp(kTurnGain * std::fabs(angle), kTurnSlowestDeg, most);
        return angle < 0 ? -rate : rate;
    }

    const Parts& parts_;
    double turn_ = 0;
    double speed_ = 0;
};

}  // namespace

run::Coded find_object(const Parts& parts) {
    return {declared(), [&parts] { return std::make_unique<FindObject>(parts); }, {}};
}

}  // namespace vagus::toolbox::carbot
