#include "sim/carbot/sonar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/trig.hpp"

namespace vagus::sim::carbot {
namespace {

constexpr double kTenth = trig::kPi / 1800;           // rad
constexpr double kMetre = 1000;                       // mm
constexpr double kNoise = 0.01;                       // of the distance
constexpr double kMillimetresPerMillisecond = 343;    // sound in air of 20 degrees
constexpr size_t kRays = 13;                          // 2 degrees from one to the next
constexpr double kConeTangent = 0.21255656167002213;  // of 12 degrees
constexpr double kEchoCosine = 0.5;                   // of 60 degrees

// The tangents of the rays, from right to left, evenly.
constexpr std::array<double, kRays> make_fan() {
    std::array<double, kRays> fan{};
    for (size_t i = 0; i < kRays; ++i)
        fan[i] = kConeTangent * (2 * static_cast<double>(i) / (kRays - 1) - 1);
    return fan;
}
constexpr std::array<double, kRays> kFan = make_fan();

// How far a slice is, if it throws the sound back.
std::optional<double> echo_of(const Slice& slice, const Pose& eye) {
    const double tangent = kFan[slice.column];
    const double cosine = trig::cos(eye.angle);
    const double sine = trig::sin(eye.angle);
    const double length = std::sqrt(1 + tangent * tangent);
    const Point way = {(cosine - sine * tangent) / length, (sine + cosine * tangent) / length};
    const double facing = -(way.x * slice.normal.x + way.y * slice.normal.y);
    if (facing < kEchoCosine) return std::nullopt;
    return slice.enter * length;
}

// The nearest echo; the range if there is none.
double nearest_echo(const Arena& arena, BodyId body, const Pose& eye) {
    std::vector<Slice> slices;
    arena.slice(body, eye, kFan, slices);
    double nearest = kSonarRange;
    uint32_t column = kRays;  // the last in which something was met
    for (const Slice& slice : slices) {
        if (slice.column == column || slice.height < kSonarEye) continue;
        column = slice.column;
        if (const auto echo = echo_of(slice, eye)) nearest = std::min(nearest, *echo);
    }
    return nearest;
}

Pose eye_of(const Pose& robot, int16_t angle) {
    const double cosine = trig::cos(robot.angle);
    const double sine = trig::sin(robot.angle);
    return {{robot.at.x + cosine * kSonarPlace.x - sine * kSonarPlace.y,
             robot.at.y + sine * kSonarPlace.x + cosine * kSonarPlace.y},
            robot.angle + angle * kTenth};
}

}  // namespace

void Sonar::turn(int16_t angle) {
    target_ = std::clamp<int16_t>(angle, -kRotatorMax, kRotatorMax);
    turning_ = true;
}

void Sonar::hold() {
    halted_ = halted_ || turning_;
    turning_ = false;
}

void Sonar::ping() {
    if (ping_ == Ping::None) ping_ = Ping::Asked;
}

void Sonar::step(const Arena& arena, BodyId body, Time now) {
    if (turning_) {
        const int left = target_ - angle_;
        angle_ = static_cast<int16_t>(angle_ + std::clamp<int>(left, -kRotatorStep, kRotatorStep));
        reached_ = reached_ || angle_ == target_;
        turning_ = angle_ != target_;
    }
    if (ping_ == Ping::Asked) {
        next_ = measure(arena, body);
        const double way = 2.0 * next_.distance;
        const auto flight = std::chrono::milliseconds(
            static_cast<int64_t>(std::ceil(way / kMillimetresPerMillisecond)));
        due_ = now + (next_.distance == 0 ? kSonarWait : Duration(flight));
        ping_ = Ping::UnderWay;
    }
    if (ping_ == Ping::UnderWay && now >= due_) {
        heard_ = next_;
        has_heard_ = true;
        echo_ = true;
        ping_ = Ping::None;
    }
}

Sonar::Heard Sonar::measure(const Arena& arena, BodyId body) {
    const double distance = nearest_echo(arena, body, eye_of(arena.pose(body), angle_));
    if (distance >= kSonarRange) return {angle_, 0};
    const double told = std::round(distance * kMetre * (1 + kNoise * noise_.next()));
    return {angle_,
            static_cast<int16_t>(std::clamp<double>(told, kSonarNearest, kSonarRange * kMetre))};
}

bool Sonar::take_reached() {
    return std::exchange(reached_, false);
}

bool Sonar::take_echo() {
    return std::exchange(echo_, false);
}

bool Sonar::take_halted() {
    return std::exchange(halted_, false);
}

std::optional<Beam> Sonar::look(const Pose& robot) const {
    if (!has_heard_) return std::nullopt;
    const Pose eye = eye_of(robot, heard_.angle);
    const double length = heard_.distance == 0 ? kSonarRange : heard_.distance / kMetre;
    return Beam{
        eye.at,
        {eye.at.x + length * trig::cos(eye.angle), eye.at.y + length * trig::sin(eye.angle)},
        heard_.distance != 0};
}

}  // namespace vagus::sim::carbot
