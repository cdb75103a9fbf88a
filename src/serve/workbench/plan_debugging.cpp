// What pages ask of the debugger of a plan: breakpoints, which the project keeps whether a plan
// runs or not, events that a person raises, and events of the bus that wait while the plan is
// paused.
#include <fmt/format.h>

#include <algorithm>

#include "aesl/mentions.hpp"
#include "plan/file.hpp"
#include "serve/json.hpp"
#include "serve/run/break_place.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kHandlersMax = 1000;  // that script.handlers gives
constexpr size_t kLineTextMax = 400;

std::string line_at(const std::string& source, size_t offset) {
    const size_t before = offset == 0 ? std::string::npos : source.rfind('\n', offset - 1);
    const size_t from = before == std::string::npos ? 0 : before + 1;
    const std::string line = source.substr(from, source.find('\n', offset) - from);
    return line.size() <= kLineTextMax ? line : std::string();
}

// The first line with code below that of a handler; 0: there is none, or it does not compile.
int first_line_of(const CompiledScript& script, int handler) {
    int first = 0;
    if (!script.result.ok()) return first;
    for (const uint16_t line : script.result.program.lines) {
        if (line > handler && (first == 0 || line < first)) first = line;
    }
    return first;
}

Json place(const aesl::Position& at) {
    return {{"line", at.line}, {"column", at.column}};
}

}  // namespace

// Before a run and during it the host has the same list.
std::vector<talk::BreakpointOrder> Workbench::plan_breakpoint_orders() const {
    return plan_breakpoints_.orders([this](const std::string& doc) { return real(doc); });
}

void Workbench::plan_breakpoints_changed() {
    desk_.topics().touch("breakpoints");
    keep_breakpoints();
    run_.set_breakpoints(plan_breakpoint_orders());
}

// One that is there stays, whatever became of its element or of the variables of its condition: its
// row says why it does not fit. A file that is not a plan right now is being typed in.
Status Workbench::is_in_plan(const PlanBreakpoint& wanted) {
    const bool is_there = plan_breakpoints_.stands_at(wanted);
    const bool is_same = plan_breakpoints_.has_condition(wanted);
    if (is_there && is_same) return Status::done();
    const auto text = files_.text(wanted.doc);
    if (!text.ok()) return text.error();
    const plan::PlanFile file = plan::parse_plan(text.value(), wanted.doc);
    if (!file.readable) return Status::done();
    if (!is_there) TRY(check_break_place(wanted, file.plan, editing_.templates()));
    return is_same ? Status::done() : check_break_variables(wanted, file.plan);
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
    const Status formed = check_break_condition(wanted);
    if (!formed.ok()) return call.fail(formed.error());
    const Status there = is_in_plan(wanted);
    if (!there.ok()) return call.fail(there.error());
    const auto set = plan_breakpoints_.set(wanted);
    if (!set.ok()) return call.fail(set.error());
    const uint64_t number = set.value()->number;
    plan_breakpoints_changed();
    call.done({{"number", number}});
}

// ---- from an element to its script ----

Json Workbench::handlers_of(const std::vector<std::string>& events) {
    Json spots = Json::array();
    for (const std::string& event : events) {
        for (const ScriptPart& part : scripts_.parts()) {
            const CompiledScript* script = scripts_.compiled(part.doc);
            if (!script) continue;
            for (const aesl::Mention& one : aesl::mentions(script->source, script->common)) {
                if (!one.handles || one.name != event || spots.size() >= kHandlersMax) continue;
                spots.push_back({{"doc", part.doc},
                                 {"at", place(one.at)},
                                 {"end", place(one.end)},
                                 {"line_text", line_at(script->source, one.offset)}});
            }
        }
    }
    return spots;
}

// Its nodes get a breakpoint that goes away with the first stop.
void Workbench::step_into_script(const Call& call) {
    if (!run_.plan_runs()) return call.fail("unavailable", "no plan runs");
    const Json spots = handlers_of(call.in["events"]);
    breakpoints_.clear_once();
    bool set = false;
    for (const Json& spot : spots) {
        const std::string doc = spot["doc"];
        const int line = first_line_of(*scripts_.compiled(doc), spot["at"]["line"]);
        if (line > 0 && breakpoints_.set_once(doc, line).ok()) set = true;
    }
    if (!set) {
        return call.fail("not_found",
                         "no script of the project handles the events by which this works on a "
                         "node; write onevent with one of their names");
    }
    target_.place_breakpoints();
    const life::CallNumber number = keep(call);
    results_[number] = {{"spots", spots}};
    tell_life(life::StepInto{number});
    live();
}

// The three acts on events that wait while the plan is paused.
void Workbench::declare_held_commands() {
    for (const auto& [name, act] : {std::pair("plan.held.go", talk::HeldAct::Go),
                                    {"plan.held.step", talk::HeldAct::Step},
                                    {"plan.held.drop", talk::HeldAct::Drop}}) {
        desk_.command(name, [this, what = act](const Call& call) {
            if (!run_.plan_runs()) return call.fail("unavailable", "no plan runs");
            std::optional<uint64_t> number;
            if (call.in.contains("number")) number = static_cast<uint64_t>(call.in["number"]);
            run_.handle_held(what, number, [call](const std::string& why) {
                if (why.empty()) return call.done();
                call.fail("conflict", why);
            });
        });
    }
}

void Workbench::declare_debug_commands() {
    declare_held_commands();
    desk_.command("script.handlers", [this](const Call& call) {
        call.done({{"spots", handlers_of(call.in["events"])}});
    });
    desk_.command("plan.into", [this](const Call& call) { step_into_script(call); });
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
