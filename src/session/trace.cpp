#include "session/trace.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "base/json.hpp"
#include "base/seconds.hpp"

namespace vagus::session {
namespace {

// The fewest digits that read back as the same number (plans.md P10); after rounding to millionths
// and below 1e16 always in plain form.
std::string shortest(double value) {
    std::array<char, 400> text{};
    const double rounded = std::round(value * 1e6) / 1e6;
    const double unsigned_zero = rounded == 0 ? 0 : rounded;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), unsigned_zero,
                                   std::chars_format::fixed);
    return {text.data(), end.ptr};
}

}  // namespace

TraceLine::TraceLine(Time at, std::string_view kind)
    : line_("{\"t\":" + seconds_text(at) + ",\"kind\":" + json_quote(kind)) {}

void TraceLine::key(std::string_view name) {
    line_ += "," + json_quote(name) + ":";
}

TraceLine& TraceLine::text(std::string_view name, std::string_view value) {
    key(name);
    line_ += json_quote(value);
    return *this;
}

TraceLine& TraceLine::number(std::string_view name, int64_t value) {
    key(name);
    line_ += std::to_string(value);
    return *this;
}

TraceLine& TraceLine::real(std::string_view name, double value) {
    key(name);
    line_ += shortest(value);
    return *this;
}

TraceLine& TraceLine::words(std::string_view name, std::span<const int16_t> values) {
    key(name);
    line_ += '[';
    for (size_t i = 0; i < values.size(); i++) {
        if (i > 0) line_ += ',';
        line_ += std::to_string(values[i]);
    }
    line_ += ']';
    return *this;
}

std::string TraceLine::done() const {
    return line_ + "}\n";
}

}  // namespace vagus::session
