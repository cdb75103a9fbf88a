#include "debug/fetch.hpp"

namespace vagus::debug {

bool Fetch::ask(Outbox& out, NodeId id) {
    if (tries_++ >= kFetchTriesMax) return false;
    deadline_ = out.now + kFetchRetry;
    for (size_t at = 0; at < values_.size(); at++) {
        if (arrived_[at]) continue;
        auto request = message_to<wire::GetVariables>(id);
        request.start = static_cast<uint16_t>(start_ + at);
        const size_t first = at;
        while (at < values_.size() && !arrived_[at] && at - first < wire::kVariablesReplyWordsMax)
            at++;
        request.length = static_cast<uint16_t>(at - first);
        out.send(request);
        at--;  // the loop goes on behind the piece
    }
    return true;
}

void Fetch::receive(const wire::Variables& reply) {
    for (size_t i = 0; i < reply.values.count; i++) {
        const size_t address = reply.start + i;
        if (address < start_ || address >= start_ + values_.size()) continue;
        const size_t at = address - start_;
        if (!arrived_[at]) have_++;
        arrived_[at] = true;
        values_[at] = reply.values.values[i];
    }
}

}  // namespace vagus::debug
