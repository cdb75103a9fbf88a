// How a frame, an event and the variables of a node are written in a recording, and read again.
//
//     tape.put(frames, at, format_frame(text, {.number = 7, .frame = frame}));
//     const auto recorded = read_frame(message.data);             // nothing: it is none
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "debug/event.hpp"
#include "wire/frame.hpp"

namespace vagus::record {

// What is formatted takes the place of what is in `room`, and is that text: a run makes a thousand
// a second, and they all share one.

struct RecordedFrame {
    uint32_t number = 0;
    uint32_t cause = 0;  // the frame that it followed from; 0: none, or nobody knows
    wire::Frame frame = {};
};

struct PassedFrame {
    uint32_t number = 0;
    uint32_t cause = 0;
    const wire::Frame& frame;
};
std::string_view format_frame(std::string& room, const PassedFrame& passed);
std::optional<RecordedFrame> read_frame(std::string_view data);

struct RecordedEvent {
    Time at{};
    uint32_t frame = 0;  // its number
    uint16_t node = 0;
    std::string name = {};  // its number, if no definition is its
    std::vector<int16_t> arguments = {};
    std::string by = {};  // of a plan on a real bus: the element whose code emitted it
};
// Decoded once, for all that write and read recordings. `number` is that of its frame.
RecordedEvent recorded_event(Time at, uint32_t number, uint16_t node, debug::UserEvent event);
std::string_view format_event(std::string& room, const RecordedEvent& event);
// Nothing: it is none.
std::optional<RecordedEvent> read_event(Time at, std::string_view data);

// A node of a real bus has described itself, has left, or is there again.
struct ToldNode {
    uint16_t node = 0;
    std::string name = {};
    std::string file = {};  // the attachment with its description; empty: it came or went
    bool left = false;
};
std::optional<ToldNode> read_node(std::string_view data);

struct RecordedVariable {
    RecordedVariable(std::string_view name, uint16_t address, uint16_t size);
    std::string key;  // its name as one of JSON, and the colon behind it
    uint16_t address = 0;
    uint16_t size = 0;
};
using RecordedVariables = std::vector<RecordedVariable>;
// Words of a node, from one to another.
struct WordRange {
    size_t begin = 0, end = 0;
    bool touches(const RecordedVariable& one) const {
        return one.address < end && size_t{one.address} + one.size > begin;
    }
};
// From the first that is another than before to the last; there are as many as before.
WordRange changed_words(std::span<const int16_t> before, std::span<const int16_t> now);
// Whether it is in both, and not the same.
bool has_changed(const RecordedVariable& variable, std::span<const int16_t> before,
                 std::span<const int16_t> now);
// Those that are in `now`. `all`: they are all that the node has.
struct ToldVariables {
    std::span<const RecordedVariable* const> variables;
    std::span<const int16_t> now;
    bool all = false;
    Time at{};
};
std::string_view format_variables(std::string& room, const ToldVariables& told);

}  // namespace vagus::record
