#include "trial/judge.hpp"

#include <fmt/format.h>

namespace vagus::trial {

namespace {

std::string seconds(Time at) {
    return plan::text_of(seconds_of(at));
}

}  // namespace

std::string name_in_order(std::string_view plan, std::string_view actor) {
    const size_t slash = plan.find('/');
    if (slash == std::string_view::npos) return std::string(actor);
    return fmt::format("{}/{}", plan.substr(slash + 1), actor);
}

std::string_view way_of(const run::Ended& ended) {
    return ended.timed_out ? "MaxTime" : plan::name_of(ended.result);
}

Judge::Judge(const TestFile& test, const plan::Graph& graph, const ReadWorld& world)
    : readings_(graph, world) {
    for (const Expectation& one : test.expect) cases_.push_back({.expectation = &one});
}

Status Judge::check(const Expectation& one) const {
    if (!one.condition) return Status::done();
    for (const Condition::Name& name : one.condition->names()) TRY(readings_.check(name));
    return Status::done();
}

// ---- as the run goes on ----

void Judge::line(const plan::TraceEvent& event) {
    if (readings_.over()) return;
    readings_.line(event);
    if (readings_.over()) return;
    if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        const bool outermost = run::level_of(event) == 0;
        if (outermost && raised->target == "@terminate") ended_by_ = raised->supervisor;
    }
    if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        follow_order(event, *started);
    }
    if (readings_.are_asked()) ask();
}

void Judge::event(Time at, std::string_view name) {
    readings_.event(at, name);
    ask();
}

void Judge::instant() {
    if (!readings_.are_asked()) return;
    readings_.instant();
    if (readings_.are_asked_now()) ask();
}

void Judge::follow_order(const plan::TraceEvent& event, const plan::ActorStarted& started) {
    for (Case& one : cases_) {
        const std::vector<std::string>& order = one.expectation->order;
        if (one.came_to >= order.size()) continue;
        const std::string& name = order[one.came_to];
        if (name != started.actor && name != name_in_order(event.plan, started.actor)) continue;
        ++one.came_to;
        one.came_at = event.at;
    }
}

void Judge::ask() {
    for (Case& one : cases_) {
        if (!one.decided && one.expectation->condition) ask(one);
    }
}

void Judge::ask(Case& one) {
    const Condition& condition = *one.expectation->condition;
    const bool eventually = one.expectation->kind == Expectation::Kind::Eventually;
    const Time now = readings_.now();
    if (eventually && one.expectation->within && seconds_of(now) > *one.expectation->within) {
        fail(one, now,
             fmt::format("it did not come about within {} s; then {}",
                         plan::text_of(*one.expectation->within), values_of(condition)));
        return;
    }
    const auto values = readings_.values(condition);
    if (!values.ok()) return fail(one, now, values.error().what);
    const Result<bool> holds = condition.holds(values.value());
    if (!holds.ok()) return fail(one, now, holds.error().what + "; " + values_of(condition));
    if (eventually) {
        one.decided = holds.value();
    } else if (holds.value() != (one.expectation->kind == Expectation::Kind::Always)) {
        fail(one, now, values_of(condition));
    }
}

void Judge::fail(Case& one, Time at, std::string what) {
    one.decided = true;
    one.verdict = {.as_expected = false, .at = at, .what = std::move(what)};
}

// The values of its names, and what the robot was at: the actor that runs, or its place.
std::string Judge::values_of(const Condition& condition) const {
    std::string text;
    const auto add = [&](const Condition::Name& name) {
        const Result<plan::Value> value = readings_.value(name);
        if (!value.ok()) return;
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name.shown,
                            plan::in_words(value.value()));
    };
    for (const Condition::Name& name : condition.names()) add(name);
    const auto also = readings_.has_plan() ? std::vector<std::string>{"actor"}
                                           : std::vector<std::string>{"x", "y"};
    for (const std::string& one : also) {
        const Signal* const signal = find_signal(one);
        if (!condition.uses(signal->id)) add({{.shown = one}, signal});
    }
    return text;
}

// ---- when it is over ----

std::vector<Verdict> Judge::end(const run::Ended& ended) {
    std::vector<Verdict> verdicts;
    for (Case& one : cases_) {
        if (!one.decided) end(one, ended);
        verdicts.push_back(one.verdict);
    }
    return verdicts;
}

void Judge::end(Case& one, const run::Ended& ended) {
    const Expectation& expected = *one.expectation;
    const Time now = readings_.now();
    if (expected.kind == Expectation::Kind::Eventually) {
        fail(one, now,
             fmt::format("it had not come about when the run ended, at {} s", seconds(now)));
    } else if (expected.kind == Expectation::Kind::Order && one.came_to < expected.order.size()) {
        const std::string& missing = expected.order[one.came_to];
        fail(one, now,
             one.came_to == 0
                 ? fmt::format("the plan never came to {}", missing)
                 : fmt::format("the plan came to {} at {} s, and never to {} after that",
                               expected.order[one.came_to - 1], seconds(one.came_at), missing));
    } else if (expected.kind == Expectation::Kind::Ends) {
        const bool same =
            expected.ends == way_of(ended) && (expected.by.empty() || expected.by == ended_by_);
        if (same) return;
        fail(one, now, how_it_ended(ended, now));
    }
}

std::string Judge::how_it_ended(const run::Ended& ended, Time now) const {
    if (ended.timed_out)
        return fmt::format("it had not ended after its max_time, {} s", seconds(now));
    return fmt::format("it ended {}{}{}, at {} s", way_of(ended),
                       ended_by_.empty() ? "" : " by " + ended_by_,
                       ended.message.empty() ? "" : " (" + ended.message + ")", seconds(now));
}

}  // namespace vagus::trial
