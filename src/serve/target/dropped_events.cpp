#include "serve/target/dropped_events.hpp"

#include <algorithm>

namespace vagus::serve {

// The table: its own length in words, then pairs of event and address.
bool handles(const aesl::Program& program, uint16_t event) {
    if (program.bytecode.empty()) return false;
    const size_t length = std::min<size_t>(program.bytecode[0], program.bytecode.size());
    for (size_t at = 1; at + 1 < length; at += 2) {
        if (program.bytecode[at] == event) return true;
    }
    return false;
}

void DroppedEvents::state(uint16_t node, debug::ProgramState state) {
    if (state == debug::ProgramState::Paused) {
        counts_.try_emplace(node);
    } else {
        counts_.erase(node);
    }
}

void DroppedEvents::came(uint16_t node, std::optional<bool> handled) {
    const auto found = counts_.find(node);
    if (found == counts_.end()) return;
    if (!handled) found->second.known = false;
    if (handled == true) ++found->second.dropped;
}

std::optional<uint64_t> DroppedEvents::of(uint16_t node) const {
    const auto found = counts_.find(node);
    if (found == counts_.end() || !found->second.known) return std::nullopt;
    return found->second.dropped;
}

}  // namespace vagus::serve
