// Breakpoints on the nodes, and how they stay with their lines: those of the project count in the
// text as it is now, those of a node in the text that it has loaded.
#include <algorithm>

#include "serve/target/target.hpp"

namespace vagus::serve {

namespace {

constexpr const char* kNotLoaded =
    "the node runs an older text, which has no such line; load the script";

}  // namespace

ScriptBreakpoint* Target::breakpoint_of(uint16_t node, int line) {
    const auto here = lines_between(node, Direction::ToText).after(line);
    return here ? breakpoints_.find(doc_of(node), *here) : nullptr;
}

LineMap Target::lines_between(uint16_t node, Direction direction) const {
    const auto known = known_.find(node);
    const CompiledScript* script = scripts_.compiled(doc_of(node));
    if (!script || known == known_.end() || !known->second.has_program) return {"", ""};
    const std::string& loaded = known->second.loaded;
    const bool to_text = direction == Direction::ToText;
    return to_text ? LineMap(loaded, script->source) : LineMap(script->source, loaded);
}

bool Target::runs_older_text(uint16_t node) const {
    const auto known = known_.find(node);
    const CompiledScript* script = scripts_.compiled(doc_of(node));
    return script && known != known_.end() && known->second.has_program &&
           known->second.loaded != script->source;
}

void Target::place_breakpoints() {
    desk_.topics().touch("breakpoints");
    remember_lines();
    if (!network_) return;
    for (const uint16_t node : live_nodes()) {
        if (!doc_of(node).empty() && network_->node(node)->program) place_breakpoints(node);
    }
}

void Target::place_breakpoints(uint16_t node) {
    const std::string doc = doc_of(node);
    const LineMap to_text = lines_between(node, Direction::ToText);
    const LineMap to_node = lines_between(node, Direction::ToNode);
    for (const debug::LineBreakpoint& there : std::vector(network_->node(node)->breakpoints)) {
        const auto here = to_text.after(there.line);
        const ScriptBreakpoint* wanted = here ? breakpoints_.find(doc, *here) : nullptr;
        if (!wanted || !wanted->enabled || wanted->condition != there.condition) {
            (void)network_->clear_breakpoint(node, there.line).ok();
        }
    }
    for (const ScriptBreakpoint& wanted : breakpoints_.all()) {
        if (wanted.doc != doc || !wanted.enabled) continue;
        ScriptBreakpoint* const mark = breakpoints_.find(doc, wanted.line);
        const auto line = to_node.after(wanted.line);
        if (!line) {
            mark->set = false;
            mark->why = kNotLoaded;
            continue;
        }
        const auto& there = network_->node(node)->breakpoints;
        const bool known = std::any_of(there.begin(), there.end(), [&](const auto& one) {
            return one.line == *line && one.condition == wanted.condition;
        });
        if (known) continue;
        const auto asked = network_->set_breakpoint(node, *line, wanted.condition);
        // The reason of the node has the line numbers of the text that it has loaded.
        const bool no_line = !asked.ok() && asked.error().code == Code::NotFound;
        const bool older = no_line && runs_older_text(node);
        mark->why = asked.ok() ? "" : older ? kNotLoaded : asked.error().what;
    }
}

// ---- with their lines ----

void Target::follow_breakpoints() {
    marked_.clear();
    remember_lines();
}

void Target::remember_lines() {
    std::map<std::string, std::string> marked;
    for (const ScriptBreakpoint& one : breakpoints_.all()) {
        if (marked.contains(one.doc)) continue;
        const auto known = marked_.find(one.doc);
        if (known != marked_.end()) {
            marked.insert(*known);
        } else if (const auto opened = files_.open(one.doc); opened.ok()) {
            marked.emplace(one.doc, opened.value().text);
        }
    }
    marked_ = std::move(marked);
}

// A file that cannot be read right now changes nothing: it may come back as it was.
void Target::follow_lines(const std::string& file) {
    bool moved = false;
    for (auto& [doc, text] : marked_) {
        if (doc.substr(0, doc.rfind('#')) != file) continue;
        const auto opened = files_.open(doc);
        if (!opened.ok() || opened.value().text == text) continue;
        moved |= breakpoints_.follow(doc, LineMap(text, opened.value().text));
        text = opened.value().text;
    }
    if (!moved) return;
    place_breakpoints();
    breakpoints_changed_();
}

}  // namespace vagus::serve
