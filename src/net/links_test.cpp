// Real sockets on the loopback interface, port 0, everything in one thread: each step polls until
// what it waits for has happened. The deadline is only there so that a broken build fails instead
// of hanging.
#include "net/links.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <thread>

#include "base/rng.hpp"
#include "net/client.hpp"

namespace vagus::net {
namespace {

using Hex = std::vector<uint8_t>;
constexpr Duration kPatience = 60s;

const Target kAnyPort = parse_target("tcp:127.0.0.1:0").value();

wire::Frame event_from(uint16_t source, uint16_t number, uint16_t payload = 8) {
    wire::Frame frame{};
    frame.source = source;
    frame.type = number;
    frame.size = payload;
    return frame;
}

// A switch with one listener, and what has happened so far.
struct Switch {
    hub::Hub hub;
    Links links;
    Listening listening = links.listen(hub, kAnyPort).value();
    std::vector<Event> events;

    void step(Duration most = 1ms) {
        for (Event& each : links.poll(links.now() + most)) events.push_back(std::move(each));
    }
    [[nodiscard]] bool until(const std::function<bool()>& done) {
        const Time deadline = links.now() + kPatience;
        while (links.now() < deadline) {
            if (done()) return true;
            step();
        }
        return false;
    }
    size_t count(EventKind kind) const {
        return static_cast<size_t>(std::count_if(
            events.begin(), events.end(), [kind](const Event& each) { return each.kind == kind; }));
    }
};

// A peer without our code on its side: a plain non-blocking socket.
class Peer {
public:
    explicit Peer(int descriptor) : descriptor_(descriptor) {}
    explicit Peer(const Target& target) : descriptor_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(std::get<TcpPlace>(target.place).port);
        // On loopback this ends at once: the listener's queue takes it.
        EXPECT_EQ(::connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    }
    ~Peer() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Peer(Peer&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Peer& operator=(Peer&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }

    size_t send_some(const Hex& bytes) const {
        const ssize_t count =
            ::send(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        return count < 0 ? 0 : static_cast<size_t>(count);
    }
    void send(const Hex& bytes) const { send_some(bytes); }
    void send(const wire::Frame& frame) const {
        Hex bytes(wire::kFrameMax);
        bytes.resize(wire::encode(frame, bytes.data()));
        send(bytes);
    }
    // What has come and was not yet taken; nullopt when the other side has closed.
    std::optional<Hex> take() const {
        Hex bytes(1 << 16);
        const ssize_t count = ::recv(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT);
        if (count == 0 || (count < 0 && errno != EAGAIN)) return std::nullopt;
        bytes.resize(count < 0 ? 0 : static_cast<size_t>(count));
        return bytes;
    }
    // Leaves without a farewell: the other side reads an error.
    void reset() {
        const linger now{1, 0};
        ::setsockopt(descriptor_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
        ::close(std::exchange(descriptor_, -1));
    }
    void shrink_receive_buffer() const {
        const int size = 4096;
        ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &size, sizeof size);
    }

private:
    int descriptor_;
};

Hex bytes_of(const wire::Frame& frame) {
    Hex bytes(wire::kFrameMax);
    bytes.resize(wire::encode(frame, bytes.data()));
    return bytes;
}

// Everything that `peer` gets until it has `size` bytes.
Hex receive(Switch& net, const Peer& peer, size_t size) {
    Hex all;
    EXPECT_TRUE(net.until([&] {
        const auto more = peer.take();
        if (more) all.insert(all.end(), more->begin(), more->end());
        return all.size() >= size;
    }));
    return all;
}

TEST(Links, GivesTheRealPortOfPort0) {
    Switch net;
    EXPECT_NE(std::get<TcpPlace>(net.listening.target.place).port, 0);
    EXPECT_EQ(to_string(net.listening.target).rfind("tcp:127.0.0.1:", 0), 0u);
}

TEST(Links, PassesAFrameFromOneClientToTheOther) {
    Switch net;
    const Peer a(net.listening.target), b(net.listening.target);
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
    EXPECT_EQ(net.count(EventKind::Opened), 2u);
    const wire::Frame event = event_from(1, 4);
    a.send(event);
    EXPECT_EQ(receive(net, b, 14), bytes_of(event));
    EXPECT_EQ(a.take(), Hex{});
}

TEST(Links, PassesAFrameThatComesByteByByte) {
    Switch net;
    const Peer a(net.listening.target), b(net.listening.target);
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
    const Hex whole = bytes_of(event_from(1, 4));
    for (const uint8_t byte : whole) {
        a.send(Hex{byte});
        net.step();
    }
    EXPECT_EQ(receive(net, b, 14), whole);
}

// Without wake() the poll would last until the test times out.
TEST(Links, AnotherThreadWakesAPoll) {
    Switch host;
    std::thread other([&host] { host.links.wake(); });
    EXPECT_TRUE(host.links.poll(Time::max()).empty());
    other.join();
    // Also one that comes before the poll.
    host.links.wake();
    EXPECT_TRUE(host.links.poll(Time::max()).empty());
}

// What must not wait for the rest of a turn: without a poll().
TEST(Links, FlushWritesWhatAHubHasAtOnce) {
    Switch net;
    const hub::LinkId own = net.hub.add({.name = "host"}).value();
    int ends[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    ASSERT_TRUE(net.links.join(net.hub, ends[0], "board 7").ok());
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
    wire::Frame frame;
    frame.source = 0;
    frame.type = 5;
    frame.size = 0;
    net.hub.receive(own, frame);
    uint8_t bytes[6] = {};
    EXPECT_EQ(::recv(ends[1], bytes, sizeof bytes, MSG_DONTWAIT), -1);
    net.links.flush();
    EXPECT_EQ(::recv(ends[1], bytes, sizeof bytes, MSG_DONTWAIT), 6);
    EXPECT_EQ(Hex(bytes, bytes + 6), (Hex{0, 0, 0, 0, 5, 0}));
    ::close(ends[1]);
}

// The line of a process that this one has started.
TEST(Links, JoinsOneEndOfAPairOfSockets) {
    Switch net;
    int ends[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    const auto place = net.links.join(net.hub, ends[0], "board 7");
    ASSERT_TRUE(place.ok());
    const Peer host(net.listening.target);
    {
        const Peer board(ends[1]);
        ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
        board.send(event_from(7, 4, 0));
        EXPECT_EQ(receive(net, host, 6), (Hex{0, 0, 7, 0, 4, 0}));
        host.send(event_from(0, 5, 2));
        EXPECT_EQ(receive(net, board, 8), bytes_of(event_from(0, 5, 2)));
    }
    ASSERT_TRUE(net.until([&] { return net.count(EventKind::Closed) == 1; }));
    EXPECT_EQ(net.events.back().place, place.value());
    EXPECT_NE(net.events.back().what.find("board 7"), std::string::npos);
}

TEST(Links, ServesAPlaceInThisProcess) {
    Switch net;
    const hub::LinkId own = net.hub.add({.name = "node"}).value();
    const Peer a(net.listening.target);
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
    a.send(event_from(0, 4));
    wire::Frame frame;
    ASSERT_TRUE(net.until([&] { return net.hub.take(own, frame); }));
    EXPECT_EQ(frame.type, 4);
    net.hub.receive(own, event_from(1, 5));
    EXPECT_EQ(receive(net, a, 14), bytes_of(event_from(1, 5)));
}

TEST(Links, TellsTheOthersThatANodeLeft) {
    Switch net;
    const Peer host(net.listening.target);
    {
        const Peer node(net.listening.target);
        ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
        node.send(event_from(7, 4, 0));
        EXPECT_EQ(receive(net, host, 6), (Hex{0, 0, 7, 0, 4, 0}));
    }
    EXPECT_EQ(receive(net, host, 6), (Hex{0, 0, 7, 0, 4, 0x90}));
    EXPECT_EQ(net.count(EventKind::Closed), 1u);
    EXPECT_NE(net.events.back().what.find("the other side closed it"), std::string::npos);
}

TEST(Links, WhatAClientSaidBeforeItLeftArrives) {
    Switch net;
    const Peer host(net.listening.target);
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 1; }));
    for (int round = 0; round < 50; ++round) {
        Peer hasty(net.listening.target);
        hasty.send(event_from(0, 4, 0));
        host.send(event_from(0, 5, 0));  // so that the switch also writes to one who has left
    }
    EXPECT_EQ(receive(net, host, 50 * 6).size(), 50u * 6);
}

TEST(Links, AClientThatNeverReadsCostsTheOthersNothing) {
    Switch net;
    const Peer sender(net.listening.target), reader(net.listening.target);
    const Peer stuck(net.listening.target);
    stuck.shrink_receive_buffer();
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 3; }));
    const hub::LinkId stuck_link = net.hub.links()[2];
    const wire::Frame event = event_from(1, 4, wire::kPayloadMax);
    uint64_t sent = 0, read = 0;
    while (net.hub.stats(stuck_link).dropped.events == 0) {
        ASSERT_LT(sent, 1000000u) << "nothing was ever dropped";
        for (int i = 0; i < 4; ++i, ++sent) sender.send(event);
        read += receive(net, reader, 4 * wire::kFrameMax).size();
    }
    EXPECT_EQ(read, sent * wire::kFrameMax);
    EXPECT_EQ(net.hub.stats(net.hub.links()[1]).dropped, hub::Dropped{});
    EXPECT_EQ(net.hub.links().size(), 3u);
}

// One sends as fast as it can, the other reads as fast as it can: nothing may be lost between them,
// though the sender is faster.
TEST(Links, AFloodReachesAReceiverThatKeepsUp) {
    Switch net;
    const Peer sender(net.listening.target), reader(net.listening.target);
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
    Hex chunk;
    for (uint16_t i = 0; i < 1000; ++i) {
        const Hex one = bytes_of(event_from(1, i));
        chunk.insert(chunk.end(), one.begin(), one.end());
    }
    const size_t all = 300 * chunk.size();
    size_t sent = 0, read = 0, at = 0;
    ASSERT_TRUE(net.until([&] {
        while (sent < all) {
            const Hex rest(chunk.begin() + static_cast<long>(at), chunk.end());
            const size_t taken = sender.send_some(rest);
            if (taken == 0) break;
            sent += taken;
            at = (at + taken) % chunk.size();
        }
        read += reader.take().value_or(Hex{}).size();
        return read == all;
    }));
    EXPECT_EQ(net.hub.stats(net.hub.links()[1]).dropped, hub::Dropped{});
}

TEST(Links, ServesHundredsOfClients) {
    Switch net;
    const size_t count = 300;
    std::vector<Peer> peers;
    while (peers.size() < count) {
        // Not more at once than the listener's queue takes.
        for (int i = 0; i < 50; ++i) peers.emplace_back(net.listening.target);
        ASSERT_TRUE(net.until([&] { return net.hub.links().size() == peers.size(); }));
    }
    peers[0].send(event_from(1, 4));
    for (size_t i = 1; i < count; ++i) {
        EXPECT_EQ(receive(net, peers[i], 14), bytes_of(event_from(1, 4)));
    }
    peers.clear();
    ASSERT_TRUE(net.until([&] { return net.hub.links().empty(); }));
}

TEST(Links, ClosesAPeerThatDoesNotSpeakTheProtocol) {
    Switch net;
    const Peer good(net.listening.target);
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 1; }));
    const Peer liar(net.listening.target);
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
    Hex oversized{0x05, 0x02, 1, 0, 4, 0};  // 517 bytes
    oversized.resize(6 + 517);
    for (uint32_t i = 0; i + 1 < kOversizedFramesMax; ++i) liar.send(oversized);
    liar.send(event_from(1, 4, 0));
    EXPECT_EQ(receive(net, good, 6), bytes_of(event_from(1, 4, 0)));  // up to the limit it stays
    liar.send(oversized);
    ASSERT_TRUE(net.until([&] { return net.count(EventKind::Closed) == 1; }));
    EXPECT_NE(net.events.back().what.find("does not speak the Aseba protocol"), std::string::npos);
    EXPECT_TRUE(net.events.back().expelled);
    EXPECT_EQ(net.hub.links().size(), 1u);
}

TEST(Links, RemapsALinkAsItsTargetSays) {
    Switch node_side;
    const hub::LinkId node = node_side.hub.add({.name = "node"}).value();
    hub::Hub hub;
    const hub::LinkId host = hub.add({.name = "host"}).value();
    Links links;
    Target target = node_side.listening.target;
    target.remap = hub::Remap{5, 1};
    ASSERT_TRUE(links.connect(hub, target).ok());
    wire::Frame frame;
    ASSERT_TRUE(node_side.until([&] {
        links.poll(links.now());
        return hub.links().size() == 2 && node_side.hub.links().size() == 2;
    }));
    node_side.hub.receive(node, event_from(1, 4));
    ASSERT_TRUE(node_side.until([&] {
        links.poll(links.now());
        return hub.take(host, frame);
    }));
    EXPECT_EQ(frame.source, 5);
}

TEST(Links, ReconnectsALostTarget) {
    hub::Hub hub;
    Links links;
    std::vector<Event> events;
    auto first = std::make_unique<Switch>();
    const Target target = first->listening.target;
    ASSERT_TRUE(links.connect(hub, target, {.retry = Retry::Forever}).ok());
    const auto until = [&](Switch* other, EventKind kind) {
        const Time deadline = links.now() + kPatience;
        while (links.now() < deadline) {
            if (other) other->step();
            for (Event& each : links.poll(links.now() + 1ms)) events.push_back(each);
            if (!events.empty() && events.back().kind == kind) return true;
        }
        return false;
    };
    ASSERT_TRUE(until(first.get(), EventKind::Opened));
    first.reset();
    ASSERT_TRUE(until(nullptr, EventKind::Failed));
    EXPECT_NE(events.back().what.find(to_string(target) + ": cannot connect"), std::string::npos);
    Switch second;
    const auto again = second.links.listen(second.hub, target);
    ASSERT_TRUE(again.ok()) << again.error().what;
    ASSERT_TRUE(until(&second, EventKind::Opened));
    std::vector<EventKind> kinds;
    for (const Event& each : events) kinds.push_back(each.kind);
    // An outage is told once, however often it was tried.
    EXPECT_EQ(kinds, (std::vector<EventKind>{EventKind::Opened, EventKind::Closed,
                                             EventKind::Failed, EventKind::Opened}));
}

TEST(Links, ASingleClientListenerReplacesItsClient) {
    hub::Hub hub;
    Links links;
    const Listening at = links.listen(hub, kAnyPort, {.clients = Clients::One}).value();
    Switch clock;  // only for its until()
    const Peer first(at.target);
    ASSERT_TRUE(clock.until([&] {
        links.poll(links.now());
        return hub.links().size() == 1;
    }));
    const hub::LinkId first_link = hub.links()[0];
    const Peer second(at.target);
    ASSERT_TRUE(clock.until([&] {
        links.poll(links.now());
        return hub.links().size() == 1 && hub.links()[0] != first_link;
    }));
    ASSERT_TRUE(clock.until([&] { return !first.take().has_value(); }));
    EXPECT_TRUE(second.take().has_value());
}

TEST(Links, NamesWhatCannotBeDone) {
    Switch net;
    const auto taken = net.links.listen(net.hub, net.listening.target);
    ASSERT_FALSE(taken.ok());
    EXPECT_NE(taken.error().what.find(to_string(net.listening.target) + ": cannot listen"),
              std::string::npos);
    EXPECT_NE(taken.error().what.find("0 takes a free one"), std::string::npos);
    const auto serial = net.links.listen(net.hub, parse_target("ser:/dev/ttyS0").value());
    ASSERT_FALSE(serial.ok());
    EXPECT_NE(serial.error().what.find("only TCP can listen"), std::string::npos);
    const auto port0 = net.links.connect(net.hub, kAnyPort);
    ASSERT_FALSE(port0.ok());
    EXPECT_EQ(port0.error().code, Code::BadInput);
    const auto rate = net.links.connect(net.hub, parse_target("ser:/dev/ptmx:12345").value());
    ASSERT_FALSE(rate.ok());
    EXPECT_NE(rate.error().what.find("12345 is no baud rate"), std::string::npos);
}

TEST(Links, AMissingDeviceIsAFailedAttempt) {
    Switch net;
    ASSERT_TRUE(net.links.connect(net.hub, parse_target("ser:/dev/no-such-line").value()).ok());
    ASSERT_TRUE(net.until([&] { return net.count(EventKind::Failed) == 1; }));
    EXPECT_NE(net.events[0].what.find("ser:/dev/no-such-line: cannot open it: No such file"),
              std::string::npos);
}

TEST(Links, PollEndsAtItsDeadline) {
    Switch net;
    const Time before = net.links.now();
    EXPECT_TRUE(net.links.poll(before + 20ms).empty());
    EXPECT_GE(net.links.now(), before + 20ms);
}

TEST(Links, TellsOfSignalsAndOfInput) {
    Switch net;
    ASSERT_TRUE(net.links.watch_signals().ok());
    ::raise(SIGTERM);
    ASSERT_TRUE(net.until([&] { return net.count(EventKind::Signal) == 1; }));
    EXPECT_EQ(net.events[0].number, SIGTERM);
    ::raise(SIGHUP);  // the terminal is gone
    ASSERT_TRUE(net.until([&] { return net.count(EventKind::Signal) == 2; }));
    EXPECT_EQ(net.events[1].number, SIGHUP);

    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_TRUE(net.links.watch_input(ends[0]).ok());
    ASSERT_EQ(::write(ends[1], "q", 1), 1);
    ASSERT_TRUE(net.until([&] { return net.count(EventKind::Readable) > 0; }));
    EXPECT_EQ(net.events.back().number, ends[0]);
    net.links.unwatch_input(ends[0]);
    ::close(ends[0]);
    ::close(ends[1]);
    EXPECT_FALSE(net.links.watch_input(ends[0]).ok());
}

// Time::max() in nanoseconds is no number: a wait for it once was a busy loop.
TEST(Links, WaitsWithoutAnEndAndWithoutWork) {
    Links links;
    ASSERT_TRUE(links.watch_signals().ok());
    sigevent tell{};
    tell.sigev_notify = SIGEV_SIGNAL;
    tell.sigev_signo = SIGTERM;
    timer_t timer{};
    ASSERT_EQ(timer_create(CLOCK_MONOTONIC, &tell, &timer), 0);
    const itimerspec once{{0, 0}, {0, 100'000'000}};
    ASSERT_EQ(timer_settime(timer, 0, &once, nullptr), 0);
    const Time begun = links.now();
    const std::clock_t worked_before = std::clock();
    const std::vector<Event> events = links.poll(Time::max());
    const double worked = static_cast<double>(std::clock() - worked_before) / CLOCKS_PER_SEC;
    const double waited = std::chrono::duration<double>(links.now() - begun).count();
    timer_delete(timer);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].kind, EventKind::Signal);
    EXPECT_LT(worked, waited / 4);
}

TEST(Links, TakesItsLinksAlongWhenItGoes) {
    hub::Hub hub;
    const hub::LinkId own = hub.add({.name = "own"}).value();
    {
        Links links;
        const Listening at = links.listen(hub, kAnyPort).value();
        const Peer peer(at.target);
        while (hub.links().size() < 2) links.poll(links.now() + 1ms);
    }
    EXPECT_EQ(hub.links(), std::vector<hub::LinkId>{own});
}

TEST(Client, SendsWaitsAndSaysWhenThePeerHasGone) {
    Switch net;
    const hub::LinkId node = net.hub.add({.name = "node"}).value();
    // Client blocks, but the system accepts and keeps what is written before the switch looks.
    Result<Client> connection = Client::connect(net.listening.target, kPatience);
    ASSERT_TRUE(connection.ok());
    Client* const client = &connection.value();
    ASSERT_TRUE(client->send(event_from(0, 4)).ok());
    wire::Frame frame;
    ASSERT_TRUE(net.until([&] { return net.hub.take(node, frame); }));
    EXPECT_EQ(frame.type, 4);
    const auto nothing = client->receive(client->now());
    ASSERT_TRUE(nothing.ok());
    EXPECT_FALSE(nothing.value().has_value());
    net.hub.receive(node, event_from(1, 5));
    net.step();
    EXPECT_EQ(client->receive(client->now() + kPatience).value().value().type, 5);
    net.hub.receive(node, event_from(1, 6));
    net.step();
    net.links.close(net.hub, net.hub.links()[1]);
    EXPECT_EQ(client->receive(client->now() + kPatience).value().value().type, 6);
    // The hub says that node 1, which spoke on that connection, cannot be reached any more.
    EXPECT_EQ(client->receive(client->now() + kPatience).value().value().type, 0x9004);
    const auto gone = client->receive(client->now() + kPatience);
    ASSERT_FALSE(gone.ok());
    EXPECT_EQ(gone.error().code, Code::Unavailable);
    EXPECT_FALSE(client->send(event_from(0, 4)).ok());
}

TEST(Client, SaysThatNobodyIsThere) {
    Target nobody;
    {
        Switch net;
        nobody = net.listening.target;
    }
    const auto client = Client::connect(nobody, kPatience);
    ASSERT_FALSE(client.ok());
    EXPECT_EQ(client.error().code, Code::Unavailable);
    EXPECT_NE(client.error().what.find("Connection refused"), std::string::npos);
}

// A thousand steps of coming, going, garbage and silence. Two clients behave and must never miss a
// frame.
TEST(Links, RandomPeersNeverDisturbTheGoodOnes) {
    const uint64_t seed = 1000;
    SCOPED_TRACE("seed " + std::to_string(seed));
    SplitMix64 random(seed);
    Switch net;
    const Peer sender(net.listening.target), reader(net.listening.target);
    ASSERT_TRUE(net.until([&] { return net.hub.links().size() == 2; }));
    std::vector<Peer> bad;
    wire::FrameReader parser;
    uint16_t expected = 0;
    for (uint16_t number = 0; number < 1000; ++number) {
        const uint64_t act = random.below(10);
        if (act < 3 && bad.size() < 20) bad.emplace_back(net.listening.target);
        if (!bad.empty()) {
            Peer& peer = bad[random.below(bad.size())];
            Hex garbage(random.below(3000));
            for (uint8_t& byte : garbage) byte = static_cast<uint8_t>(random.next());
            if (act < 7) peer.send(garbage);
            if (act == 7) (void)peer.take();
            if (act == 8) {
                std::swap(peer, bad.back());
                bad.back().reset();
                bad.pop_back();
            }
            if (act == 9) {
                std::swap(peer, bad.back());
                bad.pop_back();
            }
        }
        wire::Frame good = event_from(0xbeef, 0x1234, 2);
        good.payload[0] = static_cast<uint8_t>(number & 0xff);
        good.payload[1] = static_cast<uint8_t>(number >> 8);
        sender.send(good);
        ASSERT_TRUE(net.until([&] {
            const Hex bytes = reader.take().value_or(Hex{});
            for (size_t at = 0; at < bytes.size();) {
                at += parser.feed(bytes.data() + at, static_cast<uint16_t>(bytes.size() - at));
                if (!parser.complete() || parser.frame().source != 0xbeef) continue;
                if (parser.frame().type == 0x1234 && parser.frame().first_word() == expected) {
                    ++expected;
                }
            }
            return expected == number + 1;
        })) << "step "
            << number;
    }
}

}  // namespace
}  // namespace vagus::net
