// Other plans on the bus of a plan. Nodes know an activation by its token only; so a plan whose
// tokens are near those of another would end its actors. Of a plan that commands the same nodes a
// person is told, and this one takes its tokens from elsewhere.
//
//     RivalPlans rivals(toolbox::starts_on(nodes, library), SplitMix64(seed));
//     options.first_token = rivals.random_token();
//     rivals.said(event);                                        // each event of this plan
//     if (const auto rival = rivals.hear(event)) …               // each event of a host
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/rng.hpp"
#include "run/code.hpp"

namespace vagus::session {

// Tokens of another plan that are so near to ours could soon be the same.
constexpr uint16_t kNearTokens = 0x1000;
// Of our last start events: on a bus that gives everything back they come again.
constexpr size_t kOwnStartsKept = 1024;

class RivalPlans {
public:
    // `starts` are the events by which work begins on the nodes that this plan commands.
    RivalPlans(std::set<std::string> starts, SplitMix64 random)
        : starts_(std::move(starts)), random_(random) {}

    uint16_t random_token();

    void said(const run::BusEvent& event);

    struct Rival {
        bool is_news = false;               // the first of this run: to be told
        std::optional<uint16_t> move_to{};  // the token from which ours count on
    };
    // Nothing if the event is not of another plan that commands the same nodes.
    std::optional<Rival> hear(const run::BusEvent& event);

private:
    bool is_start(const run::BusEvent& event) const;

    std::set<std::string> starts_;
    SplitMix64 random_;
    std::deque<run::BusEvent> own_;  // of the last start events those that have not come back
    uint16_t last_token_ = 0;        // of ours
    bool told_ = false;
};

}  // namespace vagus::session
