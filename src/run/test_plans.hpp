// Plans for the tests of this module: a text, templates of the test's own, and the lines of the
// trace without their times.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "plan/trace.hpp"
#include "run/code.hpp"

namespace vagus::run {

// An actor that does what the function says.
class TestActor final : public Actor {
public:
    using Body = std::function<void(ActorContext&)>;
    explicit TestActor(Body body) : body_(std::move(body)) {}
    void run(ActorContext& context) override { body_(context); }

private:
    Body body_;
};

inline Coded test_actor(std::string name, TestActor::Body body) {
    Coded coded{.declared = {.name = std::move(name), .outcomes = {{.name = "Done"}}}};
    coded.actor = [body = std::move(body)] { return std::make_unique<TestActor>(body); };
    return coded;
}

// A supervisor with the event "Seen", one check a period.
inline Coded test_supervisor(std::string name, int64_t period_ms, MakeSupervisor make) {
    Coded coded{.declared = {.name = std::move(name),
                             .kind = plan::Kind::Supervisor,
                             .outcomes = {{.name = "Seen"}},
                             .period_ms = period_ms}};
    coded.supervisor = std::move(make);
    return coded;
}

class NeverSees final : public Supervisor {
    std::optional<plan::Given> check(const Check&) override { return std::nullopt; }
};

// "See", checked each 10 ms, and "Hear", at events: neither ever raises by itself.
inline void add_blind_supervisors(std::vector<Coded>& list) {
    const auto make = [] { return std::make_unique<NeverSees>(); };
    list.push_back(test_supervisor("See", 10, make));
    list.push_back(test_supervisor("Hear", 0, make));
}

// An actor whose own code fails: something else is to answer for it.
inline Coded unused_actor(std::string name) {
    return test_actor(std::move(name), [](ActorContext&) { throw CodeError("the toolbox's own"); });
}

// The graph of a plan that is right; a wrong one ends the test with the findings.
inline plan::Graph test_graph(const std::string& text, const CodeLibrary& library) {
    const plan::Checked checked =
        plan::check("test.plan.json", plan::OneText(text), library.templates());
    if (!checked.ok()) throw CodeError(plan::format_findings_json(checked.findings));
    return plan::make_graph(checked);
}

// "actor-end a", "late slow", "plan-end": the kind, and whom it names.
inline std::string test_line(const plan::TraceEvent& event) {
    const auto named = [](const std::string& kind, std::string_view name) {
        return kind + " " + std::string(name);
    };
    if (std::holds_alternative<plan::PlanStarted>(event.what)) return "plan-start";
    if (std::holds_alternative<plan::PlanEnded>(event.what)) return "plan-end";
    if (const auto* one = std::get_if<plan::ActorStarted>(&event.what))
        return named("actor-start", one->actor);
    if (const auto* one = std::get_if<plan::ActorEnded>(&event.what))
        return named("actor-end", one->actor);
    if (const auto* one = std::get_if<plan::ActorInterrupted>(&event.what))
        return named("interrupted", one->actor);
    if (const auto* one = std::get_if<plan::EventRaised>(&event.what))
        return named("event", one->supervisor);
    if (const auto* one = std::get_if<plan::CheckLate>(&event.what))
        return named("late", one->supervisor);
    if (const auto* one = std::get_if<plan::ErrorFound>(&event.what))
        return named("error", one->element);
    return "other";
}

}  // namespace vagus::run
