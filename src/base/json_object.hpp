// Strict reading of a JSON object, for every file format of ours: unknown and double keys, missing
// keys, wrong kinds and values out of range become complaints with a place. `"x"` belongs to other
// programs and is never complained of.
//
//     Complaints complaints;
//     JsonObject robot(item, "robot 2", complaints);
//     const std::string type = robot.text("type", Need::Required);
//     const int64_t node = robot.integer("node", {.low = 1, .high = 32767, .fallback = 1});
//     robot.finish();
//     if (!complaints.empty()) return first_complaint(complaints, file);
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"

namespace vagus {

struct Complaint {
    Place at;
    // Names the element, what was expected and found, and the fix; without the place.
    std::string what;
};
constexpr size_t kComplaintsMax = 1000;  // more are not kept
using Complaints = std::vector<Complaint>;

// The complaint that is first in the file as an Error ("FILE:LINE:COL: sentence"); `complaints`
// is not empty.
Error first_complaint(const Complaints& complaints, std::string_view file);

// Each of them as such an Error, in the order of the file; for editors, which show all at once.
std::vector<Error> errors_of(Complaints complaints, std::string_view file);

enum class Need { Optional, Required };

struct IntegerRange {
    int64_t low = INT64_MIN;
    int64_t high = INT64_MAX;
    int64_t fallback = 0;  // the value if the key is absent, or its value is complained of
    Need need = Need::Optional;
};

struct NumberRange {
    double low = -1e300;
    double high = 1e300;
    double fallback = 0;
    Need need = Need::Optional;
};

// One object under reading. Whatever is asked of it makes the key known; finish() complains of the
// rest.
class JsonObject {
public:
    // `name` is what sentences call it: "the node", "variable 3". `json` and `complaints` must
    // outlive this. A value that is no object is complained of once and then counts as an empty
    // object without needs.
    JsonObject(const JsonValue& json, std::string name, Complaints& complaints);

    // The value of that key, or nullptr. If `kind` does not fit, that is complained of and nullptr
    // given. Float means any number.
    const JsonValue* find(std::string_view key, JsonKind kind, Need need);
    // The value whatever its kind.
    const JsonValue* find(std::string_view key, Need need);

    std::string text(std::string_view key, Need need, std::string_view fallback = "");
    int64_t integer(std::string_view key, const IntegerRange& range);
    double number(std::string_view key, const NumberRange& range);
    bool boolean(std::string_view key, bool fallback);
    // Items of an array; empty if absent.
    const std::vector<JsonValue>& items(std::string_view key, Need need);
    // One of `words`; the fallback if absent or complained of.
    std::string word(std::string_view key, const std::vector<std::string_view>& words, Need need,
                     std::string_view fallback = "");

    // Complains of every key that was never asked for, except "x", of keys that are there twice,
    // and of those that are needed and missing, unless an unknown one seems to be meant for it.
    void finish();

    // For checks that only the caller can make.
    void complain(Place at, std::string what);
    const std::string& name() const { return name_; }
    Place at() const { return json_.at; }

private:
    const JsonValue& json_;
    std::string name_;
    Complaints& complaints_;
    bool is_object_;
    std::vector<std::string> known_;
    std::vector<std::string> missing_;  // needed, and not there
};

}  // namespace vagus
