#include "serve/robot/bus_carrier.hpp"

#include "net/target.hpp"

namespace vagus::serve {

Result<std::unique_ptr<BusCarrier>> BusCarrier::connect(net::Network& network,
                                                        const std::string& text) {
    const net::Target target = TRY(net::parse_target(text));
    if (target.use == net::Use::Listen) {
        return Error{Code::BadInput, text +
                                         ": this waits for others to connect; give a target "
                                         "that can be connected to"};
    }
    auto carrier = std::unique_ptr<BusCarrier>(new BusCarrier(network));
    carrier->own_ = TRY(carrier->hub_.add({.name = "studio"}));
    carrier->place_ = TRY(network.connect(carrier->hub_, target, {.retry = net::Retry::Forever}));
    return carrier;
}

BusCarrier::~BusCarrier() {
    if (door_) network_.close(door_->place);
    network_.close(place_);
}

Result<std::string> BusCarrier::open_door() {
    if (!door_) {
        const net::Target here = TRY(net::parse_target("tcp:127.0.0.1:0"));
        door_ = TRY(network_.listen(hub_, here, {.clients = net::Clients::One}));
    }
    return net::to_string(door_->target);
}

void BusCarrier::hear(const net::Event& event) {
    if (event.place != place_) return;
    if (event.kind == net::EventKind::Opened) {
        connection_ = Connection::Connected;
        why_.clear();
    } else if (event.kind == net::EventKind::Closed) {
        connection_ = Connection::Lost;
        why_ = event.what;
    } else if (event.kind == net::EventKind::Failed) {
        connection_ = Connection::Failed;
        why_ = event.what;
    } else {
        return;
    }
}

std::vector<Carried> BusCarrier::take() {
    std::vector<Carried> frames;
    wire::Frame frame;
    while (hub_.take(own_, frame)) frames.push_back({frame});
    return frames;
}

std::vector<LinkView> BusCarrier::links() const {
    std::vector<LinkView> views;
    for (const hub::LinkId link : hub_.links()) {
        if (link == own_) continue;
        const hub::LinkStats stats = hub_.stats(link);
        views.push_back({hub_.name(link), hub_.nodes(link), stats.frames_received,
                         stats.frames_queued, stats.dropped.events + stats.dropped.messages});
    }
    return views;
}

}  // namespace vagus::serve
