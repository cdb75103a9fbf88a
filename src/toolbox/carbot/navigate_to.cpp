// NavigateTo: to a place, straight on, by what the wheels have counted.
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/trig.hpp"
#include "toolbox/carbot/inputs.hpp"
#include "toolbox/carbot/rover.hpp"
#include "toolbox/carbot/templates.hpp"
#include "toolbox/carbot/walls.hpp"

namespace vagus::toolbox::carbot {

namespace {

using plan::Type;
using plan::Value;

constexpr Duration kPeriod = std::chrono::milliseconds(100);
constexpr Duration kPatience = std::chrono::seconds(3);  // without coming nearer or turning
constexpr double kArrivedCm = 3;
constexpr double kSlowCm = 20;        // from here on it drives slower
constexpr double kTurnFirstDeg = 20;  // beyond, it turns in place
constexpr double kRateMaxDeg = 60;    // a second
constexpr double kSettleSeconds = 0.5;
constexpr double kProgressCm = 1;
constexpr double kProgressDeg = 2;

enum State { kArrived, kStuck };

plan::Input place(std::string name, std::string help) {
    return {.name = std::move(name), .type = Type::Float, .unit = "cm", .help = std::move(help)};
}

const plan::Template& declared() {
    static const plan::Template kDeclared{
        .name = "NavigateTo",
        .help = "Drives straight to a place, by odometry.",
        .icon = "M5 20c0-8 14-4 14-12M16 10l3-3l3 3M3 20h4",
        .inputs = {place("x", "ahead from where the robot started"),
                   place("y", "to the left of that"), speed_input()},
        .outcomes = {{"Arrived", "it is there"}, {"Stuck", "it does not come nearer"}},
        .bus = Rover::bus_of(Rover::Needs::Drive)};
    return kDeclared;
}

struct Way {
    double distance_cm;
    double turn_deg;  // from the heading to the goal
};

class NavigateTo final : public run::Actor {
public:
    explicit NavigateTo(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        x_ = input_of(context, declared(), 0);
        y_ = input_of(context, declared(), 1);
        speed_ = input_of(context, declared(), 2);
        Rover rover(context, parts_, Rover::Needs::Drive);
        stopping(rover, [&] {
            const State state = go(context, rover);
            rover.halt();
            context.end(state);
        });
    }

private:
    State go(run::ActorContext& context, Rover& rover) {
        Way best = way_from(rover.pose());
        Time better_at = context.now();
        for (;;) {
            const Way way = way_from(rover.pose());
            if (way.distance_cm <= kArrivedCm) return kArrived;
            const bool nearer = way.distance_cm < best.distance_cm - kProgressCm;
            const bool turned = std::abs(way.turn_deg) < std::abs(best.turn_deg) - kProgressDeg;
            if (nearer || turned) {
                best = way;
                better_at = context.now();
            }
            if (context.now() - better_at > kPatience) return kStuck;
            rover.steer(steering_for(way));
            rover.wait(kPeriod);
        }
    }

    Way way_from(const Pose& pose) const {
        const double x = x_ - pose.x_cm;
        const double y = y_ - pose.y_cm;
        const double bearing = trig::atan2(y, x) * 180 / trig::kPi;
        return {trig::hypot(x, y), normal_angle(bearing - pose.heading_deg)};
    }

    Steering steering_for(const Way& way) const {
        const double rate = std::clamp(way.turn_deg / kSettleSeconds, -kRateMaxDeg, kRateMaxDeg);
        if (std::abs(way.turn_deg) > kTurnFirstDeg) return {0, rate};
        return {speed_ * std::clamp(way.distance_cm / kSlowCm, 0.2, 1.0), rate};
    }

    const Parts& parts_;
    double x_ = 0;
    double y_ = 0;
    double speed_ = 0;
};

}  // namespace

run::Coded navigate_to(const Parts& parts) {
    return {declared(), [&parts] { return std::make_unique<NavigateTo>(parts); }, {}};
}

}  // namespace vagus::toolbox::carbot
