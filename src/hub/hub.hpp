// The switch as a value: frames come in from links, and go out to other links by the rules of
// section 1.5 of docs/spec/aseba-wire-and-vm.md. No sockets, no clock, no threads: `net` moves the
// bytes of real connections, and the simulator and sessions use the same hub in one thread on
// virtual time.
//
//     hub::Hub hub;
//     const hub::LinkId robot = hub.add({.name = "robot"}).value();
//     const hub::LinkId host = hub.add({.name = "host"}).value();
//     hub.receive(robot, frame);                    // every other link gets it, by the rules
//     wire::Frame out;
//     while (hub.take(host, out)) show(out);
//
// Everything is forwarded as it came, also types and payloads that we do not know (decision D10),
// except that a remapped link sees its node under another id. Nothing a link does blocks or slows
// another: each has a bounded queue, and what is dropped is counted (output_queue.hpp). The order
// in which links are served is that of their adding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "hub/output_queue.hpp"
#include "wire/frame.hpp"

namespace vagus::hub {

constexpr size_t kLinksMax = 16384;
// Node ids that one link may be remembered for. A foreign network has fewer; a peer that makes up
// more is ignored.
constexpr size_t kNodesPerLinkMax = 256;
// Shared ids that wait to be taken; further ones are not told.
constexpr size_t kSharedIdsMax = 256;

// Never used twice in the life of a hub.
struct LinkId {
    uint32_t number = 0;
    auto operator<=>(const LinkId&) const = default;
};

// The node `target` behind this link is known to all others as `local` (remapLocal, remapTarget).
struct Remap {
    uint16_t local;
    uint16_t target;
    bool operator==(const Remap&) const = default;
};

struct LinkOptions {
    std::string name;  // for messages to people: "tcp:127.0.0.1:33333", "robot 1"
    std::optional<Remap> remap = std::nullopt;
    bool echo = false;  // the link gets its own frames back (asebaswitch -l)
    // The link ends at the node of this id, and nobody is behind it: it gets what is_for_node().
    std::optional<uint16_t> only_node = std::nullopt;
};

// Would a node of this id look at the frame: a user event, a request to all, a command to it, or a
// type that we do not know? What others tell hosts is nothing to it.
bool is_for_node(const wire::Frame& frame, uint16_t node);

// Two links on which the same node id was heard: two nodes that share an id, or links that make a
// ring. Events and answers of such nodes cannot be told apart.
struct SharedId {
    uint16_t node = 0;
    std::string first, second;  // names of the links, in the order in which it was heard on them
    bool operator==(const SharedId&) const = default;
};
// "node 3 is heard on two links, A and B: …", with the way out.
std::string sentence(const SharedId& shared);

struct LinkStats {
    uint64_t frames_received = 0;
    // For this link, dropped ones included. A Stop for a node that has one waiting is that one.
    uint64_t frames_queued = 0;
    Dropped dropped;
};

class Hub {
public:
    // Fails with Code::Limit when there are kLinksMax links.
    Result<LinkId> add(LinkOptions options);
    // Takes the link and what waits for it away. Every other link is told `Disconnected`
    // (section 2.2) for each node that was heard on it and on no other link.
    void remove(LinkId link);
    bool has(LinkId link) const { return find(link) != nullptr; }

    // Links with `only_node` for which something was queued since the last call, each once, in no
    // order. So a program with many such nodes need not ask each.
    std::vector<LinkId> take_reached();

    // From now on only frames of these types are taken from the link; the others are lost.
    void allow_only(LinkId link, std::set<uint16_t> types);

    // Routes a frame that came in on `from`.
    void receive(LinkId from, const wire::Frame& frame);
    // Is told of each frame that comes in, as it is routed, before it is; and of what remove() says
    // of nodes that are gone.
    void on_receive(std::function<void(LinkId from, const wire::Frame&)> told) {
        told_ = std::move(told);
    }

    // What waits for a link: whole frames for those who live in this process …
    bool take(LinkId link, wire::Frame& frame);
    // … or bytes for those who write to a stream: `output` is the next batch, borrowed until the
    // hub is used again, `sent` says how many of its bytes have left.
    std::span<const uint8_t> output(LinkId link);
    void sent(LinkId link, size_t bytes);
    // All bytes that wait for it.
    size_t waiting(LinkId link) const;

    LinkStats stats(LinkId link) const;
    const std::string& name(LinkId link) const;
    // In the order of their adding.
    std::vector<LinkId> links() const;
    // Nodes heard on a link, under the ids that the others know them by, in ascending order.
    std::vector<uint16_t> nodes(LinkId link) const;
    // Found since the last call; each pair of links once for each node.
    std::vector<SharedId> take_shared_ids();

private:
    struct Link {
        LinkId id;
        LinkOptions options;
        OutputQueue queue;
        uint64_t frames_received = 0;
        uint64_t frames_queued = 0;
        bool is_reached = false;  // it is in reached_
        std::set<uint16_t> nodes;
        std::optional<std::set<uint16_t>> allowed;  // types of frames; without: all
        uint16_t last_node = wire::kHostId;  // spares the set a search while one node speaks on
    };

    struct NodeOrder;  // of nodes_

    Link* find(LinkId link) const;
    Link& get(LinkId link) const;
    void note_node(Link& link, const wire::Frame& frame);
    void note_shared_id(const Link& link, uint16_t node);
    void send_to_others(const Link& from, const wire::Frame& frame);
    void send(Link& link, const wire::Frame& frame, std::span<uint8_t> encoded);
    // Those of nodes_ that would look at the frame, and perhaps some that would not.
    std::span<Link* const> nodes_for(const wire::Frame& frame) const;
    bool heard_elsewhere(uint16_t node) const;

    std::vector<std::unique_ptr<Link>> links_;  // by ascending id
    std::vector<Link*> others_;                 // those of links_ without `only_node`
    std::vector<Link*> nodes_;                  // those with it, by ascending `only_node`
    std::vector<LinkId> reached_;               // for take_reached()
    std::vector<SharedId> shared_ids_;          // not taken yet
    std::set<std::tuple<uint16_t, LinkId, LinkId>> told_shared_;  // of links that are there
    uint32_t last_number_ = 0;
    std::function<void(LinkId, const wire::Frame&)> told_;
};

}  // namespace vagus::hub
