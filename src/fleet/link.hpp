// A connection to a broker, as values: the border between the rules of a fleet and what carries
// its messages: libmosquitto (serve/broker), or in virtual time a modelled link.
//
//     link.subscribe({{.topic = "vagus/1/lab/cmd/all/stop"}});
//     link.publish({.topic = …, .payload = …, .number = 7});
//     for (const LinkEvent& event : link.take()) member.hear(event, now);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fleet/message.hpp"

namespace vagus::fleet {

struct Filter {
    std::string topic = {};  // may have wildcards
    bool own = true;         // also what this client publishes
};

struct Post {
    std::string topic = {}, payload = {};
    int qos = 1;
    bool retained = false;
    uint32_t expires_s = 0;  // a broker drops what it could not deliver by then; 0: never
    uint64_t number = 0;     // Acknowledged tells it; 0: nobody waits
};

// A session: what was subscribed before is not.
struct Connected {};
struct Lost {
    std::string why;  // a sentence; the same again is told once
};
struct Received {
    Heard heard;
    bool retained = false;  // the last one that was published before we subscribed
};
// The broker has it. What was not acknowledged when the link was lost may have arrived, or not.
struct Acknowledged {
    uint64_t number = 0;
    std::string refused = {};  // why it passed it on to nobody; empty: it did
};
// What was retained there is nothing any more: who may write it has taken it back.
struct TakenBack {
    Topic topic;
};
// A message that is none of the list: counted, and never obeyed.
struct Malformed {
    std::string why;
};

using LinkEvent = std::variant<Connected, Lost, Received, Acknowledged, TakenBack, Malformed>;

// What a message that a broker delivers is; nothing: it is none of that fleet.
std::optional<LinkEvent> event_of(std::string_view fleet, std::string_view topic,
                                  std::string_view payload, bool retained);

class Link {
public:
    virtual ~Link() = default;
    // Both do nothing while there is no connection.
    virtual void subscribe(const std::vector<Filter>& filters) = 0;
    virtual void publish(const Post& post) = 0;
    // What has happened since it was asked last, in order.
    virtual std::vector<LinkEvent> take() = 0;
};

}  // namespace vagus::fleet
