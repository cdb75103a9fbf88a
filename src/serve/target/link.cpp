// The link to the nodes: there, or lost, also when nobody has said so.
#include "serve/target/target.hpp"

namespace vagus::serve {

Connection Target::state() const {
    if (!carrier_) return Connection::Connecting;
    const Connection carried = carrier_->connection();
    return mute_ && carried == Connection::Connected ? Connection::Lost : carried;
}

std::string Target::why_lost() const {
    if (!carrier_) return {};
    if (mute_ && carrier_->connection() == Connection::Connected) {
        return "no answer on this link for 3 s: a program or cable is holding back what is sent; "
               "the nodes may be driving";
    }
    return carrier_->why();
}

void Target::link_changed() {
    if (connection_ == Connection::Connected) network_->link_lost();
    connection_ = state();
    if (connection_ == Connection::Connected) network_->list_nodes();
    desk_.topics().touch("robot");
}

// Nodes are asked each second who is there. A link without nodes may be silent, and so may one of a
// simulation, whose process says itself how it is. What we slept, or did else, is not its silence.
void Target::watch_link(Time now, bool heard) {
    const Duration since = std::min(now, due_ + kLateMax) - looked_at_;
    looked_at_ = now;
    const bool expects = live() && !network_->nodes().empty();
    if (heard || !expects || carrier_->connection() != Connection::Connected) {
        silence_ = {};
        mute_ = false;
    } else {
        silence_ += std::max(since, Duration::zero());
        mute_ = silence_ >= kLinkSilentMax;
    }
    if (state() != connection_) link_changed();
}

}  // namespace vagus::serve
