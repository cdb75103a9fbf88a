// Direct driving is a lease: a page that sets a variable of the safe stop drives that node for as
// long as the client is there.
#include "serve/target/target.hpp"
#include "session/driving.hpp"

namespace vagus::serve {

void Target::note_lease(uint32_t member, uint16_t node, const debug::VariableRange& range) {
    if (!session::drives(*network_, node, range, safe_stop_)) return;
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
