// A broker in memory, for tests of members together: retained messages, one order for everybody,
// last wills, connections that break.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fleet/member.hpp"
#include "fleet/topic.hpp"

namespace vagus::fleet {

class TestBroker {
public:
    // One member with its connection.
    struct Client {
        Member member;
        bool connected = false;
        std::vector<Filter> filters = {};
        std::vector<LinkEvent> inbox = {};
        std::vector<MemberAction> done = {};  // what it wanted of its robot
    };

    Client& add(MemberOptions options) {
        clients_.push_back(std::make_unique<Client>(Client{Member(std::move(options), now)}));
        return *clients_.back();
    }
    void connect(Client& client) {
        client.connected = true;
        client.inbox.emplace_back(Connected{});
    }
    void cut(Client& client) {
        client.connected = false;
        client.filters.clear();
        client.inbox = {Lost{"cut"}};
        publish(client.member.will(), nullptr);
    }
    // Until nobody has anything more to say now.
    void run() {
        for (bool more = true; more;) {
            more = false;
            for (const auto& client : clients_) more = turn(*client) || more;
        }
    }

    // What is retained on that topic; empty: nothing.
    std::string retained(const std::string& topic) const {
        const auto found = retained_.find(topic);
        return found == retained_.end() ? "" : found->second.payload;
    }

    Time now{};

private:
    bool turn(Client& client) {
        for (const LinkEvent& event : std::exchange(client.inbox, {})) {
            client.member.hear(event, now);
        }
        client.member.tick(now);
        const std::vector<MemberAction> actions = client.member.take();
        for (const MemberAction& action : actions) perform(client, action);
        return !actions.empty() || !client.inbox.empty();
    }

    void perform(Client& client, const MemberAction& action) {
        if (const auto* one = std::get_if<Subscribe>(&action)) return subscribe(client, *one);
        const auto* post = std::get_if<Post>(&action);
        if (post == nullptr) return client.done.push_back(action);
        if (!client.connected) return;
        publish(*post, &client);
        if (post->number != 0) client.inbox.emplace_back(Acknowledged{post->number});
    }

    void subscribe(Client& client, const Subscribe& wanted) {
        for (const Filter& filter : wanted.filters) {
            client.filters.push_back(filter);
            for (const auto& [topic, post] : retained_) {
                if (matches_filter(filter.topic, topic)) deliver(client, post, true);
            }
        }
    }

    void publish(const Post& post, const Client* by) {
        if (post.retained) retained_[post.topic] = post;
        for (const auto& client : clients_) {
            for (const Filter& filter : client->filters) {
                if (!matches_filter(filter.topic, post.topic)) continue;
                if (filter.own || client.get() != by) deliver(*client, post, false);
            }
        }
    }

    static void deliver(Client& client, const Post& post, bool retained) {
        auto event = event_of("lab", post.topic, post.payload, retained);
        if (event) client.inbox.push_back(std::move(*event));
    }

    std::vector<std::unique_ptr<Client>> clients_;
    std::map<std::string, Post> retained_;
};

}  // namespace vagus::fleet
