// One connection to a network of nodes, for command line tools: connect, send, wait.
//
//     net::Client client = TRY(net::Client::connect(target, 3s));
//     TRY(client.send(list_nodes));
//     while (const auto frame = TRY(client.receive(client.now() + 300ms))) show(*frame);
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "base/time.hpp"
#include "net/target.hpp"
#include "wire/frame.hpp"

namespace vagus::net {

class Client {
public:
    // Waits at most so long. Code::Unavailable and a sentence if nobody is there.
    static Result<Client> connect(const Target& target, Duration within);

    Client(Client&&) noexcept;
    Client& operator=(Client&&) noexcept;
    ~Client();

    // Hands the frame to the system, or waits a little if the peer takes nothing. Fails if the peer
    // has gone, or takes nothing for kSendWithin.
    Status send(const wire::Frame& frame);

    // The next frame; none if the deadline passes first. When the peer goes, `Disconnected` comes
    // for each node that was heard; after that, and after all that it sent, receive() fails.
    Result<std::optional<wire::Frame>> receive(Time deadline);

    Time now() const;
    const std::string& name() const;  // of the peer, for messages

private:
    struct State;
    explicit Client(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

constexpr Duration kSendWithin = std::chrono::seconds(2);

}  // namespace vagus::net
