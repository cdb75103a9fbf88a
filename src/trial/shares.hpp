// How often something came about among so many tries, what that says of its chance, and whether two
// such shares differ by more than chance.
//
//     const Share before{9, 20}, after{20, 20};
//     const Interval likely = wilson(before);               // 0.26 to 0.66
//     if (chance_of_same(before, after) < 0.01) tell(before, after);
#pragma once

namespace vagus::trial {

struct Share {
    int came = 0;
    int of = 0;
    double value() const { return of == 0 ? 0 : static_cast<double>(came) / of; }
    Share operator+(const Share& other) const { return {came + other.came, of + other.of}; }
    friend bool operator==(const Share&, const Share&) = default;
};

struct Interval {
    double low = 0;
    double high = 1;
};

// In which interval the chance itself is, with 95 % confidence: the score interval of E. B. Wilson,
// "Probable inference, the law of succession, and statistical inference", Journal of the American
// Statistical Association 22 (1927), pages 209 to 212. It stays within 0 to 1, and says something
// also where all or none came. Without a try: 0 to 1.
Interval wilson(const Share& share);

// The probability that two shares of one chance differ as much as these or more: R. A. Fisher's
// exact test, both sides ("Statistical Methods for Research Workers", fifth edition, 1934).
double chance_of_same(const Share& a, const Share& b);

// How much more likely the two shares are with a chance of their own each than with one for both:
// the logarithm, never below 0.
double gain_of_two(const Share& a, const Share& b);

// How much more likely `seen` is with the chance that `a` shows than with that of `b`: the
// logarithm; below 0: less. Half a try is added to each side of both, for none is ever certain.
double in_favour_of(const Share& a, const Share& b, const Share& seen);

}  // namespace vagus::trial
