#include "embed/answered_plan.hpp"

#include <fmt/format.h>

#include "base/file.hpp"
#include "base/json.hpp"

namespace vagus::embed {

namespace {

bool needs_bus(const plan::Template* of) {
    return of != nullptr && !of->bus.events.empty();
}

// Named, and without an event: it raises nothing.
void silence(const plan::GraphSupervisor& supervisor, run::Answers& answers) {
    if (!needs_bus(supervisor.of) || answers.name(supervisor)) return;
    for (const plan::Outcome& event : supervisor.of->outcomes) {
        answers.events[supervisor.name + "." + event.name];
    }
}

Status leave_no_bus(const std::string& path, const plan::Graph& graph, run::Answers& answers) {
    for (const plan::GraphPlan& plan : graph.plans) {
        for (const plan::GraphSupervisor& global : plan.globals) silence(global, answers);
        for (const plan::GraphActor& actor : plan.actors) {
            for (const plan::GraphSupervisor& own : actor.supervisors) silence(own, answers);
            if (!needs_bus(actor.of) || answers.actors.contains(actor.name) ||
                answers.actors.contains(actor.of->name)) {
                continue;
            }
            return Error{
                Code::Unavailable,
                fmt::format("{}: the actor \"{}\" of the plan {} works over a bus ({}), and there "
                            "is none; give it or its template an answer, as \"{}\": [{{ "
                            "\"state\": \"{}\" }}], or the run a world",
                            path, actor.name, plan.name, actor.of->name, actor.of->name,
                            actor.states.empty() ? "" : actor.states.front())};
        }
    }
    return Status::done();
}

}  // namespace

Result<std::unique_ptr<AnsweredPlan>> AnsweredPlan::read(const std::string& path,
                                                         const plan::Graph& graph, bool alone) {
    const std::string text = TRY(read_file(path));
    const JsonValue json = TRY(parse_json(text, path));
    const JsonValue* const list = json.find("answers");
    if (list == nullptr) {
        return Error{Code::BadInput,
                     at_place(path, json.at,
                              "expected an object with the key \"answers\", as "
                              "{ \"answers\": { \"Forward\": [{ \"after\": 2 }] } }")};
    }
    run::Answers answers = TRY(run::Answers::read(*list, path, graph));
    if (alone) TRY(leave_no_bus(path, graph, answers));
    // make_unique cannot reach the constructor.
    std::unique_ptr<AnsweredPlan> made(new AnsweredPlan(std::move(answers)));
    made->graph_ = made->answers_.checked_in_time(graph);
    return made;
}

}  // namespace vagus::embed
