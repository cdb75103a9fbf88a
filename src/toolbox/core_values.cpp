#include "toolbox/core_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "plan/compare.hpp"
#include "run/code.hpp"

namespace vagus::toolbox {

namespace {

constexpr double kSecondsMax = 1e12;

}  // namespace

Duration duration_of(double seconds) {
    if (seconds > kSecondsMax) return run::kNever;
    if (!(seconds > 0)) return Duration{0};
    return Duration{static_cast<int64_t>(std::round(seconds * 1e6))};
}

bool compare(const plan::Value& left, std::string_view op, const plan::Value& right) {
    const Result<bool> holds = plan::compare(left, op, right);
    if (!holds.ok()) throw run::CodeError(holds.error().what);
    return holds.value();
}

std::vector<int16_t> words_of(std::string_view text) {
    std::vector<int16_t> words;
    size_t at = 0;
    while ((at = text.find_first_not_of(' ', at)) != std::string_view::npos) {
        const size_t end = std::min(text.find(' ', at), text.size());
        const std::string_view word = text.substr(at, end - at);
        at = end;
        const std::string_view digits = word.substr(word.starts_with('-') ? 1 : 0);
        const bool plain =
            !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
        const auto value = plain ? plan::int_from_digits(word) : std::nullopt;
        if (!value || *value < INT16_MIN || *value > INT16_MAX) {
            throw run::CodeError(fmt::format(
                "\"{}\" is not an argument of an event: a whole number from -32768 to 32767",
                word));
        }
        if (words.size() == run::kEventArgumentsMax) {
            throw run::CodeError(fmt::format("more than {} arguments", run::kEventArgumentsMax));
        }
        words.push_back(static_cast<int16_t>(*value));
    }
    return words;
}

}  // namespace vagus::toolbox
