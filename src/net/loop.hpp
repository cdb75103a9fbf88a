// The inside of Links: its connections, what makes them (places), and the one event loop.
// Boost.Asio is known here, in loop.cpp and in places.cpp; it waits, the channels read and write.
//
// Nothing keeps a pointer to a connection or a place across a wait: handlers carry its number and
// look it up, so that closing is simply erasing.
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "net/channel.hpp"
#include "net/links.hpp"
#include "net/pace.hpp"

namespace vagus::net {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using SystemError = boost::system::error_code;

class Links::Loop {
public:
    Loop();
    ~Loop();

    Result<Listening> listen(hub::Hub& hub, const Target& target, ListenOptions options);
    Result<PlaceId> connect(hub::Hub& hub, const Target& target, ConnectOptions options);
    Result<PlaceId> join(hub::Hub& hub, int descriptor, const std::string& name);
    void close(hub::Hub& hub, hub::LinkId link);
    bool end_writing(hub::Hub& hub, hub::LinkId link);
    void close(PlaceId place);
    Status watch_signals();
    Status watch_input(int descriptor);
    void unwatch_input(int descriptor);
    std::vector<Event> poll(Time deadline);
    void flush();
    void wake();
    Time now() const;
    bool has_unwritten() const;

private:
    struct Connection {
        Connection(asio::io_context& io, std::unique_ptr<Channel> its_channel);
        ~Connection();

        PlaceId place;
        hub::Hub* hub = nullptr;
        hub::LinkId link;
        std::string name;
        std::unique_ptr<Channel> channel;
        // Waits on the channel's descriptor, does not own it.
        asio::posix::stream_descriptor waiter;
        Pace pace;
        bool write_blocked = false;  // a wait for writability is under way
        bool read_paused = false;    // no wait for readability is under way
        uint32_t skipped_told = 0;
        Time tell_skipped_after{};
    };

    struct Listener {
        hub::Hub* hub;
        Target target;
        ListenOptions options;
        Tcp::acceptor acceptor;
        asio::steady_timer again;  // after a failed accept
        bool failing = false;
    };

    struct Connector {
        hub::Hub* hub;
        Target target;
        ConnectOptions options;
        Tcp::resolver resolver;
        // Owners: this, and the handler of the connect that uses it, which Asio may call later.
        std::shared_ptr<Tcp::socket> socket;
        asio::steady_timer timer;  // the end of an attempt, or the beginning of the next
        uint32_t attempt = 0;      // handlers of an earlier one are not listened to
        Duration wait = kRetryFirst;
        bool failing = false;  // has been told
    };

    struct Input {
        explicit Input(asio::posix::stream_descriptor its_waiter) : waiter(std::move(its_waiter)) {}
        asio::posix::stream_descriptor waiter;
        bool waiting = false;
    };

    // loop.cpp
    size_t run_some(Time deadline);
    void write(uint32_t number, Connection& connection);
    void read_last_words(Connection& connection);
    Result<Done> open_link(PlaceId place, hub::Hub& hub, hub::LinkOptions options,
                           std::unique_ptr<Channel> channel);
    void wait_readable(uint32_t number, Connection& connection);
    void wait_writable(uint32_t number, Connection& connection);
    void on_readable(uint32_t number);
    void look_at_lines();
    void tell_skipped(Connection& connection);
    void drop(uint32_t number, const Transfer& last);
    void pause_if_ahead(Connection& connection, size_t bytes);
    void resume_paused();
    bool somebody_to_wait_for(const Connection& sender);
    void retry_writes_soon();
    void wait_signal();
    void wait_inputs();

    // places.cpp
    Result<Tcp::endpoint> endpoint_to_bind(const Target& target);
    void accept(PlaceId place);
    void on_accepted(PlaceId place, const SystemError& error, Tcp::socket socket);
    void accept_again_later(PlaceId place, const std::string& why);
    void close_clients_of(PlaceId place);
    Status attempt(PlaceId place);
    Status attempt_descriptor(PlaceId place, Connector& connector);
    void attempt_tcp(PlaceId place, Connector& connector);
    void on_resolved(PlaceId place, const SystemError& error,
                     const Tcp::resolver::results_type& found);
    bool is_attempt(PlaceId place, uint32_t attempt) const;
    void on_connected(PlaceId place, const SystemError& error);
    void connected(PlaceId place, Connector& connector, std::unique_ptr<Channel> channel);
    void attempt_failed(PlaceId place, const std::string& why);
    void attempt_later(PlaceId place, Connector& connector);
    void end_attempt(Connector& connector);
    void on_lost(PlaceId place);

    asio::io_context io_;
    asio::executor_work_guard<asio::io_context::executor_type> stay_;
    const std::chrono::steady_clock::time_point start_;
    asio::signal_set signals_;
    asio::steady_timer retry_writes_;
    bool retrying_writes_ = false;

    std::map<uint32_t, Connection> connections_;
    std::map<PlaceId, Listener> listeners_;
    std::map<PlaceId, Connector> connectors_;
    std::map<int, Input> inputs_;
    uint32_t last_number_ = 0;  // of connections and places alike

    std::vector<Event> events_;
    std::atomic<bool> woken_ = false;
    size_t unflushed_ = 0;  // bytes read since the last flush
    size_t received_ = 0;   // bytes read since poll() began
};

}  // namespace vagus::net
