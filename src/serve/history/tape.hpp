// What words of nodes were, where things were and sensors looked, at any instant: changes in blocks
// of some seconds, each of which begins with the whole. The newest are kept as they came; older
// ones are thinned out, the oldest dropped: by age, and by bytes.
//
//     Tape tape;
//     tape.record(bytes);                        // of the runner, or of RecordWriter
//     const TapeState then = tape.at(86.8);
//     if (const auto word = then.word(3, 40)) show(*word);
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "serve/follow/record.hpp"

namespace vagus::serve {

constexpr double kTapeBlockSeconds = 10;
constexpr size_t kTapeBlockBytes = 512u << 10;
constexpr double kTapeFineSeconds = 600;   // kept as it came
constexpr double kTapeCoarseStep = 0.2;    // what is older: one instant in so many seconds
constexpr double kTapeSeconds = 3600;      // what is older still is dropped
constexpr size_t kTapeBytes = 64u << 20;   // all together
constexpr size_t kTapeThingsMax = 10'000;  // robots and objects
constexpr float kWayStep = 0.01F;          // metres between two places of a way
constexpr size_t kWayPointsMax = 4000;     // of one robot: the newest
constexpr size_t kWaysPointsMax = 40'000;  // of all together

// All that is known of one instant.
class TapeState {
public:
    struct Words {
        std::vector<int16_t> values;
        std::vector<bool> known;
    };
    void apply(const RecordItem& item);
    std::optional<int16_t> word(uint16_t node, uint16_t address) const;
    const std::map<uint16_t, Words>& nodes() const { return nodes_; }
    const std::map<uint32_t, Standing>& things() const { return things_; }
    // The payload of the topic rays.
    std::string rays() const;
    size_t bytes() const;
    // Writes what leads from that state to this one.
    void write_since(const TapeState& before, RecordWriter& writer) const;

private:
    void apply_sight(const RecordItem& item);
    void apply_words(const RecordItem& item);
    void write_words(uint16_t node, const Words& words, const TapeState& before,
                     RecordWriter& writer) const;

    // As bytes of the topic rays.
    struct Sights {
        std::string looks, lamps;
    };
    std::map<uint16_t, Words> nodes_;
    std::map<uint32_t, Standing> things_;
    std::map<uint16_t, Sights> sights_;  // by the index of a robot
};

class Tape {
public:
    // One word in columns of equal time: its lowest and highest value in each; empty where it is
    // not known.
    struct Column {
        std::optional<int16_t> low, high;
    };
    struct Window {
        double from = 0, to = 0;
        size_t columns = 0;
    };

    // Records in the order of time; one that goes back is taken for the newest instant. False:
    // these are no whole records, and nothing of them is kept.
    bool record(std::string_view bytes);
    // As if nothing had been recorded after that instant.
    void cut(double t);
    TapeState at(double t) const;
    // Where robots went in that time, by their index in the scene: a place for each kWayStep.
    struct WayPoint {
        double t = 0;
        float x = 0, y = 0;
        friend bool operator==(const WayPoint&, const WayPoint&) = default;
    };
    std::map<uint32_t, std::deque<WayPoint>> ways(double from, double to) const;
    std::vector<Column> columns(uint16_t node, uint16_t address, const Window& window) const;

    bool empty() const { return blocks_.empty(); }
    double from() const { return blocks_.empty() ? 0 : blocks_.front().from; }
    double to() const { return to_; }
    // From here on it is kept as it came; before that, an instant each kTapeCoarseStep.
    double fine_from() const;
    size_t bytes() const { return bytes_; }

private:
    struct Block {
        double from = 0, to = 0;
        TapeState begins;
        std::string bytes;
        bool coarse = false;
        size_t size() const { return bytes.size() + begins.bytes(); }
    };
    void keep(double t, std::string_view record);
    void begin_block(double t);
    void bound();
    void thin(Block& block);
    Block* oldest_fine();
    const Block* block_at(double t) const;

    std::deque<Block> blocks_;
    TapeState now_;
    double to_ = 0;
    size_t bytes_ = 0;
};

}  // namespace vagus::serve
