// Connections, by Boost.Beast; what they are answered is in answers.cpp. One thread runs everything
// here; the thread that takes events reaches it by posting.
#include "serve/web/server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ssl/context.hpp>
#include <deque>
#include <map>
#include <optional>
#include <thread>

#include "serve/access.hpp"
#include "serve/web/answers.hpp"
#include "serve/web/beast.hpp"
#include "serve/web/inbox.hpp"
#include "serve/web/origin.hpp"
#include "serve/web/pages.hpp"
#include "serve/web/strangers.hpp"
#include "serve/web/tls.hpp"

namespace vagus::serve {

namespace {

using asio::as_tuple;
using std::chrono::seconds;

constexpr size_t kBodyBytesMax = 4096;   // of a request; none of ours has one
constexpr size_t kFirstBytesMax = 4096;  // read at once when a request begins
constexpr auto kGoodbyeWithin = seconds(2);
constexpr size_t kPieceBytes = 64 * 1024;  // of a message to a page: so much of it counts as taken
constexpr auto kWrongTokenWithin = seconds(5);  // a request with a wrong token is answered
constexpr size_t kWrongWaitingMax = 64;         // of such requests; the next one gets no answer

// The same connection once more, to end it from outside whatever carries it: its coroutine then
// reads the end. Closed with the last copy.
std::function<void()> ender_of(int connection) {
    const int own = ::fcntl(connection, F_DUPFD_CLOEXEC, 0);
    const std::shared_ptr<int> held(new int(own), [](const int* descriptor) {
        if (*descriptor >= 0) ::close(*descriptor);
        delete descriptor;
    });
    return [held] {
        if (*held >= 0) ::shutdown(*held, SHUT_RDWR);
    };
}

struct Outgoing {
    bool binary = false;
    std::string bytes;
};

// What all connections share; lives as long as the server.
struct Shared {
    const WebOptions& options;
    const Pages& pages;
    Inbox& inbox;
    Strangers& strangers;
};

// A connection among the strangers, as long as it is one. Cut off, it waits for nothing any more:
// shutting a socket down wakes its readers, but no timer.
struct Place {
    Place(Strangers& all, const std::string& address, std::function<void()> end)
        : strangers(all), number(all.add(owner_of(address), [this, end = std::move(end)] {
              cut_off = true;
              end();
              wake();
          })) {}
    ~Place() { leave(); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    void heard() const { strangers.heard(number); }
    void leave() const { strangers.remove(number); }

    Strangers& strangers;
    bool cut_off = false;
    std::function<void()> wake = [] {};  // ends what the connection waits for
    const Strangers::Place number;
};

// The WebSocket of a page.
class Live : public std::enable_shared_from_this<Live> {
public:
    // `place` is borrowed until run() has ended, and told of no longer.
    Live(Stream stream, ClientId id, Shared& shared, Place& place)
        : socket_(std::move(stream)),
          id_(id),
          shared_(shared),
          place_(place),
          ready_(socket_.get_executor()),
          taken_(socket_.get_executor()),
          goodbye_(socket_.get_executor()) {
        ready_.expires_at(asio::steady_timer::time_point::max());
        taken_.expires_at(asio::steady_timer::time_point::max());
    }

    void send(Outgoing message) {
        if (closing_) return;
        queue_.push_back(std::move(message));
        ready_.cancel();
    }
    // A client that does not answer the close frame is cut off.
    void close(std::string reason) {
        if (closing_) return;
        closing_ = true;
        reason_ = std::move(reason);
        ready_.cancel();
        taken_.cancel();
        asio::co_spawn(
            socket_.get_executor(), [self = this->shared_from_this()] { return self->cut_off(); },
            asio::detached);
    }
    // It has shown its token.
    void know() {
        known_ = true;
        place_.leave();
        socket_.read_message_max(shared_.options.message_bytes_max);
        taken_.cancel();
    }
    // What it said was taken.
    void resume() {
        waiting_ = waiting_bytes_ = 0;
        taken_.cancel();
    }

    // Accepts the upgrade, then reads until the end.
    awaitable<void> run(Asking asked) {
        const auto self = this->shared_from_this();
        prepare();
        const auto [failed] = co_await socket_.async_accept(asked, as_tuple(use_awaitable));
        if (failed) co_return;
        asio::co_spawn(
            socket_.get_executor(), [self] { return self->write(); }, asio::detached);
        place_.wake = [this] { taken_.cancel(); };
        co_await read();
        place_.wake = [] {};
        over_ = true;
        ready_.cancel();
        goodbye_.cancel();
    }

private:
    void prepare() {
        websocket::stream_base::timeout limits{shared_.options.request_within, seconds(30), true};
        socket_.set_option(limits);
        socket_.read_message_max(shared_.options.hello_bytes_max);
        socket_.auto_fragment(false);
        socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& answer) {
            answer.set(http::field::sec_websocket_protocol, kLiveProtocol);
        }));
    }

    awaitable<void> read() {
        for (;;) {
            beast::flat_buffer buffer;
            const auto [failed, size] =
                co_await socket_.async_read(buffer, as_tuple(use_awaitable));
            if (failed == websocket::error::message_too_big) {
                shared_.inbox.put(WebNote{"a page sent a message above the limit"});
            }
            if (failed) co_return;
            if (closing_) continue;
            if (!socket_.got_text()) {
                shared_.inbox.put(WebNote{"refused a message: binary ones only come from here"});
                close("expected text; binary messages only come from the server");
                continue;
            }
            std::string text = beast::buffers_to_string(buffer.data());
            Message message = Protocol::get().read(text);
            // Whoever shows a right token gives way to nobody, however late that is heard.
            shows_token(message) ? place_.leave() : place_.heard();
            shared_.inbox.put(ClientText{id_, std::move(text), std::move(message)});
            // The client must be known before it may say more.
            while (!known_ && !closing_ && !place_.cut_off) {
                co_await taken_.async_wait(as_tuple(use_awaitable));
            }
            // Back-pressure: stop reading a client that sends faster than it is answered.
            waiting_bytes_ += size;
            if (++waiting_ < kClientTextsMax &&
                waiting_bytes_ < shared_.options.message_bytes_max) {
                continue;
            }
            co_await taken_.async_wait(as_tuple(use_awaitable));
        }
    }

    bool shows_token(const Message& message) const {
        const auto* request = std::get_if<Request>(&message);
        return !known_ && request && request->name == "hello" &&
               shared_.options.may_look(request->in["token"].get<std::string>());
    }

    awaitable<void> write() {
        while (!over_) {
            if (queue_.empty()) {
                if (closing_) break;
                co_await ready_.async_wait(as_tuple(use_awaitable));
                continue;
            }
            const Outgoing message = std::move(queue_.front());
            queue_.pop_front();
            if (!co_await write(message)) co_return;
        }
        if (over_) co_return;
        const websocket::close_reason why(websocket::close_code::policy_error, reason_);
        co_await socket_.async_close(why, as_tuple(use_awaitable));
    }

    // In pieces: a page that takes a long message slowly is seen to take it.
    awaitable<bool> write(const Outgoing& message) {
        socket_.binary(message.binary);
        size_t at = 0;
        do {
            const size_t piece = std::min(kPieceBytes, message.bytes.size() - at);
            const bool last = at + piece == message.bytes.size();
            const auto [failed, size] = co_await socket_.async_write_some(
                last, asio::buffer(message.bytes.data() + at, piece), as_tuple(use_awaitable));
            if (failed) co_return false;
            at += piece;
            shared_.inbox.put(ClientTook{id_, piece});
        } while (at < message.bytes.size());
        co_return true;
    }

    awaitable<void> cut_off() {
        goodbye_.expires_after(kGoodbyeWithin);
        co_await goodbye_.async_wait(as_tuple(use_awaitable));
        if (!over_) socket_.next_layer().close();
    }

    websocket::stream<Stream> socket_;
    const ClientId id_;
    Shared& shared_;
    Place& place_;
    asio::steady_timer ready_, taken_, goodbye_;
    std::deque<Outgoing> queue_;
    size_t waiting_ = 0;  // texts that nobody has taken yet
    size_t waiting_bytes_ = 0;
    bool known_ = false, closing_ = false, over_ = false;
    std::string reason_;
};
// Owners: this table, and the coroutines of each connection, which may outlive the entry.
using Lives = std::map<ClientId, std::shared_ptr<Live>>;

Asked who_asks(const Asking& asked, const Tcp::endpoint& local, bool secure_stream) {
    Asked who;
    who.host = std::string(asked[http::field::host]);
    if (asked.find(http::field::origin) != asked.end()) {
        who.origin = std::string(asked[http::field::origin]);
    }
    auto address = local.address();
    if (address.is_v6() && address.to_v6().is_v4_mapped()) {
        address = asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
    }
    who.local_address = address.to_string();
    who.port = local.port();
    who.secure = secure_stream;
    return who;
}

bool wants_live(const Asking& asked) {
    return websocket::is_upgrade(asked) && asked.target() == "/live" &&
           http::token_list(asked[http::field::sec_websocket_protocol]).exists(kLiveProtocol);
}

}  // namespace

class WebServer::Insides {
public:
    Insides(WebOptions options, std::function<void()> wake)
        : options_(std::move(options)), inbox_(std::move(wake)), acceptor_(io_) {}

    ~Insides() {
        io_.stop();
        if (thread_.joinable()) thread_.join();
    }

    Status start() {
        pages_ = TRY(Pages::read(options_.pages));
        if (!options_.tls_cert.empty()) {
            tls_.emplace(TRY(tls_context(options_.tls_cert, options_.tls_key)));
        }
        SystemError failed;
        const auto address = asio::ip::make_address(options_.address, failed);
        if (failed) {
            return Error{Code::BadInput,
                         options_.address + ": expected an IP address, such as 127.0.0.1 or ::"};
        }
        TRY(open({address, options_.port}));
        asio::co_spawn(io_, accept(), asio::detached);
        thread_ = std::thread([this] { io_.run(); });
        return Status::done();
    }

    uint16_t port() const { return port_; }

    std::vector<WebEvent> take() {
        std::vector<WebEvent> events = inbox_.take();
        for (const WebEvent& event : events) {
            if (const auto* text = std::get_if<ClientText>(&event)) post_resume(text->client);
        }
        return events;
    }

    void send(ClientId client, Outgoing message) {
        asio::post(io_, [this, client, message = std::move(message)]() mutable {
            if (Live* live = find(client)) live->send(std::move(message));
        });
    }
    void publish_metrics(std::string text) {
        asio::post(io_, [this, text = std::move(text)]() mutable { metrics_ = std::move(text); });
    }
    void publish_health(std::string why) {
        asio::post(io_, [this, why = std::move(why)]() mutable { ill_ = std::move(why); });
    }
    void know(ClientId client) {
        asio::post(io_, [this, client] {
            if (Live* live = find(client)) live->know();
        });
    }
    void close(ClientId client, std::string reason) {
        reason.resize(std::min<size_t>(reason.size(), 120));
        asio::post(io_, [this, client, reason = std::move(reason)] {
            if (Live* live = find(client)) live->close(reason);
        });
    }

private:
    // Of a connection; borrowed from the coroutine that began with it.
    struct Ends {
        Tcp::endpoint local, remote;
        Place& place;
    };

    Live* find(ClientId client) {
        const auto found = lives_.find(client);
        return found == lives_.end() ? nullptr : found->second.get();
    }
    void post_resume(ClientId client) {
        asio::post(io_, [this, client] {
            if (Live* live = find(client)) live->resume();
        });
    }

    Status open(const Tcp::endpoint& place) {
        SystemError failed;
        acceptor_.open(place.protocol(), failed);
        if (!failed) acceptor_.set_option(asio::socket_base::reuse_address(true), failed);
        if (!failed) acceptor_.bind(place, failed);
        if (!failed) acceptor_.listen(asio::socket_base::max_listen_connections, failed);
        if (failed) {
            return Error{Code::Unavailable,
                         fmt::format("cannot listen on {} port {}: {}; give another with --port",
                                     options_.address, options_.port, failed.message())};
        }
        port_ = acceptor_.local_endpoint(failed).port();
        return Status::done();
    }

    awaitable<void> accept() {
        for (;;) {
            auto [failed, socket] = co_await acceptor_.async_accept(as_tuple(use_awaitable));
            if (failed) {
                asio::steady_timer pause(io_, seconds(1));  // too many open files, for instance
                co_await pause.async_wait(as_tuple(use_awaitable));
                continue;
            }
            asio::co_spawn(io_, connection(std::move(socket)), asio::detached);
        }
    }

    awaitable<void> connection(Tcp::socket socket) {
        SystemError failed;
        socket.set_option(Tcp::no_delay(true), failed);
        const Tcp::endpoint local = socket.local_endpoint(failed);
        const Tcp::endpoint remote = socket.remote_endpoint(failed);
        Place place(strangers_, remote.address().to_string(), ender_of(socket.native_handle()));
        const Ends ends{local, remote, place};
        Stream stream{beast::tcp_stream(std::move(socket))};
        stream.expires_after(options_.request_within);
        const TlsBegins begins = tls_ ? co_await stream.accept_tls(*tls_) : TlsBegins::Yes;
        if (begins == TlsBegins::Yes) co_await talk(std::move(stream), ends);
        // It has typed http:// or nothing, and hears what to type.
        if (begins == TlsBegins::Plain) {
            co_await tell(stream, http::status::bad_request,
                          "this port speaks HTTPS; open the address with https://");
        }
    }

    awaitable<void> talk(Stream stream, const Ends& ends) {
        beast::flat_buffer buffer;
        for (bool first = true;; first = false) {
            if (!first && !co_await begins(stream, buffer)) break;
            stream.expires_after(options_.request_within);
            http::request_parser<http::string_body> parser;
            parser.header_limit(kHeaderBytesMax);
            parser.body_limit(kBodyBytesMax);
            const auto [failed, size] =
                co_await http::async_read(stream, buffer, parser, as_tuple(use_awaitable));
            if (failed) {
                co_await tell_malformed(stream, failed);
                co_return;
            }
            ends.place.heard();
            Asking asked = parser.release();
            if (const auto odd = ambiguity_of(asked)) {
                co_await tell(stream, http::status::bad_request, odd->c_str());
                co_return;
            }
            const auto refusal =
                refusal_of(who_asks(asked, ends.local, tls_.has_value()), options_.hosts);
            if (!refusal && wants_live(asked)) {
                co_await live(std::move(stream), std::move(asked), ends);
                co_return;
            }
            if (refusal) inbox_.put(WebNote{"refused: " + *refusal});
            const std::string address = ends.remote.address().to_string();
            Answer answer = refusal ? plain(asked, http::status::forbidden, *refusal)
                                    : answer_for(asked, shown(address));
            if (answer.result() == http::status::unauthorized) {
                stream.expires_after(options_.request_within);
                if (!co_await wait_for_wrong(address, ends.place)) co_return;
            }
            const bool more = answer.keep_alive();
            if (!co_await write(stream, std::move(answer), asked.method() == http::verb::head) ||
                !more) {
                break;
            }
        }
        stream.shut_down_sending();
    }

    Shown shown(const std::string& address) {
        return {.pages = shared_.pages,
                .metrics = metrics_,
                .ill = ill_,
                .may_look = options_.may_look,
                .stop =
                    [this, address](uint32_t client) {
                        inbox_.put_first(StopAsked{address, client});
                    },
                .note = [this](std::string note) { inbox_.put(WebNote{std::move(note)}); }};
    }

    Time now() const {
        if (options_.now) return options_.now();
        const auto now = asio::steady_timer::clock_type::now().time_since_epoch();
        return std::chrono::duration_cast<Time>(now);
    }

    // As long as a page that said hello with one would wait; false if it is not to be answered.
    awaitable<bool> wait_for_wrong(const std::string& address, Place& place) {
        const Time since = now();
        const Time until = std::min<Time>(wrong_.wrong(address, since), since + kWrongTokenWithin);
        if (waiting_wrong_ >= kWrongWaitingMax) co_return false;
        ++waiting_wrong_;
        asio::steady_timer timer(io_);
        place.wake = [&timer] { timer.cancel(); };
        for (Time at = now(); at < until && !place.cut_off; at = now()) {
            timer.expires_after(until - at);
            co_await timer.async_wait(as_tuple(use_awaitable));
        }
        place.wake = [] {};
        --waiting_wrong_;
        co_return !place.cut_off;
    }

    // Waits for the first bytes of the next request: a browser keeps its connections for the parts
    // of the pages that are fetched later.
    awaitable<bool> begins(Stream& stream, beast::flat_buffer& buffer) {
        if (buffer.size() > 0) co_return true;
        stream.expires_after(options_.idle_within);
        const auto [failed, size] = co_await stream.async_read_some(buffer.prepare(kFirstBytesMax),
                                                                    as_tuple(use_awaitable));
        buffer.commit(size);
        co_return !failed;
    }

    awaitable<bool> write(Stream& stream, Answer answer, bool head) {
        // The browser asks for nothing here without TLS any more.
        if (tls_) answer.set("Strict-Transport-Security", "max-age=31536000");
        if (head) {
            http::response<http::empty_body> bare(std::move(answer.base()));
            http::response_serializer<http::empty_body> serializer(bare);
            const auto [failed, size] =
                co_await http::async_write_header(stream, serializer, as_tuple(use_awaitable));
            co_return !failed;
        }
        const auto [failed, size] =
            co_await http::async_write(stream, answer, as_tuple(use_awaitable));
        co_return !failed;
    }

    // A malformed request is told what is wrong; a client that left or said nothing is not.
    awaitable<void> tell_malformed(Stream& stream, SystemError failed) {
        if (failed == http::error::end_of_stream || failed == beast::error::timeout ||
            failed.category() != http::make_error_code(http::error::bad_method).category()) {
            co_return;
        }
        const bool large = failed == http::error::header_limit || failed == http::error::body_limit;
        co_await tell(
            stream,
            large ? http::status::request_header_fields_too_large : http::status::bad_request,
            large ? "the request is too large" : "that is not HTTP");
    }

    // The last word on a connection.
    awaitable<void> tell(Stream& stream, http::status status, const char* sentence) {
        Asking nothing;
        nothing.version(11);
        nothing.keep_alive(false);
        co_await write(stream, plain(nothing, status, sentence), false);
        stream.shut_down_sending();
    }

    awaitable<void> live(Stream stream, Asking asked, const Ends& ends) {
        const ClientId id{++last_client_};
        stream.expires_never();  // the WebSocket has limits of its own
        const auto live = std::make_shared<Live>(std::move(stream), id, shared_, ends.place);
        lives_.emplace(id, live);
        inbox_.put(ClientOpened{id, ends.remote.address().to_string()});
        co_await live->run(std::move(asked));
        lives_.erase(id);
        inbox_.put(ClientClosed{id});
    }

    const WebOptions options_;
    Inbox inbox_;
    Pages pages_;
    std::optional<std::string> metrics_;  // nothing: there is no such page
    std::string ill_;                     // empty: all is well
    // Connections that end with io_ still give their places back.
    Strangers strangers_{{options_.strangers_max, options_.strangers_of_address_max}};
    WrongTokens wrong_;
    size_t waiting_wrong_ = 0;  // requests
    asio::io_context io_{1};
    std::optional<asio::ssl::context> tls_;
    Tcp::acceptor acceptor_;
    uint16_t port_ = 0;
    Shared shared_{options_, pages_, inbox_, strangers_};
    Lives lives_;
    uint32_t last_client_ = 0;
    std::thread thread_;
};

WebServer::WebServer(std::unique_ptr<Insides> insides) : insides_(std::move(insides)) {}
WebServer::~WebServer() = default;

Result<std::unique_ptr<WebServer>> WebServer::start(const WebOptions& options,
                                                    std::function<void()> wake) {
    auto insides = std::make_unique<Insides>(options, std::move(wake));
    TRY(insides->start());
    return std::unique_ptr<WebServer>(new WebServer(std::move(insides)));
}

uint16_t WebServer::port() const {
    return insides_->port();
}
std::vector<WebEvent> WebServer::take() {
    return insides_->take();
}
void WebServer::send(ClientId client, std::string text) {
    insides_->send(client, {.binary = false, .bytes = std::move(text)});
}
void WebServer::send_binary(ClientId client, std::string bytes) {
    insides_->send(client, {.binary = true, .bytes = std::move(bytes)});
}
void WebServer::publish_health(std::string why) {
    insides_->publish_health(std::move(why));
}

void WebServer::publish_metrics(std::string text) {
    insides_->publish_metrics(std::move(text));
}
void WebServer::know(ClientId client) {
    insides_->know(client);
}
void WebServer::close(ClientId client, std::string reason) {
    insides_->close(client, std::move(reason));
}

}  // namespace vagus::serve
