// Sine, cosine and their kin with the same bits on every amd64 machine. The C library chooses its
// code by processor (FMA or not), so that a simulation that used it would differ from machine to
// machine. Only basic operations and the square root, which IEEE 754 defines to the last bit, are
// used here.
//
// Error: below 2 units in the last place. Arguments of sine, cosine and tangent beyond 1.6 million
// radians are first taken modulo the double nearest to 2 pi, which moves them by less than the gap
// between neighbouring doubles there. Not a number in, not a number out; sine, cosine and tangent
// of an infinity are not a number either.
#pragma once

namespace vagus::trig {

constexpr double kPi = 0x1.921fb54442d18p+1;
constexpr double kDegree = kPi / 180;  // rad

double sin(double radians);
double cos(double radians);
double tan(double radians);
// Both at once, the same bits as sin() and cos() for half of the work.
struct SineCosine {
    double sine;
    double cosine;
};
SineCosine sin_cos(double radians);

// The angle of the vector (x, y), -pi to pi; signs of zeros and infinities as in the C library.
double atan2(double y, double x);

// The same in degrees, which are reduced exactly: sine and cosine are 0, 1 and -1 where they should
// be, and a zero is never negative. The tangent of 90 degrees and its like is infinite. The error
// is below 3 units in the last place.
double sin_degrees(double degrees);
double cos_degrees(double degrees);
double tan_degrees(double degrees);
// -1 to 1 only; else not a number.
double asin_degrees(double sine);
double acos_degrees(double cosine);
// 0 if both are 0, whatever their signs.
double atan2_degrees(double y, double x);

double sqrt(double value);

// Length of the vector (x, y), without overflow in between.
double hypot(double x, double y);

}  // namespace vagus::trig
