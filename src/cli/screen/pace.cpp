#include "cli/screen/pace.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vagus::cli {
namespace {

// 0, as fast as it goes, is the last.
constexpr std::array<double, 10> kSpeeds = {0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 0};

double rank(double speed) {
    return speed == 0 ? 1e9 : speed;
}

double faster_than(double speed) {
    const auto next = std::find_if(kSpeeds.begin(), kSpeeds.end(),
                                   [&](double step) { return rank(step) > rank(speed); });
    return next == kSpeeds.end() ? speed : *next;
}

double slower_than(double speed) {
    const auto next = std::find_if(kSpeeds.rbegin(), kSpeeds.rend(),
                                   [&](double step) { return rank(step) < rank(speed); });
    return next == kSpeeds.rend() ? speed : *next;
}

Duration scaled(Duration span, double factor) {
    return Duration(std::llround(static_cast<double>(span.count()) * factor));
}

}  // namespace

std::string Pace::text() const {
    if (speed_ == 0) return "max";
    std::string digits = std::to_string(speed_);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) digits.pop_back();
    return "x" + digits;
}

bool Pace::act(Key key) {
    switch (key) {
        case Key::Pause:
            paused_ = !paused_;
            return true;
        case Key::Faster:
            speed_ = faster_than(speed_);
            break;
        case Key::Slower:
            speed_ = slower_than(speed_);
            break;
        default:
            return false;
    }
    forget();
    return true;
}

Duration Pace::due(Duration real) {
    if (paused_) return {};
    owed_ = std::min(owed_ + scaled(real, speed_), scaled(kBehindMax, std::max(speed_, 1.0)));
    return owed_;
}

Time Pace::end_of(Time before, Duration simulated, Time now) const {
    if (speed_ == 0) return now;
    const Time end = before + scaled(simulated, 1 / speed_);
    return now > end + kBehindMax ? now : end;
}

}  // namespace vagus::cli
