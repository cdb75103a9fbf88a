// The workbench of a robot that is a member of a fleet: what is shown of it, and what others want.
#include <algorithm>

#include "base/text.hpp"
#include "fleet/limits.hpp"
#include "serve/json.hpp"
#include "serve/workbench/missing_nodes.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

namespace {

fleet::Answer refusal(const std::string& why) {
    return {.done = false, .what = std::string(utf8_prefix(why, fleet::kLineBytesMax))};
}

fleet::Answer answer_of_why(const std::string& why) {
    return why.empty() ? fleet::Answer{.done = true} : refusal(why);
}

// A call that nobody's page makes.
Call call_for(Json in, Workbench::Obeyed done) {
    return Call(std::move(in), 0, [done = std::move(done)](const Call::Outcome& outcome) {
        const auto* problem = std::get_if<Problem>(&outcome);
        done(answer_of_why(problem ? problem->what : ""));
    });
}

}  // namespace

fleet::Shown Workbench::shown() const {
    fleet::Shown shown{
        .actor = run_.actor(), .problems = target_.problems(), .nodes = target_.names_of_nodes()};
    const bool fault = target_.is_at_fault();
    for (const std::string& node : missing_nodes()) {
        shown.problems.push_back(node == kAnyNode ? "no node is there" : node + " is not there");
    }
    if (shown.problems.size() > fleet::kProblemsMax) shown.problems.resize(fleet::kProblemsMax);
    for (std::string& one : shown.problems)
        one.resize(utf8_prefix(one, fleet::kLineBytesMax).size());
    // Nodes of a bus may run without us.
    const bool nodes_run = bus_ && target_.counts().running > 0;
    const Life::State state = life_.state();
    if (state == Life::State::Dead || fault) {
        shown.state = "fault";
    } else if (state == Life::State::Paused) {
        shown.state = "paused";
    } else if (state == Life::State::Running || nodes_run) {
        shown.state = "running";
    }
    return shown;
}

void Workbench::on_tells(std::vector<fleet::Tells> variables, TargetTells tells) {
    target_.tell_variables(std::move(variables));
    target_.on_tells(std::move(tells));
}

Status Workbench::hear_of_fleet(const talk::HearOfFleet& event) {
    if (run_.plan_runs()) run_.hear_of_fleet(event);
    return emit(event.event, event.args);
}

void Workbench::stop_for(const std::string& by) {
    somebody_stops(0);
    end_by(by, life::Why::Stop);
}

void Workbench::obey(const fleet::Command& command, Obeyed done) {
    const std::string& verb = command.verb;
    if (verb == "stop") return stop_and_report("the fleet", std::move(done));
    if (verb == "set") return write(command, std::move(done));
    if (verb == "start" || verb == "continue") return obey_start(command, std::move(done));
    if (verb == "pause") {
        tell_life(life::Pause{keep(call_for(Json::object(), std::move(done)))});
        return live();
    }
    if (verb == "identify") {
        const Status sent = emit(verb, {});
        const std::string why = sent.ok() ? "" : sent.error().what;
        return done(answer_of_why(why));
    }
    if (verb == "emit") {
        const Status sent = emit(command.event, command.values);
        return done(answer_of_why(sent.ok() ? "" : sent.error().what));
    }
    if (verb == "raise" && run_.plan_runs()) {
        return run_.raise(
            command.supervisor, command.event, Json::object(),
            [done = std::move(done)](const std::string& why) { done(answer_of_why(why)); });
    }
    done(refusal(verb == "raise" ? "no plan runs" : verb + " is no command of this version"));
}

void Workbench::obey_start(const fleet::Command& command, Obeyed done) {
    const bool paused = life_.state() == Life::State::Paused;
    if (command.verb == "continue" && !paused) return done(refusal("it is not paused"));
    start_run([done = std::move(done)](const std::string& why) { done(answer_of_why(why)); });
}

// Stopped means read back: who did not say so is named.
void Workbench::stop_and_report(const std::string& by, Obeyed done) {
    somebody_stops(0);
    const Call call(Json::object(), 0, [done = std::move(done)](const Call::Outcome& outcome) {
        const auto* problem = std::get_if<Problem>(&outcome);
        fleet::Answer answer = answer_of_why(problem ? problem->what : "");
        const auto* report = std::get_if<Json>(&outcome);
        if (report != nullptr) answer.silent = not_stopped(*report);
        if (answer.silent.size() > fleet::kNodesMax) answer.silent.resize(fleet::kNodesMax);
        answer.done = answer.done && answer.silent.empty();
        done(std::move(answer));
    });
    stop(call, {by, life::Why::Stop});
}

void Workbench::write(const fleet::Command& command, Obeyed done) {
    const auto told = [done = std::move(done)](const std::string& why) {
        done(answer_of_why(why));
    };
    if (!command.node.empty()) {
        return target_.write(command.node, command.name, command.values, told);
    }
    if (!run_.plan_runs()) return told("no plan runs; name the node of the variable: NODE.NAME");
    if (command.values.size() != 1) return told("a variable of a plan takes one value");
    run_.set_variable(0, command.name, command.values.front(), told);
}

}  // namespace vagus::serve
