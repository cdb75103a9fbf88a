// Nodes in an endless loop. Where another event comes the node tells that it ended the handler
// (Fault of kind Killed); where none comes it tells nothing, and is asked.
//
// Nodes look at questions between two turns of the machine, each of 1,000 instructions or so: a
// short handler is never met there. One that takes long is met now and then, one without an end
// always.
#include <fmt/format.h>

#include <algorithm>

#include "serve/target/target.hpp"

namespace vagus::serve {

void Target::look_at_handlers(Time now) {
    if (!looks_for_endless_ || !network_ || now < look_at_) return;
    look_at_ = now + kHandlerLookEvery;
    for (const debug::NodeId node : network_->nodes()) {
        const debug::NodeView& view = *network_->node(node);
        Known& known = known_[node];
        const bool runs = view.connected && view.state == debug::ProgramState::Running;
        if (!runs || !known.has_program || !known.busy.empty() || known.look) continue;
        const auto asked = network_->query(node);
        if (asked.ok()) known.look = asked.value();
    }
}

// Without an answer nothing is known: a world may be paused, a line cut.
void Target::note_look(uint16_t node, bool answered) {
    Known& known = known_[node];
    known.look.reset();
    const debug::NodeView* const view = network_->node(node);
    const bool busy = answered && view != nullptr && view->in_event &&
                      view->state == debug::ProgramState::Running;
    known.busy_looks = busy ? std::min(known.busy_looks + 1, kEndlessLooks) : 0;
    if (answered && !busy && std::exchange(known.endless, false)) {
        known.fault.clear();
        known.fault_line = 0;
    }
    if (known.busy_looks < kEndlessLooks || !known.fault.empty()) return;
    known.endless = true;
    known.fault = debug::kEndlessText;
    known.fault_line = view->at.line;
    const std::string place = view->at.line > 0 ? fmt::format(" at line {}", view->at.line) : "";
    say_("error", fmt::format("{}{}: {}", name_of(node), place, known.fault));
    desk_.topics().touch("robot");
}

}  // namespace vagus::serve
