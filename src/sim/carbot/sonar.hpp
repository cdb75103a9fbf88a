// The ultrasonic sensor of a Carbot on its rotator: angles and millimetres as its node counts them,
// a millisecond at a time.
//
//     Sonar sonar(seed);
//     sonar.turn(900);                        // to the left, 300 degrees a second
//     sonar.step(arena, body, now);           // each millisecond
//     if (sonar.take_reached()) sonar.ping();
//     if (sonar.take_echo()) use(sonar.heard_angle(), sonar.distance());
//
// What is heard: the nearest of all that a fan of rays, 12 degrees to both sides, meets at most 60
// degrees off its normal; a smooth wall at more of a slant throws the sound elsewhere. Things lower
// than the sensor are below its beam. The answer takes as long as the sound to there and back.
#pragma once

#include <optional>

#include "base/time.hpp"
#include "sim/arena.hpp"
#include "sim/drawing.hpp"
#include "sim/noise.hpp"

namespace vagus::sim::carbot {

constexpr Point kSonarPlace = {0.18, 0};  // of the rotator's axis, in the frame of the robot
constexpr double kSonarEye = 0.10;        // m above the ground
constexpr double kSonarRange = 3.0;       // m
constexpr int16_t kSonarNearest = 30;     // mm: what is nearer reads so
constexpr int16_t kRotatorMax = 1200;     // tenths of a degree, either way
constexpr int16_t kRotatorStep = 3;       // tenths of a degree in a millisecond
constexpr Duration kSonarWait = std::chrono::milliseconds(20);  // for an echo that does not come

class Sonar {
public:
    // `seed` is that of its noise: 1 % of the distance.
    explicit Sonar(uint64_t seed) : noise_(seed) {}
    void reseed(uint64_t seed) { noise_.reseed(seed); }

    // As the natives of the node ask: done in the next step().
    void turn(int16_t angle);
    // Nothing while one is under way.
    void ping();
    // Holds the rotator where it is. If it was on its way, take_halted() says so.
    void hold();

    // One millisecond has passed.
    void step(const Arena& arena, BodyId body, Time now);

    int16_t angle() const { return angle_; }
    // Of the last measurement that has come back; 0: nothing within range.
    int16_t heard_angle() const { return heard_.angle; }
    int16_t distance() const { return heard_.distance; }
    // Has it happened since it was last asked?
    bool take_reached();
    bool take_echo();
    bool take_halted();
    // Where the last measurement went, for drawings; nothing before the first.
    std::optional<Beam> look(const Pose& robot) const;

private:
    struct Heard {
        int16_t angle = 0;
        int16_t distance = 0;
    };
    enum class Ping : uint8_t { None, Asked, UnderWay };

    Heard measure(const Arena& arena, BodyId body);

    Noise noise_;
    int16_t angle_ = 0;
    int16_t target_ = 0;
    bool turning_ = false;
    bool reached_ = false;
    bool halted_ = false;
    Ping ping_ = Ping::None;
    Heard next_;
    Time due_{};
    bool echo_ = false;
    Heard heard_;
    bool has_heard_ = false;
};

}  // namespace vagus::sim::carbot
