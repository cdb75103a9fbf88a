// The links of hubs that lead out of the process: TCP, serial lines, CAN. One event loop in the
// thread that calls poll(); what happened comes back as values, nothing is called back.
//
//     hub::Hub hub;
//     net::Links links;                                        // after the hub: it goes first
//     const hub::LinkId own = hub.add({.name = "node"}).value();   // a place in this process
//     const auto listening = links.listen(hub, net::parse_target("tcp:127.0.0.1:0").value());
//     for (;;) {
//         for (const net::Event& event : links.poll(next_deadline)) show(event);
//         wire::Frame frame;
//         while (hub.take(own, frame)) answer(frame);               // hub.receive(own, reply)
//     }
//
// Every connection is a link of the hub it was made for. poll() writes what the hub has for it,
// reads what came and hands it to the hub; a switch is a hub and this loop, a node or a host adds a
// link of its own. Nothing here blocks except poll() itself, until its deadline. A peer may be
// slow, send garbage or leave at any time; nobody else notices:
//
// - What a slow peer does not take in time waits in its bounded queue in the hub, then is dropped
//   and counted there.
// - Only a peer that sends much at once is slowed down, and only by receivers that keep up
//   (docs/decisions/0052-who-waits-for-whom.md), so that two fast programs lose nothing.
// - A serial line on which bytes were lost finds the next frame again (wire/line_reader.hpp).
// - A peer that announces kOversizedFramesMax frames of illegal size over TCP does not speak this
//   protocol: it is closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "hub/hub.hpp"
#include "net/target.hpp"

namespace vagus::net {

using namespace std::chrono_literals;

constexpr uint32_t kOversizedFramesMax = 8;
// A lost target is tried again after the first of these times, then twice as long, up to the
// second.
constexpr Duration kRetryFirst = 100ms;
constexpr Duration kRetryLast = 2s;
// An attempt to connect that lasts longer has failed.
constexpr Duration kConnectWithin = 5s;

// What one call of listen() or connect() stands for.
struct PlaceId {
    uint32_t number = 0;
    auto operator<=>(const PlaceId&) const = default;
};

enum class EventKind {
    Opened,    // `link` is there
    Closed,    // `link` is gone from the hub, `what` says why
    Failed,    // a connection could not be made or accepted; said once an outage
    Readable,  // a descriptor given to watch_input()
    Signal,    // SIGINT, SIGTERM or SIGHUP, after watch_signals()
    Skipped,   // bytes of a serial line were no frame; said once they are over, once a second
};

struct Event {
    EventKind kind;
    PlaceId place;              // Opened, Closed, Failed, Skipped
    hub::LinkId link;           // Opened, Closed, Skipped
    int number = 0;             // Readable: the descriptor. Signal: its number
    std::string what;           // a name (Opened) or a sentence for a person that names the peer
    hub::LinkStats stats = {};  // Closed: what the link did
    bool expelled = false;      // Closed: by us, since the peer does not speak the protocol
};

// How many clients a listener keeps. With One a new client replaces the one that is there, as at
// the nodes of the reference (section 1.4).
enum class Clients { Many, One };
struct ListenOptions {
    Clients clients = Clients::Many;
    bool echo = false;  // hub::LinkOptions::echo of each link
};

enum class Retry { Never, Forever };
struct ConnectOptions {
    Retry retry = Retry::Never;
    bool echo = false;
};

struct Listening {
    PlaceId place;
    Target target;  // with the real port; "listening " + to_string(target) is what to print
};

class Links {
public:
    Links();
    ~Links();  // closes everything and takes its links out of their hubs
    Links(const Links&) = delete;
    Links& operator=(const Links&) = delete;

    // Only TCP. The hub must live longer than these; so in connect().
    Result<Listening> listen(hub::Hub& hub, const Target& target, ListenOptions options = {});
    // Begins to connect; Opened or Failed comes from poll(). Errors are those of a target that can
    // never work.
    Result<PlaceId> connect(hub::Hub& hub, const Target& target, ConnectOptions options = {});

    // Takes over one end of a pair of sockets: a peer that this process started itself. Opened
    // comes from poll(), with the place that is given.
    Result<PlaceId> join(hub::Hub& hub, int descriptor, const std::string& name);

    // Closes one link; there is no event for it.
    void close(hub::Hub& hub, hub::LinkId link);
    // Tells the peer that nothing more comes, when has_unwritten() is false. It then reads all that
    // was written and closes: Closed. A close() that does not wait for that may take the last
    // frames with it. False: the peer cannot be told (serial, CAN), or the link is gone.
    bool end_writing(hub::Hub& hub, hub::LinkId link);
    // Stops listening or connecting, and closes the links that came of it.
    void close(PlaceId place);

    // From now on poll() tells of SIGINT, SIGTERM and SIGHUP (the terminal is gone), which then do
    // not end the process. Under nohup SIGHUP stays without effect.
    Status watch_signals();
    // From now on poll() tells when there is something to read (or the end), once for each poll().
    // For standard input; a regular file cannot be watched.
    Status watch_input(int descriptor);
    void unwatch_input(int descriptor);

    // Moves bytes until something came in, something happened, or the deadline has passed. A
    // deadline in the past: what is ready now.
    std::vector<Event> poll(Time deadline);

    // Writes at once what hubs have for their links, as far as peers take it; the next poll() tells
    // what came of that. For what must not wait for the rest of a turn.
    void flush();

    // From any other thread: the poll() that waits, or the next one, returns at once.
    void wake();

    // Since this was made; steady.
    Time now() const;

    // True while something for one of these connections waits to be written: poll() on before
    // closing, if it must arrive.
    bool has_unwritten() const;

private:
    class Loop;  // Asio stays in links.cpp
    std::unique_ptr<Loop> loop_;
};

}  // namespace vagus::net
