// Lines of `sim --trace` (docs/formats.md, "Outputs"): one JSON object a line, keys in a fixed
// order, no spaces.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/time.hpp"

namespace vagus::session {

class TraceLine {
public:
    TraceLine(Time at, std::string_view kind);
    TraceLine& text(std::string_view key, std::string_view value);
    TraceLine& number(std::string_view key, int64_t value);
    // Rounded to millionths: what is smaller says nothing about a robot.
    TraceLine& real(std::string_view key, double value);
    TraceLine& words(std::string_view key, std::span<const int16_t> values);
    // With its newline.
    std::string done() const;

private:
    void key(std::string_view name);
    std::string line_;
};

}  // namespace vagus::session
