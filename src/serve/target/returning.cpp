// Nodes that were away. What they run when they are back is asked, not guessed: a node may have
// been started again, or be another one.
#include "debug/program_mark.hpp"
#include "serve/target/target.hpp"

namespace vagus::serve {

// The program that the node has is known by its text: names, lines, breakpoints.
void Target::restore(uint16_t node) {
    const CompiledScript* script = scripts_.compiled(doc_of(node));
    const Known& known = known_[node];
    if (!script || !script->result.ok() || !known.has_program) return;
    network_->set_common(script->common);
    if (known.loaded == script->source) (void)network_->adopt(node, script->result.program).ok();
    place_breakpoints();
    desk_.topics().touch("robot");
    desk_.topics().touch("node");
}

// In a simulation it was its process that was slow: nothing has changed there. Elsewhere nobody
// knows from now on what the node does.
void Target::went_away(uint16_t node) {
    Known& known = known_[node];
    known.runs = known.held = false;
    if (!live()) return;
    known.away = true;
    network_->forget_program(node);
    brake(node);
}

void Target::came_back(uint16_t node) {
    Known& known = known_[node];
    const bool away = std::exchange(known.away, false);
    if (!known.has_program) return;
    if (!live()) return restore(node);
    if (!away) return;
    if (debug::mark_address(network_->node(node)->target)) {
        known.in_doubt = true;  // its answer is under way
        return;
    }
    program_is_lost(node);
}

void Target::program_is_lost(uint16_t node) {
    Known& known = known_[node];
    known.lost_program = true;
    known.has_program = known.in_doubt = false;
    known.loaded.clear();
}

// What it runs is what it had, or it gets that again.
void Target::told_program(uint16_t node, uint32_t mark) {
    Known& known = known_[node];
    if (!std::exchange(known.in_doubt, false)) return;
    const CompiledScript* script = scripts_.compiled(doc_of(node));
    const bool same = script && script->result.ok() && script->source == known.loaded &&
                      debug::mark_of(script->result.program.bytecode) == mark;
    if (!same) return program_is_lost(node);
    restore(node);
    // It ran on while nobody watched.
    if (!moves(node) || brake_causes_.empty()) return;
    brake_causes_.erase(node);
    braked_.insert(node);
    known.braking = network_->pause_now(node);
    make_safe(node);
}

// Its script is loaded again, and it stays paused.
void Target::load_lost_programs() {
    std::vector<uint16_t> nodes;
    for (auto& [node, known] : known_) {
        const debug::NodeView* view = network_->node(node);
        if (!known.lost_program || !view || !view->connected || !view->described) continue;
        known.lost_program = false;
        nodes.push_back(node);
    }
    for (const uint16_t node : nodes) {
        const bool tells = debug::mark_address(network_->node(node)->target).has_value();
        say_("note", name_of(node) + (tells ? " came back without its script; its script is "
                                              "loaded again and it stays paused"
                                            : " came back and cannot tell which script it has; "
                                              "its script is loaded again and it stays paused"));
        load({node}, false, [](Batch&) {});
    }
}

}  // namespace vagus::serve
