#include "serve/field/health_watch.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "fleet/limits.hpp"

namespace vagus::serve {

HealthWatch::HealthWatch(const fleet::Healthy& healthy, Read read)
    : formula_(plan::WordFormula::parse(healthy.condition)),
      lasts_(healthy.lasts),
      read_(std::move(read)) {}

HealthWatch::Look HealthWatch::look() const {
    if (!formula_.ok()) return {false, formula_.error().what};
    std::vector<plan::Value> values;
    std::string words;
    for (const plan::WordFormula::Name& name : formula_.value().names()) {
        auto value = read_(name);
        if (!value.ok()) return {false, value.error().what};
        words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", name.shown,
                             plan::in_words(value.value()));
        values.push_back(std::move(value.value()));
    }
    const auto holds = formula_.value().holds(values);
    if (!holds.ok()) return {false, fmt::format("{}; {}", holds.error().what, words)};
    return {holds.value(), std::move(words)};
}

void HealthWatch::tick(Time now) {
    if (is_well_ || now < next_) return;
    next_ = now + fleet::kConditionEvery;
    const Look seen = look();
    if (!seen.holds) {
        true_since_.reset();
    } else if (!true_since_) {
        true_since_ = now;
    }
    is_well_ = true_since_ && now - *true_since_ >= lasts_;
    const std::string lasts = fmt::format("{} s", seconds_of(lasts_));
    const std::string how = is_well_     ? "was true for " + lasts
                            : seen.holds ? "is true, but not yet for " + lasts
                                         : "is not true";
    const std::string condition = formula_.ok() ? formula_.value().text() : "";
    const std::string all = fmt::format("its condition {} {}{}{}", condition, how,
                                        seen.values.empty() ? "" : ": ", seen.values);
    why_ = utf8_prefix(visible_lines(all), fleet::kLineBytesMax);
}

}  // namespace vagus::serve
