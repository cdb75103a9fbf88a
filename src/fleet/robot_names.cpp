#include "fleet/robot_names.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <tuple>

#include "base/text.hpp"

namespace vagus::fleet {
namespace {

struct Counted {
    std::string_view front;
    std::optional<uint32_t> number;  // without zeros in front, so that it is written as it was
};

Counted counted(std::string_view name) {
    const size_t front = name.find_last_not_of("0123456789") + 1;  // 0: there are only digits
    const std::string_view digits = name.substr(front);
    uint32_t number = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = read.ec == std::errc() && read.ptr == digits.data() + digits.size();
    if (!whole || (digits.size() > 1 && digits.front() == '0')) return {name, std::nullopt};
    return {name.substr(0, front), number};
}

}  // namespace

std::vector<std::string> names_in(const std::string& text) {
    const size_t dots = text.find("..");
    if (dots == std::string::npos) return {text};
    const Counted first = counted(std::string_view(text).substr(0, dots));
    const Counted last = counted(std::string_view(text).substr(dots + 2));
    const bool is_range = first.number && last.number && first.front == last.front &&
                          *first.number <= *last.number &&
                          *last.number - *first.number < kNamesInRangeMax;
    if (!is_range) return {text};
    std::vector<std::string> names;
    for (uint32_t i = *first.number; i <= *last.number; ++i) {
        names.push_back(std::string(first.front) + std::to_string(i));
    }
    return names;
}

std::string no_range(const std::string& text) {
    return fmt::format(
        "{}: expected two numbers, the smaller one first, at most {} robots, as t1..t30",
        visible(text), kNamesInRangeMax);
}

bool counted_before(std::string_view one, std::string_view other) {
    const Counted a = counted(one), b = counted(other);
    return std::tie(a.front, a.number, one) < std::tie(b.front, b.number, other);
}

}  // namespace vagus::fleet
