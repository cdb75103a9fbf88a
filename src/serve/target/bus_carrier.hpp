// A target of the command line as a carrier: TCP, serial line, CAN. A lost connection is tried
// again for ever, without asking anybody.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "hub/hub.hpp"
#include "net/links.hpp"
#include "serve/target/carrier.hpp"

namespace vagus::serve {

class BusCarrier final : public Carrier {
public:
    // `links` are borrowed; their events go to hear().
    static Result<std::unique_ptr<BusCarrier>> connect(net::Links& links,
                                                       const std::string& target);
    ~BusCarrier() override;

    void hear(const net::Event& event);
    // Each frame, as it comes or goes.
    void on_frame(std::function<void(const wire::Frame& frame)> told) { told_ = std::move(told); }
    // Where another process of this computer can join the bus: "tcp:127.0.0.1:40123". Only one at a
    // time is there.
    Result<std::string> open_door();
    // From now on the bus gets only these events of who came by the door. It still hears all.
    void close_door_but_for(std::set<uint16_t> events);

    void send(const wire::Frame& frame) override;
    std::vector<Carried> take() override;
    uint64_t heard() const override;
    Connection connection() const override { return connection_; }
    std::string why() const override { return why_; }
    std::vector<LinkView> links() const override;

private:
    explicit BusCarrier(net::Links& links) : links_(links) {}
    void hear_door(const net::Event& event);

    net::Links& links_;
    hub::Hub hub_;
    hub::LinkId own_;
    net::PlaceId place_;
    std::optional<net::Listening> door_;
    std::optional<hub::LinkId> guest_;               // who came by the door
    std::optional<std::set<uint16_t>> guest_sends_;  // events; without: all that it likes
    std::function<void(const wire::Frame& frame)> told_ = [](auto&) {};
    Connection connection_ = Connection::Connecting;
    std::string why_;
    std::optional<hub::LinkId> robot_;  // while it is connected
    uint64_t heard_before_ = 0;         // on links that are gone
    mutable uint64_t heard_there_ = 0;  // on robot_, when it was looked at last
};

}  // namespace vagus::serve
