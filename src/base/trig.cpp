// Trigonometry from basic operations: argument reduction in several words, then Taylor polynomials
// on short intervals. This file is compiled with -ffp-contract=off: a fused multiply-add would
// change the bits.
#include "base/trig.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace vagus::trig {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// pi / 2 in four parts; the first three have 33 bits, so that their products with n below 2^20 are
// exact.
constexpr std::array<double, 4> kHalfPi = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69,
                                           0x1.b839a252049c1p-104};
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
constexpr double kTwoPi = 2 * kPi;
constexpr double kPiLow = 0x1.1a62633145c07p-53;  // pi - kPi
constexpr double kReduceMax = 0x1p20;             // multiples of pi / 2
// Adding and subtracting this rounds a double below 2^51 to a whole number.
constexpr double kRounder = 0x1.8p52;

// A value as a sum of two doubles, the second below half a unit of the first.
struct Pair {
    double high;
    double low;
};

// The exact sum of two doubles (Knuth).
Pair two_sum(double a, double b) {
    const double sum = a + b;
    const double part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}

struct Reduced {
    Pair angle;  // -pi/4 to pi/4
    int quadrant;
};

// `radians` modulo 2 pi, for |radians| beyond kReduceMax quarter turns. Each difference is exact
// (Sterbenz).
double wrap_large(double radians) {
    double rest = std::fabs(radians);
    double period = kTwoPi;
    while (period <= rest / 2) period *= 2;
    for (; period >= kTwoPi; period /= 2)
        if (rest >= period) rest -= period;
    return radians < 0 ? -rest : rest;
}

Reduced reduce(double radians) {
    if (std::fabs(radians) > kReduceMax * 1.5) radians = wrap_large(radians);
    const double n = (radians * kTwoOverPi + kRounder) - kRounder;
    const Pair first = two_sum(radians - n * kHalfPi[0], -(n * kHalfPi[1]));
    const Pair second = two_sum(first.high, -(n * kHalfPi[2]));
    const double tail = (first.low + second.low) - n * kHalfPi[3];
    const double high = second.high + tail;
    return {{high, (second.high - high) + tail}, static_cast<int>(static_cast<int64_t>(n) & 3)};
}

constexpr Pair kDegree = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};   // pi / 180
constexpr Pair kRadian = {0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49};  // 180 / pi

// A double as two with 26 bits each at most, whose products are exact (Veltkamp).
Pair split(double value) {
    const double spread = value * 0x1.000002p+27;
    const double high = spread - (spread - value);
    return {high, value - high};
}

// The exact product (Dekker).
Pair product(double a, double b) {
    const double most = a * b;
    const Pair x = split(a);
    const Pair y = split(b);
    const double rest =
        ((x.high * y.high - most) + x.high * y.low + x.low * y.high) + x.low * y.low;
    return {most, rest};
}

Pair product(const Pair& a, const Pair& b) {
    const Pair most = product(a.high, b.high);
    return two_sum(most.high, most.low + (a.high * b.low + a.low * b.high));
}

// Every step is exact but the last, from degrees to radians.
Reduced reduce_degrees(double degrees) {
    const double turn = std::fmod(degrees, 360);
    const double n = (turn / 90 + kRounder) - kRounder;
    const double rest = turn - 90 * n;
    return {product({rest, 0}, kDegree), static_cast<int>(static_cast<int64_t>(n) & 3)};
}

// 1/3!, 1/5!, … with signs: sin x = x + x^3 (kSine[0] + x^2 (kSine[1] + …)).
constexpr std::array<double, 8> kSine = {-1.0 / 6,
                                         1.0 / 120,
                                         -1.0 / 5040,
                                         1.0 / 362880,
                                         -1.0 / 39916800.0,
                                         1.0 / 6227020800.0,
                                         -1.0 / 1307674368000.0,
                                         1.0 / 355687428096000.0};
// 1/4!, 1/6!, … with signs: cos x = 1 - x^2 / 2 + x^4 (kCosine[0] + …).
constexpr std::array<double, 7> kCosine = {
    1.0 / 24,          -1.0 / 720,           1.0 / 40320,           -1.0 / 3628800,
    1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0};
// 1/3, 1/5, … with signs, for |x| up to 1/16.
constexpr std::array<double, 7> kArc = {-1.0 / 3,  1.0 / 5,  -1.0 / 7, 1.0 / 9,
                                        -1.0 / 11, 1.0 / 13, -1.0 / 15};

template <size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
    double sum = coefficients[N - 1];
    for (size_t i = N - 1; i-- > 0;) sum = coefficients[i] + x * sum;
    return sum;
}

double sine_of(const Pair& x) {
    const double square = x.high * x.high;
    const double correction = square * x.high * polynomial(kSine, square);
    return x.high + (correction + x.low * (1 - square / 2));
}

double cosine_of(const Pair& x) {
    const double square = x.high * x.high;
    const double half = square / 2;
    const double most = 1 - half;
    const double rest = (1 - most) - half;  // what `most` lost in rounding, exactly
    return most + (rest + (square * square * polynomial(kCosine, square) - x.high * x.low));
}

double sine_in(const Reduced& x) {
    const double value = x.quadrant % 2 == 0 ? sine_of(x.angle) : cosine_of(x.angle);
    return x.quadrant < 2 ? value : -value;
}

double cosine_in(const Reduced& x) {
    const double value = x.quadrant % 2 == 0 ? cosine_of(x.angle) : sine_of(x.angle);
    return x.quadrant == 0 || x.quadrant == 3 ? value : -value;
}

// atan(k / 8), k = 0 … 8.
constexpr std::array<Pair, 9> kArcTable = {{{0, 0},
                                            {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                            {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                            {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                            {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                            {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                            {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                            {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                            {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};

// small - factor * large without the rounding of the product: `large` is split so that both
// products are exact.
double difference(double small, double factor, double large) {
    const double spread = large * 0x1.000001p+28;
    const double high = spread - (spread - large);
    return (small - factor * high) - factor * (large - high);
}

// atan(small / large), 0 <= small <= large, neither of them near the ends of the range of a double.
Pair first_octant(double small, double large) {
    const double ratio = small / large;
    const auto k = static_cast<size_t>(ratio * 8 + 0.5);
    const double factor = static_cast<double>(k) / 8;
    const double rest =
        k == 0 ? ratio : difference(small, factor, large) / (large + factor * small);
    const double square = rest * rest;
    const double series = rest + rest * square * polynomial(kArc, square);
    const Pair sum = two_sum(kArcTable[k].high, series);
    return {sum.high, sum.low + kArcTable[k].low};
}

double largest_of(double a, double b) {
    return a > b ? a : b;
}

// A power of two that brings the larger of two lengths, both finite, to where squares neither
// overflow nor vanish.
double scale_for(double largest) {
    if (largest > 0x1p+500) return 0x1p-600;
    if (largest < 0x1p-400) return 0x1p+600;
    return 1;
}

bool is_nan(double value) {
    return value != value;
}

double with_sign_of(double magnitude, double sign) {
    return std::copysign(magnitude, sign);
}

// atan2 for |y| and |x|, not both zero: 0 to pi/2.
Pair first_quadrant(double y, double x) {
    if (y == kInfinity || x == kInfinity) {
        y = y == kInfinity ? 1 : 0;
        x = x == kInfinity ? 1 : 0;
    }
    const double scale = scale_for(largest_of(y, x));
    if (y <= x) return first_octant(y * scale, x * scale);
    const Pair rest = first_octant(x * scale, y * scale);
    const Pair angle = two_sum(kPi / 2, -rest.high);
    return {angle.high, angle.low + (kPiLow / 2 - rest.low)};
}

}  // namespace

double sin(double radians) {
    if (is_nan(radians) || std::fabs(radians) == kInfinity) return kNaN;
    if (std::fabs(radians) < 0x1p-27) return radians;  // also keeps the sign of zero
    return sine_in(reduce(radians));
}

double cos(double radians) {
    if (is_nan(radians) || std::fabs(radians) == kInfinity) return kNaN;
    return cosine_in(reduce(radians));
}

SineCosine sin_cos(double radians) {
    if (is_nan(radians) || std::fabs(radians) == kInfinity) return {kNaN, kNaN};
    const Reduced x = reduce(radians);
    const double sine = sine_of(x.angle);
    const double cosine = cosine_of(x.angle);
    const bool even = x.quadrant % 2 == 0;
    const double up = even ? sine : cosine;
    const double right = even ? cosine : sine;
    return {std::fabs(radians) < 0x1p-27 ? radians : (x.quadrant < 2 ? up : -up),
            x.quadrant == 0 || x.quadrant == 3 ? right : -right};
}

double tan(double radians) {
    if (is_nan(radians) || std::fabs(radians) == kInfinity) return kNaN;
    if (std::fabs(radians) < 0x1p-27) return radians;
    const Reduced x = reduce(radians);
    const double sine = sine_of(x.angle);
    const double cosine = cosine_of(x.angle);
    return x.quadrant % 2 == 0 ? sine / cosine : -cosine / sine;
}

double atan2(double y, double x) {
    if (is_nan(y) || is_nan(x)) return kNaN;
    const bool left = std::signbit(x);
    if (y == 0 && (x == 0 || !left)) return with_sign_of(left ? kPi : 0, y);
    const Pair acute = first_quadrant(std::fabs(y), std::fabs(x));
    if (!left) return with_sign_of(acute.high + acute.low, y);
    const Pair obtuse = two_sum(kPi, -acute.high);
    return with_sign_of(obtuse.high + (obtuse.low + (kPiLow - acute.low)), y);
}

double sin_degrees(double degrees) {
    if (is_nan(degrees) || std::fabs(degrees) == kInfinity) return kNaN;
    return sine_in(reduce_degrees(degrees)) + 0.0;  // no negative zero
}

double cos_degrees(double degrees) {
    if (is_nan(degrees) || std::fabs(degrees) == kInfinity) return kNaN;
    return cosine_in(reduce_degrees(degrees)) + 0.0;
}

double tan_degrees(double degrees) {
    if (is_nan(degrees) || std::fabs(degrees) == kInfinity) return kNaN;
    const double turn = std::fmod(degrees, 180);
    if (std::fabs(turn) == 90) return kInfinity;
    if (std::fabs(turn) == 45) return turn < 0 ? -1 : 1;
    if (std::fabs(turn) == 135) return turn < 0 ? 1 : -1;
    const Reduced x = reduce_degrees(degrees);
    return sine_in(x) / cosine_in(x) + 0.0;
}

double asin_degrees(double sine) {
    if (!(std::fabs(sine) <= 1)) return kNaN;
    const double size = std::fabs(sine);
    const Pair angle = first_quadrant(size, std::sqrt((1 - size) * (1 + size)));
    return with_sign_of(product(angle, kRadian).high, sine);
}

double acos_degrees(double cosine) {
    if (!(std::fabs(cosine) <= 1)) return kNaN;
    return atan2_degrees(std::sqrt((1 - cosine) * (1 + cosine)), cosine);
}

double atan2_degrees(double y, double x) {
    if (is_nan(y) || is_nan(x)) return kNaN;
    if (y == 0 && x == 0) return 0;
    const Pair acute = product(first_quadrant(std::fabs(y), std::fabs(x)), kRadian);
    if (!std::signbit(x)) return with_sign_of(acute.high, y);
    const Pair obtuse = two_sum(180, -acute.high);
    return with_sign_of(obtuse.high + (obtuse.low - acute.low), y);
}

double sqrt(double value) {
    return std::sqrt(value);
}

double hypot(double x, double y) {
    if (std::fabs(x) == kInfinity || std::fabs(y) == kInfinity) return kInfinity;
    if (is_nan(x) || is_nan(y)) return kNaN;
    const double scale = scale_for(largest_of(std::fabs(x), std::fabs(y)));
    const double across = x * scale;
    const double up = y * scale;
    return std::sqrt(across * across + up * up) / scale;
}

}  // namespace vagus::trig
