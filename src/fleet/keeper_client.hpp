// What a member asks the keeper of its fleet, over a link: questions that are asked until they are
// answered, and leases (keeper/leases.hpp). A state machine, as Member is.
//
//     KeeperClient client({.fleet = "lab", .robot = "r1", .epoch = …});
//     const uint64_t number = client.ask(keeper::Take{"pick", 10s}, now);
//     for (const LinkEvent& event : link.take()) client.hear(event, now);
//     client.tick(now);
//     for (const Post& post : client.take()) link.publish(post);
//     for (const keeper::Over& over : client.leases().take_over()) tell(over);
#pragma once

#include <string>
#include <vector>

#include "fleet/link.hpp"
#include "keeper/leases.hpp"

namespace vagus::fleet {

class KeeperClient {
public:
    struct Options {
        std::string fleet = {}, robot = {};
        int64_t epoch = 0;  // as that of the member
    };
    explicit KeeperClient(Options options) : options_(std::move(options)) {}

    // To be subscribed to at each connection.
    std::vector<Filter> filters() const;
    // 0: too many questions at once.
    uint64_t ask(keeper::Request request, Time now) { return leases_.ask(std::move(request), now); }
    void hear(const LinkEvent& event, Time now);
    void tick(Time now);
    std::vector<Post> take() { return std::exchange(posts_, {}); }

    keeper::Leases& leases() { return leases_; }
    const keeper::Leases& leases() const { return leases_; }

private:
    const Options options_;
    keeper::Leases leases_;
    std::vector<Post> posts_;
};

}  // namespace vagus::fleet
