#include "serve/web/live_client.hpp"

#include <fmt/format.h>

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/use_future.hpp>
#include <charconv>
#include <limits>
#include <optional>

#include "base/text.hpp"
#include "serve/process.hpp"
#include "serve/protocol/protocol.hpp"
#include "serve/web/beast.hpp"
#include "serve/web/server.hpp"

namespace vagus::serve {

namespace {

using Socket = websocket::stream<Stream>;

constexpr uint16_t kUsualPort = 8910;
constexpr size_t kAnswerBytesMax = 64u << 20;

Error bad_address(const std::string& text) {
    return {Code::BadInput, text +
                                ": expected the address of a server, such as robot.local:8910 or "
                                "https://192.168.1.7:8910/"};
}

std::string authority(const ServerAddress& address) {
    const bool v6 = address.host.find(':') != address.host.npos;
    return fmt::format("{}:{}", v6 ? "[" + address.host + "]" : address.host, address.port);
}

void prepare(Socket& socket) {
    socket.read_message_max(kAnswerBytesMax);
    socket.set_option(websocket::stream_base::decorator([](websocket::request_type& request) {
        request.set(http::field::sec_websocket_protocol, kLiveProtocol);
    }));
}

double own_ms() {
    const auto now = asio::steady_timer::clock_type::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(now).count();
}

// The server's time, from what it says of it. What lay unread for a while makes its clock seem
// slow, never fast.
struct ServerTime {
    double ahead = std::numeric_limits<double>::lowest();  // of our clock, in ms
    void hear(double now) { ahead = std::max(ahead, now - own_ms()); }
    double deadline() const {
        return ahead + own_ms() + static_cast<double>(Protocol::get().limit("act_ms"));
    }
};

awaitable<std::string> exchange(Socket& socket, uint64_t id, std::string text, ServerTime& time) {
    socket.next_layer().expires_after(kAnswerWithin);
    co_await socket.async_write(asio::buffer(text), use_awaitable);
    for (;;) {
        beast::flat_buffer buffer;
        co_await socket.async_read(buffer, use_awaitable);
        std::string came = beast::buffers_to_string(buffer.data());
        const auto message = nlohmann::json::parse(came, nullptr, false);
        const bool ours = message.is_object() && message.contains("id") && message["id"] == id;
        if (ours) co_return came;
        const bool ping = message.is_object() && message.contains("ping") &&
                          message.contains("now") && message["now"].is_number();
        if (!ping) continue;
        time.hear(message["now"]);
        const std::string pong = nlohmann::json{{"pong", message["ping"]}}.dump();
        co_await socket.async_write(asio::buffer(pong), use_awaitable);
    }
}

Code code_of(const std::string& word) {
    if (word == "not_found") return Code::NotFound;
    if (word == "limit") return Code::Limit;
    if (word == "not_driver") return Code::Refused;
    if (word == "bad_input" || word == "bad_message") return Code::BadInput;
    return Code::Unavailable;
}

}  // namespace

Result<ServerAddress> parse_address(const std::string& text) {
    ServerAddress address{.port = kUsualPort};
    std::string rest = text;
    const size_t fragment = rest.find("#token=");
    if (fragment != rest.npos) {
        address.token = rest.substr(fragment + 7);
        rest.resize(fragment);
    }
    for (const char* scheme : {"http://", "https://"}) {
        if (!rest.starts_with(scheme)) continue;
        address.secure = std::string_view(scheme) == "https://";
        rest.erase(0, std::string_view(scheme).size());
    }
    if (rest.ends_with('/')) rest.pop_back();
    const size_t bracket = rest.rfind(']');
    const size_t colon = rest.rfind(':');
    const bool bracketed = rest.starts_with('[') && bracket != rest.npos;
    if (colon != rest.npos && (!bracketed || colon > bracket)) {
        const char* end = rest.data() + rest.size();
        const auto [last, failed] = std::from_chars(&rest[colon + 1], end, address.port);
        if (failed != std::errc() || last != end || address.port == 0) return bad_address(text);
        rest.resize(colon);
    }
    // An IPv6 address needs its brackets: what follows its last colon may be a port.
    if (!bracketed && rest.find(':') != rest.npos) return bad_address(text);
    if (bracketed) rest = rest.substr(1, rest.size() - 2);
    if (rest.empty() || rest.find_first_of("/ ?#@[]") != rest.npos) return bad_address(text);
    address.host = rest;
    return address;
}

class LiveClient::Insides {
public:
    Status connect(const ServerAddress& address, const std::string& name) {
        try {
            const std::string refused = run(meet(address));
            if (!refused.empty()) {
                return Error{Code::Unavailable, fmt::format("{}: {}", authority(address), refused)};
            }
        } catch (const boost::system::system_error& failed) {
            return Error{Code::Unavailable,
                         fmt::format("{}: no server of Vagus answers there: {}; is `vagus serve` "
                                     "running, and does --listen of it name an address that can be "
                                     "reached from here?",
                                     authority(address), failed.code().message())};
        }
        const std::string client = hex_of(random_bytes(8));
        const auto greeted =
            ask("hello", {{"token", address.token}, {"client", client}, {"name", name}});
        if (!greeted.ok()) return greeted.error();
        const Json now = greeted.value().value("now", Json());
        if (now.is_number()) time_.hear(now);
        return Status::done();
    }

    Result<Json> ask(const std::string& command, Json in) {
        const uint64_t id = ++last_;
        Json message = {{"id", id}, {"do", command}, {"in", std::move(in)}};
        const CommandType* type = Protocol::get().command(command);
        if (type && type->kind == CommandKind::Act) message["until"] = time_.deadline();
        try {
            const std::string text = message.dump();
            const std::string came = run(exchange(*socket_, id, text, time_));
            const Json answer = Json::parse(came);
            if (answer.contains("ok")) return answer["ok"];
            return Error{code_of(answer.at("error").at("code")), answer.at("error").at("what")};
        } catch (const boost::system::system_error& failed) {
            return Error{Code::Unavailable, fmt::format("{}: the connection has ended: {}", command,
                                                        failed.code().message())};
        } catch (const Json::exception& odd) {
            return Error{Code::Unavailable,
                         fmt::format("{}: expected an answer of Vagus: {}", command, odd.what())};
        }
    }

    void wait(std::chrono::milliseconds so_long) {
        asio::steady_timer timer(io_, so_long);
        timer.wait();
    }

private:
    // What an awaitable gives, or throws.
    template <typename Value>
    Value run(awaitable<Value> work) {
        auto future = asio::co_spawn(io_, std::move(work), asio::use_future);
        io_.restart();
        io_.run();
        return future.get();
    }

    // Why the server's certificate is not accepted; empty: it is.
    awaitable<std::string> meet(ServerAddress address) {
        Tcp::resolver resolver(io_);
        const auto found = co_await resolver.async_resolve(
            address.host, std::to_string(address.port), use_awaitable);
        beast::tcp_stream tcp(io_);
        tcp.expires_after(kMeetWithin);
        co_await tcp.async_connect(found, use_awaitable);
        Stream stream(std::move(tcp));
        if (address.secure) {
            verify(address);
            const auto why = co_await stream.connect_tls(tls_, address.host);
            if (why) co_return *why;
        }
        socket_.emplace(std::move(stream));
        prepare(*socket_);
        co_await socket_->async_handshake(authority(address), "/live", use_awaitable);
        co_return std::string();
    }

    void verify(const ServerAddress& address) {
        tls_.set_default_verify_paths();
        if (!address.certificate.empty()) tls_.load_verify_file(address.certificate);
        tls_.set_verify_mode(asio::ssl::verify_peer);
    }

    asio::io_context io_{1};
    asio::ssl::context tls_{asio::ssl::context::tls_client};
    std::optional<Socket> socket_;  // once connected
    uint64_t last_ = 0;
    ServerTime time_;
};

LiveClient::LiveClient(std::unique_ptr<Insides> insides) : insides_(std::move(insides)) {}
LiveClient::~LiveClient() = default;

Result<std::unique_ptr<LiveClient>> LiveClient::connect(const ServerAddress& address,
                                                        const std::string& name) {
    auto insides = std::make_unique<Insides>();
    TRY(insides->connect(address, name));
    return std::unique_ptr<LiveClient>(new LiveClient(std::move(insides)));
}

Result<Json> LiveClient::ask(const std::string& command, Json in) {
    return insides_->ask(command, std::move(in));
}
void LiveClient::wait(std::chrono::milliseconds so_long) {
    insides_->wait(so_long);
}

}  // namespace vagus::serve
