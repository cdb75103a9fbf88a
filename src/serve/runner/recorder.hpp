// Writes down what changes in a simulated world, for the history of the run: words of all nodes,
// where things are, where sensors look, how busy the bus is. Changes only, at instants of
// simulated time; what the
// server has no time for is left out, and the next record tells the whole again.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "serve/follow/record.hpp"
#include "sim/world.hpp"

namespace vagus::serve {

constexpr Duration kRecordEvery = std::chrono::milliseconds(20);
constexpr Duration kLoadEvery = std::chrono::milliseconds(200);  // it costs more to know
constexpr size_t kRecordedNodes = 32;  // at that pace; with more of them, less often
constexpr size_t kSightRobots = 4;     // the same of robots, of which looks and lamps are written
constexpr size_t kRecordsAtOnce = 64u << 10;
constexpr size_t kRecordsMax = 1u << 20;  // bytes that wait for the server behind a whole world

class Recorder {
public:
    // Another world.
    void begin();
    // Looks, if it is time to.
    void look(const sim::World& world);
    bool is_due_to_send() const { return writer_.size() >= kRecordsAtOnce; }
    // What was written since; may be empty.
    std::string take() { return writer_.take(); }
    // The whole of a large world is more than what waits otherwise, and counts for nothing here: it
    // would be dropped before it was ever sent, and written again at once.
    bool overflows() const { return writer_.size() >= whole_ + kRecordsMax; }
    // The server did not take it: nothing of it counts.
    void forget();

private:
    void look_at_nodes(const sim::World& world);
    void look_at_things(const sim::World& world);
    void look_at_loads(const sim::World& world);
    void look_at_sights(const sim::World& world);
    void see(uint16_t node, std::span<const int16_t> words);
    void see(uint32_t key, const Standing& standing);

    RecordWriter writer_;
    size_t whole_ = 0;  // bytes of the last record that told the whole
    std::map<uint16_t, std::vector<int16_t>> words_;
    std::map<uint32_t, Standing> things_;
    std::map<uint16_t, std::pair<std::string, std::string>> sights_;  // looks and lamps
    Time next_{}, next_load_{}, next_sight_{};
};

}  // namespace vagus::serve
