// The physics and sensing of Vagus beside those of Debian's libenki, in one run: the same arenas,
// as many Thymios at the same density, the same controller, seven distance sensors of three rays
// and two ground sensors read in every step by both. Bodies only: no nodes, no scripts.
//
// Linked where libenki is installed; else sim_no_peer.cpp is.
#include "sim_peer.hpp"

#include <enki/PhysicalEngine.h>
#include <enki/robots/thymio2/Thymio2.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "sim/arena.hpp"
#include "sim/ground.hpp"
#include "sim/noise.hpp"
#include "sim/thymio2/body.hpp"

namespace {

using namespace vagus;
using Clock = std::chrono::steady_clock;

constexpr double kSpacing = 0.4;     // m: one robot on so much by so much
constexpr double kStep = 0.01;       // s
constexpr double kCruise = 0.1;      // m/s
constexpr double kThreshold = 1000;  // of a distance sensor
constexpr int kRoundSteps = 100;
constexpr int kRounds = 7;

struct Start {
    double x, y, angle;
};

// A square field, robots on a grid, looking everywhere.
std::vector<Start> starts(size_t count) {
    const auto side = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    std::vector<Start> all;
    SplitMix64 random(7);
    for (size_t i = 0; i < count; ++i) {
        all.push_back({kSpacing * (static_cast<double>(i % side) + 0.5),
                       kSpacing * (static_cast<double>(i / side) + 0.5), random.unit() * 6.28});
    }
    return all;
}

double field_side(size_t count) {
    return kSpacing * std::ceil(std::sqrt(static_cast<double>(count)));
}

// Straight ahead, and away from what is nearer on the left or on the right.
struct Speeds {
    double left, right;
};
Speeds control(double left_seen, double right_seen) {
    if (left_seen > kThreshold) return {kCruise, -kCruise};
    if (right_seen > kThreshold) return {-kCruise, kCruise};
    return {kCruise, kCruise};
}

class VagusField {
public:
    explicit VagusField(size_t count)
        : arena_({.width = field_side(count), .height = field_side(count)}),
          ground_(field_side(count), field_side(count), {0.9, 0.9, 0.9}),
          noise_(1) {
        for (const Start& start : starts(count))
            robots_.emplace_back(arena_, sim::Pose{{start.x, start.y}, start.angle});
        seen_.resize(count);
    }

    void step() {
        for (size_t i = 0; i < robots_.size(); ++i) {
            const auto& prox = seen_[i].values;
            const Speeds speeds = control(std::max(prox[0], prox[1]), std::max(prox[3], prox[4]));
            robots_[i].drive(arena_, to_target(speeds.left), to_target(speeds.right));
        }
        arena_.step();
        arena_.prepare_looks();
        for (size_t i = 0; i < robots_.size(); ++i) {
            seen_[i] = robots_[i].look(arena_, noise_);
            sum_ +=
                robots_[i].look_down(arena_.pose(robots_[i].id()), ground_, noise_).reflected[0];
        }
    }
    double checksum() const { return sum_; }

private:
    static int16_t to_target(double speed) {
        return static_cast<int16_t>(speed / sim::thymio2::kSpeedUnit);
    }
    sim::Arena arena_;
    sim::Ground ground_;
    sim::Noise noise_;
    std::vector<sim::thymio2::Body> robots_;
    std::vector<sim::thymio2::Horizontal> seen_;
    double sum_ = 0;
};

class EnkiField {
public:
    explicit EnkiField(size_t count)
        : world_(field_side(count) * 100, field_side(count) * 100, Enki::Color(0.9, 0.9, 0.9)) {
        world_.takeObjectOwnership = false;
        for (const Start& start : starts(count)) {
            auto& robot = robots_.emplace_back(std::make_unique<Enki::Thymio2>());
            robot->pos = Enki::Point(start.x * 100, start.y * 100);
            robot->angle = start.angle;
            world_.addObject(robot.get());
        }
    }
    ~EnkiField() {
        for (auto& robot : robots_) world_.removeObject(robot.get());
    }
    EnkiField(const EnkiField&) = delete;
    EnkiField& operator=(const EnkiField&) = delete;

    void step() {
        for (auto& robot : robots_) {
            const Speeds speeds = control(
                std::max(robot->infraredSensor0.getValue(), robot->infraredSensor1.getValue()),
                std::max(robot->infraredSensor3.getValue(), robot->infraredSensor4.getValue()));
            robot->leftSpeed = speeds.left * 100;
            robot->rightSpeed = speeds.right * 100;
        }
        world_.step(kStep);
        for (auto& robot : robots_) sum_ += robot->groundSensor0.getValue();
    }
    double checksum() const { return sum_; }

private:
    Enki::World world_;
    std::vector<std::unique_ptr<Enki::Thymio2>> robots_;
    double sum_ = 0;
};

// Microseconds a robot and step. Other programs on the machine only add, so the best round counts.
template <typename Field>
double measure(size_t count) {
    Field field(count);
    for (int i = 0; i < kRoundSteps; ++i) field.step();
    double best = 1e9;
    for (int round = 0; round < kRounds; ++round) {
        const Clock::time_point start = Clock::now();
        for (int i = 0; i < kRoundSteps; ++i) field.step();
        const std::chrono::duration<double, std::micro> took = Clock::now() - start;
        best = std::min(best, took.count() / kRoundSteps / static_cast<double>(count));
    }
    if (field.checksum() < 0) std::puts("");  // keeps the readings from being left out
    return best;
}

}  // namespace

void compare_with_peer() {
    std::puts("robots   Vagus us/robot-step   Enki us/robot-step   Enki / Vagus");
    for (const size_t count : {size_t{1}, size_t{10}, size_t{100}, size_t{400}}) {
        const double ours = measure<VagusField>(count);
        const double enki = measure<EnkiField>(count);
        std::printf("%6zu %21.3f %20.3f %14.1f\n", count, ours, enki, enki / ours);
        std::fflush(stdout);
    }
}
