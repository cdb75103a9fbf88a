#include "base/seconds.hpp"

#include <array>
#include <cstdlib>

#include "base/text.hpp"

namespace vagus {

void append_seconds(std::string& to, Time at) {
    constexpr int kDecimals = 6;
    constexpr int64_t kMicroseconds = 1'000'000;  // in one second
    if (at < Time{}) to += '-';
    const int64_t count = std::abs(at.count());
    append_number(to, count / kMicroseconds);
    std::array<char, 1 + kDecimals> rest;
    rest.front() = '.';
    int64_t left = count % kMicroseconds;
    for (size_t i = kDecimals; i > 0; --i) {
        rest[i] = static_cast<char>('0' + left % 10);
        left /= 10;
    }
    to.append(rest.data(), rest.size());
}

std::string seconds_text(Time at) {
    std::string text;
    append_seconds(text, at);
    return text;
}

}  // namespace vagus
