#include "serve/talk/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstring>

#include "base/text.hpp"
#include "serve/json.hpp"
#include "serve/talk/frames.hpp"

namespace vagus::serve::talk {

namespace {

constexpr size_t kShownMax = 40;  // bytes of a text in a sentence

std::string_view name_of(Kind kind) {
    switch (kind) {
        case Kind::Nothing:
            return "nothing";
        case Kind::Bool:
            return "yes or no";
        case Kind::Count:
            return "a whole number from 0";
        case Kind::Whole:
            return "a whole number";
        case Kind::Number:
            return "a number";
        case Kind::Text:
            return "a text";
        case Kind::Bytes:
            return "bytes";
        case Kind::List:
            return "a list";
        case Kind::Table:
            return "a table";
        case Kind::Parts:
            return "parts";
    }
    return "an unknown kind of value";
}

std::string in_quotes(std::string_view text) {
    const bool long_text = text.size() > kShownMax;
    return fmt::format("“{}{}”", visible(text.substr(0, kShownMax)), long_text ? "…" : "");
}

}  // namespace

// ---- failing ----

bool Reader::fail(std::string_view expected, std::string_view found) {
    if (!fault_) fault_ = fmt::format("{}: expected {}, found {}", place_, expected, found);
    return false;
}

std::optional<std::string> Reader::finish() {
    if (!bytes_.empty()) fail("its end", fmt::format("{} bytes more", bytes_.size()));
    return fault_;
}

std::string_view Reader::take_some(size_t size) {
    if (bytes_.size() < size) fail(fmt::format("{} bytes more", size), "its end");
    if (fault_) return {};
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
}

std::string_view Reader::next_kind() const {
    return bytes_.empty() ? "its end" : name_of(static_cast<Kind>(bytes_.front()));
}

// ---- what comes before values ----

bool Reader::take_field(std::string_view name) {
    if (fault_) return false;
    if (bytes_.empty()) return fail("this field", "its end");
    const std::string_view found = take_some(take_raw<uint32_t>());
    if (fault_) return false;
    return found == name || fail("this field", "a field " + in_quotes(found));
}

bool Reader::expect(Kind kind) {
    if (fault_) return false;
    const bool there = !bytes_.empty() && bytes_.front() == static_cast<char>(kind);
    if (!there) return fail(name_of(kind), next_kind());
    bytes_.remove_prefix(1);
    return true;
}

bool Reader::take_nothing() {
    const bool there = !bytes_.empty() && bytes_.front() == static_cast<char>(Kind::Nothing);
    return !fault_ && there && expect(Kind::Nothing);
}

// Each item takes a byte at least, so what is announced and not there costs nothing.
size_t Reader::take_items(Kind kind) {
    if (!expect(kind)) return 0;
    const size_t count = take_raw<uint32_t>();
    if (count > kItemsMax) fail(fmt::format("at most {} items", kItemsMax), std::to_string(count));
    if (count > bytes_.size()) fail(fmt::format("{} items", count), "its end");
    return fault_ ? 0 : count;
}

// ---- values ----

void Reader::take(bool& value) {
    if (!expect(Kind::Bool)) return;
    const auto byte = take_raw<uint8_t>();
    if (byte > 1) fail("yes or no", std::to_string(byte));
    value = byte == 1;
}

// A word of a node.
void Reader::take(int16_t& value) {
    if (!expect(Kind::Whole)) return;
    constexpr int64_t kLeast = std::numeric_limits<int16_t>::min();
    constexpr int64_t kMost = std::numeric_limits<int16_t>::max();
    const auto whole = take_raw<int64_t>();
    if (whole < kLeast || whole > kMost) {
        fail(fmt::format("a number from {} to {}", kLeast, kMost), std::to_string(whole));
    }
    value = static_cast<int16_t>(whole);
}

void Reader::take(double& value) {
    if (!expect(Kind::Number)) return;
    value = take_raw<double>();
    if (!std::isfinite(value)) fail("a finite number", fmt::format("{}", value));
}

void Reader::take(std::string& text) {
    if (!expect(Kind::Text)) return;
    text = take_some(take_raw<uint32_t>());
    if (malformed_utf8_at(text)) fail("UTF-8", in_quotes(text));
}

void Reader::take(Bytes& bytes) {
    if (expect(Kind::Bytes)) bytes.bytes = take_some(take_raw<uint32_t>());
}

void Reader::take(BusFrame& frame) {
    Bytes bytes;
    take(bytes);
    if (fault_ || decode_frame(bytes.bytes, frame.frame)) return;
    fail("a whole frame of the bus", fmt::format("{} bytes that are none", bytes.bytes.size()));
}

void Reader::take(std::set<std::string>& list) {
    const size_t count = take_items(Kind::List);
    for (size_t i = 0; i < count && !fault_; ++i) {
        std::string one;
        take_at(i, one);
        list.insert(std::move(one));
    }
}

uint64_t Reader::take_count(uint64_t most) {
    if (!expect(Kind::Count)) return 0;
    const auto value = take_raw<uint64_t>();
    if (value > most) fail(fmt::format("a number up to {}", most), std::to_string(value));
    return fault_ ? 0 : value;
}

size_t Reader::take_word(std::span<const std::string_view> words) {
    std::string word;
    take(word);
    for (size_t i = 0; i < words.size() && !fault_; ++i) {
        if (words[i] == word) return i;
    }
    fail(fmt::format("one of {}", fmt::join(words, ", ")), in_quotes(word));
    return 0;
}

void Reader::take(plan::Value& value) {
    Json json;
    const std::string_view found = next_kind();
    take(json);
    if (fault_) return;
    if (json.is_boolean()) {
        value = plan::Value(json.get<bool>());
    } else if (json.is_number_integer()) {
        value = plan::Value(json.get<int64_t>());
    } else if (json.is_number()) {
        value = plan::Value(json.get<double>());
    } else if (json.is_string()) {
        value = plan::Value(json.get<std::string>());
    } else if (json.is_null()) {
        value = plan::Value(plan::Object{});
    } else {
        fail("a value of a plan", found);
    }
}

// ---- documents ----

void Reader::take(Document& document) {
    if (fault_) return;
    const std::string_view found = next_kind();
    take(document.json);
    if (!document.json.is_object()) fail("a table", found);
}

void Reader::take(DocumentList& list) {
    if (fault_) return;
    const std::string_view found = next_kind();
    take(list.json);
    if (!list.json.is_array()) fail("a list", found);
}

void Reader::take_json(Json& json, int depth) {
    if (depth > kJsonDepthMax) fail(fmt::format("at most {} levels", kJsonDepthMax), "one more");
    if (fault_) return;
    if (bytes_.empty()) return void(fail("a value", "its end"));
    switch (static_cast<Kind>(bytes_.front())) {
        case Kind::Nothing:
            json = nullptr;
            return bytes_.remove_prefix(1);
        case Kind::Bool:
            return take_as<bool>(json);
        case Kind::Count:
            return take_as<uint64_t>(json);
        case Kind::Whole:
            bytes_.remove_prefix(1);
            json = take_raw<int64_t>();
            return;
        case Kind::Number:
            return take_as<double>(json);
        case Kind::Text:
            return take_as<std::string>(json);
        case Kind::List:
            return take_json_list(json, depth);
        case Kind::Table:
            return take_json_table(json, depth);
        case Kind::Bytes:
        case Kind::Parts:
            break;
    }
    fail("a value of JSON", next_kind());
}

template <typename T>
void Reader::take_as(Json& json) {
    T value{};
    take(value);
    json = std::move(value);
}

void Reader::take_json_list(Json& json, int depth) {
    json = Json::array();
    const size_t count = take_items(Kind::List);
    for (size_t i = 0; i < count && !fault_; ++i) {
        Json one;
        take_json(one, depth + 1);
        json.push_back(std::move(one));
    }
}

void Reader::take_json_table(Json& json, int depth) {
    json = Json::object();
    const size_t count = take_items(Kind::Table);
    for (size_t i = 0; i < count && !fault_; ++i) {
        std::string name;
        take(name);
        Json one;
        take_json(one, depth + 1);
        if (!fault_) json[name] = std::move(one);
    }
}

}  // namespace vagus::serve::talk
