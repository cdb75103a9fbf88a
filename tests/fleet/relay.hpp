// A way to a port on loopback that can be cut: what is connected is closed, and what comes is, too,
// until it is restored. On a thread of its own.
//
//     Relay relay(8883);
//     connect(relay.port());
//     relay.cut();
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace vagus::fleet_tests {

class Relay {
public:
    explicit Relay(uint16_t to) : to_(to), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in here = loopback(0);
        socklen_t size = sizeof here;
        bind(listener_, reinterpret_cast<sockaddr*>(&here), size);
        listen(listener_, kWaitingMax);
        getsockname(listener_, reinterpret_cast<sockaddr*>(&here), &size);
        port_ = ntohs(here.sin_port);
        thread_ = std::thread([this] { run(); });
    }
    ~Relay() {
        ends_ = true;
        eventfd_write(signal_, 1);
        thread_.join();
        close(listener_);
        close(signal_);
    }
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;

    uint16_t port() const { return port_; }
    void cut() { set(true); }
    void restore() { set(false); }

private:
    static constexpr int kWaitingMax = 8;
    struct Pair {
        int from, to;
    };

    static sockaddr_in loopback(uint16_t port) {
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_port = htons(port);
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        return place;
    }

    void set(bool cut) {
        cut_ = cut;
        eventfd_write(signal_, 1);
    }

    void run() {
        while (!ends_) {
            std::vector<pollfd> waits = {{signal_, POLLIN, 0}, {listener_, POLLIN, 0}};
            for (const Pair& pair : pairs_) waits.push_back({pair.from, POLLIN, 0});
            poll(waits.data(), waits.size(), -1);
            eventfd_t count = 0;
            if (waits[0].revents != 0) eventfd_read(signal_, &count);
            if (cut_) close_all();
            for (size_t i = 2; i < waits.size(); ++i) {
                if (waits[i].revents != 0) pass_on(waits[i].fd);
            }
            if (waits[1].revents != 0) take_one();
        }
        close_all();
    }

    void take_one() {
        const int client = accept(listener_, nullptr, nullptr);
        const int server = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in there = loopback(to_);
        if (cut_ || connect(server, reinterpret_cast<sockaddr*>(&there), sizeof there) != 0) {
            close(client);
            close(server);
            return;
        }
        pairs_.push_back({client, server});
        pairs_.push_back({server, client});
    }

    void pass_on(int from) {
        const auto pair =
            std::ranges::find_if(pairs_, [from](const Pair& one) { return one.from == from; });
        if (pair == pairs_.end()) return;  // the other end of one that was closed
        char bytes[65536];
        const ssize_t size = recv(from, bytes, sizeof bytes, 0);
        if (size > 0 && send(pair->to, bytes, static_cast<size_t>(size), MSG_NOSIGNAL) == size) {
            return;
        }
        const Pair over = *pair;
        std::erase_if(pairs_, [over](const Pair& one) {
            return one.from == over.from || one.from == over.to;
        });
        close(over.from);
        close(over.to);
    }

    void close_all() {
        for (const Pair& pair : pairs_) close(pair.from);
        pairs_.clear();
    }

    const uint16_t to_;
    const int listener_;
    const int signal_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    uint16_t port_ = 0;
    std::atomic<bool> ends_ = false, cut_ = false;
    std::vector<Pair> pairs_;  // one for each direction
    std::thread thread_;
};

}  // namespace vagus::fleet_tests
