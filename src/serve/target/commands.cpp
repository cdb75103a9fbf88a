// What pages ask of the robot: breakpoints, values, nodes.
#include <fmt/format.h>

#include <algorithm>

#include "debug/condition.hpp"
#include "serve/json.hpp"
#include "serve/target/shared_id.hpp"
#include "serve/target/target.hpp"
#include "session/driving.hpp"

namespace vagus::serve {

namespace {

constexpr const char* kNoRobot = "there is no robot; choose a target first";

constexpr const char* kBrakes =
    "the robot is alive: it brakes at every hit, also at one that does not count, since only here "
    "is known whether it counts";

}  // namespace

// ---- breakpoints ----

void Target::set_breakpoint(const Call& call) {
    const std::string doc = call.in["doc"];
    int line = call.in["line"];
    const CompiledScript* script = scripts_.compiled(doc);
    if (!script) return call.fail("not_found", doc + ": there is no such script");
    const std::string condition = call.in.value("condition", "");
    const Status formed =
        condition.empty() ? Status::done() : debug::Condition::check_form(condition);
    if (!formed.ok()) return call.fail("bad_input", "in.condition: " + formed.error().what);
    // The next line with code, if the script compiles; else where it was asked for.
    if (script->result.ok()) {
        int next = 0;
        for (const uint16_t one : script->result.program.lines) {
            if (one >= line && (next == 0 || one < next)) next = one;
        }
        if (next == 0) {
            return call.fail("bad_input",
                             fmt::format("line {} and those below it have no code; set the "
                                         "breakpoint at a statement",
                                         line));
        }
        line = next;
        const auto parsed =
            debug::Condition::parse(condition.empty() ? "1" : condition,
                                    script->result.program.variables, script->common.constants);
        if (!parsed.ok()) return call.fail("bad_input", "in.condition: " + parsed.error().what);
    }
    const auto made = breakpoints_.set(doc, line);
    if (!made.ok()) return call.fail(made.error());
    ScriptBreakpoint& one = *made.value();
    one.condition = call.in.value("condition", one.condition);
    one.ignore = call.in.value("ignore", one.ignore);
    one.enabled = call.in.value("enabled", one.enabled);
    one.hits = 0;
    one.once = false;
    place_breakpoints();
    breakpoints_changed_();
    Json answer = {{"line", line}};
    if (live() && (!one.condition.empty() || one.ignore > 0)) answer["note"] = kBrakes;
    call.done(std::move(answer));
}

// ---- commands ----

void Target::set_variable(const Call& call) {
    if (!network_) return call.fail("unavailable", kNoRobot);
    const uint16_t node = call.in["node"];
    const std::vector<int16_t> values = call.in["values"];
    const size_t first = call.in["first"];
    const std::string text =
        values.size() == 1 && first == 0
            ? call.in["name"].get<std::string>()
            : fmt::format("{}[{}:{}]", call.in["name"].get<std::string>(), first,
                          first + std::max<size_t>(values.size(), 1) - 1);
    auto range = network_->variable(node, text);
    if (!range.ok()) return call.fail(range.error());
    range.value().count = static_cast<uint16_t>(values.size());
    will_move();
    note_lease(call.member, node, range.value());
    start_batch(
        {node}, [&](uint16_t id) { return network_->set(id, range.value(), values); },
        [call](Batch& batch) {
            if (batch.failed.empty()) return call.done();
            call.fail("failed", batch.failed.front().second);
        },
        "");
}

Status Target::emit(const std::string& event, const std::vector<int16_t>& args) {
    if (!network_) return Error{Code::Unavailable, kNoRobot};
    will_move();
    TRY(network_->emit(event, args));
    happen({.kind = "event", .source = source_of(wire::kHostId), .name = event, .args = args});
    const auto& events = network_->common().events;
    const auto named = std::find_if(events.begin(), events.end(),
                                    [&event](const auto& one) { return one.name == event; });
    count_dropped(wire::kHostId, static_cast<uint16_t>(named - events.begin()));
    return Status::done();
}

Status Target::find_variable(const std::string& node, const std::string& name) const {
    if (!network_) return Error{Code::Unavailable, kNoRobot};
    const uint16_t id = TRY(network_->find(node));
    (void)TRY(network_->variable(id, name));
    return Status::done();
}

void Target::write(const std::string& node, const std::string& variable,
                   const std::vector<int16_t>& values, std::function<void(std::string why)> done) {
    if (!network_) return done(kNoRobot);
    const auto id = network_->find(node);
    if (!id.ok()) return done(id.error().what);
    const auto range = network_->variable(id.value(), variable);
    if (!range.ok()) return done(range.error().what);
    if (values.size() != range.value().count) {
        return done(fmt::format("{} has {} words; found {} values", variable, range.value().count,
                                values.size()));
    }
    const std::string why =
        session::why_not_from_afar(*network_, id.value(), variable, values, safe_stop_);
    if (!why.empty()) return done(why);
    will_move();
    start_batch(
        {id.value()}, [&](uint16_t one) { return network_->set(one, range.value(), values); },
        [done = std::move(done)](Batch& batch) {
            done(batch.failed.empty() ? "" : batch.failed.front().second);
        },
        "");
}

std::vector<std::string> Target::problems() const {
    std::vector<std::string> problems;
    for (const auto& [node, known] : known_) {
        if (known.away) problems.push_back(name_of(node) + " is away");
        if (known.fault.empty()) continue;
        const std::string place =
            known.fault_line > 0 ? fmt::format(" at line {}", known.fault_line) : "";
        problems.push_back(fmt::format("{}{}: {}", name_of(node), place, known.fault));
    }
    if (!network_) return problems;
    for (const debug::NodeId node : network_->nodes()) {
        const debug::NodeView& view = *network_->node(node);
        if (view.id_shared) problems.push_back(shared_id_words(view));
    }
    return problems;
}

bool Target::is_at_fault() const {
    return std::any_of(known_.begin(), known_.end(), [this](const auto& one) {
        const bool stopped = stopping_.state_of(one.first) == StopNode::State::Stopped;
        return one.second.away || (!one.second.fault.empty() && !stopped);
    });
}

void Target::declare_node_commands() {
    desk_.command("node.run", [this](const Call& call) {
        if (call.in["node"] == 0) release_all();
        act(
            call, [this](uint16_t node) { return let_run(node); }, "starting");
    });
    desk_.command("node.pause", [this](const Call& call) { act(call, &Target::pause, "pausing"); });
    desk_.command("node.step", [this](const Call& call) {
        act(
            call, [this](uint16_t node) { return step(node); }, "stepping");
    });
    desk_.command("node.stop", [this](const Call& call) {
        if (!network_) return call.fail("unavailable", kNoRobot);
        start_batch(
            nodes_of(call.in["node"]), [this](uint16_t node) { return stop(node); },
            [this, call](Batch& batch) {
                note_stopped(batch);
                call.done({{"failed", batch.failures()}});
            },
            "stopping");
    });
    desk_.command("node.reset",
                  [this](const Call& call) { act(call, &Target::reset, "restarting"); });
    desk_.command("node.save", [this](const Call& call) {
        if (!network_) return call.fail("unavailable", kNoRobot);
        start_batch(
            nodes_of(call.in["node"]), [this](uint16_t node) { return network_->save(node); },
            [call](Batch& batch) {
                call.done({{"failed", batch.failures()}, {"notes", batch.answers()}});
            },
            "saving");
    });
    desk_.command("node.load", [this](const Call& call) {
        if (!network_) return call.fail("unavailable", kNoRobot);
        std::vector<uint16_t> nodes = nodes_of(call.in["node"]);
        if (call.in["node"] == 0) {
            std::erase_if(nodes, [this](uint16_t node) { return doc_of(node).empty(); });
        }
        load(nodes, call.in.value("run", true), [call](Batch& batch) {
            call.done({{"loaded", batch.done}, {"failed", batch.failures()}});
        });
    });
}

void Target::declare_commands() {
    declare_node_commands();
    desk_.command("break.set", [this](const Call& call) { set_breakpoint(call); });
    desk_.command("break.clear", [this](const Call& call) {
        std::optional<std::string> doc;
        std::optional<int> line;
        if (call.in.contains("doc")) doc = call.in["doc"];
        if (call.in.contains("line")) line = call.in["line"];
        breakpoints_.clear(doc, line);
        place_breakpoints();
        breakpoints_changed_();
        call.done();
    });
    desk_.command("variable.set", [this](const Call& call) { set_variable(call); });
    desk_.command("event.send", [this](const Call& call) {
        call.answer(emit(call.in["name"], call.in["args"]));
    });
}

}  // namespace vagus::serve
