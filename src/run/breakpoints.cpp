#include "run/breakpoints.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/nearest.hpp"

namespace vagus::run {

namespace {

// "the plan A has no actor "x"; did you mean y?"
Error no_such(std::string_view whose, std::string_view what, std::string_view name,
              const std::vector<std::string>& known) {
    return {Code::NotFound,
            fmt::format("{} has no {} \"{}\"; {}", whose, what, name, known_instead(name, known))};
}

std::vector<const plan::GraphSupervisor*> supervisors_of(const plan::GraphPlan& plan) {
    std::vector<const plan::GraphSupervisor*> all;
    for (const auto& supervisor : plan.globals) all.push_back(&supervisor);
    for (const auto& actor : plan.actors) {
        for (const auto& supervisor : actor.supervisors) all.push_back(&supervisor);
    }
    return all;
}

Status check_outcome(std::string_view whose, std::string_view what, const std::string& name,
                     const std::vector<std::string>& known) {
    const bool there = std::find(known.begin(), known.end(), name) != known.end();
    if (name.empty() || there) return Status::done();
    return no_such(whose, what, name, known);
}

Status check_actor(const Breakpoint& breakpoint, const plan::GraphPlan& plan) {
    std::vector<std::string> known;
    for (const plan::GraphActor& actor : plan.actors) {
        known.push_back(actor.name);
        if (actor.name == breakpoint.element) {
            return check_outcome("the actor " + actor.name, "state", breakpoint.outcome,
                                 actor.states);
        }
    }
    return no_such("the plan " + plan.name, "actor", breakpoint.element, known);
}

Status check_supervisor(const Breakpoint& breakpoint, const plan::GraphPlan& plan) {
    std::vector<std::string> known;
    for (const plan::GraphSupervisor* supervisor : supervisors_of(plan)) {
        known.push_back(supervisor->name);
        if (supervisor->name != breakpoint.element) continue;
        std::vector<std::string> events;
        for (const plan::Outcome& event : supervisor->of->outcomes) events.push_back(event.name);
        return check_outcome("the supervisor " + supervisor->name, "event", breakpoint.outcome,
                             events);
    }
    return no_such("the plan " + plan.name, "supervisor", breakpoint.element, known);
}

bool is(const Breakpoint& breakpoint, Breakpoint::Kind kind, std::string_view element,
        std::string_view outcome) {
    return breakpoint.kind == kind && breakpoint.element == element &&
           (breakpoint.outcome.empty() || breakpoint.outcome == outcome);
}

}  // namespace

Result<const plan::GraphPlan*> Breakpoints::find_plan(const std::string& name) const {
    if (name.empty()) return &graph_->plans.front();
    std::vector<std::string> known;
    const plan::GraphPlan* found = nullptr;
    for (const plan::GraphPlan& plan : graph_->plans) {
        if (plan.file == name) return &plan;
        known.push_back(plan.name);
        if (plan.name != name) continue;
        if (found) {
            return Error{Code::BadInput,
                         fmt::format("the plans of {} and {} are both named {}; give the file",
                                     found->file, plan.file, name)};
        }
        found = &plan;
    }
    if (found) return found;
    return no_such("this run", "plan", name, known);
}

Status Breakpoints::check_names(const Breakpoint& breakpoint, const plan::GraphPlan& plan) const {
    switch (breakpoint.kind) {
        case Breakpoint::Kind::Actor:
        case Breakpoint::Kind::State:
            return check_actor(breakpoint, plan);
        case Breakpoint::Kind::Event:
            return check_supervisor(breakpoint, plan);
        case Breakpoint::Kind::Condition:
            if (!breakpoint.condition.empty()) return Status::done();
            return Error{Code::BadInput, "a breakpoint on a condition needs one, as distance < 5"};
    }
    return Status::done();
}

Result<int> Breakpoints::add(Breakpoint breakpoint) {
    if (kept_.size() >= kBreakpointsMax) {
        return Error{Code::Limit, fmt::format("there are {} breakpoints already, the most there "
                                              "can be; delete some",
                                              kBreakpointsMax)};
    }
    if (breakpoint.stop_at == 0) {
        return Error{Code::BadInput, "a breakpoint stops at its hit 1 or a later one, not at 0"};
    }
    const plan::GraphPlan* plan = TRY(find_plan(breakpoint.plan));
    Kept kept{.shown = std::move(breakpoint),
              .file = plan->file,
              .plan = plan,
              .condition = {},
              .held = {}};
    TRY(fit(kept));
    const bool outcomes =
        kept.shown.kind == Breakpoint::Kind::State || kept.shown.kind == Breakpoint::Kind::Event;
    if (!outcomes) kept.shown.outcome.clear();
    kept.shown.plan = plan->name;
    kept.shown.id = ++last_id_;
    kept.shown.hits = 0;
    kept.shown.trouble.clear();
    note_conditions(kept);
    kept_.push_back(std::move(kept));
    return last_id_;
}

Result<Breakpoints::Kept*> Breakpoints::find(int id) {
    for (Kept& kept : kept_) {
        if (kept.shown.id == id) return &kept;
    }
    return Error{Code::NotFound,
                 fmt::format("there is no breakpoint {}; `list` shows those there are", id)};
}

Status Breakpoints::remove(int id) {
    const Kept* kept = TRY(find(id));
    kept_.erase(kept_.begin() + (kept - kept_.data()));
    return Status::done();
}

Status Breakpoints::enable(int id, bool enabled) {
    Kept* kept = TRY(find(id));
    kept->shown.enabled = enabled;
    note_conditions(*kept);
    return Status::done();
}

std::vector<Breakpoint> Breakpoints::list() const {
    std::vector<Breakpoint> all;
    for (const Kept& kept : kept_) all.push_back(kept.shown);
    return all;
}

void Breakpoints::start_again() {
    change(first_);
    variables_ = TracedVariables(first_);
    for (Kept& kept : kept_) {
        kept.shown.hits = 0;
        kept.shown.trouble.clear();
        kept.held.clear();
    }
    met_.reset();
}

// A breakpoint whose element or variable is gone in the new version stays in the list and says so;
// it is met again when a later version has it again.
void Breakpoints::change(const plan::Graph& graph) {
    if (&graph == graph_) return;
    graph_ = &graph;
    for (Kept& kept : kept_) {
        kept.plan = nullptr;
        kept.shown.trouble.clear();
        const Status fits = fit(kept);
        if (!fits.ok()) kept.shown.trouble = fits.error().what;
        if (!fits.ok()) kept.plan = nullptr;
    }
}

Status Breakpoints::fit(Kept& kept) const {
    kept.plan = TRY(find_plan(kept.file));
    TRY(check_names(kept.shown, *kept.plan));
    if (!kept.shown.condition.empty()) {
        kept.condition = TRY(Expression::parse(kept.shown.condition, *kept.plan));
    }
    return Status::done();
}

// ---- hits ----

bool Breakpoints::holds(Kept& kept, int level) {
    std::vector<plan::Value> values;
    for (const int slot : kept.condition->slots()) values.push_back(variables_.value(level, slot));
    const Result<bool> holds = kept.condition->holds(values);
    kept.shown.trouble = holds.ok() ? "" : holds.error().what;
    return holds.ok() && holds.value();
}

// What holds already need not become true.
void Breakpoints::note_conditions(Kept& kept) {
    if (kept.shown.kind != Breakpoint::Kind::Condition) return;
    kept.held.assign(static_cast<size_t>(variables_.depth()), false);
    for (int level = 0; level < variables_.depth(); ++level) {
        if (&variables_.plan_at(level) != kept.plan) continue;
        kept.held[static_cast<size_t>(level)] = holds(kept, level);
    }
}

void Breakpoints::hit(Kept& kept, std::vector<int>& stopping) {
    if (++kept.shown.hits >= kept.shown.stop_at) stopping.push_back(kept.shown.id);
}

void Breakpoints::see_write(std::vector<int>& stopping) {
    for (Kept& kept : kept_) {
        if (kept.shown.kind != Breakpoint::Kind::Condition || !kept.shown.enabled) continue;
        const std::vector<bool> before = kept.held;
        note_conditions(kept);
        bool became = false;
        for (size_t level = 0; level < kept.held.size(); ++level) {
            became = became || (kept.held[level] && !(level < before.size() && before[level]));
        }
        if (became) hit(kept, stopping);
    }
}

void Breakpoints::meet(const Met& met, std::vector<int>& stopping) {
    for (Kept& kept : kept_) {
        if (!kept.shown.enabled || !is(kept.shown, met.kind, met.element, met.outcome)) continue;
        if (&variables_.plan_at(met.level) != kept.plan) continue;
        if (!kept.condition || holds(kept, met.level)) hit(kept, stopping);
    }
}

std::vector<int> Breakpoints::settle() {
    std::vector<int> stopping;
    if (met_) meet(*met_, stopping);
    met_.reset();
    return stopping;
}

std::vector<int> Breakpoints::see(const plan::TraceEvent& event) {
    const bool write = std::holds_alternative<plan::VariableWritten>(event.what);
    std::vector<int> stopping;
    if (!write) stopping = settle();
    variables_.see(event);
    if (const auto* changed = std::get_if<plan::PlanChanged>(&event.what)) change(*changed->graph);
    if (const auto* ended = std::get_if<plan::ActorEnded>(&event.what)) {
        met_ = {Breakpoint::Kind::State, ended->actor, ended->state, level_of(event)};
    } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        met_ = {Breakpoint::Kind::Event, raised->supervisor, raised->event, level_of(event)};
    } else if (std::holds_alternative<plan::PlanStarted>(event.what) ||
               std::holds_alternative<plan::PlanEnded>(event.what) ||
               std::holds_alternative<plan::PlanChanged>(event.what)) {
        for (Kept& kept : kept_) note_conditions(kept);
    }
    if (write) see_write(stopping);
    return stopping;
}

std::vector<int> Breakpoints::before_begin(int level, const plan::GraphActor& actor) {
    std::vector<int> stopping;
    meet({Breakpoint::Kind::Actor, actor.name, {}, level}, stopping);
    return stopping;
}

}  // namespace vagus::run
