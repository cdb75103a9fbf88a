#include "tests/plans/trace_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace vagus {

void TraceRules::complain(const plan::TraceEvent& event, const std::string& what) {
    breaches_.push_back(what + ": " + plan::format_trace(event));
}

// Of an instance path.
const plan::GraphPlan& TraceRules::plan_of(const std::string& path) const {
    const plan::GraphPlan* plan = &graph_->plans.front();
    const auto names = split(path, '/');
    for (size_t i = 1; i < names.size(); ++i) {
        const auto actor = static_cast<size_t>(plan::find_actor(*plan, names[i]));
        plan = &graph_->plans[static_cast<size_t>(plan->actors[actor].sub_plan)];
    }
    return *plan;
}

bool TraceRules::is_computation(const std::string& path, std::string_view actor) const {
    const plan::GraphPlan& plan = plan_of(path);
    const auto index = static_cast<size_t>(plan::find_actor(plan, actor));
    const plan::Template* of = plan.actors[index].of;
    return of && of->kind == plan::Kind::Computation;
}

// An activation that began, or was over before it could.
void TraceRules::note_activation(const plan::TraceEvent& event, std::string_view actor,
                                 uint64_t activation) {
    auto& resting = plans_[event.plan].resting;
    std::erase_if(resting, [activation](const auto& one) {
        return one.second.remedy != 0 && activation > one.second.remedy;
    });
    for (auto& [supervisor, rest] : resting) {
        const bool follows = rest.remedy == 0 && activation > rest.since;
        if (follows && !is_computation(event.plan, actor)) rest.remedy = activation;
    }
}

void TraceRules::note_raised(const plan::TraceEvent& event, const plan::EventRaised& raised) {
    auto& resting = plans_[event.plan].resting;
    const std::string supervisor(raised.supervisor);
    const auto found = resting.find(supervisor);
    if (raised.global && found != resting.end()) {
        const Rest& rest = found->second;
        const bool is_later = rest.remedy != 0 && raised.activation > rest.remedy;
        if (!is_later) complain(event, "a global supervisor raised while it rests");
        resting.erase(found);
    }
    const bool rests = raised.global && raised.target != plan::kIgnore;
    if (rests) resting[supervisor] = {.since = raised.activation, .remedy = 0};
}

// A global supervisor that is gone rests no longer: one of that name that comes later is new.
void TraceRules::note_change(const plan::TraceEvent& event,
                             std::shared_ptr<const plan::Graph> graph) {
    changed_ = std::move(graph);
    graph_ = changed_.get();
    const plan::GraphPlan& plan = plan_of(event.plan);
    std::erase_if(plans_[event.plan].resting, [&plan](const auto& one) {
        return plan::find_supervisor(plan.globals, one.first) < 0;
    });
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
        note_activation(event, e->actor, e->activation);
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
        if (!e3->ran) note_activation(event, e3->actor, e3->activation);
    } else if (const auto* e4 = std::get_if<plan::EventRaised>(&event.what)) {
        if (over_.contains(e4->activation)) complain(event, "an event for what is over");
        note_raised(event, *e4);
        plan.writer = e4->target == "@ignore" ? std::string() : std::string(e4->supervisor);
    } else if (const auto* e5 = std::get_if<plan::VariableWritten>(&event.what)) {
        const bool from_outside = e5->by == "initial" || e5->by == "outside" || e5->by == "change";
        if (!from_outside && e5->by != plan.writer) complain(event, "a loser wrote");
    } else if (const auto* e6 = std::get_if<plan::PlanChanged>(&event.what)) {
        note_change(event, e6->graph);
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
