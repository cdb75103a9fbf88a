// A plan that runs gets new versions of its files while they are edited (docs/plans.md, P31).
//
//     PlanChange change(plan, path, talk, tell);
//     change.take(order);                   // its answer is told
//     show(change.took(graph));             // at the line of the trace
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "embed/plan_versions.hpp"
#include "serve/runner/plan_talk.hpp"
#include "serve/talk/news.hpp"
#include "serve/talk/orders.hpp"

namespace vagus::serve {

class PlanChange {
public:
    using Tell = std::function<void(const talk::Answer& answer)>;

    // The talk is borrowed. `tell` gets one answer to each request, at once or when the plan comes
    // to it.
    PlanChange(const embed::LoadedPlan& plan, std::string path, PlanTalk& talk, Tell tell)
        : versions_(plan, std::move(path)), talk_(talk), tell_(std::move(tell)) {}

    // Files have been saved: what is made of them is to take over.
    void take(const talk::ChangePlan& order);
    // Whether it could take over now, if files had these texts. At once: on the thread of the run,
    // between two decisions.
    enum class Ask { AtOnce, ByTheTalk };
    void check(const talk::CheckPlan& order, Ask how);

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
