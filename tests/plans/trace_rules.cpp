#include "tests/plans/trace_rules.hpp"

#include <fmt/format.h>

namespace vagus {

void TraceRules::complain(const plan::TraceEvent& event, const std::string& what) {
    breaches_.push_back(what + ": " + plan::format_trace(event));
}

void TraceRules::see(const plan::TraceEvent& event) {
    if (event.at.count() < last_us_) complain(event, "time ran backwards");
    last_us_ = event.at.count();
    if (ended_) complain(event, "after the end of the run");
    const bool starts = std::holds_alternative<plan::PlanStarted>(event.what);
    if (starts == plans_.contains(event.plan)) {
        complain(event, starts ? "a plan that runs was started" : "a plan that does not run");
        return;
    }
    Running& plan = plans_[event.plan];
    if (const auto* e = std::get_if<plan::ActorStarted>(&event.what)) {
        // P14: one active actor in each plan; its callers' actors run it.
        if (plan.active != 0) complain(event, "two actors active");
        if (e->activation <= highest_ && e->activation <= plan.last_begun) {
            complain(event, "an activation began twice");
        }
        plan.active = plan.last_begun = e->activation;
        highest_ = std::max(highest_, e->activation);
        plan.writer.clear();
    } else if (const auto* e2 = std::get_if<plan::ActorEnded>(&event.what)) {
        if (plan.active != e2->activation) complain(event, "an actor ended that did not run");
        if (!over_.insert(e2->activation).second) complain(event, "two winners");
        plan.active = 0;
        plan.writer = e2->actor;
    } else if (const auto* e3 = std::get_if<plan::ActorInterrupted>(&event.what)) {
        if (e3->ran != (plan.active == e3->activation)) complain(event, "ran is wrong");
        if (!over_.insert(e3->activation).second) complain(event, "two winners");
        plan.active = 0;
        plan.writer.clear();
    } else if (const auto* e4 = std::get_if<plan::EventRaised>(&event.what)) {
        if (over_.contains(e4->activation)) complain(event, "an event for what is over");
        plan.writer = e4->target == "@ignore" ? std::string() : std::string(e4->supervisor);
    } else if (const auto* e5 = std::get_if<plan::VariableWritten>(&event.what)) {
        const bool from_outside = e5->by == "initial" || e5->by == "outside";
        if (!from_outside && e5->by != plan.writer) complain(event, "a loser wrote");
    } else if (std::holds_alternative<plan::ErrorFound>(event.what)) {
        plan.writer.clear();
        plan.active = 0;
    } else if (std::holds_alternative<plan::PlanEnded>(event.what)) {
        for (const auto& [path, other] : plans_) {
            if (path.starts_with(event.plan + "/")) complain(event, "ended before its inner plan");
        }
        plans_.erase(event.plan);
        ended_ = plans_.empty();
    }
}

const std::vector<std::string>& TraceRules::finish() {
    if (!ended_) breaches_.push_back("the run has no end");
    return breaches_;
}

}  // namespace vagus
