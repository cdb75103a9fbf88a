#include "serve/runner/plan_change.hpp"

#include <algorithm>
#include <utility>

#include "base/file.hpp"

namespace vagus::serve {

namespace {

// It is nobody's mistake: most files of a project are not of the plan that runs.
talk::Answer not_this_plan(uint64_t request) {
    return {.request = request, .why = "the plan that runs is not made of this file"};
}

talk::Answer reasons(uint64_t request, std::vector<std::string> against) {
    return {.request = request, .reasons = std::move(against)};
}

}  // namespace

void PlanChange::take(const talk::ChangePlan& order) {
    std::vector<std::string> saved;
    for (const std::string& file : order.files) {
        if (versions_.is_part(file)) saved.push_back(file);
    }
    if (saved.empty()) return tell_(not_this_plan(order.request));
    embed::PlanVersions::Made made = read(saved);
    if (!made.plan.ok()) return tell_(reasons(order.request, embed::errors_of(made.plan)));
    const plan::NewVersion next = made.next;
    versions_.hand_in(std::move(made));
    ask(order.request, next, false, [this, graph = next.graph.get()](bool taken) {
        if (!taken) versions_.refused(*graph);
    });
}

embed::PlanVersions::Made PlanChange::read(const std::vector<std::string>& saved) {
    if (!told_of_read_) return versions_.read(saved);
    const FilesRead files;
    embed::PlanVersions::Made made = versions_.read(saved);
    told_of_read_({saved, files.all(), made.next.graph.get()});
    return made;
}

void PlanChange::check(const talk::CheckPlan& order, Ask how) {
    const auto is_part = [this](const auto& one) { return versions_.is_part(one.first); };
    if (std::ranges::none_of(order.texts, is_part)) return tell_(not_this_plan(order.request));
    const embed::PlanVersions::Made made = versions_.with(order.texts);
    if (!made.plan.ok()) return tell_(reasons(order.request, embed::errors_of(made.plan)));
    if (how == Ask::AtOnce) return tell_(reasons(order.request, talk_.reasons_against(made.next)));
    ask(order.request, made.next, true, [](bool) {});
}

// A debugger answers it while the plan runs and while it is held.
void PlanChange::ask(uint64_t request, plan::NewVersion next, bool only_ask,
                     std::function<void(bool taken)> then) {
    talk_.ask(run::TakeVersion{std::move(next), only_ask},
              [this, request, then = std::move(then)](const Result<run::Reply>& reply) {
                  talk::Answer answer{.request = request};
                  if (!reply.ok()) answer.why = reply.error().what;
                  if (reply.ok()) answer.reasons = std::get<run::Change>(reply.value()).reasons;
                  then(answer.reasons && answer.reasons->empty());
                  tell_(answer);
              });
}

}  // namespace vagus::serve
