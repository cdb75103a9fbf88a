#include "base/trig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

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

TEST(Trig, SineAndCosineAtOnceHaveTheBitsOfEachAlone) {
    SplitMix64 random(5);
    for (int i = 0; i < kSamples; ++i) {
        const double x = i == 0 ? -0.0 : sample(random, -40, 30);
        const auto [sine, cosine] = trig::sin_cos(x);
        ASSERT_EQ(sine, trig::sin(x)) << x;
        ASSERT_EQ(std::signbit(sine), std::signbit(trig::sin(x))) << x;
        ASSERT_EQ(cosine, trig::cos(x)) << x;
    }
    EXPECT_TRUE(std::isnan(trig::sin_cos(kInfinity).sine));
    EXPECT_TRUE(std::isnan(trig::sin_cos(kNaN).cosine));
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

// ---- degrees ----

constexpr long double kDegree = 3.14159265358979323846264338327950288L / 180;

TEST(TrigDegrees, AreExactWhereTheTrueValueIs) {
    const auto bits = [](double value) { return std::pair(value, std::signbit(value)); };
    for (int turns = -3; turns <= 3; ++turns) {
        const double start = 360.0 * turns;
        const std::tuple<double, double, double> cases[] = {
            {0, 0, 1}, {90, 1, 0}, {180, 0, -1}, {270, -1, 0}};
        for (const auto& [angle, sine, cosine] : cases) {
            EXPECT_EQ(bits(trig::sin_degrees(start + angle)), bits(sine)) << start + angle;
            EXPECT_EQ(bits(trig::cos_degrees(start + angle)), bits(cosine)) << start + angle;
        }
        EXPECT_EQ(trig::sin_degrees(start + 30), 0.5);
        EXPECT_EQ(trig::sin_degrees(start + 150), 0.5);
        EXPECT_EQ(trig::cos_degrees(start + 60), 0.5);
        EXPECT_EQ(trig::cos_degrees(start + 240), -0.5);
        EXPECT_EQ(trig::tan_degrees(start + 45), 1);
        EXPECT_EQ(trig::tan_degrees(start + 135), -1);
        EXPECT_EQ(bits(trig::tan_degrees(start + 180)), bits(0));
        EXPECT_TRUE(std::isinf(trig::tan_degrees(start + 90)));
        EXPECT_TRUE(std::isinf(trig::tan_degrees(start - 90)));
    }
    EXPECT_EQ(trig::sin_degrees(360e15), 0);  // a multiple of 360, exactly
    EXPECT_TRUE(std::isnan(trig::sin_degrees(kInfinity)));
    EXPECT_TRUE(std::isnan(trig::cos_degrees(kNaN)));
}

TEST(TrigDegrees, AnglesOfRoundValuesAreRound) {
    const std::pair<double, double> sines[] = {{0, 0}, {0.5, 30}, {1, 90}, {-0.5, -30}, {-1, -90}};
    for (const auto& [sine, angle] : sines) EXPECT_EQ(trig::asin_degrees(sine), angle);
    const std::pair<double, double> cosines[] = {
        {1, 0}, {0.5, 60}, {0, 90}, {-0.5, 120}, {-1, 180}};
    for (const auto& [cosine, angle] : cosines) EXPECT_EQ(trig::acos_degrees(cosine), angle);
    const std::tuple<double, double, double> vectors[] = {
        {1, 1, 45},   {1, -1, 135}, {-1, -1, -135}, {-1, 1, -45}, {1, 0, 90},
        {-1, 0, -90}, {0, -1, 180}, {0, 1, 0},      {0, 0, 0},    {-0.0, -0.0, 0}};
    for (const auto& [y, x, angle] : vectors) EXPECT_EQ(trig::atan2_degrees(y, x), angle);
    EXPECT_TRUE(std::isnan(trig::asin_degrees(1.0000001)));
    EXPECT_TRUE(std::isnan(trig::acos_degrees(-1.0000001)));
    EXPECT_TRUE(std::isnan(trig::acos_degrees(kNaN)));
}

// The sine, from -45 to 45 degrees: turning the rest into radians costs nothing near a zero.
long double sine_of(double degrees) {
    const long double quarters = std::nearbyint(static_cast<long double>(degrees) / 90);
    const long double rest = (static_cast<long double>(degrees) - 90 * quarters) * kDegree;
    const auto quadrant = (static_cast<int64_t>(quarters) % 4 + 4) % 4;
    const long double size = quadrant % 2 == 0 ? std::sin(rest) : std::cos(rest);
    return quadrant < 2 ? size : -size;
}

TEST(TrigDegrees, AreWithinThreeUnits) {
    SplitMix64 random(5);
    for (int i = 0; i < kSamples; ++i) {
        // With 20 bits behind the point, so that x + 90 is exact.
        const double x = std::ldexp(std::round(std::ldexp(sample(random, -8, 20), 20)), -20);
        const long double sine = sine_of(x);
        const long double cosine = sine_of(x + 90);
        ASSERT_LT(ulps(trig::sin_degrees(x), sine), 2) << x;
        ASSERT_LT(ulps(trig::cos_degrees(x), cosine), 2) << x;
        if (cosine != 0) {
            ASSERT_LT(ulps(trig::tan_degrees(x), sine / cosine), 3) << x;
        }
        const double part = random.unit() * 2 - 1;
        const auto wide = static_cast<long double>(part);
        ASSERT_LT(ulps(trig::asin_degrees(part), std::asin(wide) / kDegree), 3) << part;
        ASSERT_LT(ulps(trig::acos_degrees(part), std::acos(wide) / kDegree), 3) << part;
        const double y = sample(random, -40, 40);
        const long double truth =
            std::atan2(static_cast<long double>(y), static_cast<long double>(x)) / kDegree;
        ASSERT_LT(ulps(trig::atan2_degrees(y, x), truth), 3) << y << " " << x;
    }
}

}  // namespace
}  // namespace vagus
