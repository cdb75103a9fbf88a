// Writing JSON in the saved form of docs/formats.md, so that our files diff well.
#include <fmt/format.h>

#include <algorithm>

#include "base/json.hpp"
#include "base/json_part.hpp"
#include "base/text.hpp"

namespace vagus {
namespace {

constexpr size_t kLineMax = 100;  // characters, with indentation, key and comma

std::string number_text(const JsonValue& json) {
    if (!json.text.empty()) return json.text;
    if (json.kind == JsonKind::Int) return std::to_string(json.integer);
    return fmt::format("{}", json.number);  // the shortest that reads back as the same number
}

std::string scalar_text(const JsonValue& json) {
    switch (json.kind) {
        case JsonKind::Null:
            return "null";
        case JsonKind::Bool:
            return json.boolean ? "true" : "false";
        case JsonKind::Int:
        case JsonKind::Float:
            return number_text(json);
        case JsonKind::String:
            return json.raw.empty() ? json_quote(json.text) : json.raw;
        case JsonKind::Array:
        case JsonKind::Object:
            break;
    }
    return "";
}

std::string key_text(const JsonMember& member) {
    return (member.raw_key.empty() ? json_quote(member.key) : member.raw_key) + ": ";
}

bool is_empty(const JsonValue& json) {
    return json.items.empty() && json.members.empty();
}

// `{ "a": 1, "b": [2, 3] }`
std::string one_line(const JsonValue& json) {
    std::string line;
    if (json.kind == JsonKind::Array) {
        for (const JsonValue& item : json.items)
            line += (line.empty() ? "" : ", ") + one_line(item);
        return "[" + line + "]";
    }
    if (json.kind == JsonKind::Object) {
        for (const JsonMember& member : json.members)
            line += (line.empty() ? "" : ", ") + key_text(member) + one_line(member.value);
        return line.empty() ? "{}" : "{ " + line + " }";
    }
    return scalar_text(json);
}

// Cheap answer for big values, so that deep trees are not written once a level: every value takes a
// character, and a character takes at most four bytes.
bool surely_too_long(const JsonValue& json, size_t& room) {
    const size_t least = 1 + std::max(json.raw.size(), json.text.size()) / 4;
    if (room < least) return true;
    room -= least;
    for (const JsonValue& item : json.items)
        if (surely_too_long(item, room)) return true;
    for (const JsonMember& member : json.members)
        if (surely_too_long(member.value, room)) return true;
    return false;
}

class Formatter {
public:
    // Writes `json` behind `prefix` (indentation and key), with `suffix` (a comma or nothing) at
    // its end.
    void write(const JsonValue& json, size_t depth, const std::string& prefix,
               std::string_view suffix) {
        const bool is_open = json.kind == JsonKind::Object && depth <= 1 && !is_root_array_;
        if (is_empty(json) || (!is_open && fits(json, prefix, suffix))) {
            out_ += prefix + one_line(json) + std::string(suffix) + "\n";
            return;
        }
        const bool is_array = json.kind == JsonKind::Array;
        out_ += prefix + (is_array ? "[\n" : "{\n");
        write_parts(json, depth + 1);
        out_ += std::string(depth * 2, ' ') + (is_array ? "]" : "}") + std::string(suffix) + "\n";
    }

    std::string take_part(const JsonValue& json, size_t depth, std::string_view prefix,
                          std::string_view suffix) {
        write(json, depth, std::string(depth * 2, ' ') + std::string(prefix), suffix);
        out_.pop_back();
        return out_.substr(depth * 2);
    }

    std::string take(const JsonValue& root) {
        is_root_array_ = root.kind == JsonKind::Array;
        write(root, 0, "", "");
        return std::move(out_);
    }

private:
    static bool fits(const JsonValue& json, const std::string& prefix, std::string_view suffix) {
        size_t room = kLineMax;
        if (surely_too_long(json, room)) return false;
        return count_code_points(prefix + one_line(json)) + suffix.size() <= kLineMax;
    }

    void write_parts(const JsonValue& json, size_t depth) {
        const std::string indent(depth * 2, ' ');
        for (size_t i = 0; i < json.items.size(); ++i)
            write(json.items[i], depth, indent, i + 1 < json.items.size() ? "," : "");
        for (size_t i = 0; i < json.members.size(); ++i)
            write(json.members[i].value, depth, indent + key_text(json.members[i]),
                  i + 1 < json.members.size() ? "," : "");
    }

    std::string out_;
    bool is_root_array_ = false;
};

}  // namespace

JsonValue json_string(std::string_view text) {
    JsonValue json;
    json.kind = JsonKind::String;
    json.text = text;
    return json;
}

JsonValue json_integer(int64_t value) {
    JsonValue json;
    json.kind = JsonKind::Int;
    json.integer = value;
    json.number = static_cast<double>(value);
    return json;
}

JsonValue json_array(std::vector<JsonValue> items) {
    JsonValue json;
    json.kind = JsonKind::Array;
    json.items = std::move(items);
    return json;
}

JsonMember json_member(std::string_view key, std::string_view text) {
    return json_member(key, json_string(text));
}

JsonMember json_member(std::string_view key, std::vector<JsonMember> members) {
    return json_member(key, json_object(std::move(members)));
}

JsonMember json_member(std::string_view key, JsonValue value) {
    JsonMember member;
    member.key = key;
    member.value = std::move(value);
    return member;
}

JsonValue json_object(std::vector<JsonMember> members) {
    JsonValue json;
    json.kind = JsonKind::Object;
    json.members = std::move(members);
    return json;
}

std::string format_json(const JsonValue& value) {
    return Formatter().take(value);
}

std::string format_json_part(const JsonValue& value, size_t depth, std::string_view prefix,
                             std::string_view suffix) {
    return Formatter().take_part(value, depth, prefix, suffix);
}

std::string format_json_line(const JsonValue& value) {
    return one_line(value);
}

void append_json_quote(std::string& to, std::string_view text) {
    constexpr std::string_view kEscaped = "\"\\\b\f\n\r\t";
    constexpr std::string_view kReplacement = "\ufffd";
    constexpr std::string_view kLetters = "\"\\bfnrt";
    to += '"';
    // Nearly all texts are names and sentences of ASCII.
    const auto is_plain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
    const auto special = std::find_if_not(text.begin(), text.end(), is_plain);
    const auto plain = static_cast<size_t>(special - text.begin());
    to.append(text.substr(0, plain));
    text.remove_prefix(plain);
    while (!text.empty()) {
        const CodePoint point = first_code_point(text);
        const size_t bytes = std::max<size_t>(point.bytes, 1);
        const size_t escape = kEscaped.find(text[0]);
        if (escape != kEscaped.npos) {
            to += {'\\', kLetters[escape]};
        } else if (point.bytes == 0) {
            to += kReplacement;
        } else if (point.value < 0x20) {
            to += fmt::format("\\u{:04x}", static_cast<unsigned>(point.value));
        } else {
            to += text.substr(0, bytes);
        }
        text.remove_prefix(bytes);
    }
    to += '"';
}

std::string json_quote(std::string_view text) {
    std::string quoted;
    append_json_quote(quoted, text);
    return quoted;
}

}  // namespace vagus
