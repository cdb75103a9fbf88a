// A plan that runs gets new versions of its files while they are edited (docs/plans.md, P31).
//
//     PlanChange change(plan, path, talk);
//     if (const auto answer = change.take(told)) tell(*answer);     // else it comes by the talk
//     follower.change(change.took(graph));                          // at the line of the trace
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "embed/plan_versions.hpp"
#include "serve/host/plan_talk.hpp"

namespace vagus::serve {

class PlanChange {
public:
    using Answered = PlanTalk::Answered;
    // The talk is borrowed.
    PlanChange(const embed::LoadedPlan& plan, std::string path, PlanTalk& talk)
        : versions_(plan, std::move(path)), talk_(talk) {}

    // Files have been saved: what is made of them is to take over. An answer that is known at once;
    // else it comes as one of the talk.
    std::optional<Answered> take(const nlohmann::json& told);
    // Whether it could take over now, if files had these texts. At once: on the thread of the run,
    // between two decisions.
    enum class Ask { AtOnce, ByTheTalk };
    std::optional<Answered> check(const nlohmann::json& told, Ask ask) const;

    // The trace says so: what the newest version was made of.
    const std::vector<plan::Plan>& took(const plan::Graph& graph) { return versions_.took(graph); }
    // An answer of the talk.
    void note(const Answered& answered);

private:
    embed::PlanVersions versions_;
    PlanTalk& talk_;
    std::map<uint64_t, const plan::Graph*> asked_;  // by request
};

}  // namespace vagus::serve
