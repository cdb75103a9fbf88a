#include "plan/guess.hpp"

#include <fmt/format.h>

#include "base/nearest.hpp"
#include "base/text.hpp"

namespace vagus::plan {

std::string hint(std::string_view word, const std::vector<std::string_view>& known) {
    if (known.size() > kGuessAmongMax) return "";
    const std::string near = nearest(word, known);
    if (!near.empty()) return fmt::format("; did you mean \"{}\"?", near);
    if (known.empty() || known.size() > 20) return "";
    return fmt::format("; there {} {}", known.size() == 1 ? "is" : "are", list_of(known));
}

std::string unit_hint(std::string_view error, std::string_view unit) {
    if (unit.empty() || !error.ends_with(fmt::format("found \"{}\"", unit))) return "";
    return fmt::format("; write the number without its unit, it counts in {} already", unit);
}

std::optional<Meant> meant_by(std::string_view word, const std::vector<std::string_view>& known) {
    if (known.size() > kGuessAmongMax) return std::nullopt;
    std::string near = nearest(word, known);
    if (near.empty()) return std::nullopt;
    return Meant{std::string(word), std::move(near)};
}

std::optional<Meant> key_meant_by(std::string_view key,
                                  const std::vector<std::string_view>& known) {
    auto meant = meant_by(key, known);
    if (meant) meant->is_key = true;
    return meant;
}

}  // namespace vagus::plan
