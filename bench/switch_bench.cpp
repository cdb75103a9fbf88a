// `vagus switch` beside Debian's `asebaswitch` (package aseba), in one run on one machine: one
// sender, 1, 4 and 16 receivers, events of 8 bytes.
//
//     ./dev bench switch
//
// Throughput: one thread writes events as fast as the switch takes them for kFloodTime, another
// reads all receivers; counted is what the slowest receiver got until everything sent has arrived.
// Latency: one event at a time, through both switches in turn, from the write to the read of each
// receiver; the reader spins, so that only the switch has to be woken. The median of three rounds.
//
// asebaswitch binds to all addresses, so the whole benchmark moves into a network namespace of its
// own first, which needs root or user namespaces.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <net/if.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "wire/frame.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kFloodTime = 500ms;
constexpr auto kSettle = 2s;  // without a byte so long after the flood, the rest counts as lost
constexpr int kRounds = 3;
constexpr int kLatencyEvents = 3000;
constexpr size_t kEventBytes = 14;
constexpr size_t kChunkEvents = 512;

[[noreturn]] void fail(const std::string& what) {
    fmt::print(stderr, "bench_switch: {}: {}\n", what, std::strerror(errno));
    std::exit(1);
}

// ---- the place ----

void enter_own_network() {
    if (::unshare(CLONE_NEWNET) < 0 && ::unshare(CLONE_NEWUSER | CLONE_NEWNET) < 0) {
        fail("no network namespace (run as root)");
    }
    const int any = ::socket(AF_INET, SOCK_DGRAM, 0);
    ifreq loopback{};
    std::strcpy(loopback.ifr_name, "lo");
    loopback.ifr_flags = IFF_UP | IFF_RUNNING;
    if (::ioctl(any, SIOCSIFFLAGS, &loopback) < 0) fail("lo cannot be brought up");
    ::close(any);
}

int try_connect(uint16_t port) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) < 0) {
        ::close(socket);
        return -1;
    }
    const int on = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return socket;
}

struct Subject {
    const char* name;
    uint16_t port;
    std::vector<std::string> command;
};

class Running {
public:
    explicit Running(const Subject& subject) : subject_(subject), child_(fork_clean()) {
        if (child_ == 0) become(subject);
        const auto deadline = Clock::now() + 10s;
        int socket = -1;
        while ((socket = try_connect(subject.port)) < 0) {
            if (Clock::now() > deadline) fail(std::string(subject.name) + " does not listen");
            ::poll(nullptr, 0, 10);
        }
        ::close(socket);
    }
    ~Running() {
        ::kill(child_, SIGTERM);
        ::waitpid(child_, nullptr, 0);
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    int connect() const {
        const int socket = try_connect(subject_.port);
        if (socket < 0) fail(std::string(subject_.name) + " does not accept");
        return socket;
    }

private:
    static pid_t fork_clean() {
        std::fflush(stdout);  // or the child says it again
        return ::fork();
    }
    [[noreturn]] static void become(const Subject& subject) {
        if (std::freopen("/dev/null", "w", stdout) == nullptr) ::_exit(1);
        if (std::freopen("/dev/null", "w", stderr) == nullptr) ::_exit(1);
        std::vector<char*> words;
        for (const std::string& word : subject.command) {
            words.push_back(const_cast<char*>(word.c_str()));
        }
        words.push_back(nullptr);
        ::execvp(words[0], words.data());
        ::_exit(127);
    }

    const Subject& subject_;
    pid_t child_;
};

// ---- what is sent ----

void put_event(uint8_t* at, int64_t payload) {
    vagus::wire::Frame frame{};
    frame.source = 1;
    frame.type = 1;
    frame.size = 8;
    std::memcpy(frame.payload, &payload, 8);
    std::array<uint8_t, vagus::wire::kFrameMax> bytes;
    std::memcpy(at, bytes.data(), vagus::wire::encode(frame, bytes.data()));
}

int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
        .count();
}

struct Clients {
    int sender;
    std::vector<int> receivers;

    Clients(const Running& subject, int count) : sender(subject.connect()) {
        for (int i = 0; i < count; ++i) receivers.push_back(subject.connect());
        prove_all_connected();
    }
    ~Clients() {
        ::close(sender);
        for (const int each : receivers) ::close(each);
    }
    Clients(const Clients&) = delete;
    Clients& operator=(const Clients&) = delete;

private:
    // A switch accepts in its own time: an event that all receivers have read proves that they are
    // in. It is sent again until then, and the copies that follow are read away.
    void prove_all_connected() {
        std::vector<bool> in(receivers.size(), false);
        std::array<uint8_t, kEventBytes> event;
        put_event(event.data(), 0);
        while (std::find(in.begin(), in.end(), false) != in.end()) {
            if (::send(sender, event.data(), event.size(), 0) < 0) fail("send");
            ::poll(nullptr, 0, 20);
            read_away(in);
        }
        ::poll(nullptr, 0, 100);
        read_away(in);
    }
    void read_away(std::vector<bool>& in) const {
        std::array<uint8_t, 4096> buffer;
        for (size_t i = 0; i < receivers.size(); ++i) {
            while (::recv(receivers[i], buffer.data(), buffer.size(), MSG_DONTWAIT) > 0) {
                in[i] = true;
            }
        }
    }
};

// ---- throughput ----

struct Flood {
    double events_per_second;
    double lost_percent;
};

size_t send_for(int sender, Clock::duration time) {
    std::vector<uint8_t> chunk(kChunkEvents * kEventBytes);
    for (size_t i = 0; i < kChunkEvents; ++i) put_event(chunk.data() + i * kEventBytes, 0);
    const auto end = Clock::now() + time;
    size_t events = 0;
    for (; Clock::now() < end; events += kChunkEvents) {
        for (size_t sent = 0; sent < chunk.size();) {
            const ssize_t count = ::send(sender, chunk.data() + sent, chunk.size() - sent, 0);
            if (count < 0) fail("send");
            sent += static_cast<size_t>(count);
        }
    }
    return events;
}

Flood flood(const Running& subject, int count) {
    const Clients clients(subject, count);
    std::vector<pollfd> watched;
    for (const int each : clients.receivers) watched.push_back({each, POLLIN, 0});
    std::vector<size_t> received(watched.size(), 0);
    std::atomic<size_t> sent_events{0};  // 0: still sending
    const auto begin = Clock::now();
    std::jthread sending(
        [&clients, &sent_events] { sent_events = send_for(clients.sender, kFloodTime); });
    auto last = begin;
    std::vector<uint8_t> buffer(1 << 18);
    for (;;) {
        const size_t all = sent_events.load() * kEventBytes;
        if (all > 0 && std::all_of(received.begin(), received.end(),
                                   [all](size_t bytes) { return bytes >= all; })) {
            break;
        }
        if (::poll(watched.data(), watched.size(), 50) == 0 && Clock::now() - last > kSettle) break;
        for (size_t i = 0; i < watched.size(); ++i) {
            if ((watched[i].revents & POLLIN) == 0) continue;
            const ssize_t got = ::recv(watched[i].fd, buffer.data(), buffer.size(), MSG_DONTWAIT);
            if (got <= 0) continue;
            received[i] += static_cast<size_t>(got);
            last = Clock::now();
        }
    }
    const double seconds = std::chrono::duration<double>(last - begin).count();
    const auto slowest = static_cast<double>(*std::min_element(received.begin(), received.end()));
    const auto all = static_cast<double>(sent_events.load() * kEventBytes);
    return {slowest / kEventBytes / seconds, 100.0 * (1.0 - slowest / all)};
}

// ---- latency ----

// One event through one switch; adds the time of each receiver, in ns.
void time_one_event(const Clients& clients, std::vector<int64_t>& samples) {
    std::array<uint8_t, kEventBytes> event;
    const int64_t begin = now_ns();
    put_event(event.data(), begin);
    if (::send(clients.sender, event.data(), event.size(), 0) < 0) fail("send");
    std::vector<int> waiting = clients.receivers;
    while (!waiting.empty()) {
        std::erase_if(waiting, [&](int receiver) {
            std::array<uint8_t, kEventBytes> back;
            const ssize_t got = ::recv(receiver, back.data(), back.size(), MSG_DONTWAIT);
            if (got <= 0) return false;
            samples.push_back(now_ns() - begin);
            // A switch may write a frame in pieces: the rest follows at once.
            const size_t rest = kEventBytes - static_cast<size_t>(got);
            if (rest > 0) ::recv(receiver, back.data(), rest, MSG_WAITALL);
            return true;
        });
    }
}

struct Latency {
    double p50_us;
    double p99_us;
};

Latency summary(std::vector<int64_t>& samples) {
    std::sort(samples.begin(), samples.end());
    const auto at = [&samples](double part) {
        const auto index = static_cast<size_t>(part * static_cast<double>(samples.size() - 1));
        return static_cast<double>(samples[index]) / 1000.0;
    };
    return {at(0.50), at(0.99)};
}

// ---- the table ----

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Row {
    std::vector<double> rates, losses, p50s, p99s;

    void add(const Flood& flood) {
        rates.push_back(flood.events_per_second);
        losses.push_back(flood.lost_percent);
    }
    void add(const Latency& latency) {
        p50s.push_back(latency.p50_us);
        p99s.push_back(latency.p99_us);
    }
    void print(const char* name, int receivers) const {
        fmt::print("{:>9}  {:<12} {:>11.0f} {:>7.2f} {:>8.1f} {:>8.1f}\n", receivers, name,
                   median(rates), median(losses), median(p50s), median(p99s));
    }
};

void measure(const Subject& peer, const Subject& vagus, int receivers, Row& theirs, Row& ours) {
    const Running their_switch(peer), our_switch(vagus);
    theirs.add(flood(their_switch, receivers));
    ours.add(flood(our_switch, receivers));
    // Event by event in turn, so that whatever else the machine does hits both alike.
    const Clients their_clients(their_switch, receivers), our_clients(our_switch, receivers);
    std::vector<int64_t> their_samples, our_samples;
    for (int i = 0; i < kLatencyEvents; ++i) {
        time_one_event(their_clients, their_samples);
        time_one_event(our_clients, our_samples);
    }
    theirs.add(summary(their_samples));
    ours.add(summary(our_samples));
}

void compare(const Subject& peer, const Subject& vagus, int receivers) {
    Row theirs, ours;
    for (int round = 0; round < kRounds; ++round) measure(peer, vagus, receivers, theirs, ours);
    theirs.print(peer.name, receivers);
    ours.print(vagus.name, receivers);
    fmt::print(
        "{:>9}  ratio: {:.1f} times the events, {:.2f} times the p50, {:.2f} times the p99\n", "",
        median(ours.rates) / median(theirs.rates), median(ours.p50s) / median(theirs.p50s),
        median(ours.p99s) / median(theirs.p99s));
}

}  // namespace

int main() {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    enter_own_network();
    const Subject peer{"asebaswitch", 33401, {"asebaswitch", "-p", "33401"}};
    const Subject vagus{
        "vagus switch", 33402, {VAGUS_PROGRAM, "switch", "--listen", "tcp:127.0.0.1:33402"}};
    fmt::print("{:>9}  {:<12} {:>11} {:>7} {:>8} {:>8}\n", "receivers", "switch", "events/s",
               "lost %", "p50 us", "p99 us");
    for (const int receivers : {1, 4, 16}) compare(peer, vagus, receivers);
    return 0;
}
