#include "cli/fleet/keep.hpp"

#include <chrono>

#include "base/text.hpp"
#include "cli/output.hpp"
#include "fleet/keeping.hpp"
#include "net/end_signal.hpp"
#include "net/wall_clock.hpp"
#include "serve/broker/bell.hpp"
#include "serve/process.hpp"

namespace vagus::cli {
namespace {

using namespace std::chrono_literals;

constexpr Duration kListenAgainAfter = 5s;  // for a keeper that was there
constexpr size_t kInstanceBytes = 8;

// For a broker that has lost what it kept: later than every keeper before.
uint64_t epoch_of_today() {
    return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::seconds>(
                                     std::chrono::system_clock::now().time_since_epoch())
                                     .count());
}

std::string random_instance() {
    return "keeper-" + hex_of(serve::random_bytes(kInstanceBytes));
}

// One keeper, from its connection on.
class Post {
public:
    explicit Post(serve::LinkOptions options)
        : keeping_({options.target.fleet,
                    {.instance = options.client, .first_epoch = epoch_of_today()}}),
          link_(std::move(options), [this] { bell_.ring(); }) {}

    // Until it is out, or an end is asked for. What it says the first time is said.
    void keep(std::string& told_why) {
        while (!net::end_asked()) {
            for (const fleet::LinkEvent& event : link_.take())
                keeping_.hear(event, net::wall_now());
            keeping_.tick(net::wall_now());
            for (const fleet::KeepingAction& action : keeping_.take()) {
                std::visit([&](const auto& one) { perform(one, told_why); }, action);
            }
            if (keeping_.is_out()) return;
            bell_.wait(fleet::kKeeperTickEvery);
        }
    }

private:
    void perform(const fleet::Subscribe& one, std::string&) { link_.subscribe(one.filters); }
    void perform(const fleet::Post& post, std::string&) { link_.publish(post); }
    // A second keeper that listens again and again says so once.
    void perform(const fleet::Say& said, std::string& told_why) {
        const bool serves = keeping_.state() == keeper::Keeper::State::Serving;
        if (!told_why.empty() && !keeping_.is_out() && !serves) return;
        if (keeping_.is_out() && std::exchange(told_why, keeping_.why_out()) != "") return;
        if (serves) told_why.clear();
        say(said.text + "\n");
    }

    serve::Bell bell_;
    fleet::Keeping keeping_;
    serve::MosquittoLink link_;  // ends before what its thread rings
};

}  // namespace

int keep(const serve::FleetOptions& broker) {
    const OutputNeverWaits never;
    net::watch_for_end();
    std::string told_why;
    while (!net::end_asked()) {
        auto options = serve::link_of_fleet(broker, random_instance());
        if (!options.ok()) return complain(options.error(), kExitUsage);
        Post(std::move(options.value())).keep(told_why);
        serve::Bell nobody_rings;
        for (const Duration until = net::wall_now() + kListenAgainAfter;
             net::wall_now() < until && !net::end_asked();) {
            nobody_rings.wait(fleet::kKeeperTickEvery);
        }
    }
    return kExitDone;
}

}  // namespace vagus::cli
