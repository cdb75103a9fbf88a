#include "net/loop.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <csignal>
#include <cstring>
#include <utility>

#include "net/end_signal.hpp"

namespace vagus::net {

namespace {

// Handlers run in one poll() before its caller gets a turn.
constexpr int kHandlersAtOnce = 256;
// What was read is written out at the latest after so many bytes, and the caller has a turn after
// so many: queues are several times that long.
constexpr size_t kFlushAfterBytes = 32 * 1024;
constexpr size_t kReturnAfterBytes = 64 * 1024;
// How often the last words of a peer are read when writing to it has failed.
constexpr int kLastReadsMax = 64;
constexpr Duration kRetryWrites = 1ms;
constexpr Duration kTellSkippedEvery = 1s;
constexpr Duration kWaitMax = 1h;  // then it looks at the clock and waits on

}  // namespace

Links::Loop::Connection::Connection(asio::io_context& io, std::unique_ptr<Channel> its_channel)
    : channel(std::move(its_channel)), waiter(io) {
    waiter.assign(channel->descriptor());
}

Links::Loop::Connection::~Connection() {
    waiter.release();
}

Links::Loop::Loop()
    : io_(1),  // one thread
      stay_(io_.get_executor()),
      start_(std::chrono::steady_clock::now()),
      signals_(io_),
      retry_writes_(io_) {}

Links::Loop::~Loop() {
    for (auto& [number, connection] : connections_) connection.hub->remove(connection.link);
}

Time Links::Loop::now() const {
    return std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - start_);
}

std::vector<Event> Links::Loop::poll(Time deadline) {
    received_ = 0;
    wait_inputs();
    flush();
    while (events_.empty() && received_ == 0 && !woken_.exchange(false)) {
        if (run_some(deadline) == 0 && now() >= deadline) break;
    }
    return std::exchange(events_, {});
}

// The handler does nothing: that there is one ends the wait.
void Links::Loop::wake() {
    woken_ = true;
    asio::post(io_, [] {});
}

// Waits for one handler, then runs those that are ready too, then writes what came of it.
size_t Links::Loop::run_some(Time deadline) {
    resume_paused();
    Time until = deadline;
    for (const auto& [number, connection] : connections_) {
        if (connection.read_paused) until = std::min(until, now() + kPacePeriod);
        until = std::min(until, connection.channel->next_look());
    }
    // Time::max() is more than the nanoseconds of the system's clock can hold.
    until = std::min(until, now() + kWaitMax);
    size_t ran = until > now() ? io_.run_one_until(start_ + until) : 0;
    for (int i = 0; i < kHandlersAtOnce && received_ < kReturnAfterBytes; ++i) {
        const size_t more = io_.poll_one();
        ran += more;
        if (more == 0) break;
    }
    look_at_lines();
    flush();
    return ran;
}

void Links::Loop::look_at_lines() {
    for (auto& [number, connection] : connections_) {
        if (connection.channel->next_look() > now()) continue;
        received_ += connection.channel->look(*connection.hub, connection.link, now()).bytes;
        tell_skipped(connection);
    }
}

void Links::Loop::tell_skipped(Connection& connection) {
    const uint32_t skipped = connection.channel->skipped();
    if (skipped == connection.skipped_told || now() < connection.tell_skipped_after) return;
    const uint32_t more = skipped - connection.skipped_told;
    connection.skipped_told = skipped;
    connection.tell_skipped_after = now() + kTellSkippedEvery;
    events_.push_back({EventKind::Skipped, connection.place, connection.link, 0,
                       connection.name + ": skipped " + std::to_string(more) +
                           (more == 1 ? " byte" : " bytes") +
                           " that belonged to no frame; bytes get lost or damaged on this line"});
}

Result<Done> Links::Loop::open_link(PlaceId place, hub::Hub& hub, hub::LinkOptions options,
                                    std::unique_ptr<Channel> channel) {
    const std::string name = options.name;
    const hub::LinkId link = TRY(hub.add(std::move(options)));
    const uint32_t number = ++last_number_;
    Connection& connection =
        connections_.try_emplace(number, io_, std::move(channel)).first->second;
    connection.place = place;
    connection.hub = &hub;
    connection.link = link;
    connection.name = name;
    events_.push_back({EventKind::Opened, place, link, 0, name});
    wait_readable(number, connection);
    return Done{};
}

void Links::Loop::wait_readable(uint32_t number, Connection& connection) {
    connection.read_paused = false;
    connection.waiter.async_wait(asio::posix::stream_descriptor::wait_read,
                                 [this, number](const SystemError& error) {
                                     if (error != asio::error::operation_aborted) {
                                         on_readable(number);
                                     }
                                 });
}

void Links::Loop::on_readable(uint32_t number) {
    const auto at = connections_.find(number);
    if (at == connections_.end()) return;
    Connection& connection = at->second;
    const Transfer done = connection.channel->read(*connection.hub, connection.link, now());
    // The first to be heard is passed on at once; those who are heard in the same turn share the
    // writes.
    const bool first = received_ == 0;
    received_ += done.bytes;
    unflushed_ += done.bytes;
    if (first || unflushed_ >= kFlushAfterBytes) flush();
    if (done.flow == Flow::Ended) {
        drop(number, done);
        return;
    }
    // The flush may have found that this peer is gone.
    if (!connections_.contains(number)) return;
    tell_skipped(connection);
    pause_if_ahead(connection, done.bytes);
    if (!connection.read_paused) wait_readable(number, connection);
}

void Links::Loop::flush() {
    unflushed_ = 0;
    for (auto at = connections_.begin(); at != connections_.end();) {
        auto& [number, connection] = *at++;  // the connection may be erased below
        const bool waiting =
            connection.hub->waiting(connection.link) > 0 || connection.channel->has_unwritten();
        if (waiting && !connection.write_blocked) write(number, connection);
    }
}

void Links::Loop::write(uint32_t number, Connection& connection) {
    const Transfer done = connection.channel->write(*connection.hub, connection.link);
    connection.pace.took(done.bytes);
    switch (done.flow) {
        case Flow::Moved:
            break;
        case Flow::Blocked:
            wait_writable(number, connection);
            break;
        case Flow::Retry:
            retry_writes_soon();
            break;
        case Flow::Ended:
            read_last_words(connection);
            drop(number, done);
            break;
    }
}

// The peer may have sent something before it went.
void Links::Loop::read_last_words(Connection& connection) {
    for (int i = 0; i < kLastReadsMax; ++i) {
        const Transfer done = connection.channel->read(*connection.hub, connection.link, now());
        received_ += done.bytes;
        if (done.bytes == 0) return;
    }
}

void Links::Loop::wait_writable(uint32_t number, Connection& connection) {
    connection.write_blocked = true;
    connection.waiter.async_wait(asio::posix::stream_descriptor::wait_write,
                                 [this, number](const SystemError& error) {
                                     const auto at = connections_.find(number);
                                     if (error || at == connections_.end()) return;
                                     at->second.write_blocked = false;
                                     write(number, at->second);
                                 });
}

void Links::Loop::retry_writes_soon() {
    if (retrying_writes_) return;
    retrying_writes_ = true;
    retry_writes_.expires_after(kRetryWrites);
    // The flush at the end of each turn does the work.
    retry_writes_.async_wait([this](const SystemError&) { retrying_writes_ = false; });
}

void Links::Loop::drop(uint32_t number, const Transfer& last) {
    const auto at = connections_.find(number);
    if (at == connections_.end()) return;
    Connection& connection = at->second;
    const PlaceId place = connection.place;
    events_.push_back({EventKind::Closed, place, connection.link, 0,
                       connection.name + ": " + last.why, connection.hub->stats(connection.link),
                       last.expelled});
    connection.hub->remove(connection.link);
    connections_.erase(at);
    on_lost(place);
}

void Links::Loop::close(hub::Hub& hub, hub::LinkId link) {
    for (auto at = connections_.begin(); at != connections_.end(); ++at) {
        if (at->second.hub != &hub || at->second.link != link) continue;
        hub.remove(link);
        connections_.erase(at);
        return;
    }
}

bool Links::Loop::end_writing(hub::Hub& hub, hub::LinkId link) {
    for (auto& [number, connection] : connections_) {
        if (connection.hub == &hub && connection.link == link) {
            return connection.channel->end_writing();
        }
    }
    return false;
}

// ---- pacing (pace.hpp) ----

void Links::Loop::pause_if_ahead(Connection& connection, size_t bytes) {
    connection.read_paused = bytes >= kBulkBytes && somebody_to_wait_for(connection);
}

bool Links::Loop::somebody_to_wait_for(const Connection& sender) {
    bool found = false;
    for (auto& [number, other] : connections_) {
        if (other.hub != sender.hub || &other == &sender) continue;
        const size_t waiting = other.hub->waiting(other.link);
        found = other.pace.worth_waiting_for(now(), waiting) || found;
    }
    return found;
}

void Links::Loop::resume_paused() {
    for (auto& [number, connection] : connections_) {
        if (connection.read_paused && !somebody_to_wait_for(connection)) {
            wait_readable(number, connection);
        }
    }
}

bool Links::Loop::has_unwritten() const {
    for (const auto& [number, connection] : connections_) {
        if (connection.hub->waiting(connection.link) > 0) return true;
        if (connection.channel->has_unwritten()) return true;
    }
    return false;
}

// ---- signals and inputs ----

Status Links::Loop::watch_signals() {
    SystemError error;
    signals_.add(SIGINT, error);
    if (!error) signals_.add(SIGTERM, error);
    if (!error && !is_ignored(SIGHUP)) signals_.add(SIGHUP, error);
    if (error) return Error{Code::Unavailable, "signals cannot be watched: " + error.message()};
    wait_signal();
    return Status::done();
}

void Links::Loop::wait_signal() {
    signals_.async_wait([this](const SystemError& error, int number) {
        if (error) return;
        events_.push_back({EventKind::Signal, {}, {}, number, strsignal(number)});
        wait_signal();
    });
}

Status Links::Loop::watch_input(int descriptor) {
    const auto at = inputs_.try_emplace(descriptor, asio::posix::stream_descriptor(io_)).first;
    const int copy = ::dup(descriptor);  // the waiter closes its own
    SystemError error;
    if (copy < 0) {
        error = SystemError(errno, boost::system::system_category());
    } else {
        at->second.waiter.assign(copy, error);
    }
    if (!error) return Status::done();
    inputs_.erase(at);
    if (copy >= 0) ::close(copy);
    return Error{Code::Unavailable, "descriptor " + std::to_string(descriptor) +
                                        " cannot be watched: " + error.message()};
}

void Links::Loop::unwatch_input(int descriptor) {
    inputs_.erase(descriptor);
}

void Links::Loop::wait_inputs() {
    for (auto& [descriptor, input] : inputs_) {
        if (input.waiting) continue;
        input.waiting = true;
        input.waiter.async_wait(asio::posix::stream_descriptor::wait_read,
                                [this, number = descriptor](const SystemError& error) {
                                    const auto at = inputs_.find(number);
                                    if (error || at == inputs_.end()) return;
                                    at->second.waiting = false;
                                    events_.push_back({EventKind::Readable, {}, {}, number, ""});
                                });
    }
}

}  // namespace vagus::net
