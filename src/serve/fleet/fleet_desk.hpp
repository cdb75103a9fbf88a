// The fleet that pages look at: its broker, the topics fleet and fleet_events, the commands
// fleet.open, fleet.close, fleet.order, fleet.stop, and those of a roll-out (rollout_desk.hpp).
// Beside the project and its target, not in their place. One thread, told the time.
//
//     FleetDesk fleet(desk, [&](LinkOptions options) { return link_to_broker(options); });
//     TRY(fleet.open({.target = "mqtts://broker/lab", .ca = "ca.crt"}, now));
//     fleet.tick(now);
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/broker/fleet_options.hpp"
#include "serve/fleet/fleet_view.hpp"
#include "serve/fleet/rollout_desk.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kFleetShownEvery = 200ms;  // tiles change 5 times a second at most
constexpr Duration kFleetAgesEvery = 500ms;   // states that have become too old are looked for
constexpr Duration kFleetAnswerWithin = 10s;  // then who did not answer is named
constexpr Duration kFleetAwayAfter = 1s;      // one who is not online is not waited for longer
constexpr size_t kFleetOrdersMax = 64;        // under way at a time

class FleetDesk {
public:
    using Connect = std::function<std::unique_ptr<fleet::Link>(LinkOptions options)>;
    // Declares its topics and commands.
    FleetDesk(Desk& desk, Connect connect, RolloutPlaces places = {});

    // In place of the one that is open. The Error says what is wrong with the options or the files
    // that they name; a broker that is not there is looked for until it is.
    Status open(const FleetOptions& options, Time now);
    void close();
    void tick(Time now);
    Time next_tick() const;

private:
    // An order of a page that waits for its answers.
    struct Waiting {
        Call call;
        fleet::OrderNumber number = 0;
        std::string verb;
        Time since{};
    };

    void declare_commands();
    void order(const Call& call);
    void stop(const Call& call);
    void declare_rollout_commands();
    RolloutDesk::Order rollout_order(const Call& call) const;
    std::vector<std::string> robots_in_order(const Json& in) const;
    bool is_ready(const Call& call) const;
    std::string name_of(const Call& call) const;
    void begin(const Call& call, fleet::Order order);
    bool is_settled(const Waiting& waiting) const;
    void settle(const Waiting& waiting);
    Json outcome_of(const fleet::Outcome& one) const;
    void log_order(const Waiting& waiting, const Json& outcomes);
    void perform_all();
    bool is_online(const std::string& robot) const;

    Desk& desk_;
    const Connect connect_;
    RolloutDesk rollouts_;
    std::unique_ptr<FleetView> view_;
    std::string target_, host_;  // of the fleet that is open
    std::unique_ptr<fleet::Link> link_;
    std::list<Waiting> waiting_;
    Time now_{}, next_shown_{}, next_ages_{};
    bool to_show_ = false;
};

}  // namespace vagus::serve
