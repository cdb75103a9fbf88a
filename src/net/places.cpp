// Where connections come from: listening, connecting, and trying again.
#include <fcntl.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <boost/asio/connect.hpp>
#include <utility>

#include "net/loop.hpp"

namespace vagus::net {

namespace {

constexpr Duration kAcceptAgain = 100ms;

// A peer whose machine or cable is gone is noticed after about 10 + 3 * 5 seconds of silence.
constexpr int kKeepAliveIdle_s = 10;
constexpr int kKeepAliveInterval_s = 5;
constexpr int kKeepAliveProbes = 3;

// What the kernel has taken, no message can pass any more: so it takes little
// (docs/decisions/0054-messages-pass-events.md). It doubles the number for its own needs.
constexpr int kSendBufferBytes = 64 * 1024;

void set_option(int descriptor, int level, int option, int value) {
    // A socket without the option still works.
    (void)::setsockopt(descriptor, level, option, &value, sizeof value);
}

std::unique_ptr<Channel> channel_of(Tcp::socket& socket) {
    SystemError error;
    socket.native_non_blocking(true, error);
    const int descriptor = socket.release(error);
    set_option(descriptor, IPPROTO_TCP, TCP_NODELAY, 1);
    set_option(descriptor, SOL_SOCKET, SO_SNDBUF, kSendBufferBytes);
    set_option(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
    set_option(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, kKeepAliveIdle_s);
    set_option(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, kKeepAliveInterval_s);
    set_option(descriptor, IPPROTO_TCP, TCP_KEEPCNT, kKeepAliveProbes);
    return make_socket_channel(descriptor);
}

std::string name_of(const Tcp::endpoint& endpoint) {
    return to_string(Target{.place = TcpPlace{endpoint.address().to_string(), endpoint.port()}});
}

Error cannot_listen(const Target& target, const SystemError& error) {
    std::string fix;
    if (error == asio::error::address_in_use) {
        fix = "; end the program that uses it, or choose another port (0 takes a free one)";
    } else if (error == asio::error::access_denied) {
        fix = "; choose a port from 1024 up";
    }
    return Error{Code::Unavailable,
                 to_string(target) + ": cannot listen: " + error.message() + fix};
}

}  // namespace

// ---- listening ----

Result<Listening> Links::Loop::listen(hub::Hub& hub, const Target& target, ListenOptions options) {
    if (!std::holds_alternative<TcpPlace>(target.place)) {
        return Error{Code::BadInput, to_string(target) +
                                         ": only TCP can listen; write tcp:127.0.0.1:33333, and "
                                         "give this one as a target to connect to"};
    }
    const Tcp::endpoint wanted = TRY(endpoint_to_bind(target));
    Tcp::acceptor acceptor(io_);
    SystemError error;
    acceptor.open(wanted.protocol(), error);
    if (!error) acceptor.set_option(Tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(wanted, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) return cannot_listen(target, error);

    Listening listening{PlaceId{++last_number_}, target};
    const Tcp::endpoint bound = acceptor.local_endpoint(error);
    if (error) return cannot_listen(target, error);
    listening.target.place = TcpPlace{bound.address().to_string(), bound.port()};
    listeners_.try_emplace(listening.place, Listener{&hub, listening.target, options,
                                                     std::move(acceptor), asio::steady_timer(io_)});
    accept(listening.place);
    return listening;
}

// A name may have several addresses: the first of IPv4 is what peers expect.
Result<Tcp::endpoint> Links::Loop::endpoint_to_bind(const Target& target) {
    const auto& place = std::get<TcpPlace>(target.place);
    SystemError error;
    const asio::ip::address address = asio::ip::make_address(place.host, error);
    if (!error) return Tcp::endpoint(address, place.port);
    Tcp::resolver resolver(io_);
    const auto found = resolver.resolve(place.host, std::to_string(place.port), error);
    if (error || found.empty()) return cannot_listen(target, error);
    for (const auto& each : found) {
        if (each.endpoint().address().is_v4()) return each.endpoint();
    }
    return found.begin()->endpoint();
}

void Links::Loop::accept(PlaceId place) {
    listeners_.at(place).acceptor.async_accept(
        [this, place](const SystemError& error, Tcp::socket socket) {
            if (listeners_.contains(place)) on_accepted(place, error, std::move(socket));
        });
}

void Links::Loop::on_accepted(PlaceId place, const SystemError& error, Tcp::socket socket) {
    Listener& listener = listeners_.at(place);
    if (error) {
        accept_again_later(place, error.message());
        return;
    }
    SystemError gone;
    const Tcp::endpoint peer = socket.remote_endpoint(gone);
    if (gone) {  // it left before its turn came
        accept(place);
        return;
    }
    if (listener.options.clients == Clients::One) close_clients_of(place);
    const auto opened = open_link(
        place, *listener.hub,
        {.name = name_of(peer), .remap = listener.target.remap, .echo = listener.options.echo},
        channel_of(socket));
    if (!opened.ok()) {
        accept_again_later(place, opened.error().what);
        return;
    }
    listener.failing = false;
    accept(place);
}

// No more descriptors, say: waits a little instead of asking the system again and again.
void Links::Loop::accept_again_later(PlaceId place, const std::string& why) {
    Listener& listener = listeners_.at(place);
    if (!listener.failing) {
        events_.push_back({EventKind::Failed,
                           place,
                           {},
                           0,
                           to_string(listener.target) + ": a client was not accepted: " + why});
    }
    listener.failing = true;
    listener.again.expires_after(kAcceptAgain);
    listener.again.async_wait([this, place](const SystemError& error) {
        if (!error && listeners_.contains(place)) accept(place);
    });
}

void Links::Loop::close_clients_of(PlaceId place) {
    std::vector<uint32_t> numbers;
    for (const auto& [number, connection] : connections_) {
        if (connection.place == place) numbers.push_back(number);
    }
    for (const uint32_t number : numbers)
        drop(number, {.flow = Flow::Ended, .why = "replaced by a new client"});
}

// ---- connecting ----

Result<PlaceId> Links::Loop::connect(hub::Hub& hub, const Target& target, ConnectOptions options) {
    const auto* tcp = std::get_if<TcpPlace>(&target.place);
    if (target.use == Use::Listen || (tcp != nullptr && tcp->port == 0)) {
        return Error{Code::BadInput, to_string(target) +
                                         ": this is a place to listen at; to connect, write "
                                         "tcp:HOST:PORT with a port from 1 to 65535"};
    }
    const PlaceId place{++last_number_};
    connectors_.try_emplace(place, Connector{&hub, target, options, Tcp::resolver(io_), nullptr,
                                             asio::steady_timer(io_)});
    const Status begun = attempt(place);
    if (begun.ok()) return place;
    connectors_.erase(place);
    return begun.error();
}

Result<PlaceId> Links::Loop::join(hub::Hub& hub, int descriptor, const std::string& name) {
    auto channel = make_socket_channel(descriptor);
    const int flags = ::fcntl(descriptor, F_GETFL);
    if (flags < 0 || ::fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) < 0) {
        return Error{Code::Unavailable, name + ": cannot be joined: " + std::strerror(errno)};
    }
    const PlaceId place{++last_number_};
    TRY(open_link(place, hub, {.name = name}, std::move(channel)));
    return place;
}

// Fails only if trying again would fail again.
Status Links::Loop::attempt(PlaceId place) {
    Connector& connector = connectors_.at(place);
    if (!std::holds_alternative<TcpPlace>(connector.target.place)) {
        return attempt_descriptor(place, connector);
    }
    attempt_tcp(place, connector);
    return Status::done();
}

Status Links::Loop::attempt_descriptor(PlaceId place, Connector& connector) {
    const auto* serial = std::get_if<SerialPlace>(&connector.target.place);
    Result<std::unique_ptr<Channel>> opened =
        serial ? open_serial(*serial) : open_can(std::get<CanPlace>(connector.target.place));
    if (opened.ok()) {
        connected(place, connector, std::move(opened.value()));
        return Status::done();
    }
    if (opened.error().code != Code::Unavailable) return opened.error();
    attempt_failed(place, opened.error().what);
    return Status::done();
}

void Links::Loop::attempt_tcp(PlaceId place, Connector& connector) {
    const uint32_t attempt = ++connector.attempt;
    connector.timer.expires_after(kConnectWithin);
    connector.timer.async_wait([this, place, attempt](const SystemError& error) {
        if (!error && is_attempt(place, attempt)) attempt_failed(place, "no answer in time");
    });
    const auto& where = std::get<TcpPlace>(connector.target.place);
    connector.resolver.async_resolve(
        where.host, std::to_string(where.port),
        [this, place, attempt](const SystemError& error, const Tcp::resolver::results_type& found) {
            if (is_attempt(place, attempt)) on_resolved(place, error, found);
        });
}

bool Links::Loop::is_attempt(PlaceId place, uint32_t attempt) const {
    const auto at = connectors_.find(place);
    return at != connectors_.end() && at->second.attempt == attempt;
}

void Links::Loop::on_resolved(PlaceId place, const SystemError& error,
                              const Tcp::resolver::results_type& found) {
    if (error) {
        attempt_failed(place, "the host is not known (" + error.message() + ")");
        return;
    }
    Connector& connector = connectors_.at(place);
    const auto socket = std::make_shared<Tcp::socket>(io_);
    connector.socket = socket;
    const uint32_t attempt = connector.attempt;
    asio::async_connect(
        *socket, found,
        [this, place, attempt, socket](const SystemError& result, const Tcp::endpoint&) {
            if (is_attempt(place, attempt)) on_connected(place, result);
        });
}

void Links::Loop::on_connected(PlaceId place, const SystemError& error) {
    Connector& connector = connectors_.at(place);
    if (error) {
        attempt_failed(place, error.message());
        return;
    }
    std::unique_ptr<Channel> channel = channel_of(*connector.socket);
    end_attempt(connector);
    connected(place, connector, std::move(channel));
}

void Links::Loop::connected(PlaceId place, Connector& connector, std::unique_ptr<Channel> channel) {
    const auto opened = open_link(place, *connector.hub,
                                  {.name = to_string(connector.target),
                                   .remap = connector.target.remap,
                                   .echo = connector.options.echo},
                                  std::move(channel));
    if (!opened.ok()) {
        attempt_failed(place, opened.error().what);
        return;
    }
    connector.failing = false;
    connector.wait = kRetryFirst;
}

void Links::Loop::attempt_failed(PlaceId place, const std::string& why) {
    Connector& connector = connectors_.at(place);
    end_attempt(connector);
    const std::string name = to_string(connector.target);
    const std::string what = why.starts_with(name) ? why : name + ": cannot connect: " + why;
    if (!connector.failing) events_.push_back({EventKind::Failed, place, {}, 0, what});
    connector.failing = true;
    attempt_later(place, connector);
}

// What is still under way of it has no effect any more.
void Links::Loop::end_attempt(Connector& connector) {
    ++connector.attempt;
    connector.timer.cancel();
    connector.resolver.cancel();
    if (!connector.socket) return;
    SystemError ignored;
    connector.socket->close(ignored);
    connector.socket.reset();
}

void Links::Loop::attempt_later(PlaceId place, Connector& connector) {
    if (connector.options.retry == Retry::Never) {
        connectors_.erase(place);
        return;
    }
    connector.timer.expires_after(connector.wait);
    connector.wait = std::min(2 * connector.wait, kRetryLast);
    connector.timer.async_wait([this, place, ended = connector.attempt](const SystemError& error) {
        if (error || !is_attempt(place, ended)) return;
        const Status begun = attempt(place);
        if (!begun.ok()) attempt_failed(place, begun.error().what);
    });
}

// A connection of this place has closed.
void Links::Loop::on_lost(PlaceId place) {
    const auto at = connectors_.find(place);
    if (at != connectors_.end()) attempt_later(place, at->second);
}

void Links::Loop::close(PlaceId place) {
    listeners_.erase(place);
    connectors_.erase(place);
    std::vector<uint32_t> numbers;
    for (const auto& [number, connection] : connections_) {
        if (connection.place == place) numbers.push_back(number);
    }
    for (const uint32_t number : numbers) {
        const auto at = connections_.find(number);
        at->second.hub->remove(at->second.link);
        connections_.erase(at);
    }
}

}  // namespace vagus::net
