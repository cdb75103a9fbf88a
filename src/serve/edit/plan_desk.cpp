#include "serve/edit/plan_desk.hpp"

#include <fmt/format.h>

#include "serve/edit/json_patch.hpp"

namespace vagus::serve {

namespace {

// The plan that a call is about; fails the call if it is none.
std::optional<DocumentView> plan_of(const Call& call, Files& files) {
    const std::string doc = call.in["doc"];
    auto view = files.open(doc);
    if (!view.ok()) {
        call.fail(view.error());
        return std::nullopt;
    }
    if (view.value().language == "plan") return std::move(view.value());
    call.fail("bad_input",
              fmt::format("{} is no plan; name a file that ends with .plan.json", doc));
    return std::nullopt;
}

}  // namespace

PlanDesk::PlanDesk(Desk& desk, Files& files, Findings& findings)
    : files_(files), findings_(findings) {
    desk.command("plan.check", [this](const Call& call) { check(call); });
}

// What would be wrong after some steps; nothing is changed.
void PlanDesk::check(const Call& call) {
    const auto view = plan_of(call, files_);
    if (!view) return;
    const std::string doc = call.in["doc"];
    const auto steps = read_steps(call.in["steps"]);
    if (!steps.ok()) return call.fail(steps.error());
    const auto text = patched(view->text, {view->language, doc}, steps.value());
    if (!text.ok()) return call.fail(text.error());
    const Checkup checkup =
        check_plan_as(files_, doc, text.value(), findings_.toolboxes(), findings_.bus_names());
    auto list = nlohmann::json::array();
    for (const Finding& one : checkup.findings) {
        if (one.doc == doc && list.size() < kFindingsMax) list.push_back(json_of(one));
    }
    call.done({{"findings", std::move(list)}});
}

}  // namespace vagus::serve
