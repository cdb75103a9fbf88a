// A fleet::Link over libmosquitto: MQTT 5, TLS, a will, reconnecting for ever. The library lives on
// a thread of its own, which alone calls it: looking up a host, connecting and encrypting hold up
// nobody else. What comes is parsed and checked there, too.
//
//     MosquittoLink link(options, [&links] { links.wake(); });
//     for (const fleet::LinkEvent& event : link.take()) member.hear(event, now);
//
// The one place of Vagus that knows libmosquitto.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "fleet/link.hpp"
#include "fleet/target.hpp"

namespace vagus::serve {

constexpr size_t kLinkInboxMax = 10'000;  // events that the owner has not taken; then one is lost
constexpr size_t kLinkOutboxMax = 1000;   // posts that the library has not taken; the same
constexpr int kLinkAgainMs = 1000;        // after a connection that failed or was lost
constexpr int kLinkConnectMs = 10'000;    // for an answer of the broker
constexpr int kLinkTurnMs = 500;          // keep-alive is looked at
constexpr int kLinkGoodByeMs = 1000;      // for the last words; then nobody waits
constexpr int kLinkLastReadMs = 500;      // of these, for each that the broker still says

struct LinkOptions {
    fleet::FleetTarget target;
    std::string client;  // id; a broker throws out the one that was there
    fleet::Login login = {};
    std::string ca = {};           // PEM file of who signed the broker's certificate
    std::string certificate = {};  // PEM files, instead of a login
    std::string key = {};
    fleet::Post will = {};  // no topic: none
};

class MosquittoLink : public fleet::Link {
public:
    // `wake` is called from the other thread when there is something to take.
    MosquittoLink(LinkOptions options, std::function<void()> wake);
    // What was published goes out, and good-bye: the will is not published then.
    ~MosquittoLink() override;
    MosquittoLink(const MosquittoLink&) = delete;
    MosquittoLink& operator=(const MosquittoLink&) = delete;

    void subscribe(const std::vector<fleet::Filter>& filters) override;
    void publish(const fleet::Post& post) override;
    std::vector<fleet::LinkEvent> take() override;

    // What did not fit into the queues.
    uint64_t dropped() const;

private:
    class Session;
    class Inside;
    // Owners: this, and the thread, which may still look up a host when this has gone.
    std::shared_ptr<Inside> inside_;
    std::thread thread_;
};

}  // namespace vagus::serve
