// A target of the command line as a carrier: TCP, serial line, CAN. A lost connection is tried
// again for ever, without asking anybody.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hub/hub.hpp"
#include "net/network.hpp"
#include "serve/robot/carrier.hpp"

namespace vagus::serve {

class BusCarrier final : public Carrier {
public:
    // The network is borrowed; its events go to hear().
    static Result<std::unique_ptr<BusCarrier>> connect(net::Network& network,
                                                       const std::string& target);
    ~BusCarrier() override;

    void hear(const net::Event& event);
    // Where another process of this computer can join the bus: "tcp:127.0.0.1:40123". Only one at a
    // time is there.
    Result<std::string> open_door();

    void send(const wire::Frame& frame) override { hub_.receive(own_, frame); }
    std::vector<Carried> take() override;
    Connection connection() const override { return connection_; }
    std::string why() const override { return why_; }
    std::vector<LinkView> links() const override;

private:
    explicit BusCarrier(net::Network& network) : network_(network) {}

    net::Network& network_;
    hub::Hub hub_;
    hub::LinkId own_;
    net::PlaceId place_;
    std::optional<net::Listening> door_;
    Connection connection_ = Connection::Connecting;
    std::string why_;
};

}  // namespace vagus::serve
