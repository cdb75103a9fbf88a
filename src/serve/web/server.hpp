// The door to browsers: HTTP for the pages, WebSocket for everything that lives, on a thread of its
// own. It knows bytes, addresses and limits, not what messages are for: they come out as values,
// read by the protocol's list, and what is sent goes in as text or bytes.
//
//     auto started = WebServer::start({.pages = "share/pages"}, [&] { links.wake(); });
//     WebServer& web = *started.value();
//     for (WebEvent& event : web.take()) hear(event);              // the thread that asks
//     web.send(client, R"({"id":1,"ok":{}})");
//
// What a browser may do here (docs/protocol.md): GET and HEAD of the pages, /healthz,
// /metrics with a token, POST /stop with a token, and the WebSocket at /live. Host must name this
// machine and Origin, if there is one, the same host: other pages in the same browser and names
// that point here get nothing. The token in the first message says who a client is; the taker
// of the events checks it. Until know() says so a connection is a stranger: it may say one short
// message, and above the limits the stranger that is silent the longest makes room for the next.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/protocol/protocol.hpp"

namespace vagus::serve {

constexpr size_t kHeaderBytesMax = 16 * 1024;
constexpr size_t kClientTextsMax = 1000;  // of one client, not taken yet: it is not read further
constexpr auto kRequestWithin = std::chrono::seconds(10);  // from its first byte to its last
constexpr auto kIdleWithin = std::chrono::seconds(75);     // from one request to the next
constexpr const char* kLiveProtocol = "vagus-1";

struct ClientId {
    uint32_t number = 0;
    auto operator<=>(const ClientId&) const = default;
};

struct WebOptions {
    std::string address = "127.0.0.1";    // an IP address
    uint16_t port = 0;                    // 0: a free one
    std::string pages = {};               // folder of the built pages
    std::vector<std::string> hosts = {};  // further names of this machine that Host may have
    // Whether the token may read /metrics, and stop; asked on the thread of the server.
    std::function<bool(std::string_view token)> may_look = [](std::string_view) { return false; };
    std::string tls_cert = {}, tls_key = {};  // PEM files; empty: HTTP
    size_t strangers_max = 128;
    size_t strangers_of_address_max = 64;
    size_t message_bytes_max = 4u << 20;
    size_t hello_bytes_max = 4096;  // of a stranger's message
    std::chrono::milliseconds request_within = kRequestWithin;
    std::chrono::milliseconds idle_within = kIdleWithin;
    std::function<Time()> now = {};  // for the wait after a wrong token; empty: the clock's
};

// A page has opened its WebSocket; nothing else is known of it.
struct ClientOpened {
    ClientId client;
    std::string address;  // "127.0.0.1"
};
struct ClientText {
    ClientId client;
    std::string text;
    // What it says, if it was read already: JSON is read on this thread, not in the loop.
    std::optional<Message> message = {};
};
// So many bytes of what was sent have left for the client.
struct ClientTook {
    ClientId client;
    size_t bytes = 0;
};
struct ClientClosed {
    ClientId client;
};
// Something for the log: a refused request, for instance.
struct WebNote {
    std::string text;
};
// POST /stop with a token: it comes before all that has not been taken yet.
struct StopAsked {
    std::string address;
    uint32_t client = 0;  // the number of the client that says that it is its own
};
using WebEvent =
    std::variant<ClientOpened, ClientText, ClientTook, ClientClosed, WebNote, StopAsked>;

class WebServer {
public:
    // Listens, and serves from now on. `wake` is called on the thread of the server when there is
    // something to take. The Error names the address, certificate or folder.
    static Result<std::unique_ptr<WebServer>> start(const WebOptions& options,
                                                    std::function<void()> wake);
    ~WebServer();  // closes everything

    uint16_t port() const;

    std::vector<WebEvent> take();
    // From the thread that takes. Text must be UTF-8. Nothing happens if the client is gone.
    void send(ClientId client, std::string text);
    void send_binary(ClientId client, std::string bytes);
    // What /metrics shows from now on, to who has a token; before, there is no such page.
    void publish_metrics(std::string text);
    // Why /healthz answers 503 from now on; empty: it says ok.
    void publish_health(std::string why);
    // The client has shown its token: it has a place of its own, and is read further.
    void know(ClientId client);
    // Says goodbye with a reason (at most 120 bytes) after what was sent before.
    void close(ClientId client, std::string reason);

private:
    class Insides;
    explicit WebServer(std::unique_ptr<Insides> insides);
    std::unique_ptr<Insides> insides_;
};

}  // namespace vagus::serve
