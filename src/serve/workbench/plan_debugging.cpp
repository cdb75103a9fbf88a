// What pages ask of the debugger of a plan: breakpoints, which the project keeps whether a plan
// runs or not, and events that a person raises.
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

using Json = nlohmann::json;

// Before a run and during it the host has the same list.
Json Workbench::plan_breakpoint_orders() const {
    return plan_breakpoints_.orders(
        [this](const std::string& doc) { return project_ ? project_->real(doc) : doc; });
}

void Workbench::plan_breakpoints_changed() {
    desk_.board().touch("breakpoints");
    keep_breakpoints();
    run_.tell({{"do", "plan.breakpoints"}, {"list", plan_breakpoint_orders()}});
}

void Workbench::set_plan_breakpoint(const Call& call) {
    if (!project_) return call.fail("unavailable", "no project is open; open one first");
    PlanBreakpoint wanted;
    wanted.number = static_cast<uint64_t>(call.in.value("number", 0.0));
    wanted.doc = call.in["doc"];
    wanted.kind = call.in["kind"];
    wanted.element = call.in.value("element", "");
    wanted.outcome = call.in.value("outcome", "");
    wanted.condition = call.in.value("condition", "");
    wanted.stop_at = call.in.value("stop_at", uint64_t{1});
    wanted.enabled = call.in.value("enabled", true);
    const auto set = plan_breakpoints_.set(wanted);
    if (!set.ok()) return call.fail(set.error());
    const uint64_t number = set.value()->number;
    plan_breakpoints_changed();
    call.done({{"number", number}});
}

void Workbench::declare_debug_commands() {
    desk_.command("plan.break.set", [this](const Call& call) { set_plan_breakpoint(call); });
    desk_.command("plan.break.clear", [this](const Call& call) {
        std::optional<uint64_t> number;
        std::optional<std::string> doc;
        if (call.in.contains("number")) number = static_cast<uint64_t>(call.in["number"]);
        if (call.in.contains("doc")) doc = call.in["doc"];
        plan_breakpoints_.clear(number, doc);
        plan_breakpoints_changed();
        call.done();
    });
    desk_.command("plan.break.rename", [this](const Call& call) {
        plan_breakpoints_.rename_element(call.in["doc"], call.in["from"], call.in["to"]);
        plan_breakpoints_changed();
        call.done();
    });
    desk_.command("plan.raise", [this](const Call& call) {
        if (!run_.plan_runs()) return call.fail("unavailable", "no plan runs");
        run_.raise(call.in["supervisor"], call.in["event"],
                   call.in.value("outputs", Json::object()), [call](const std::string& why) {
                       if (why.empty()) return call.done();
                       call.fail("bad_input", why);
                   });
    });
}

}  // namespace vagus::serve
