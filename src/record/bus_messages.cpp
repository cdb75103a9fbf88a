#include "record/bus_messages.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <utility>

#include "base/json.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "debug/user_event.hpp"
#include "mcap/records.hpp"

namespace vagus::record {

std::string_view format_frame(std::string& room, const PassedFrame& passed) {
    room.clear();
    std::array<uint8_t, wire::kFrameMax> bytes;
    const uint16_t size = wire::encode(passed.frame, bytes.data());
    mcap::Put put(room);
    put.u32(passed.number).u32(passed.cause).u16(passed.frame.source);
    put.bytes({reinterpret_cast<const char*>(bytes.data()), size});
    return room;
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

namespace {

// "[1,-2]". Sensors with a hundred words say them fifty times a second: no call for each.
void append_words(std::string& to, std::span<const int16_t> words) {
    constexpr size_t kLongest = 7;  // "-32768,"
    const size_t before = to.size();
    to.resize(before + kLongest * words.size() + 2);
    char* at = to.data() + before;
    char* const end = to.data() + to.size();
    *at++ = '[';
    for (const int16_t word : words) {
        at = std::to_chars(at, end, word).ptr;
        *at++ = ',';
    }
    if (!words.empty()) --at;
    *at++ = ']';
    to.resize(static_cast<size_t>(at - to.data()));
}

}  // namespace

std::string_view format_event(std::string& room, const RecordedEvent& event) {
    room = R"({"t":)";
    append_seconds(room, event.at);
    room += R"(,"frame":)";
    append_number(room, event.frame);
    room += R"(,"node":)";
    append_number(room, event.node);
    room += R"(,"name":)";
    append_json_quote(room, event.name);
    room += R"(,"args":)";
    append_words(room, event.arguments);
    if (!event.by.empty()) {
        room += R"(,"by":)";
        append_json_quote(room, event.by);
    }
    room += '}';
    return room;
}

namespace {

// A whole number from 0 to `most`.
std::optional<uint32_t> count_in(const JsonValue& from, std::string_view key, int64_t most) {
    const JsonValue* const value = from.find(key);
    if (value == nullptr || value->kind != JsonKind::Int) return std::nullopt;
    if (value->integer < 0 || value->integer > most) return std::nullopt;
    return static_cast<uint32_t>(value->integer);
}

bool append_word(std::vector<int16_t>& words, const JsonValue& value) {
    if (value.kind != JsonKind::Int || words.size() >= wire::kPayloadMax / 2) return false;
    if (value.integer < INT16_MIN || value.integer > INT16_MAX) return false;
    words.push_back(static_cast<int16_t>(value.integer));
    return true;
}

}  // namespace

std::optional<RecordedEvent> read_event(Time at, std::string_view data) {
    const auto json = read_json(data);
    const auto* const tree = std::get_if<JsonValue>(&json);
    if (tree == nullptr) return std::nullopt;
    const auto frame = count_in(*tree, "frame", UINT32_MAX);
    const auto node = count_in(*tree, "node", UINT16_MAX);
    if (!frame || !node) return std::nullopt;
    RecordedEvent event{.at = at,
                        .frame = *frame,
                        .node = static_cast<uint16_t>(*node),
                        .name = text_in(*tree, "name"),
                        .by = text_in(*tree, "by")};
    const JsonValue* const words = tree->find("args");
    if (words == nullptr) return event;
    for (const JsonValue& word : words->items) {
        if (!append_word(event.arguments, word)) return std::nullopt;
    }
    return event;
}

std::optional<ToldNode> read_node(std::string_view data) {
    const auto json = read_json(data);
    const auto* const tree = std::get_if<JsonValue>(&json);
    const auto node = tree == nullptr ? std::nullopt : count_in(*tree, "node", UINT16_MAX);
    if (!node) return std::nullopt;
    return ToldNode{.node = static_cast<uint16_t>(*node),
                    .name = text_in(*tree, "name"),
                    .file = text_in(*tree, "file"),
                    .left = text_in(*tree, "state") == "left"};
}

RecordedVariable::RecordedVariable(std::string_view name, uint16_t address_of, uint16_t size_of)
    : key(json_quote(name) + ':'), address(address_of), size(size_of) {}

namespace {

bool is_in(const RecordedVariable& variable, std::span<const int16_t> words) {
    return variable.size > 0 && size_t{variable.address} + variable.size <= words.size();
}

}  // namespace

// Four words at a time: nodes have hundreds, of which few change.
WordRange changed_words(std::span<const int16_t> before, std::span<const int16_t> now) {
    constexpr size_t kMany = 4;
    const auto same = [&](size_t at, size_t words) {
        return std::memcmp(&before[at], &now[at], words * sizeof before[at]) == 0;
    };
    size_t begin = 0;
    size_t end = before.size();
    while (end - begin >= kMany && same(begin, kMany)) begin += kMany;
    while (begin < end && same(begin, 1)) ++begin;
    while (end - begin >= kMany && same(end - kMany, kMany)) end -= kMany;
    while (begin < end && same(end - 1, 1)) --end;
    return {begin, end};
}

bool has_changed(const RecordedVariable& variable, std::span<const int16_t> before,
                 std::span<const int16_t> now) {
    if (!is_in(variable, before) || !is_in(variable, now)) return false;
    return !std::ranges::equal(before.subspan(variable.address, variable.size),
                               now.subspan(variable.address, variable.size));
}

std::string_view format_variables(std::string& room, const ToldVariables& told) {
    room = R"({"t":)";
    append_seconds(room, told.at);
    room += told.all ? R"(,"all":true,"set":{)" : R"(,"all":false,"set":{)";
    bool first = true;
    for (const RecordedVariable* const one : told.variables) {
        if (!is_in(*one, told.now)) continue;
        if (!std::exchange(first, false)) room += ',';
        room += one->key;
        const std::span<const int16_t> words = told.now.subspan(one->address, one->size);
        if (one->size == 1) {
            append_number(room, words.front());
        } else {
            append_words(room, words);
        }
    }
    room += "}}";
    return room;
}

}  // namespace vagus::record
