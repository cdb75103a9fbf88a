#include "base/trig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/rng.hpp"

namespace vagus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamples = 200'000;

// Distance from the true value in units of its last place.
long double ulps(double value, long double truth) {
    const double rounded = static_cast<double>(truth);
    const double next = std::nextafter(std::fabs(rounded), kInfinity);
    return std::fabs((value - truth) / (static_cast<long double>(next) - std::fabs(rounded)));
}

// A double of either sign with an exponent drawn evenly from the range.
double sample(SplitMix64& random, int lowest, int highest) {
    const int range = highest - lowest + 1;
    const int exponent = lowest + static_cast<int>(random.below(static_cast<uint64_t>(range)));
    const double mantissa = 1 + random.unit();
    return std::ldexp(random.below(2) == 0 ? mantissa : -mantissa, exponent);
}

TEST(Trig, SineCosineTangentAreWithinTwoUnits) {
    SplitMix64 random(1);
    for (int i = 0; i < kSamples; ++i) {
        const double x = sample(random, -30, 19);
        ASSERT_LT(ulps(trig::sin(x), std::sin(static_cast<long double>(x))), 2) << x;
        ASSERT_LT(ulps(trig::cos(x), std::cos(static_cast<long double>(x))), 2) << x;
        ASSERT_LT(ulps(trig::tan(x), std::tan(static_cast<long double>(x))), 2) << x;
    }
}

TEST(Trig, MultiplesOfAQuarterTurnKeepTheirAccuracy) {
    for (int n = -2000; n <= 2000; ++n) {
        const double x = n * (trig::kPi / 2);
        ASSERT_LT(ulps(trig::sin(x), std::sin(static_cast<long double>(x))), 2) << n;
        ASSERT_LT(ulps(trig::cos(x), std::cos(static_cast<long double>(x))), 2) << n;
    }
}

// Beyond 1.6 million radians the argument may be off by the gap to its neighbour.
TEST(Trig, LargeArgumentsAreOffByTheirOwnGapAtMost) {
    SplitMix64 random(2);
    for (int i = 0; i < kSamples; ++i) {
        const double x = sample(random, 20, 40);
        const double gap = std::nextafter(std::fabs(x), kInfinity) - std::fabs(x);
        ASSERT_NEAR(trig::sin(x), std::sin(x), gap + 1e-15) << x;
        ASSERT_NEAR(trig::cos(x), std::cos(x), gap + 1e-15) << x;
    }
    EXPECT_LE(std::fabs(trig::sin(1e308)), 1.0);
}

TEST(Trig, Atan2IsWithinTwoUnits) {
    SplitMix64 random(3);
    for (int i = 0; i < kSamples; ++i) {
        const double y = sample(random, -40, 40);
        const double x = i % 2 == 0 ? sample(random, -40, 40) : y * (random.unit() * 4 - 2);
        const long double truth =
            std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        ASSERT_LT(ulps(trig::atan2(y, x), truth), 2) << y << " " << x;
    }
}

TEST(Trig, Atan2AgreesWithTheLibraryAtTheEnds) {
    const double values[] = {0.0,   -0.0,   1.0,    -1.0,    kInfinity, -kInfinity,
                             1e308, -1e308, 1e-310, -1e-310, 5e-324,    kNaN};
    for (const double y : values) {
        for (const double x : values) {
            const double got = trig::atan2(y, x);
            const double expected = std::atan2(y, x);
            if (std::isnan(expected)) {
                EXPECT_TRUE(std::isnan(got)) << y << " " << x;
            } else {
                EXPECT_EQ(std::signbit(got), std::signbit(expected)) << y << " " << x;
                EXPECT_NEAR(got, expected, 1e-15) << y << " " << x;
            }
        }
    }
}

TEST(Trig, HypotIsWithinTwoUnitsAndDoesNotOverflow) {
    SplitMix64 random(4);
    for (int i = 0; i < kSamples; ++i) {
        const double x = sample(random, -600, 600);
        const double y = x * (random.unit() * 4 - 2);
        const long double truth =
            std::hypot(static_cast<long double>(x), static_cast<long double>(y));
        ASSERT_LT(ulps(trig::hypot(x, y), truth), 2) << x << " " << y;
    }
    EXPECT_EQ(trig::hypot(3, -4), 5.0);
    EXPECT_EQ(trig::hypot(0, -0.0), 0.0);
    EXPECT_LT(ulps(trig::hypot(1e308, 1e308), 1e308L * std::sqrt(2.0L)), 2);
    EXPECT_EQ(trig::hypot(kNaN, -kInfinity), kInfinity);
    EXPECT_TRUE(std::isnan(trig::hypot(kNaN, 1)));
}

TEST(Trig, SpecialValuesPassThrough) {
    EXPECT_TRUE(std::isnan(trig::sin(kInfinity)));
    EXPECT_TRUE(std::isnan(trig::cos(-kInfinity)));
    EXPECT_TRUE(std::isnan(trig::tan(kNaN)));
    EXPECT_TRUE(std::signbit(trig::sin(-0.0)));
    EXPECT_EQ(trig::cos(0), 1.0);
    EXPECT_EQ(trig::sqrt(2), 0x1.6a09e667f3bcdp+0);
}

// The promise of this file: these bits are the same on every machine and with every compiler. If a
// change of the formulas is wanted, recorded simulations change with it.
TEST(Trig, BitsNeverChange) {
    SplitMix64 random(5);
    uint64_t hash = 0xcbf29ce484222325u;
    const auto mix = [&hash](double value) {
        uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3u;
    };
    for (int i = 0; i < 10'000; ++i) {
        const double x = (random.unit() - 0.5) * 1000;
        const double y = (random.unit() - 0.5) * 1000;
        for (const double value :
             {trig::sin(x), trig::cos(x), trig::tan(x), trig::atan2(y, x), trig::hypot(x, y)})
            mix(value);
    }
    EXPECT_EQ(hash, 8790433546533371253u);
}

}  // namespace
}  // namespace vagus
