// A JSON document as a tree in which everything knows its place: the line and column of every key
// and value, the order of members, double keys. Our file formats need that for their errors and for
// saving what was not changed byte for byte. Built over nlohmann's event reader; no type of that
// library shows here.
//
//     Result<JsonValue> file = parse_json(text, "arena.world.json");
//     const JsonValue* seed = file.value().find("seed");
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.hpp"

namespace vagus {

constexpr int kJsonDepthMax = 100;
constexpr size_t kJsonBytesMax = 64u << 20;
constexpr size_t kJsonValuesMax =
    1'000'000;  // a short text could otherwise become a tree a hundred times its size

struct Place {
    int line = 0;    // from 1; 0: no place
    int column = 0;  // from 1, in code points
    friend bool operator==(const Place&, const Place&) = default;
};

enum class JsonKind { Null, Bool, Int, Float, String, Array, Object };

struct JsonMember;

struct JsonValue {
    JsonKind kind = JsonKind::Null;
    Place at;
    bool boolean = false;
    int64_t integer = 0;              // Int: digits only, fits 64 bits
    double number = 0;                // Int and Float
    std::string text;                 // String: its characters; numbers: as written in the file
    std::string raw;                  // String: as written in the file, quotes included; else empty
    std::vector<JsonValue> items;     // Array
    std::vector<JsonMember> members;  // Object, in the order of the file, double keys kept

    bool is_number() const { return kind == JsonKind::Int || kind == JsonKind::Float; }
    // The first member of that key, or nullptr.
    const JsonValue* find(std::string_view key) const;
};

// A member that is a text or a number, as it is written; empty without it.
std::string text_in(const JsonValue& object, std::string_view key);

struct JsonMember {
    std::string key;
    std::string raw_key;  // as written, quotes included
    Place at;             // of the key
    JsonValue value;
};

// "an object", "a whole number": for sentences.
std::string_view name_of(JsonKind kind);

// Values made by a program, without a place: what a writer builds before format_json().
JsonValue json_string(std::string_view text);
JsonValue json_integer(int64_t value);
JsonValue json_array(std::vector<JsonValue> items);
JsonMember json_member(std::string_view key, JsonValue value);
JsonMember json_member(std::string_view key, std::string_view text);
JsonMember json_member(std::string_view key, std::vector<JsonMember> members);
JsonValue json_object(std::vector<JsonMember> members);

struct JsonError {
    Place at;
    std::string what;  // without the place
};

// The first thing that keeps the text from being one JSON value (RFC 8259; UTF-8 without byte order
// mark; depth, size and number of values limited; numbers out of range of a double and half
// surrogates refused).
std::variant<JsonValue, JsonError> read_json(std::string_view text);

// "FILE:LINE:COL"; without the column, or both, if they are 0.
std::string at_file(std::string_view file, Place at);

// "FILE:LINE:COL: sentence": how every error in a text file begins.
std::string at_place(std::string_view file, Place at, std::string_view sentence);

// The same as a Result; the Error reads "FILE:LINE:COL: sentence".
Result<JsonValue> parse_json(std::string_view text, std::string_view file);

// The saved form of docs/formats.md: the object and the objects directly in it one member a line,
// the rest on one line where it fits 100 characters. Numbers and strings as they were written
// (`raw`, `text`); a string without `raw` is quoted again, a number without `text` is written from
// its value. A newline at the end.
std::string format_json(const JsonValue& value);

// A string as JSON, quotes included: `"`, `\` and characters below U+0020 escaped, bytes that are
// no UTF-8 (names that came over a bus) as U+FFFD, all else as it is.
std::string json_quote(std::string_view text);
void append_json_quote(std::string& to, std::string_view text);

}  // namespace vagus
