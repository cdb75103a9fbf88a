// FollowObject: drives to an object that the camera sees, also if it moves away. Where its foot is
// below the picture, the distance sensor and its width tell how near it is.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/trig.hpp"
#include "toolbox/carbot/inputs.hpp"
#include "toolbox/carbot/looker.hpp"
#include "toolbox/carbot/rover.hpp"
#include "toolbox/carbot/templates.hpp"

namespace vagus::toolbox::carbot {

namespace {

using plan::Type;
using plan::Value;

constexpr Duration kLookEvery = std::chrono::milliseconds(100);
constexpr double kLookSeconds = 0.1;
constexpr double kFrontCm = 20 - kCameraAheadCm;  // the hull's front before the camera
constexpr double kSonarCm = 2;                    // the hull's front before the distance sensor
constexpr double kNearCm = 60;      // what the distance sensor hears beyond is something else
constexpr double kTurnGain = 1.5;   // degrees a second for each degree that it is off
constexpr double kTurnMaxDeg = 60;  // a second
constexpr double kSlowDownCm = 40;  // before the end
constexpr double kSlowest = 0.25;   // of the speed
constexpr double kAsideDeg = 40;    // so far off it only turns
constexpr double kSearchDeg = 30;   // a second, toward where it was lost

enum State { kObjectReached, kObjectLost };

const plan::Template& declared() {
    static const plan::Template kDeclared = [] {
        plan::Template of{.name = "FollowObject",
                          .help = "Drives to an object of this colour, and after it if it moves.",
                          .icon = "M3 12h8M8 8l4 4l-4 4M18 7a5 5 0 1 0 .1 0",
                          .inputs = colour_inputs(),
                          .outputs = {{.name = "angle",
                                       .type = Type::Float,
                                       .unit = "deg",
                                       .help = "where it is, or was lost, from ahead"},
                                      {.name = "distance",
                                       .type = Type::Float,
                                       .unit = "cm",
                                       .help = "from the front of the robot"}},
                          .outcomes = {{"ObjectReached", "it is so near"},
                                       {"ObjectLost", "it was lost from sight"}},
                          .bus = Rover::bus_of(Rover::Needs::DriveAndRange)};
        of.inputs.push_back({.name = "distance",
                             .type = Type::Float,
                             .fallback = Value(40.0),
                             .unit = "cm",
                             .help = "how near to go, from the front of the robot",
                             .low = 15,
                             .high = 300});
        of.inputs.push_back(speed_input());
        of.inputs.push_back({.name = "patience",
                             .type = Type::Float,
                             .fallback = Value(2.0),
                             .unit = "s",
                             .help = "how long it may be out of sight",
                             .low = 0,
                             .high = 60});
        return of;
    }();
    return kDeclared;
}

class FollowObject final : public run::Actor {
public:
    explicit FollowObject(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        near_ = input_of(context, declared(), 3);
        speed_ = input_of(context, declared(), 4);
        patience_ = Duration(static_cast<int64_t>(input_of(context, declared(), 5) * 1e6));
        Looker looker(context, parts_, declared());
        Rover rover(context, parts_, Rover::Needs::DriveAndRange);
        stopping(rover, [&] {
            const State state = follow(context, rover, looker);
            rover.halt();
            context.end(state);
            context.out(0, Value(angle_));
            context.out(1, Value(distance_));
        });
    }

private:
    State follow(const run::ActorContext& context, Rover& rover, Looker& looker) {
        for (Time seen_at = context.now();;) {
            if (const std::optional<Sighting> seen = looker.follow()) {
                seen_at = context.now();
                angle_ = seen->angle_deg;
                distance_ = measure(rover, *seen);
                if (distance_ <= near_) return kObjectReached;
                speed_cm_ = speed_for();
                rover.steer({speed_cm_, rate_for()});
            } else {
                if (context.now() - seen_at >= patience_) return kObjectLost;
                rover.steer({0, angle_ < 0 ? -kSearchDeg : kSearchDeg});
            }
            rover.wait(kLookEvery);
        }
    }

    // From the front of the robot.
    double measure(Rover& rover, const Sighting& seen) {
        const double half = trig::tan(std::min(seen.width_deg, 60.0) / 2 * trig::kPi / 180);
        if (seen.distance_cm > 0) {
            if (seen.whole) half_width_ = half * seen.distance_cm;
            return std::max(seen.distance_cm - kFrontCm, 0.0);
        }
        const double echo = rover.look(seen.angle_deg).distance_cm;
        const bool heard = echo > 0 && echo < kNearCm;
        if (heard) return std::max(echo - kSonarCm, 0.0);
        // Too low to be heard: by how wide it has become.
        if (seen.whole && half_width_ > 0 && half > 0)
            return std::max(half_width_ / half - kFrontCm, 0.0);
        // Nothing tells: as near as it was, less what has been driven since.
        return std::max(distance_ - speed_cm_ * kLookSeconds, 0.0);
    }

    double speed_for() const {
        if (std::fabs(angle_) >= kAsideDeg) return 0;
        const double share = std::clamp((distance_ - near_) / kSlowDownCm, kSlowest, 1.0);
        return speed_ * share * (1 - std::fabs(angle_) / kAsideDeg);
    }

    double rate_for() const { return std::clamp(kTurnGain * angle_, -kTurnMaxDeg, kTurnMaxDeg); }

    const Parts& parts_;
    double near_ = 0;
    double speed_ = 0;
    Duration patience_{};
    double angle_ = 0;
    double distance_ = 0;
    double half_width_ = 0;  // cm, 0: not known
    double speed_cm_ = 0;    // as told last
};

}  // namespace

run::Coded follow_object(const Parts& parts) {
    return {declared(), [&parts] { return std::make_unique<FollowObject>(parts); }, {}};
}

}  // namespace vagus::toolbox::carbot
