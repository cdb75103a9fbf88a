#include "serve/target/bus_carrier.hpp"

#include "net/target.hpp"

namespace vagus::serve {

Result<std::unique_ptr<BusCarrier>> BusCarrier::connect(net::Links& links,
                                                        const std::string& text) {
    const net::Target target = TRY(net::parse_target(text));
    if (target.use == net::Use::Listen) {
        return Error{Code::BadInput, text +
                                         ": this waits for others to connect; give a target "
                                         "that can be connected to"};
    }
    auto carrier = std::unique_ptr<BusCarrier>(new BusCarrier(links));
    carrier->own_ = TRY(carrier->hub_.add({.name = "studio"}));
    carrier->place_ = TRY(links.connect(carrier->hub_, target, {.retry = net::Retry::Forever}));
    return carrier;
}

BusCarrier::~BusCarrier() {
    if (door_) links_.close(door_->place);
    links_.close(place_);
}

Result<std::string> BusCarrier::open_door() {
    if (!door_) {
        const net::Target here = TRY(net::parse_target("tcp:127.0.0.1:0"));
        door_ = TRY(links_.listen(hub_, here, {.clients = net::Clients::One}));
    }
    guest_sends_.reset();
    return net::to_string(door_->target);
}

void BusCarrier::close_door_but_for(std::set<uint16_t> events) {
    guest_sends_ = std::move(events);
    if (guest_) hub_.allow_only(*guest_, *guest_sends_);
}

void BusCarrier::hear_door(const net::Event& event) {
    if (event.kind == net::EventKind::Opened) guest_ = event.link;
    if (event.kind == net::EventKind::Closed && guest_ == event.link) guest_.reset();
    if (guest_ && guest_sends_) hub_.allow_only(*guest_, *guest_sends_);
}

void BusCarrier::hear(const net::Event& event) {
    if (door_ && event.place == door_->place) return hear_door(event);
    if (event.place != place_) return;
    if (event.kind == net::EventKind::Opened) {
        connection_ = Connection::Connected;
        robot_ = event.link;
        why_.clear();
    } else if (event.kind == net::EventKind::Closed) {
        connection_ = Connection::Lost;
        heard_before_ += event.stats.frames_received;
        heard_there_ = 0;
        robot_.reset();
        why_ = event.what;
    } else if (event.kind == net::EventKind::Failed) {
        connection_ = Connection::Failed;
        why_ = event.what;
    } else {
        return;
    }
}

void BusCarrier::send(const wire::Frame& frame) {
    if (connection_ == Connection::Connected) told_(frame);
    hub_.receive(own_, frame);
}

std::vector<Carried> BusCarrier::take() {
    std::vector<Carried> frames;
    wire::Frame frame;
    while (frames.size() < kTakenAtOnce && hub_.take(own_, frame)) {
        told_(frame);
        frames.push_back({frame});
    }
    return frames;
}

uint64_t BusCarrier::heard() const {
    // A link that broke is gone from the hub before its event is taken from there.
    if (robot_ && hub_.has(*robot_)) heard_there_ = hub_.stats(*robot_).frames_received;
    return heard_before_ + heard_there_;
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
