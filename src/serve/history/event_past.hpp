// What happened on the bus during a run, and where nodes were paused: the newest that fit.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "serve/history/lane.hpp"
#include "serve/target/happened.hpp"

namespace vagus::serve {

constexpr size_t kPastEvents = 200'000;
constexpr size_t kPastEventBytes = 48u << 20;
constexpr double kPastEventSeconds = 3600;
constexpr size_t kEventLanesMax = 64;     // sources of events that a timeline shows
constexpr size_t kNodeStatesKept = 5000;  // of a node
constexpr size_t kNodesKept = 2048;

class EventPast {
public:
    // In the order of time; one that goes back is taken for the newest instant.
    void add(Happened event);
    // As if nothing had been told after that instant.
    void cut(double t);
    // The last ones until then: Happening of the protocol.
    nlohmann::json until(double t, size_t most) const;
    // One lane for each source of events: HistoryLane. What has no room is counted.
    std::vector<nlohmann::json> lanes(const LaneWindow& window, size_t& left_out) const;

    // HistoryNode of the protocol, of the nodes that had said something by then.
    nlohmann::json nodes_at(double t) const;

    bool empty() const { return events_.empty(); }
    double from() const { return events_.empty() ? 0 : events_.front().t; }
    double to() const { return to_; }
    size_t bytes() const { return bytes_; }
    size_t count() const { return events_.size(); }
    uint64_t dropped() const { return first_; }

private:
    struct NodeState {
        double t = 0;
        std::string state;
        uint32_t line = 0;
    };
    void note_state(const Happened& event);

    std::deque<Happened> events_;
    uint64_t first_ = 0;  // number of the oldest one kept
    size_t bytes_ = 0;
    double to_ = 0;
    std::map<uint16_t, std::deque<NodeState>> states_;
};

}  // namespace vagus::serve
