#include "sim/spacing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "base/rng.hpp"
#include "base/trig.hpp"
#include "sim/moving_grid.hpp"

using namespace vagus;
using namespace vagus::sim;

namespace {

constexpr double kSide = 3;         // m
constexpr double kRadius = 0.08;    // of every body
constexpr double kStepMax = 0.005;  // m: faster than any robot

// Discs in a square with one wall of 10 cm across the middle.
struct Field {
    explicit Field(size_t count) : sight({.width = kSide, .height = kSide}), spacing(sight) {
        const std::vector<Point> wall = {{-0.5, -0.05}, {0.5, -0.05}, {0.5, 0.05}, {-0.5, 0.05}};
        sight.add(0, {.corners = wall}, 0.1, Mobility::Fixed);
        sight.put(0, {kSide / 2, kSide / 2, 1, 0});
        sight.refresh();
        for (uint32_t i = 1; i <= count; ++i) {
            sight.add(i, {.corners = {}, .radius = kRadius}, 0.1, Mobility::Moving);
            spacing.add(i, Company::MayBeAlone);
        }
    }
    void put(uint32_t index, double x, double y) { sight.put(index, {x, y, 1, 0}); }
    double between(uint32_t a, uint32_t b) const {
        const Stand& from = sight.stand(a);
        const Stand& to = sight.stand(b);
        return trig::hypot(from.x - to.x, from.y - to.y) - 2 * kRadius;
    }
    // From its disc to the wall or the border, worked out on its own.
    double to_fixed(uint32_t index) const {
        const Stand& at = sight.stand(index);
        const double dx = std::max(0.0, std::abs(at.x - kSide / 2) - 0.5);
        const double dy = std::max(0.0, std::abs(at.y - kSide / 2) - 0.05);
        const double border = std::min({at.x, kSide - at.x, at.y, kSide - at.y});
        return std::min(trig::hypot(dx, dy), border) - kRadius;
    }

    Sight sight;
    Spacing spacing;
};

TEST(Spacing, IsAloneInTheMiddleOfNowhereAndNotBesideAnother) {
    Field field(2);
    field.put(1, 0.5, 0.5);
    field.put(2, 0.5, 2.5);
    field.spacing.settle(1);
    field.spacing.settle(2);
    EXPECT_TRUE(field.spacing.is_alone(1));
    EXPECT_TRUE(field.spacing.is_alone(2));
    // It comes to within a centimetre of the other one, which has not moved.
    field.put(2, 0.5, 0.5 + 2 * kRadius + 0.01);
    ASSERT_TRUE(field.spacing.has_strayed(2));
    field.spacing.settle(2);
    EXPECT_FALSE(field.spacing.is_alone(2));
    EXPECT_FALSE(field.spacing.is_alone(1));
}

TEST(Spacing, WallsAndTheBorderAreCompany) {
    Field field(2);
    field.put(1, kSide / 2, kSide / 2 + 0.05 + kRadius + 0.01);
    field.put(2, kRadius + 0.01, 0.5);
    field.spacing.settle(1);
    field.spacing.settle(2);
    EXPECT_FALSE(field.spacing.is_alone(1));
    EXPECT_FALSE(field.spacing.is_alone(2));
}

// The promise on which the arena builds: a body that is alone is beside nothing, however all have
// moved, although only those that strayed have looked around.
TEST(Spacing, WhoIsAloneTouchesNothingAfterAnySteps) {
    constexpr uint64_t kSeed = 20;
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    SplitMix64 random(kSeed);
    constexpr uint32_t kCount = 60;
    Field field(kCount);
    std::vector<double> ways(kCount + 1);
    for (uint32_t i = 1; i <= kCount; ++i) {
        field.put(i, 0.1 + 2.8 * random.unit(), 0.1 + 2.8 * random.unit());
        field.sight.anchor(i);
    }
    for (uint32_t i = 1; i <= kCount; ++i) field.spacing.settle(i);
    uint64_t alone = 0;
    for (int step = 0; step < 2000; ++step) {
        for (uint32_t i = 1; i <= kCount; ++i) {
            ways[i] += random.unit() - 0.5;
            const Stand& at = field.sight.stand(i);
            field.put(i, std::clamp(at.x + kStepMax * trig::cos(ways[i]), 0.1, 2.9),
                      std::clamp(at.y + kStepMax * trig::sin(ways[i]), 0.1, 2.9));
        }
        for (uint32_t i = 1; i <= kCount; ++i)
            if (field.spacing.has_strayed(i)) field.spacing.settle(i);
        for (uint32_t i = 1; i <= kCount; ++i) {
            if (!field.spacing.is_alone(i)) continue;
            ++alone;
            ASSERT_GT(field.to_fixed(i), 0) << "step " << step;
            for (uint32_t other = 1; other <= kCount; ++other) {
                if (other == i) continue;
                ASSERT_GT(field.between(i, other), 0) << "step " << step;
            }
        }
    }
    EXPECT_GT(alone, 2000u * kCount / 10);  // else nothing was tested
}

TEST(MovingGrid, FindsWhatIsInABoxAndForgetsWhatIsRemoved) {
    constexpr uint64_t kSeed = 21;
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    SplitMix64 random(kSeed);
    MovingGrid grid(4, 2);
    std::vector<Point> points(100);
    std::vector<bool> there(points.size());
    for (int round = 0; round < 2000; ++round) {
        const auto index = static_cast<uint32_t>(random.below(points.size()));
        if (there[index] && random.below(4) == 0) {
            grid.remove(index);
            there[index] = false;
        } else {
            points[index] = {-1 + 6 * random.unit(), -1 + 4 * random.unit()};  // also outside
            grid.put(index, points[index]);
            there[index] = true;
        }
        const Point corner = {-1 + 5 * random.unit(), -1 + 3 * random.unit()};
        const Box box = {corner.x, corner.y, corner.x + random.unit(), corner.y + random.unit()};
        std::multiset<uint32_t> found;
        grid.visit(box, [&found](uint32_t each) { found.insert(each); });
        for (uint32_t i = 0; i < points.size(); ++i) {
            const Point& at = points[i];
            const bool inside = there[i] && at.x >= box.left && at.x <= box.right &&
                                at.y >= box.low && at.y <= box.high;
            ASSERT_LE(found.count(i), there[i] ? 1u : 0u);
            ASSERT_TRUE(!inside || found.count(i) == 1) << i << " in round " << round;
        }
    }
}

}  // namespace
