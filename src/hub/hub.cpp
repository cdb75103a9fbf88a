#include "hub/hub.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace vagus::hub {

namespace {

void put_word(uint8_t* bytes, uint16_t value) {
    bytes[0] = static_cast<uint8_t>(value & 0xff);
    bytes[1] = static_cast<uint8_t>(value >> 8);
}

// Hosts have no id of their own, commands and requests come from hosts.
bool comes_from_a_node(const wire::Frame& frame) {
    return frame.source != wire::kHostId && frame.source != wire::kInvalidId && frame.type < 0xa000;
}

constexpr uint16_t kDisconnected = static_cast<uint16_t>(wire::MessageType::Disconnected);

// What nodes tell hosts, boot loaders' answers included.
bool is_for_hosts(uint16_t type) {
    return (type >= 0x8004 && type <= 0x8006) || (type >= 0x9000 && type <= 0x9fff);
}

}  // namespace

bool is_for_node(const wire::Frame& frame, uint16_t node) {
    if (wire::is_user_event(frame.type)) return true;
    if (wire::is_command(frame.type)) return frame.first_word() == node;
    return !is_for_hosts(frame.type);
}

std::string sentence(const SharedId& shared) {
    return "node " + std::to_string(shared.node) + " is heard on two links, " + shared.first +
           " and " + shared.second +
           ": two nodes share this id, or the links make a ring; give one node another id, or "
           "remove one link";
}

struct Hub::NodeOrder {
    bool operator()(const Link* a, uint16_t b) const { return *a->options.only_node < b; }
    bool operator()(uint16_t a, const Link* b) const { return a < *b->options.only_node; }
};

void Hub::receive(LinkId from, const wire::Frame& frame) {
    Link& link = get(from);
    ++link.frames_received;
    if (link.allowed && !link.allowed->contains(frame.type)) return;
    const std::optional<Remap>& remap = link.options.remap;
    if (remap && frame.source == remap->target) {
        wire::Frame renamed = frame;
        renamed.source = remap->local;
        note_node(link, renamed);
        send_to_others(link, renamed);
        return;
    }
    note_node(link, frame);
    send_to_others(link, frame);
}

void Hub::send_to_others(const Link& from, const wire::Frame& frame) {
    if (told_) told_(from.id, frame);
    std::array<uint8_t, wire::kFrameMax> bytes;
    const std::span<uint8_t> encoded(bytes.data(), wire::encode(frame, bytes.data()));
    const auto offer = [&](Link* link) {
        if (link != &from || link->options.echo) send(*link, frame, encoded);
    };
    std::for_each(others_.begin(), others_.end(), offer);
    const std::span<Link* const> nodes = nodes_for(frame);
    std::for_each(nodes.begin(), nodes.end(), offer);
}

// Hundreds of simulated nodes must not each be asked about what concerns one, or none.
std::span<Hub::Link* const> Hub::nodes_for(const wire::Frame& frame) const {
    if (is_for_hosts(frame.type)) return {};
    if (!wire::is_command(frame.type)) return nodes_;
    const auto [first, end] =
        std::equal_range(nodes_.begin(), nodes_.end(), frame.first_word(), NodeOrder{});
    return {first, end};
}

void Hub::send(Link& link, const wire::Frame& frame, std::span<uint8_t> encoded) {
    if (link.options.only_node && !is_for_node(frame, *link.options.only_node)) return;
    const std::optional<Remap>& remap = link.options.remap;
    const bool renamed = remap && wire::is_command(frame.type);
    if (renamed) {
        // A command without a destination matches none: first_word() is then kInvalidId.
        if (frame.size < 2 || frame.first_word() != remap->local) return;
        put_word(encoded.data() + wire::kHeaderSize, remap->target);
    }
    if (link.options.only_node && !std::exchange(link.is_reached, true))
        reached_.push_back(link.id);
    if (link.queue.push(encoded)) ++link.frames_queued;
    if (renamed) put_word(encoded.data() + wire::kHeaderSize, remap->local);
}

Result<LinkId> Hub::add(LinkOptions options) {
    if (links_.size() >= kLinksMax) {
        return Error{Code::Limit, options.name + ": the switch has " + std::to_string(kLinksMax) +
                                      " links already, which is its limit; close one first"};
    }
    auto link = std::make_unique<Link>();
    link->id = LinkId{++last_number_};
    link->options = std::move(options);
    Link* const added = link.get();
    links_.push_back(std::move(link));
    if (!added->options.only_node)
        others_.push_back(added);
    else
        nodes_.insert(
            std::upper_bound(nodes_.begin(), nodes_.end(), *added->options.only_node, NodeOrder{}),
            added);
    return added->id;
}

void Hub::remove(LinkId link) {
    const auto at = std::find_if(links_.begin(), links_.end(),
                                 [link](const auto& each) { return each->id == link; });
    assert(at != links_.end());
    const std::unique_ptr<Link> gone = std::move(*at);
    links_.erase(at);
    std::erase(reached_, link);
    std::erase(others_, gone.get());
    std::erase(nodes_, gone.get());
    std::erase_if(told_shared_, [link](const auto& told) {
        return std::get<1>(told) == link || std::get<2>(told) == link;
    });
    for (const uint16_t node : gone->nodes) {
        if (heard_elsewhere(node)) continue;
        wire::Frame farewell;
        farewell.source = node;
        farewell.type = kDisconnected;
        farewell.size = 0;
        send_to_others(*gone, farewell);
    }
}

void Hub::note_node(Link& link, const wire::Frame& frame) {
    if (frame.source == link.last_node && frame.type != kDisconnected) return;
    if (!comes_from_a_node(frame)) return;
    if (frame.type == kDisconnected) {
        link.nodes.erase(frame.source);
        link.last_node = wire::kHostId;
        return;
    }
    if (link.nodes.size() >= kNodesPerLinkMax && !link.nodes.contains(frame.source)) return;
    if (link.nodes.insert(frame.source).second) note_shared_id(link, frame.source);
    link.last_node = frame.source;
}

void Hub::note_shared_id(const Link& link, uint16_t node) {
    for (const auto& other : links_) {
        if (other.get() == &link || !other->nodes.contains(node)) continue;
        if (shared_ids_.size() >= kSharedIdsMax) return;
        const auto [first, second] = std::minmax(other->id, link.id);
        if (!told_shared_.emplace(node, first, second).second) continue;
        shared_ids_.push_back({node, other->options.name, link.options.name});
    }
}

void Hub::allow_only(LinkId link, std::set<uint16_t> types) {
    get(link).allowed = std::move(types);
}

std::vector<LinkId> Hub::take_reached() {
    for (const LinkId link : reached_) get(link).is_reached = false;
    return std::exchange(reached_, {});
}

std::vector<SharedId> Hub::take_shared_ids() {
    return std::exchange(shared_ids_, {});
}

bool Hub::heard_elsewhere(uint16_t node) const {
    return std::any_of(links_.begin(), links_.end(),
                       [node](const auto& link) { return link->nodes.contains(node); });
}

bool Hub::take(LinkId link, wire::Frame& frame) {
    return get(link).queue.pop(frame);
}

std::span<const uint8_t> Hub::output(LinkId link) {
    return get(link).queue.batch();
}

size_t Hub::waiting(LinkId link) const {
    return get(link).queue.bytes();
}

void Hub::sent(LinkId link, size_t bytes) {
    get(link).queue.sent(bytes);
}

LinkStats Hub::stats(LinkId link) const {
    const Link& of = get(link);
    return {of.frames_received, of.frames_queued, of.queue.dropped()};
}

const std::string& Hub::name(LinkId link) const {
    return get(link).options.name;
}

std::vector<LinkId> Hub::links() const {
    std::vector<LinkId> ids;
    for (const auto& link : links_) ids.push_back(link->id);
    return ids;
}

std::vector<uint16_t> Hub::nodes(LinkId link) const {
    const std::set<uint16_t>& nodes = get(link).nodes;
    return {nodes.begin(), nodes.end()};
}

Hub::Link* Hub::find(LinkId link) const {
    const auto at = std::lower_bound(links_.begin(), links_.end(), link,
                                     [](const auto& each, LinkId id) { return each->id < id; });
    return at != links_.end() && (*at)->id == link ? at->get() : nullptr;
}

Hub::Link& Hub::get(LinkId link) const {
    Link* found = find(link);
    assert(found != nullptr);
    return *found;
}

}  // namespace vagus::hub
