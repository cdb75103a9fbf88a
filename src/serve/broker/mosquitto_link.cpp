#include "serve/broker/mosquitto_link.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <mosquitto.h>
#include <mqtt_protocol.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <map>
#include <mutex>
#include <variant>

#include "fleet/limits.hpp"

namespace vagus::serve {

namespace {

// The library's global state, as long as the program lives.
void need_library() {
    static const int kReady = mosquitto_lib_init();
    (void)kReady;
}

const char* or_null(const std::string& text) {
    return text.empty() ? nullptr : text.c_str();
}

// Properties of MQTT 5 for one call.
class Properties {
public:
    ~Properties() { mosquitto_property_free_all(&list_); }
    Properties() = default;
    Properties(const Properties&) = delete;
    Properties& operator=(const Properties&) = delete;
    void add(int identifier, uint32_t value) {
        mosquitto_property_add_int32(&list_, identifier, value);
    }
    const mosquitto_property* list() const { return list_; }

private:
    mosquitto_property* list_ = nullptr;
};

std::string sentence_of(int result) {
    // What TLS says of a broker that has ended the connection.
    if (result == MOSQ_ERR_ERRNO && errno == EPROTO) return mosquitto_strerror(MOSQ_ERR_CONN_LOST);
    // The library has no word for it.
    if (result == MOSQ_ERR_KEEPALIVE) {
        return fmt::format("it has not answered for {} s", fleet::kKeepAliveSeconds);
    }
    return result == MOSQ_ERR_ERRNO ? std::strerror(errno) : mosquitto_strerror(result);
}

// What is said of a certificate that came and is not accepted; the library tells it in its log
// alone, and not what is wrong with it.
constexpr std::string_view kNotAccepted = "verif";  // certificate verify, host name verification

// A broker that is known may be ended, or its link cut, at that moment, too.
std::string sentence_of_tls(const LinkOptions& options, bool not_accepted, bool is_known) {
    if (!not_accepted && is_known) return "the connection ended before TLS began";
    if (!not_accepted) {
        return fmt::format(
            "what answers at port {} does not speak TLS; does the broker want "
            "mqtt://?",
            options.target.port);
    }
    if (options.ca.empty()) {
        return "TLS failed: this computer does not trust the broker's certificate; name the "
               "authority that signed it, as --tls-ca ca.crt";
    }
    return fmt::format(
        "TLS failed: the broker's certificate is not signed by {}, is not for the name {}, or is "
        "not valid on the date of this computer's clock",
        options.ca, options.target.host);
}

}  // namespace

// What the owner and the thread share.
class MosquittoLink::Inside {
public:
    using Order = std::variant<std::vector<fleet::Filter>, fleet::Post>;

    Inside(LinkOptions options, std::function<void()> wake)
        : options_(std::move(options)), wake_(std::move(wake)) {
        signal_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    }
    ~Inside() { close(signal_); }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

    // ---- of the owner ----
    void order(Order order);
    std::vector<fleet::LinkEvent> take();
    // True once the thread has ended; it does not wake the owner any more.
    bool end();
    uint64_t dropped() const { return dropped_; }

    // ---- of the thread ----
    void run();
    void give(fleet::LinkEvent event);
    const LinkOptions& options() const { return options_; }
    // There was a connection before: what answers there is a broker.
    bool is_known() const { return is_known_; }

private:
    bool run_session();
    void obey_orders(Session& session);
    std::vector<Order> take_orders();
    bool ends();

    const LinkOptions options_;
    int signal_ = -1;  // eventfd: there are orders, or it ends
    std::atomic<uint64_t> dropped_ = 0;
    bool is_known_ = false;  // of the thread

    std::mutex guard_;  // of all below
    std::condition_variable ended_;
    std::function<void()> wake_;  // only sets a flag
    bool ends_ = false, has_ended_ = false, connected_ = false;
    std::vector<fleet::LinkEvent> inbox_;
    std::vector<Order> outbox_;
};

// One connection, from its attempt to its end.
class MosquittoLink::Session {
public:
    explicit Session(Inside& link) : link_(link) {
        library_ = mosquitto_new(link.options().client.c_str(), false, this);
        mosquitto_int_option(library_, MOSQ_OPT_PROTOCOL_VERSION, MQTT_PROTOCOL_V5);
        mosquitto_int_option(library_, MOSQ_OPT_TCP_NODELAY, 1);
        mosquitto_connect_v5_callback_set(library_, on_connect);
        mosquitto_disconnect_v5_callback_set(library_, on_disconnect);
        mosquitto_message_v5_callback_set(library_, on_message);
        mosquitto_publish_v5_callback_set(library_, on_publish);
        mosquitto_log_callback_set(library_, on_log);
    }
    ~Session() { mosquitto_destroy(library_); }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    // Why there can be none; empty: it is under way.
    std::string begin() {
        const LinkOptions& options = link_.options();
        if (options.target.tls) {
            const int set = mosquitto_tls_set(
                library_, or_null(options.ca), options.ca.empty() ? "/etc/ssl/certs" : nullptr,
                or_null(options.certificate), or_null(options.key), nullptr);
            if (set != MOSQ_ERR_SUCCESS) return "the certificates: " + sentence_of(set);
        }
        if (!options.login.user.empty()) {
            mosquitto_username_pw_set(library_, options.login.user.c_str(),
                                      options.login.password.c_str());
        }
        const fleet::Post& will = options.will;
        if (!will.topic.empty()) {
            mosquitto_will_set_v5(library_, will.topic.c_str(),
                                  static_cast<int>(will.payload.size()), will.payload.data(),
                                  will.qos, will.retained, nullptr);
        }
        Properties properties;
        properties.add(MQTT_PROP_SESSION_EXPIRY_INTERVAL, fleet::kSessionSeconds);
        const int begun =
            mosquitto_connect_bind_v5(library_, options.target.host.c_str(), options.target.port,
                                      fleet::kKeepAliveSeconds, nullptr, properties.list());
        return begun == MOSQ_ERR_SUCCESS ? "" : why_of(begun);
    }

    // Moves bytes until there is something to do; false: it is over, and why() says why.
    bool turn(int signal) {
        const int socket = mosquitto_socket(library_);
        if (socket < 0) return end(MOSQ_ERR_CONN_LOST);
        const auto wanted =
            static_cast<short>(mosquitto_want_write(library_) ? POLLIN | POLLOUT : POLLIN);
        pollfd waits[] = {{socket, wanted, 0}, {signal, POLLIN, 0}};
        poll(waits, 2, kLinkTurnMs);
        int result = MOSQ_ERR_SUCCESS;
        if (waits[0].revents & (POLLIN | POLLHUP | POLLERR)) {
            result = mosquitto_loop_read(library_, 1);
        }
        if (result == MOSQ_ERR_SUCCESS && (waits[0].revents & POLLOUT)) {
            result = mosquitto_loop_write(library_, 1);
        }
        if (result == MOSQ_ERR_SUCCESS) result = mosquitto_loop_misc(library_);
        return result == MOSQ_ERR_SUCCESS && refused_.empty() ? true : end(result);
    }

    void obey(const std::vector<fleet::Filter>& filters) {
        for (const fleet::Filter& one : filters) {
            mosquitto_subscribe_v5(library_, nullptr, one.topic.c_str(), 1,
                                   one.own ? 0 : MQTT_SUB_OPT_NO_LOCAL, nullptr);
        }
    }

    void obey(const fleet::Post& post) {
        Properties properties;
        if (post.expires_s > 0) properties.add(MQTT_PROP_MESSAGE_EXPIRY_INTERVAL, post.expires_s);
        int id = 0;
        const int sent = mosquitto_publish_v5(
            library_, &id, post.topic.c_str(), static_cast<int>(post.payload.size()),
            post.payload.data(), post.qos, post.retained, properties.list());
        if (sent == MOSQ_ERR_SUCCESS && post.number != 0) numbers_[id] = post.number;
    }

    // What was published goes out first. A connection that is closed while something of the broker
    // is unread is reset, which can overtake our good-bye, and then the will is published: so a
    // descriptor of our own keeps it open until the broker has closed it.
    void say_good_bye() {
        for (int i = 0; i < kGoodByeTurns && mosquitto_want_write(library_); ++i) {
            if (mosquitto_loop_write(library_, 1) != MOSQ_ERR_SUCCESS) return;
        }
        const int kept = fcntl(mosquitto_socket(library_), F_DUPFD_CLOEXEC, 0);
        mosquitto_disconnect_v5(library_, MQTT_RC_NORMAL_DISCONNECTION, nullptr);
        if (kept < 0) return;
        shutdown(kept, SHUT_WR);
        pollfd waits{kept, POLLIN, 0};
        char unread[4096];
        for (int i = 0; i < kGoodByeTurns && poll(&waits, 1, kLinkLastReadMs) > 0; ++i) {
            if (recv(kept, unread, sizeof unread, 0) <= 0) break;
        }
        close(kept);
    }

    bool connected() const { return connected_; }
    const std::string& why() const { return why_; }

private:
    static constexpr int kGoodByeTurns = 100;
    static constexpr int kFirstFailure = 0x80;  // of the reason codes of MQTT 5

    bool end(int result) {
        why_ = refused_.empty() ? why_of(result) : refused_;
        return false;
    }
    std::string why_of(int result) const {
        if (result == MOSQ_ERR_TLS)
            return sentence_of_tls(link_.options(), not_accepted_, link_.is_known());
        const bool is_strange = !connected_ && !link_.is_known();
        if (result == MOSQ_ERR_PROTOCOL && is_strange) {
            return fmt::format(
                "what answers at port {} does not speak MQTT; is that the port for "
                "WebSockets? Robots and this program need the other one, as 8883",
                link_.options().target.port);
        }
        const bool maybe_tls = result == MOSQ_ERR_CONN_LOST && is_strange;
        return sentence_of(result) + (maybe_tls && !link_.options().target.tls
                                          ? " Does the broker want TLS? Then write mqtts://"
                                          : "");
    }

    static void on_connect(mosquitto* library, void* self, int code, int,
                           const mosquitto_property*) {
        auto& session = *static_cast<Session*>(self);
        if (code != 0) {
            session.refused_ = fmt::format("refused: {}", mosquitto_reason_string(code));
            if (code == MQTT_RC_NOT_AUTHORIZED || code == MQTT_RC_BAD_USERNAME_OR_PASSWORD) {
                session.refused_ += "; is the login one of this broker?";
            }
            return;
        }
        session.connected_ = true;
        mosquitto_log_callback_set(library, nullptr);  // it writes a line for each message
        session.link_.give(fleet::Connected{});
    }
    static void on_disconnect(mosquitto*, void* self, int code, const mosquitto_property*) {
        auto& session = *static_cast<Session*>(self);
        if (!session.refused_.empty()) return;
        if (code == MOSQ_ERR_SUCCESS) {
            session.refused_ = "the broker has ended the connection";
        } else {
            session.refused_ = code >= kFirstFailure
                                   ? fmt::format("the broker has ended the connection: {}",
                                                 mosquitto_reason_string(code))
                                   : session.why_of(code);
        }
    }
    static void on_log(mosquitto*, void* self, int level, const char* text) {
        const bool found = std::string_view(text).find(kNotAccepted) != std::string_view::npos;
        if (level == MOSQ_LOG_ERR && found) static_cast<Session*>(self)->not_accepted_ = true;
    }
    static void on_publish(mosquitto*, void* self, int id, int code, const mosquitto_property*) {
        auto& session = *static_cast<Session*>(self);
        const auto found = session.numbers_.find(id);
        if (found == session.numbers_.end()) return;
        const char* const refused = code >= kFirstFailure ? mosquitto_reason_string(code) : "";
        session.link_.give(fleet::Acknowledged{found->second, refused});
        session.numbers_.erase(found);
    }
    static void on_message(mosquitto*, void* self, const mosquitto_message* message,
                           const mosquitto_property*) {
        auto& session = *static_cast<Session*>(self);
        const std::string_view payload(static_cast<const char*>(message->payload),
                                       static_cast<size_t>(message->payloadlen));
        auto event = fleet::event_of(session.link_.options().target.fleet, message->topic, payload,
                                     message->retain);
        if (event) session.link_.give(std::move(*event));
    }

    Inside& link_;
    mosquitto* library_ = nullptr;
    bool connected_ = false;
    bool not_accepted_ = false;  // the certificate of the broker
    std::string refused_, why_;
    std::map<int, uint64_t> numbers_;  // by the library's
};

// ---- Inside ----

void MosquittoLink::Inside::order(Order order) {
    {
        const std::lock_guard lock(guard_);
        if (!connected_) return;
        if (outbox_.size() >= kLinkOutboxMax) {
            ++dropped_;
            return;
        }
        outbox_.push_back(std::move(order));
    }
    eventfd_write(signal_, 1);
}

std::vector<fleet::LinkEvent> MosquittoLink::Inside::take() {
    const std::lock_guard lock(guard_);
    return std::exchange(inbox_, {});
}

void MosquittoLink::Inside::give(fleet::LinkEvent event) {
    const std::lock_guard lock(guard_);
    if (std::get_if<fleet::Connected>(&event)) connected_ = is_known_ = true;
    if (inbox_.size() >= kLinkInboxMax && std::get_if<fleet::Received>(&event)) {
        ++dropped_;
        return;
    }
    inbox_.push_back(std::move(event));
    if (!ends_) wake_();
}

std::vector<MosquittoLink::Inside::Order> MosquittoLink::Inside::take_orders() {
    eventfd_t count = 0;
    eventfd_read(signal_, &count);
    const std::lock_guard lock(guard_);
    return std::exchange(outbox_, {});
}

bool MosquittoLink::Inside::ends() {
    const std::lock_guard lock(guard_);
    return ends_;
}

bool MosquittoLink::Inside::end() {
    std::unique_lock lock(guard_);
    ends_ = true;
    eventfd_write(signal_, 1);
    return ended_.wait_for(lock, std::chrono::milliseconds(kLinkGoodByeMs),
                           [this] { return has_ended_; });
}

void MosquittoLink::Inside::run() {
    while (!ends()) {
        if (!run_session()) continue;
        pollfd waits{signal_, POLLIN, 0};
        if (!ends()) poll(&waits, 1, kLinkAgainMs);
    }
    const std::lock_guard lock(guard_);
    has_ended_ = true;
    ended_.notify_all();
}

void MosquittoLink::Inside::obey_orders(Session& session) {
    for (const Order& order : take_orders()) {
        std::visit([&session](const auto& one) { session.obey(one); }, order);
    }
}

// False: it was ended by the owner.
bool MosquittoLink::Inside::run_session() {
    Session session(*this);
    std::string why = session.begin();
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(kLinkConnectMs);
    while (why.empty() && !ends()) {
        const bool goes_on = session.turn(signal_);
        obey_orders(session);
        if (!goes_on) why = session.why();
        const bool late = std::chrono::steady_clock::now() > until;
        if (why.empty() && !session.connected() && late) why = "it did not answer";
    }
    if (why.empty()) {
        obey_orders(session);
        session.say_good_bye();
    }
    {
        const std::lock_guard lock(guard_);
        connected_ = false;
        outbox_.clear();
    }
    if (why.empty()) return false;
    give(fleet::Lost{fmt::format("no connection to {}: {}", to_string(options_.target), why)});
    return true;
}

// ---- MosquittoLink ----

MosquittoLink::MosquittoLink(LinkOptions options, std::function<void()> wake) {
    need_library();
    inside_ = std::make_shared<Inside>(std::move(options), std::move(wake));
    thread_ = std::thread([inside = inside_] { inside->run(); });
}

MosquittoLink::~MosquittoLink() {
    inside_->end() ? thread_.join() : thread_.detach();
}

void MosquittoLink::subscribe(const std::vector<fleet::Filter>& filters) {
    inside_->order(filters);
}

void MosquittoLink::publish(const fleet::Post& post) {
    inside_->order(post);
}

std::vector<fleet::LinkEvent> MosquittoLink::take() {
    return inside_->take();
}

uint64_t MosquittoLink::dropped() const {
    return inside_->dropped();
}

}  // namespace vagus::serve
