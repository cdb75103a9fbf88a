// Direct driving is a lease: a page that sets a variable of the safe stop drives that node for as
// long as the client is there.
#include <algorithm>

#include "serve/target/target.hpp"

namespace vagus::serve {

namespace {

bool overlap(const debug::VariableRange& one, const debug::VariableRange& other) {
    return one.address < other.address + other.count && other.address < one.address + one.count;
}

}  // namespace

// By its words: a variable has more than one name, motor.left.target and motor.left.target[0].
void Target::note_lease(uint32_t member, uint16_t node, const debug::VariableRange& range) {
    const auto found = safe_stop_.find(described_name(node));
    if (found == safe_stop_.end()) return;
    const auto& set = found->second.set;
    const bool drives = std::any_of(set.begin(), set.end(), [&](const auto& one) {
        const auto named = network_->variable(node, one.first);
        return named.ok() && overlap(named.value(), range);
    });
    if (!drives) return;
    if (leases_.size() >= kLeasesMax && !leases_.contains(member)) return;
    leases_[member].insert(node);
}

void Target::end_leases() {
    for (auto lease = leases_.begin(); lease != leases_.end();) {
        if (desk_.is_there(lease->first)) {
            ++lease;
            continue;
        }
        for (const uint16_t node : lease->second) {
            make_safe(node);
            say_("note",
                 name_of(node) + " was stopped: the page that drove it lost the connection");
        }
        lease = leases_.erase(lease);
    }
    if (network_) send_frames();
}

}  // namespace vagus::serve
