#include "serve/host/plan_change.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace vagus::serve {

using Json = nlohmann::json;

namespace {

// It is nobody's mistake: most files of a project are not of the plan that runs.
PlanTalk::Answered not_this_plan(uint64_t request) {
    return {request, "the plan that runs is not made of this file", {}};
}

}  // namespace

std::optional<PlanChange::Answered> PlanChange::take(const Json& told) {
    const uint64_t request = told["request"];
    std::vector<std::string> saved;
    for (const std::string file : told["files"]) {
        if (versions_.is_part(file)) saved.push_back(file);
    }
    if (saved.empty()) return not_this_plan(request);
    embed::PlanVersions::Made made = versions_.read(saved);
    if (!made.plan.ok()) return Answered{request, "", embed::errors_of(made.plan)};
    const plan::NewVersion next = made.next;
    asked_[request] = next.graph.get();
    versions_.hand_in(std::move(made));
    talk_.take_version(request, next, false);
    return std::nullopt;
}

std::optional<PlanChange::Answered> PlanChange::check(const Json& told, Ask ask) const {
    const uint64_t request = told["request"];
    const std::map<std::string, std::string> texts = told["texts"];
    const bool is_part = std::any_of(texts.begin(), texts.end(), [this](const auto& one) {
        return versions_.is_part(one.first);
    });
    if (!is_part) return not_this_plan(request);
    const embed::PlanVersions::Made made = versions_.with(texts);
    if (!made.plan.ok()) return Answered{request, "", embed::errors_of(made.plan)};
    if (ask == Ask::AtOnce) return Answered{request, "", talk_.reasons_against(made.next)};
    talk_.take_version(request, made.next, true);
    return std::nullopt;
}

void PlanChange::note(const Answered& answered) {
    const auto asked = asked_.find(answered.request);
    if (asked == asked_.end()) return;
    const bool refused = !answered.reasons || !answered.reasons->empty();
    if (refused) versions_.refused(*asked->second);
    asked_.erase(asked);
}

}  // namespace vagus::serve
