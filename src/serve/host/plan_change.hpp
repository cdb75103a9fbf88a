// A plan that runs gets new versions of its files while they are edited (docs/plans.md, P31).
//
//     PlanChange change(plan, path, talk, tell);
//     change.take(told);                                            // its answer is told
//     follower.change(change.took(graph));                          // at the line of the trace
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "embed/plan_versions.hpp"
#include "serve/host/plan_talk.hpp"

namespace vagus::serve {

class PlanChange {
public:
    struct Answer {
        uint64_t request = 0;
        std::string why;                                  // why there is none; empty: there is
        std::optional<std::vector<std::string>> reasons;  // against the new version; none: it fits
    };
    using Tell = std::function<void(const Answer& answer)>;

    // The talk is borrowed. `tell` gets one answer to each request, at once or when the plan comes
    // to it.
    PlanChange(const embed::LoadedPlan& plan, std::string path, PlanTalk& talk, Tell tell)
        : versions_(plan, std::move(path)), talk_(talk), tell_(std::move(tell)) {}

    // Files have been saved: what is made of them is to take over.
    void take(const nlohmann::json& told);
    // Whether it could take over now, if files had these texts. At once: on the thread of the run,
    // between two decisions.
    enum class Ask { AtOnce, ByTheTalk };
    void check(const nlohmann::json& told, Ask ask);

    // The trace says so: what the newest version was made of.
    const std::vector<plan::Plan>& took(const plan::Graph& graph) { return versions_.took(graph); }

private:
    void ask(uint64_t request, plan::NewVersion next, bool only_ask,
             std::function<void(bool taken)> then);

    embed::PlanVersions versions_;
    PlanTalk& talk_;
    Tell tell_;
};

}  // namespace vagus::serve
