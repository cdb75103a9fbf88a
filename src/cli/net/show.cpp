#include "cli/net/show.hpp"

#include <algorithm>
#include <cstdio>

#include "base/json.hpp"
#include "base/text.hpp"
#include "base/time.hpp"

namespace vagus::cli {
namespace {

// Nobody can ask a node for its program. What it has executed shows that there is one; a node that
// has executed nothing may have a program that waits for its first event.
const char* program_of(const debug::NodeView& node) {
    const bool paused = node.state == debug::ProgramState::Paused;
    return node.program || node.at.pc > 0 || paused ? "present" : "unknown";
}

// A node between two events is in the same state after `pause` as after `stop`, and the next event
// makes it one that is paused inside an event: one word for both.
std::string state_of(const debug::NodeView& node) {
    if (!node.connected) return "disconnected";
    const bool stopped = node.state == debug::ProgramState::Stopped;
    return debug::name_of(stopped ? debug::ProgramState::Paused : node.state);
}

std::string array_of(const std::string& name, uint16_t size) {
    return size == 1 ? name : name + "[" + std::to_string(size) + "]";
}

std::string signature(const aesl::NativeFunction& native) {
    std::string text = native.name + "(";
    for (size_t i = 0; i < native.parameters.size(); i++) {
        const aesl::NativeParameter& parameter = native.parameters[i];
        text += (i > 0 ? ", " : "") + parameter.name;
        if (parameter.size > 1) text += "[" + std::to_string(parameter.size) + "]";
        if (parameter.size <= 0) {
            const char letter = static_cast<char>('N' + std::min(-parameter.size, 12) - 1);
            text += parameter.size == 0 ? "[]" : "[" + std::string(1, letter) + "]";
        }
    }
    return text + ")";
}

}  // namespace

std::string padded(std::string text, size_t width) {
    const size_t size = count_code_points(text);
    return size < width ? text.append(width - size, ' ') : text;
}

size_t widest(const std::vector<std::string>& texts) {
    size_t width = 0;
    for (const std::string& text : texts) width = std::max(width, count_code_points(text));
    return width;
}

std::string table(std::vector<std::vector<std::string>> rows) {
    std::vector<size_t> widths;
    for (std::vector<std::string>& row : rows) {
        for (std::string& cell : row) cell = visible(cell);
        widths.resize(std::max(widths.size(), row.size()));
        for (size_t i = 0; i < row.size(); i++) {
            widths[i] = std::max(widths[i], count_code_points(row[i]));
        }
    }
    std::string text;
    for (const std::vector<std::string>& row : rows) {
        std::string line;
        for (size_t i = 0; i < row.size(); i++) {
            line += row[i];
            line.append(widths[i] - count_code_points(row[i]) + 2, ' ');
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string json_list(const std::vector<std::string>& elements) {
    if (elements.empty()) return "[]\n";
    std::string text = "[\n";
    for (size_t i = 0; i < elements.size(); i++) {
        text += "  " + elements[i] + (i + 1 < elements.size() ? ",\n" : "\n");
    }
    return text + "]\n";
}

std::string json_words(const std::vector<int16_t>& words) {
    std::string text = "[";
    for (size_t i = 0; i < words.size(); i++)
        text += (i > 0 ? ", " : "") + std::to_string(words[i]);
    return text + "]";
}

std::string spaced(const std::vector<int16_t>& words) {
    std::string text;
    for (size_t i = 0; i < words.size(); i++) text += (i > 0 ? " " : "") + std::to_string(words[i]);
    return text;
}

std::string node_name(const NetSession& session, debug::NodeId id) {
    const debug::NodeView* node = session.network().node(id);
    const std::string number = std::to_string(id);
    if (node == nullptr || !node->described) return number;
    return number + " \"" + visible(node->name) + "\"";
}

// ---- nodes ----

std::string show_nodes(const NetSession& session, const std::vector<debug::NodeId>& ids) {
    std::vector<std::vector<std::string>> rows;
    for (const debug::NodeId id : ids) {
        const debug::NodeView& node = session.view(id);
        std::string state = state_of(node);
        if (node.state == debug::ProgramState::Paused) {
            state += " at " + show_place(session, id, node.at);
        }
        const std::string program = program_of(node);
        rows.push_back({std::to_string(id), node.described ? node.name : "(no description)", state,
                        "protocol " + std::to_string(node.protocol), "program " + program});
    }
    return table(rows);
}

std::string show_nodes_json(const NetSession& session, const std::vector<debug::NodeId>& ids) {
    std::vector<std::string> elements;
    for (const debug::NodeId id : ids) {
        const debug::NodeView& node = session.view(id);
        elements.push_back("{ \"id\": " + std::to_string(id) +
                           ", \"name\": " + (node.described ? json_quote(node.name) : "null") +
                           ", \"state\": " + json_quote(state_of(node)) +
                           ", \"protocol\": " + std::to_string(node.protocol) +
                           ", \"program\": " + json_quote(program_of(node)) +
                           (node.id_shared ? ", \"id_shared\": true" : "") + " }");
    }
    return json_list(elements);
}

std::string id_list(const std::vector<debug::NodeId>& ids) {
    std::string text;
    for (size_t i = 0; i < ids.size();) {
        size_t last = i;
        while (last + 1 < ids.size() && ids[last + 1] == ids[last] + 1) ++last;
        text += (text.empty() ? "" : ", ") + std::to_string(ids[i]);
        if (last > i) text += (last == i + 1 ? ", " : " to ") + std::to_string(ids[last]);
        i = last + 1;
    }
    return text;
}

std::string show_description(const debug::NodeView& node) {
    const aesl::Target& target = node.target;
    std::vector<std::vector<std::string>> rows = {
        {"node", std::to_string(node.id)},
        {"name", target.name},
        {"protocol", std::to_string(target.protocol_version)},
        {"bytecode", std::to_string(target.bytecode_size) + " words"},
        {"variables", std::to_string(target.variables_size) + " words"},
        {"stack", std::to_string(target.stack_size) + " words"},
    };
    size_t address = 0;
    for (const aesl::NamedVariable& variable : target.variables) {
        rows.push_back({"variable", array_of(variable.name, variable.size),
                        "address " + std::to_string(address)});
        address += variable.size;
    }
    for (const aesl::LocalEvent& event : target.local_events) {
        rows.push_back({"event", event.name, event.doc});
    }
    for (const aesl::NativeFunction& native : target.natives) {
        rows.push_back({"native", signature(native), native.doc});
    }
    return table(rows);
}

// ---- events ----

std::string show_place(const NetSession& session, debug::NodeId id, const debug::CodePlace& at) {
    const aesl::Script* script = session.script_of(id);
    if (at.line > 0 && script != nullptr) {
        return session.project()->path + ":" + std::to_string(file_line(*script, at.line));
    }
    if (at.line > 0) return "line " + std::to_string(at.line) + " of its script";
    return "pc " + std::to_string(at.pc);
}

namespace {

// What `log` and `watch` say of an event, before it is text or JSON.
struct Told {
    const char* kind = nullptr;  // nullptr: not shown
    std::string event;
    std::vector<int16_t> args = {};
    std::string detail = {};  // for people
    std::optional<debug::CodePlace> at = std::nullopt;
    std::string text = {};  // of a fault
};

struct Teller {
    Told operator()(const debug::NodeAppeared& e) const {
        return {.kind = "node",
                .event = "appeared",
                .detail = "protocol " + std::to_string(e.protocol)};
    }
    Told operator()(const debug::NodeDescribed& e) const {
        return {.kind = "node", .event = "described", .detail = e.name};
    }
    Told operator()(const debug::DescriptionFailed& e) const {
        return {.kind = "node", .event = "no_description", .detail = e.why};
    }
    Told operator()(const debug::NodeDisconnected&) const {
        return {.kind = "node", .event = "disconnected"};
    }
    Told operator()(const debug::NodeReconnected&) const {
        return {.kind = "node", .event = "reconnected"};
    }
    Told operator()(const debug::ProtocolMismatch& e) const {
        return {.kind = "node",
                .event = "protocol_mismatch",
                .detail = "protocol " + std::to_string(e.protocol) + "; 4 to 9 are understood"};
    }
    Told operator()(const debug::NodeIdShared& e) const {
        return {.kind = "node",
                .event = "id_shared",
                .detail = e.other_name.empty() ? "with another node"
                                               : "with a node called " + e.other_name};
    }
    Told operator()(const debug::TooManyNodes&) const {
        return {.kind = "node",
                .event = "too_many_nodes",
                .detail = std::to_string(debug::kNodesMax) + " are the most that is shown"};
    }
    Told operator()(const debug::StateChanged& e) const {
        return {.kind = "state", .event = debug::name_of(e.state), .at = e.at};
    }
    Told operator()(const debug::Fault& e) const {
        return {.kind = "fault",
                .event = debug::name_of(e.kind),
                .detail = e.text,
                .at = e.at,
                .text = e.text};
    }
    Told operator()(const debug::NodeConfirmed&) const { return {}; }
    Told operator()(const debug::BreakpointResult&) const { return {}; }
    Told operator()(const debug::BreakpointReached&) const { return {}; }
    Told operator()(const debug::BreakpointPassed&) const { return {}; }
    Told operator()(const debug::BreakpointHit& e) const {
        return {.kind = "breakpoint", .event = "hit", .at = e.at};
    }
    Told operator()(const debug::ConditionFailed& e) const {
        return {.kind = "breakpoint",
                .event = "condition_failed",
                .detail = e.why,
                .at = e.at,
                .text = e.why};
    }
    Told operator()(const debug::ProgramReplaced&) const {
        return {.kind = "program", .event = "replaced", .detail = "by another host or a restart"};
    }
    Told operator()(const debug::ProgramTold&) const { return {}; }
    Told operator()(const debug::ProgramUntold&) const { return {}; }
    Told operator()(const debug::VariablesArrived&) const { return {}; }
    Told operator()(const debug::VariableChanged& e) const {
        return {.kind = "variable",
                .event = e.name,
                .args = e.values,
                .detail = "= " + spaced(e.values)};
    }
    Told operator()(const debug::UserEvent& e) const {
        const std::string name = e.name.empty() ? std::to_string(e.number) : e.name;
        return {.kind = "event", .event = name, .args = e.arguments, .detail = spaced(e.arguments)};
    }
    Told operator()(const debug::RequestDone&) const { return {}; }
};

// A running node has no place worth telling; of a stopped one the line is, the counter is not.
bool has_place(const Told& told) {
    if (!told.at || told.event == "running") return false;
    return told.event != "stopped" || told.at->line > 0;
}

std::string seconds(Time at) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", seconds_of(at));
    return text;
}

std::string short_name(const NetSession& session, debug::NodeId id) {
    if (id == wire::kHostId) return "host";
    const debug::NodeView* node = session.network().node(id);
    const std::string number = std::to_string(id);
    return node == nullptr || !node->described ? number : number + " " + node->name;
}

constexpr size_t kTimeWidth = 8, kNodeWidth = 14, kKindWidth = 10;

}  // namespace

std::string show_event(const NetSession& session, const debug::Event& event) {
    const Told told = std::visit(Teller{}, event.what);
    if (told.kind == nullptr) return "";
    const std::string time = seconds(event.at);
    std::string line = time.size() < kTimeWidth ? std::string(kTimeWidth - time.size(), ' ') : "";
    line += time + "  " + padded(short_name(session, event.node), kNodeWidth) + "  " +
            padded(told.kind, kKindWidth) + "  " + told.event;
    if (!told.detail.empty()) line += (told.kind[0] == 'f' ? ": " : " ") + told.detail;
    if (has_place(told)) line += " at " + show_place(session, event.node, *told.at);
    return visible(line) + "\n";
}

std::string show_event_json(const NetSession& session, const debug::Event& event) {
    const Told told = std::visit(Teller{}, event.what);
    if (told.kind == nullptr) return "";
    std::string line =
        "{ \"t\": " + seconds(event.at) + ", \"node\": " + std::to_string(event.node) +
        ", \"kind\": " + json_quote(told.kind) + ", \"event\": " + json_quote(told.event) +
        ", \"args\": " + json_words(told.args);
    if (has_place(told)) {
        line += ", \"pc\": " + std::to_string(told.at->pc);
        const aesl::Script* script = session.script_of(event.node);
        if (told.at->line > 0 && script != nullptr) {
            line += ", \"file\": " + json_quote(session.project()->path) +
                    ", \"line\": " + std::to_string(file_line(*script, told.at->line));
        }
    }
    if (!told.text.empty()) line += ", \"text\": " + json_quote(told.text);
    return line + " }\n";
}

}  // namespace vagus::cli
