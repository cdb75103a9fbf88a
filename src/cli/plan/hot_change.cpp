#include "cli/plan/hot_change.hpp"

#include <algorithm>
#include <utility>

namespace vagus::cli {

namespace {

// A run answers between two decisions; one that ends says so, too.
constexpr Duration kAnswerEvery = std::chrono::seconds(1);

// What the run says to a request; nothing: it is over.
std::optional<Result<run::Reply>> wait_answer(run::Debugger& debugger, run::Request request) {
    const auto posted = debugger.post(std::move(request));
    if (!posted.ok()) return std::nullopt;
    for (;;) {
        const std::optional<run::Report> report = debugger.wait_report(kAnswerEvery);
        if (!report) continue;
        if (std::holds_alternative<run::RunOver>(*report)) return std::nullopt;
        const auto* answer = std::get_if<run::Answer>(&*report);
        if (answer && answer->request == posted.value()) return answer->reply;
    }
}

}  // namespace

HotChange::HotChange(const TerminalRun& run, const std::string& file,
                     std::function<void(const std::string&)> say)
    : versions_(run.loaded(), file),
      debugger_(run.graph(), run::Debugger::At::Run),
      say_(std::move(say)) {}

bool HotChange::is_for(const std::vector<std::string>& saved) const {
    return std::all_of(saved.begin(), saved.end(),
                       [this](const std::string& file) { return versions_.is_part(file); });
}

bool HotChange::hand_in(const std::vector<std::string>& saved, FileWatch& watch) {
    embed::PlanVersions::Made made = versions_.read(saved);
    if (watch.add(versions_.files())) made = versions_.read(saved);
    if (!made.plan.ok()) {
        // The plan may be over by now: then there is nothing that runs on.
        if (!wait_answer(debugger_, run::AskWhere{})) return false;
        refuse(embed::errors_of(made.plan));
        return true;
    }
    versions_.hand_in(made);
    const auto reply = wait_answer(debugger_, run::TakeVersion{made.next});
    if (!reply) return false;
    const std::vector<std::string> reasons = reply->ok()
                                                 ? std::get<run::Change>(reply->value()).reasons
                                                 : std::vector{reply->error().what};
    if (reasons.empty()) {
        versions_.took(made.plan.graph());
        say_(saved.front() + " was saved: the new version runs");
    } else {
        versions_.refused(made.plan.graph());
        refuse(reasons);
    }
    return true;
}

void HotChange::refuse(const std::vector<std::string>& reasons) {
    for (const std::string& reason : reasons) say_(reason);
    say_("the plan as it was runs on");
}

}  // namespace vagus::cli
