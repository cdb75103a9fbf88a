// What changed in a world between two instants, as bytes: words of nodes, where things are, where
// sensors look.
// The runner writes them, the history keeps them as they are.
//
//     RecordWriter writer;
//     writer.begin(12.34);
//     writer.words(3, 40, words);
//     tell(talk::Records{{writer.take()}});
//     if (!each_record(bytes, {.item = [&](const RecordItem& item) { … }})) give_up();
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace vagus::serve {

// What has a pose: a robot by its index in the scene, an object by its number.
constexpr uint32_t kRobotKey = 0x8000'0000;
// How busy the bus is counts among the words of nodes: those of this number, which no node has, by
// node, in hundredths of a percent.
constexpr uint16_t kLoadNode = 0xffff;
constexpr uint16_t kLoadUnit = 100;
constexpr size_t kSightRobotsMax = 256;     // robots whose looks and lamps are written, and kept
constexpr size_t kRecordedNodesMax = 2048;  // nodes whose words are written, and kept

struct Standing {
    float x = 0, y = 0, angle = 0;
    friend bool operator==(const Standing&, const Standing&) = default;
};

class RecordWriter {
public:
    // What follows is of this instant, in seconds.
    void begin(double t);
    void words(uint16_t node, uint16_t address, std::span<const int16_t> values);
    // Nobody knows these words any more.
    void forget(uint16_t node, uint16_t address, uint16_t count);
    void pose(uint32_t key, float x, float y, float angle);
    // What is drawn of a robot beside its pose (sights.hpp): all its looks, or all its lamps.
    void looks(uint16_t robot, std::string_view bytes);
    void lamps(uint16_t robot, std::string_view bytes);
    // The instant has something to tell; one without is left out.
    bool has_items() const { return items_; }
    size_t size() const { return bytes_.size(); }
    std::string take();

private:
    void end();
    std::string bytes_;
    size_t began_ = 0;
    bool open_ = false;
    bool items_ = false;
};

struct RecordItem {
    enum class Kind : uint8_t {
        Words = 'W',
        Forgotten = 'F',
        Pose = 'P',
        Looks = 'L',
        Lamps = 'B'
    };
    double t = 0;
    Kind kind = Kind::Words;
    uint16_t node = 0, address = 0, count = 0;
    std::string_view values;  // Words: count times 16 bit, little endian
    uint16_t robot = 0;       // of Looks and Lamps: its index in the scene
    std::string_view bytes;   // the same, whole ones
    uint32_t key = 0;
    float x = 0, y = 0, angle = 0;

    int16_t value(size_t index) const;
};

// Calls `see` for each item, record by record, with the bytes of its record before the first of
// them. False: these are no whole records.
struct RecordSeen {
    std::function<void(double t, std::string_view record)> record = [](double, auto) {};
    std::function<void(const RecordItem&)> item = [](const RecordItem&) {};
};
bool each_record(std::string_view bytes, const RecordSeen& seen);

}  // namespace vagus::serve
