// Machine's hot change (docs/plans.md, P31): a new version of plans that run takes over.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "plan/machine_parts.hpp"

namespace vagus::plan {

namespace {

bool is_about(const NewVersion& next, const std::string& file) {
    return std::find(next.files.begin(), next.files.end(), file) != next.files.end();
}

}  // namespace

std::vector<std::string> Machine::reasons_against(const NewVersion& next) const {
    if (levels_.empty()) return {"the run has ended or not begun: there is nothing to change"};
    if (changes_.size() >= kChangesMax) {
        return {
            fmt::format("this run has taken {} new versions, the most there can be; stop it "
                        "and start it again",
                        kChangesMax)};
    }
    std::vector<std::string> reasons;
    for (int level = 0; level < depth(); ++level) {
        const GraphPlan* const plan = plan_in(*next.graph, level);
        if (!plan) continue;  // then what called it is missing, or another
        for (std::string& one : plan::reasons_against(underway(level), *plan)) {
            reasons.push_back(std::move(one));
        }
    }
    return reasons;
}

std::vector<std::string> Machine::change(const NewVersion& next, Time now) {
    std::vector<std::string> reasons = reasons_against(next);
    if (!reasons.empty()) return reasons;
    changes_.push_back(next.graph);
    graph_ = next.graph.get();
    bool told = false;
    for (int level = 0; level < depth(); ++level) {
        const std::shared_ptr<const Version> before = at(level).now;
        const GraphPlan& plan = *plan_in(*graph_, level);
        take_version(level, plan);
        if (!is_about(next, plan.file)) continue;
        tell_change(level, *before, now);
        told = true;
    }
    // A plan that does not run now belongs to the outermost.
    if (!told) trace(0, now, PlanChanged{changes_.back()});
    commands_.emplace_back(RankAgain{});
    return {};
}

// What runs at that level, in another version: nullptr if it has no such file.
const GraphPlan* Machine::plan_in(const Graph& graph, int level) const {
    if (level == 0) return &graph.plans.front();
    for (const GraphPlan& plan : graph.plans) {
        if (plan.file == at(level).now->plan->file) return &plan;
    }
    return nullptr;
}

Underway Machine::underway(int level) const {
    const Level& l = at(level);
    Underway underway{.path = l.path, .plan = l.now->plan, .actor = l.active};
    for (const Watch& watch : l.globals) {
        if (watch.id != 0) underway.watching.push_back(watch.of);
    }
    const bool leads = stopping_from_ == level && !l.after.failed && l.after.target >= 0;
    if (leads) underway.on_its_way_to = target_name(level, l.after.target);
    return underway;
}

// Variables that were there before are the same ones, shared ones those of the caller's newest
// version; others begin with their initial value.
std::shared_ptr<Machine::Version> Machine::make_version(int level, const GraphPlan& plan,
                                                        const Version* before) const {
    auto version = std::make_shared<Version>(Version{&plan, {}});
    std::vector<int> callers(plan.variables.size(), -1);
    if (level > 0) {
        for (const auto& [slot, outer] : at(level - 1).newest->shared) {
            callers[static_cast<size_t>(slot)] = outer;
        }
    }
    for (size_t i = 0; i < plan.variables.size(); ++i) {
        const GraphVariable& variable = plan.variables[i];
        const int kept = before ? find_variable(*before->plan, variable.name) : -1;
        if (callers[i] >= 0) {
            version->cells.push_back(at(level - 1).now->cells[static_cast<size_t>(callers[i])]);
        } else if (kept >= 0) {
            version->cells.push_back(before->cells[static_cast<size_t>(kept)]);
        } else {
            version->cells.push_back(std::make_shared<Value>(variable.initial));
        }
    }
    return version;
}

void Machine::take_version(int level, const GraphPlan& plan) {
    Level& l = at(level);
    const bool leads = stopping_from_ == level && !l.after.failed && l.after.target >= 0;
    if (leads) l.after.target = find_actor(plan, target_name(level, l.after.target));
    l.now = make_version(level, plan, l.now.get());
    l.newest = &plan.actors[static_cast<size_t>(find_actor(plan, l.active->name))];
    for (Watch& watch : l.own) {
        if (watch.id == 0) continue;
        const int index = find_supervisor(l.newest->supervisors, watch.of->name);
        watch.newest = &l.newest->supervisors[static_cast<size_t>(index)];
    }
    take_globals(level, plan);
}

// Those that watch or rest go on so; new ones start, but not in a plan whose supervisors have been
// stopped because it is being ended.
void Machine::take_globals(int level, const GraphPlan& plan) {
    Level& l = at(level);
    std::vector<Watch> before = std::exchange(l.globals, std::vector<Watch>(plan.globals.size()));
    const auto find_before = [&before](const std::string& name) {
        return std::find_if(before.begin(), before.end(), [&name](const Watch& watch) {
            return watch.of && watch.of->name == name;
        });
    };
    const bool ends = stopping_from_ >= 0 && level > stopping_from_;
    for (size_t i = 0; i < plan.globals.size(); ++i) {
        const auto known = find_before(plan.globals[i].name);
        const int index = static_cast<int>(i);
        if (known != before.end()) {
            l.globals[i] = std::move(*known);
            l.globals[i].index = index;
            l.globals[i].newest = &plan.globals[i];
        } else if (!ends) {
            start_watch(level, true, index);
        }
    }
}

void Machine::tell_change(int level, const Version& before, Time now) {
    trace(level, now, PlanChanged{changes_.back()});
    const Version& version = *at(level).now;
    for (size_t i = 0; i < version.plan->variables.size(); ++i) {
        const GraphVariable& variable = version.plan->variables[i];
        const bool callers = level > 0 && variable.access == Access::Shared;
        if (callers || find_variable(*before.plan, variable.name) >= 0) continue;
        trace(level, now, VariableWritten{variable.name, *version.cells[i], "change"});
    }
}

}  // namespace vagus::plan
