// The keeper of a fleet (keeper/keeper.hpp) on a link to the broker: what it is told and what it
// wants done, as topics and payloads. A state machine, as Member is.
//
//     Keeping keeping({.fleet = "lab", .keeper = {.instance = "a1b2"}});
//     for (const LinkEvent& event : link.take()) keeping.hear(event, now);
//     keeping.tick(now);
//     for (const KeepingAction& action : keeping.take()) perform(action);
//     if (keeping.is_out()) tell(keeping.why_out());  // another keeper is there
//
// The machine is told of a connection once all retained messages have been received: when a beat of
// its own, sent after the subscriptions, has returned.
#pragma once

#include <deque>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "fleet/link.hpp"
#include "fleet/member.hpp"
#include "keeper/keeper.hpp"

namespace vagus::fleet {

constexpr size_t kRecordsInFlight = 100;  // published, and not acknowledged; the others wait here
constexpr Duration kKeeperTickEvery = 100ms;

using KeepingAction = std::variant<Subscribe, Post, Say>;

struct KeepingOptions {
    std::string fleet = {};
    keeper::Options keeper = {};
};

class Keeping {
public:
    explicit Keeping(KeepingOptions options)
        : options_(std::move(options)), keeper_(options_.keeper) {}

    void hear(const LinkEvent& event, Time now);
    void tick(Time now);
    Time next_tick() const { return now_ + kKeeperTickEvery; }
    std::vector<KeepingAction> take() { return std::exchange(actions_, {}); }

    // Another keeper is there: this one does nothing any more.
    bool is_out() const { return keeper_.state() == keeper::Keeper::State::Out; }
    const std::string& why_out() const { return why_out_; }
    keeper::Keeper::State state() const { return keeper_.state(); }

private:
    void on(const Connected&);
    void on(const Lost& lost);
    void on(const Received& received);
    void on(const Acknowledged& acknowledged);
    void on(const Malformed& malformed);
    void on(const TakenBack&) {}  // the keeper's own records are published again

    void tell(const keeper::Input& input);
    void perform(const keeper::Actions& actions);
    void perform(const keeper::Beat& beat);
    void perform(const keeper::Publish& publish);
    void perform(const keeper::Answer& answer);
    void perform(const keeper::Leave& leave);
    void send_echo();
    void send_records();
    void tell_state();
    Post post(const Topic& topic, const Message& message) const;
    void say(const std::string& kind, const std::string& text) {
        actions_.emplace_back(Say{kind, text});
    }

    const KeepingOptions options_;
    keeper::Keeper keeper_;
    std::vector<KeepingAction> actions_;
    Time now_{};
    bool connected_ = false;
    uint64_t echoes_ = 0;               // sent so far
    uint64_t first_echo_ = 1;           // of this connection
    Time echo_at_{};                    // when the next one is sent
    bool knows_all_ = false;            // one has returned, after all retained messages
    std::vector<keeper::Input> early_;  // received before that
    std::deque<Post> waiting_;          // records
    std::set<uint64_t> in_flight_;
    keeper::Keeper::State told_state_ = keeper::Keeper::State::Away;
    std::string lost_told_, why_out_;
    bool refusal_told_ = false, malformed_told_ = false;
};

}  // namespace vagus::fleet
