// A plan that runs gets new versions of its files while they are edited (docs/plans.md, P31).
//
//     PlanChange change(plan, path, talk, tell);
//     change.take(order);                   // its answer is told
//     show(change.took(graph));             // at the line of the trace
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "embed/plan_versions.hpp"
#include "record/recording.hpp"
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

    // Is told of files that were saved, before the plan is asked to take what is made of them.
    using Read = std::function<void(const record::FilesSaved& files)>;
    void on_read(Read told) { told_of_read_ = std::move(told); }

    // Files have been saved: what is made of them is to take over.
    void take(const talk::ChangePlan& order);
    // Whether it could take over now, if files had these texts. At once: on the thread of the run,
    // between two decisions.
    enum class Ask { AtOnce, ByTheTalk };
    void check(const talk::CheckPlan& order, Ask how);

    // The trace says so: what the newest version was made of.
    const std::vector<plan::Plan>& took(const plan::Graph& graph) { return versions_.took(graph); }

private:
    embed::PlanVersions::Made read(const std::vector<std::string>& saved);
    void ask(uint64_t request, plan::NewVersion next, bool only_ask,
             std::function<void(bool taken)> then);

    embed::PlanVersions versions_;
    PlanTalk& talk_;
    Tell tell_;
    Read told_of_read_;
};

}  // namespace vagus::serve
