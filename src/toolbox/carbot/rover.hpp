// What Carbot's templates in C++ do with its nodes drive, range and head, as calls that wait for
// the answer. While it drives, each wait says the driving command again before the drive node would
// take its silence for an end.
//
//     Rover rover(context, parts, Rover::Needs::DriveAndRange);
//     rover.steer({.speed_cm = 20, .rate_deg = 0});
//     if (rover.look(0).distance_cm < 30) rover.halt();
//
// Units as in plans: cm, degrees counter-clockwise from ahead.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/code.hpp"
#include "toolbox/bus_talk.hpp"
#include "toolbox/carbot/body.hpp"
#include "toolbox/carbot/distance_map.hpp"
#include "toolbox/parts.hpp"

namespace vagus::toolbox::carbot {

constexpr Duration kSteerPeriod = std::chrono::milliseconds(100);
constexpr Duration kAnswerWithin = std::chrono::seconds(30);  // a whole scan takes seconds
constexpr size_t kEchoesMax = 720;                            // of a scan

// What the infrared sensor sees.
struct Beacon {
    double direction_deg = 0;
    int intensity = 0;  // 1 to 1000 at the beacon; 0: there is none
};

// What the colour sensor sees right ahead, parts from 0 to 1.
struct Surface {
    bool near = false;  // false: nothing, and no colour
    double red = 0;
    double green = 0;
    double blue = 0;
};

class Rover {
public:
    enum class Needs { Range, Drive, DriveAndRange, Head, DriveAndHead };

    Rover(run::ActorContext& context, const Parts& parts, Needs needs);

    // What is said and heard on the bus.
    static plan::BusUse bus_of(Needs needs);

    // Drives so until told otherwise.
    void steer(const Steering& steering);
    // Stops and waits until the wheels are at rest.
    void halt();
    // After Stop: takes back what is still asked for; stops as halt() does, if the wheels may turn.
    void stop();

    Echo look(double angle_deg);
    // One echo for each direction; `step_deg` is at least 1.
    std::vector<Echo> scan(double from_deg, double to_deg, double step_deg);
    Pose pose();
    Beacon beacon();
    Surface surface();
    void wait(Duration time);

private:
    std::optional<run::BusEvent> hear_until(Time end);
    run::BusEvent await(const std::string& one, const std::string& other);
    void say_steering();

    run::ActorContext& context_;
    BusTalk talk_;
    bool ranges_;                       // the sensor is asked
    std::optional<Steering> steering_;  // to be said again
    bool moves_ = false;                // the wheels may turn
    Time steer_again_{0};
};

// Does the work. If the plan takes another way meanwhile, the robot stops, and Stop goes on.
template <typename Work>
auto stopping(Rover& rover, const Work& work) {
    try {
        return work();
    } catch (const run::Stop&) {
        rover.stop();
        throw;
    }
}

// A whole number of tenths, as the nodes count, within a word.
int16_t tenths(double value);

}  // namespace vagus::toolbox::carbot
