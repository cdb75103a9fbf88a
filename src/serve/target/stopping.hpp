// Stop as people press it in the studio. session/stopping.hpp brings the nodes to rest; this tells
// the caller, once, and asks on afterwards until each node has stopped, is forgotten or
// acknowledged (design: safe stop, S6 and S9).
//
//     Stopping stopping;
//     stopping.begin(network, safe_stop, nodes, link, now, [](const StopReport& report) { … });
//     stopping.hear(event); stopping.tick(now);          // the caller's loop
//     stopping.forget(node);                             // somebody lets it run
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "debug/network.hpp"
#include "serve/target/stop_report.hpp"
#include "session/safe_stop.hpp"
#include "session/stopping.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kStopWithin = 1s;      // then the report goes out as it is
constexpr Duration kMovesLongEvery = 1s;  // a node that moves is read, once the report is out

// "asked", "stopped", "moving", "silent", "gone".
const char* word_of(StopNode::State state);

// What Stop answers to who pressed it.
nlohmann::json answer_of(const StopReport& report);
// Of such an answer the names of nodes that were not read back as stopped, also of those that are
// away: they may move.
std::vector<std::string> not_stopped(const nlohmann::json& answer);

class Stopping {
public:
    using Done = std::function<void(const StopReport&)>;

    Stopping() = default;
    Stopping(const Stopping&) = delete;  // its safe stop is borrowed within
    Stopping& operator=(const Stopping&) = delete;

    // Nodes beyond those that the network has met are told to stop, too; of them nothing is heard.
    // `done` gets the report once, at the latest after kStopWithin. `link`: somebody is there to
    // be talked to; otherwise nobody is gone, but silent.
    void begin(debug::Network& network, const session::SafeStop& safe,
               const std::vector<uint16_t>& heard, bool link, Time now, Done done);
    // Nothing is asked any more, and who waits gets what is known.
    void end();

    // Every event of the network. Gives the node that has just answered that its program stopped.
    std::optional<uint16_t> hear(const debug::Event& event) { return nodes_.hear(event); }
    void tick(Time now);
    Time next_tick() const;

    // It is to run, or gets a program: what it does then is not what Stop asked for.
    void forget(uint16_t node) { nodes_.forget(node); }
    // A person knows of those that are silent, gone or moving: they are asked no more.
    void acknowledge() { nodes_.acknowledge(); }

    // Of a node that was told to stop, and not to run since.
    std::optional<StopNode::State> state_of(uint16_t node) const { return nodes_.state_of(node); }
    // Empty while somebody waits for it.
    StopReport report() const;

private:
    struct Waiting {
        Done done;
        Time until{};
    };

    void answer();

    session::SafeStop safe_;
    session::Stopping nodes_;
    std::vector<Waiting> waiting_;
    Time now_{};
};

}  // namespace vagus::serve
