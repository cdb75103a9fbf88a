// Whether a robot is well after a roll-out: its project's own condition (docs/fleet.md, "Well") was
// true for as long as it says. Told the time; what names of the condition stand for is handed in.
//
//     HealthWatch watch({"battery > 20", 5s}, [&](const auto& name) { return read(name); });
//     watch.tick(now);
//     if (!watch.is_well()) show(watch.why());
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "fleet/project_part.hpp"
#include "plan/word_formula.hpp"

namespace vagus::serve {

class HealthWatch {
public:
    // The Error says why nobody knows it now.
    using Read = std::function<Result<plan::Value>(const plan::WordFormula::Name& name)>;
    HealthWatch(const fleet::Healthy& healthy, Read read);

    // Looks each kConditionEvery: between two looks nobody sees that it was not true.
    void tick(Time now);
    Time next_tick() const { return is_well_ ? Time::max() : next_; }

    bool is_well() const { return is_well_; }
    // What it lacks, with the values that it was made of; of one that is well what was true.
    const std::string& why() const { return why_; }

private:
    struct Look {
        bool holds = false;
        std::string values;  // "battery = 12"; or why there are none
    };
    Look look() const;

    Result<plan::WordFormula> formula_;
    const Duration lasts_;
    const Read read_;
    Time next_ = Time::min();
    std::optional<Time> true_since_;
    bool is_well_ = false;
    std::string why_;
};

}  // namespace vagus::serve
