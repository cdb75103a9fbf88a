#include "trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/file.hpp"
#include "base/test_places.hpp"
#include "base/trig.hpp"

namespace vagus::samples {

namespace {

Result<sim::Pose> start_of(const std::string& file) {
    const std::string text = TRY(read_file(file));
    return TRY(sim::World::load(text, file)).robots().front().pose;
}

double around_zero(SplitMix64& random, double most) {
    return (2 * random.unit() - 1) * most;
}

}  // namespace

std::string example(const std::string& path) {
    return test::examples(path);
}

std::string test_world(const std::string& name) {
    return test::sample_worlds(name);
}

sim::Pose Trial::from_begin(const sim::Pose& pose) const {
    const double x = pose.at.x - begin.at.x;
    const double y = pose.at.y - begin.at.y;
    const double cosine = std::cos(begin.angle);
    const double sine = std::sin(begin.angle);
    return {{x * cosine + y * sine, y * cosine - x * sine}, pose.angle - begin.angle};
}

Duration Trial::longest_contact() const {
    Duration longest{0};
    for (const Contact& contact : ran.contacts) longest = std::max(longest, contact.length);
    return longest;
}

void try_seeds(const TrialOptions& options, const std::function<void(const Trial&)>& judge) {
    const auto start = start_of(options.world);
    ASSERT_TRUE(start.ok()) << start.error().what;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
        SplitMix64 random(seed);
        sim::Pose begin = start.value();
        begin.at.x += around_zero(random, options.off_metres);
        begin.at.y += around_zero(random, options.off_metres);
        begin.angle += around_zero(random, options.off_radians);
        SCOPED_TRACE("seed " + std::to_string(seed) + ", start " + std::to_string(begin.at.x) +
                     " " + std::to_string(begin.at.y) + " " + std::to_string(begin.angle));
        auto ran = run_sample({.plan = options.plan,
                               .world = options.world,
                               .seed = seed,
                               .at = begin,
                               .at_most = options.at_most,
                               .traced = options.traced,
                               .set = options.set});
        ASSERT_TRUE(ran.ok()) << ran.error().what;
        judge({seed, begin, std::move(ran.value())});
    }
}

Worst::~Worst() {
    std::printf("[  figure  ] %s: %.3g at worst of %d\n", what_.c_str(), worst_, noted_);
}

double Worst::note(double figure) {
    worst_ = noted_++ == 0 ? figure : std::max(worst_, figure);
    return figure;
}

double metres_between(const sim::Point& one, const sim::Point& other) {
    return std::hypot(one.x - other.x, one.y - other.y);
}

double degrees_off(double radians, double wanted_radians) {
    return std::abs(std::remainder(radians - wanted_radians, 2 * trig::kPi)) * 180 / trig::kPi;
}

double seconds(Duration duration) {
    return std::chrono::duration<double>(duration).count();
}

}  // namespace vagus::samples
