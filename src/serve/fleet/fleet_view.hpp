// What pages see of a fleet: an operator (fleet/operator.hpp) and what it heard, as the documents
// of the protocol. Pure: told what came, the time, and the wall clock.
//
//     FleetView view({.target = "mqtt://broker/lab", .fleet = "lab", .name = "operator-1"});
//     for (const fleet::LinkEvent& event : link.take()) view.hear(event, now, wall_ms);
//     if (view.take_news() || view.age(now)) touch("fleet");
//     show(view.document());
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "fleet/counters.hpp"
#include "fleet/operator.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

class FleetView {
public:
    struct Options {
        std::string target = {}, fleet = {};
        std::string name = {};  // of the operator
        std::string user = {};  // at the broker; empty: none was given
    };
    explicit FleetView(Options options);

    const std::string& fleet() const { return options_.fleet; }
    fleet::Operator& desk() { return desk_; }
    const fleet::Operator& desk() const { return desk_; }
    void hear(const fleet::LinkEvent& event, Time now, double wall_ms);
    // What it is by now: a state that is too old says nothing any more. True: something became so.
    bool age(Time now);
    // What was heard changes the document.
    bool take_news() { return std::exchange(news_, false); }
    // Items of the topic fleet_events, without their numbers, since it was asked last.
    std::vector<Json> take_events() { return std::exchange(events_, {}); }

    bool is_connected() const { return connected_ && desk_.knows_all(); }
    // The last trouble with the broker; empty: none.
    std::string why() const;
    // The topic fleet.
    Json document() const;

private:
    enum class Age { Fresh, Waiting, Stale };
    // When a robot told its state, by our own clocks.
    struct Told {
        Time at{};
        double at_wall = 0;
        int64_t epoch = 0, since = -1;
        double since_wall = 0;
    };

    void hear_robot(const fleet::Received& received, double wall_ms);
    void hear_connection(const std::string& robot, const fleet::Connection& connection,
                         bool retained, double wall_ms);
    void hear_state(const std::string& robot, const fleet::State& state, double wall_ms);
    Age age_of(const std::string& robot, const fleet::Known& known) const;
    Json robot_document(const std::string& name, const fleet::Known& known) const;
    std::string state_word() const;

    const Options options_;
    fleet::Operator desk_;
    Time now_{};
    bool connected_ = false, was_connected_ = false;
    Time connected_at_{};
    std::string why_;
    std::map<std::string, Told> told_;
    std::map<std::string, Age> ages_;  // as the document had them
    fleet::Numbers heard_;
    bool news_ = true;
    std::vector<Json> events_;
};

}  // namespace vagus::serve
