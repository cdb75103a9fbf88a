#include "fleet/keeper_client.hpp"

#include "fleet/limits.hpp"

namespace vagus::fleet {

std::vector<Filter> KeeperClient::filters() const {
    return {{text_of(options_.fleet, {.kind = Kind::Reply, .robot = options_.robot})},
            {text_of(options_.fleet, {.kind = Kind::Beat})}};
}

void KeeperClient::hear(const LinkEvent& event, Time now) {
    const auto* received = std::get_if<Received>(&event);
    if (received == nullptr) return;
    const Message& message = received->heard.message;
    if (const auto* beat = std::get_if<keeper::Beat>(&message)) leases_.heard_of(beat->epoch, now);
    const auto* reply = std::get_if<Reply>(&message);
    const bool ours = reply != nullptr && received->heard.topic.robot == options_.robot &&
                      reply->epoch == options_.epoch;
    if (ours) leases_.hear(reply->number, reply->reply, now);
}

// A question that is older than it is asked again says nothing that the next one does not say.
void KeeperClient::tick(Time now) {
    constexpr uint32_t kSeconds = keeper::kAskAtMost / 1s;
    for (const keeper::Ask& ask : leases_.tick(now)) {
        posts_.push_back({.topic = text_of(options_.fleet, topic_of(options_.robot, ask.request)),
                          .payload = payload_of(Question{options_.epoch, ask.number, ask.request}),
                          .qos = info_of(Kind::Question).qos,
                          .expires_s = kSeconds});
    }
}

}  // namespace vagus::fleet
