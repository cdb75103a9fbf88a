#include "record/bus_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/json.hpp"
#include "base/seconds.hpp"
#include "debug/user_event.hpp"
#include "mcap/records.hpp"

namespace vagus::record {

std::string format_frame(const RecordedFrame& recorded) {
    std::array<uint8_t, wire::kFrameMax> bytes;
    const uint16_t size = wire::encode(recorded.frame, bytes.data());
    std::string data;
    mcap::Put put(data);
    put.u32(recorded.number).u32(recorded.cause).u16(recorded.frame.source);
    put.bytes({reinterpret_cast<const char*>(bytes.data()), size});
    return data;
}

std::optional<RecordedFrame> read_frame(std::string_view data) {
    mcap::Take take(data);
    RecordedFrame recorded{.number = take.u32(), .cause = take.u32()};
    (void)take.u16();  // the sender, which is in the frame
    const std::string_view bytes = take.rest();
    if (take.bad() || bytes.empty() || bytes.size() > wire::kFrameMax) return std::nullopt;
    wire::FrameReader reader;
    const auto size = static_cast<uint16_t>(bytes.size());
    const auto* const begin = reinterpret_cast<const uint8_t*>(bytes.data());
    if (reader.feed(begin, size) != size || !reader.complete()) return std::nullopt;
    recorded.frame = reader.frame();
    return recorded;
}

RecordedEvent recorded_event(Time at, uint32_t number, uint16_t node, debug::UserEvent event) {
    return {.at = at,
            .frame = number,
            .node = node,
            .name = debug::name_or_number(event),
            .arguments = std::move(event.arguments)};
}

std::string format_event(const RecordedEvent& event) {
    const std::string by = event.by.empty() ? "" : ",\"by\":" + json_quote(event.by);
    return fmt::format(R"({{"t":{},"frame":{},"node":{},"name":{},"args":{}{}}})",
                       seconds_text(event.at), event.frame, event.node, json_quote(event.name),
                       words_json(event.arguments), by);
}

std::string words_json(std::span<const int16_t> words) {
    std::string text = "[";
    for (const int16_t word : words) {
        if (text.size() > 1) text += ',';
        text += std::to_string(word);
    }
    return text + "]";
}

namespace {

bool is_in(const RecordedVariable& variable, std::span<const int16_t> words) {
    return variable.size > 0 && size_t{variable.address} + variable.size <= words.size();
}

}  // namespace

bool has_changed(const RecordedVariable& variable, std::span<const int16_t> before,
                 std::span<const int16_t> now) {
    if (!is_in(variable, before) || !is_in(variable, now)) return false;
    return !std::ranges::equal(before.subspan(variable.address, variable.size),
                               now.subspan(variable.address, variable.size));
}

std::string format_variables(std::span<const RecordedVariable* const> variables,
                             std::span<const int16_t> now, bool all, Time at) {
    std::string set;
    for (const RecordedVariable* const one : variables) {
        if (!is_in(*one, now)) continue;
        const std::span<const int16_t> words = now.subspan(one->address, one->size);
        if (!set.empty()) set += ',';
        set += json_quote(one->name);
        set += ':';
        set += one->size == 1 ? std::to_string(words.front()) : words_json(words);
    }
    return fmt::format(R"({{"t":{},"all":{},"set":{{{}}}}})", seconds_text(at), all, set);
}

}  // namespace vagus::record
