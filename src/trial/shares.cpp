#include "trial/shares.hpp"

#include <algorithm>
#include <cmath>

namespace vagus::trial {

namespace {

constexpr double kZ = 1.959963984540054;  // of the normal distribution, 95 % within

double log_choose(int n, int k) {
    return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
}

// Of the most likely chance; 0 log 0 is 0.
double log_likelihood(const Share& share) {
    const double chance = share.value();
    double sum = 0;
    if (share.came > 0) sum += share.came * std::log(chance);
    if (share.came < share.of) sum += (share.of - share.came) * std::log1p(-chance);
    return sum;
}

}  // namespace

Interval wilson(const Share& share) {
    if (share.of == 0) return {};
    const double n = share.of;
    const double p = share.value();
    const double scale = 1 / (1 + kZ * kZ / n);
    const double middle = scale * (p + kZ * kZ / (2 * n));
    const double half = scale * kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n));
    // With none or all the bound is 0 or 1, which the arithmetic only comes close to.
    return {share.came == 0 ? 0 : std::max(0.0, middle - half),
            share.came == share.of ? 1 : std::min(1.0, middle + half)};
}

double chance_of_same(const Share& a, const Share& b) {
    const int came = a.came + b.came;
    const int of = a.of + b.of;
    const auto log_chance = [&](int of_a) {
        return log_choose(a.of, of_a) + log_choose(b.of, came - of_a) - log_choose(of, came);
    };
    // What is as likely as what was seen counts, though its last digits are others.
    const double seen = log_chance(a.came) + 1e-7;
    double sum = 0;
    for (int i = std::max(0, came - b.of); i <= std::min(a.of, came); ++i) {
        const double one = log_chance(i);
        if (one <= seen) sum += std::exp(one);
    }
    return std::min(1.0, sum);
}

double gain_of_two(const Share& a, const Share& b) {
    return std::max(0.0, log_likelihood(a) + log_likelihood(b) - log_likelihood(a + b));
}

double in_favour_of(const Share& a, const Share& b, const Share& seen) {
    const auto chance = [](const Share& share) { return (share.came + 0.5) / (share.of + 1.0); };
    const int not_seen = seen.of - seen.came;
    return seen.came * std::log(chance(a) / chance(b)) +
           not_seen * std::log((1 - chance(a)) / (1 - chance(b)));
}

}  // namespace vagus::trial
