#include "trial/awaited.hpp"

#include "trial/judge.hpp"

namespace vagus::trial {

void Awaited::line(const plan::TraceEvent& event) {
    if (over_) return;
    readings_.line(event);
    started_ = started_ || std::holds_alternative<plan::ActorStarted>(event.what);
    over_ = run::level_of(event) == 0 && std::holds_alternative<plan::PlanEnded>(event.what);
    if (!over_ && started_) ask();  // its variables are gone with it
}

void Awaited::instant() {
    if (over_) return;
    readings_.instant();
    if (started_ && readings_.now() % kAskedEvery == Duration::zero()) ask();
}

void Awaited::ask() {
    if (is_over()) return;
    const Result<bool> now = holds();
    if (!now.ok()) {
        trouble_ = now.error();
    } else if (now.value()) {
        came_ = readings_.now();
    }
}

Result<bool> Awaited::holds() const {
    std::vector<plan::Value> values;
    for (const Condition::Name& name : condition_.names()) {
        values.push_back(TRY(readings_.value(name)));
    }
    return condition_.holds(values);
}

}  // namespace vagus::trial
