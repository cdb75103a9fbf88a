// Direct driving is a lease: a page that sets a variable of the safe stop drives that node for as
// long as the connection lasts.
#include <algorithm>

#include "serve/target/target.hpp"

namespace vagus::serve {

void Target::note_lease(uint32_t member, uint16_t node, const std::string& variable) {
    const auto found = safe_stop_.find(described_name(node));
    if (found == safe_stop_.end()) return;
    const auto& set = found->second.set;
    const bool drives =
        std::any_of(set.begin(), set.end(), [&](const auto& one) { return one.first == variable; });
    if (!drives) return;
    if (leases_.size() >= kLeasesMax && !leases_.contains(member)) return;
    leases_[member].insert(node);
}

void Target::end_leases() {
    for (auto lease = leases_.begin(); lease != leases_.end();) {
        const Clients::Member* const client = desk_.clients().find(lease->first);
        if (client && client->connection) {
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
}

}  // namespace vagus::serve
