#include "serve/host/plan_change.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace vagus::serve {

using Json = nlohmann::json;

namespace {

// It is nobody's mistake: most files of a project are not of the plan that runs.
PlanChange::Answer not_this_plan(uint64_t request) {
    return {request, "the plan that runs is not made of this file", {}};
}

}  // namespace

void PlanChange::take(const Json& told) {
    const uint64_t request = told["request"];
    std::vector<std::string> saved;
    for (const std::string file : told["files"]) {
        if (versions_.is_part(file)) saved.push_back(file);
    }
    if (saved.empty()) return tell_(not_this_plan(request));
    embed::PlanVersions::Made made = versions_.read(saved);
    if (!made.plan.ok()) return tell_({request, "", embed::errors_of(made.plan)});
    const plan::NewVersion next = made.next;
    versions_.hand_in(std::move(made));
    ask(request, next, false, [this, graph = next.graph.get()](bool taken) {
        if (!taken) versions_.refused(*graph);
    });
}

void PlanChange::check(const Json& told, Ask how) {
    const uint64_t request = told["request"];
    const std::map<std::string, std::string> texts = told["texts"];
    const bool is_part = std::any_of(texts.begin(), texts.end(), [this](const auto& one) {
        return versions_.is_part(one.first);
    });
    if (!is_part) return tell_(not_this_plan(request));
    const embed::PlanVersions::Made made = versions_.with(texts);
    if (!made.plan.ok()) return tell_({request, "", embed::errors_of(made.plan)});
    if (how == Ask::AtOnce) return tell_({request, "", talk_.reasons_against(made.next)});
    ask(request, made.next, true, [](bool) {});
}

// A debugger answers it while the plan runs and while it is held.
void PlanChange::ask(uint64_t request, plan::NewVersion next, bool only_ask,
                     std::function<void(bool taken)> then) {
    talk_.ask(run::TakeVersion{std::move(next), only_ask},
              [this, request, then = std::move(then)](const Result<run::Reply>& reply) {
                  Answer answer{request, reply.ok() ? "" : reply.error().what, {}};
                  if (reply.ok()) answer.reasons = std::get<run::Change>(reply.value()).reasons;
                  then(answer.reasons && answer.reasons->empty());
                  tell_(answer);
              });
}

}  // namespace vagus::serve
