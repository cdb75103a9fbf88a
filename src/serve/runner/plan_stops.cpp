#include "serve/runner/plan_stops.hpp"

#include <algorithm>
#include <set>

namespace vagus::serve {

namespace {

run::Breakpoint::Kind kind_of(talk::BreakpointKind kind) {
    using Kind = run::Breakpoint::Kind;
    switch (kind) {
        case talk::BreakpointKind::Actor:
            return Kind::Actor;
        case talk::BreakpointKind::State:
            return Kind::State;
        case talk::BreakpointKind::Event:
            return Kind::Event;
        case talk::BreakpointKind::Condition:
            return Kind::Condition;
    }
    return Kind::Condition;
}

run::Breakpoint breakpoint_of(const talk::BreakpointOrder& wanted) {
    return {.kind = kind_of(wanted.kind),
            .plan = wanted.plan,
            .element = wanted.element,
            .outcome = wanted.outcome,
            .condition = wanted.condition,
            .stop_at = wanted.stop_at,
            .enabled = wanted.enabled};
}

}  // namespace

void PlanStops::tend(PlanTalk& talk) {
    if (waiting_ > 0) return;
    if (posted_ != wanted_) return post_differences(talk);
    ask_for_hits(talk);
}

void PlanStops::forget() {
    known_.clear();
    posted_.clear();
    waiting_ = 0;
}

void PlanStops::post_differences(PlanTalk& talk) {
    posted_ = wanted_;
    std::set<uint64_t> there;
    for (const talk::BreakpointOrder& wanted : posted_) {
        const uint64_t number = wanted.number;
        there.insert(number);
        const auto known = known_.find(number);
        if (known != known_.end() && known->second.wanted == wanted) continue;
        if (known != known_.end()) drop(talk, known->second);
        add(talk, wanted);
    }
    for (const auto& [number, known] : known_) {
        if (!there.contains(number)) drop(talk, known);
    }
    std::erase_if(known_, [&](const auto& one) { return !there.contains(one.first); });
}

void PlanStops::add(PlanTalk& talk, const talk::BreakpointOrder& wanted) {
    const uint64_t number = wanted.number;
    known_[number] = {.wanted = wanted, .id = std::nullopt, .why = "", .hits = 0};
    ++waiting_;
    talk.ask(run::AddBreakpoint{breakpoint_of(wanted)},
             [this, number](const Result<run::Reply>& reply) {
                 waiting_ = std::max(0, waiting_ - 1);
                 const auto known = known_.find(number);
                 if (known == known_.end()) return;
                 if (reply.ok()) {
                     known->second.id = std::get<int>(reply.value());
                 } else {
                     known->second.why = reply.error().what;
                 }
             });
}

void PlanStops::drop(PlanTalk& talk, const Known& known) {
    if (known.id) talk.ask(run::RemoveBreakpoint{*known.id}, [](const Result<run::Reply>&) {});
}

void PlanStops::ask_for_hits(PlanTalk& talk) {
    if (known_.empty()) return;
    ++waiting_;
    talk.ask(run::ListBreakpoints{}, [this](const Result<run::Reply>& reply) {
        waiting_ = std::max(0, waiting_ - 1);
        if (reply.ok()) note(std::get<std::vector<run::Breakpoint>>(reply.value()));
    });
}

void PlanStops::note(const std::vector<run::Breakpoint>& list) {
    for (auto& [number, known] : known_) {
        for (const run::Breakpoint& one : list) {
            if (one.id != known.id) continue;
            known.hits = one.hits;
            known.why = one.trouble;
        }
    }
}

std::optional<std::vector<talk::BreakpointNow>> PlanStops::news() {
    std::vector<talk::BreakpointNow> list;
    for (const auto& [number, known] : known_) {
        list.push_back({number, known.hits, known.id.has_value(), known.why});
    }
    if (list == told_) return std::nullopt;
    told_ = list;
    return list;
}

std::vector<uint64_t> PlanStops::numbers(const std::vector<int>& ids) const {
    std::vector<uint64_t> found;
    for (const auto& [number, known] : known_) {
        const bool meant = known.id && std::find(ids.begin(), ids.end(), *known.id) != ids.end();
        if (meant) found.push_back(number);
    }
    return found;
}

}  // namespace vagus::serve
