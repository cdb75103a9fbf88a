// The strict reader's sentences: see json_object.hpp.
#include "base/json_object.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>

#include "base/nearest.hpp"
#include "base/text.hpp"

namespace vagus {
namespace {

// Kept for other programs; nothing in it has a meaning here.
constexpr std::string_view kForeignKey = "x";
// Longest value that is shown in a sentence.
constexpr size_t kShownMax = 40;

bool fits_kind(const JsonValue& json, JsonKind kind) {
    return json.kind == kind || (kind == JsonKind::Float && json.kind == JsonKind::Int);
}

std::string_view wanted_name(JsonKind kind) {
    return kind == JsonKind::Float ? "a number" : name_of(kind);
}

std::string shown(const JsonValue& json) {
    if (json.kind == JsonKind::String) return json_quote(json.text.substr(0, kShownMax));
    if (json.is_number()) return json.text.substr(0, kShownMax);
    return std::string(name_of(json.kind));
}

bool is_before(const Complaint& left, const Complaint& right) {
    return std::pair(left.at.line, left.at.column) < std::pair(right.at.line, right.at.column);
}

}  // namespace

Error first_complaint(const Complaints& complaints, std::string_view file) {
    assert(!complaints.empty());
    const Complaint& first = *std::min_element(complaints.begin(), complaints.end(), is_before);
    return {Code::BadInput, at_place(file, first.at, first.what)};
}

std::vector<Error> errors_of(Complaints complaints, std::string_view file) {
    std::stable_sort(complaints.begin(), complaints.end(), is_before);
    std::vector<Error> errors;
    for (const Complaint& one : complaints) {
        errors.push_back({Code::BadInput, at_place(file, one.at, one.what)});
    }
    return errors;
}

JsonObject::JsonObject(const JsonValue& json, std::string name, Complaints& complaints)
    : json_(json),
      name_(std::move(name)),
      complaints_(complaints),
      is_object_(json.kind == JsonKind::Object) {
    if (is_object_) return;
    complain(json.at, fmt::format("{} is {}; it must be an object: {{ … }}", name_, shown(json)));
}

const JsonValue* JsonObject::find(std::string_view key, Need need) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    const JsonValue* value = json_.find(key);
    const bool lacks = value == nullptr && need == Need::Required && is_object_;
    if (lacks && std::find(missing_.begin(), missing_.end(), key) == missing_.end())
        missing_.emplace_back(key);
    return value;
}

const JsonValue* JsonObject::find(std::string_view key, JsonKind kind, Need need) {
    const JsonValue* value = find(key, need);
    if (value == nullptr || fits_kind(*value, kind)) return value;
    complain(value->at, fmt::format("\"{}\" of {} is {}; write {}", key, name_, shown(*value),
                                    wanted_name(kind)));
    return nullptr;
}

std::string JsonObject::text(std::string_view key, Need need, std::string_view fallback) {
    const JsonValue* value = find(key, JsonKind::String, need);
    return value == nullptr ? std::string(fallback) : value->text;
}

int64_t JsonObject::integer(std::string_view key, const IntegerRange& range) {
    const JsonValue* value = find(key, JsonKind::Int, range.need);
    if (value == nullptr) return range.fallback;
    if (value->integer >= range.low && value->integer <= range.high) return value->integer;
    complain(value->at, fmt::format("\"{}\" of {} is {}; write a whole number from {} to {}", key,
                                    name_, shown(*value), range.low, range.high));
    return range.fallback;
}

double JsonObject::number(std::string_view key, const NumberRange& range) {
    const JsonValue* value = find(key, JsonKind::Float, range.need);
    if (value == nullptr) return range.fallback;
    if (value->number >= range.low && value->number <= range.high) return value->number;
    complain(value->at, fmt::format("\"{}\" of {} is {}; write a number from {} to {}", key, name_,
                                    shown(*value), range.low, range.high));
    return range.fallback;
}

bool JsonObject::boolean(std::string_view key, bool fallback) {
    const JsonValue* value = find(key, JsonKind::Bool, Need::Optional);
    return value == nullptr ? fallback : value->boolean;
}

const std::vector<JsonValue>& JsonObject::items(std::string_view key, Need need) {
    static const std::vector<JsonValue> kNone;
    const JsonValue* value = find(key, JsonKind::Array, need);
    return value == nullptr ? kNone : value->items;
}

std::string JsonObject::word(std::string_view key, const std::vector<std::string_view>& words,
                             Need need, std::string_view fallback) {
    const JsonValue* value = find(key, JsonKind::String, need);
    if (value == nullptr) return std::string(fallback);
    if (std::find(words.begin(), words.end(), value->text) != words.end()) return value->text;
    const std::string guess = nearest(value->text, words);
    const std::string fix = guess.empty() ? fmt::format("write one of {}", list_of(words))
                                          : fmt::format("did you mean \"{}\"?", guess);
    complain(value->at, fmt::format("\"{}\" of {} is {}; {}", key, name_, shown(*value), fix));
    return std::string(fallback);
}

void JsonObject::finish() {
    const std::vector<std::string_view> known(known_.begin(), known_.end());
    std::set<std::string_view> seen;
    std::set<std::string> meant;  // by keys that are unknown
    for (const JsonMember& member : json_.members) {
        const std::string key = json_quote(member.key.substr(0, kShownMax));
        if (!seen.insert(member.key).second) {
            complain(member.at,
                     fmt::format("{} has the key {} a second time; remove one", name_, key));
        } else if (member.key != kForeignKey &&
                   std::find(known.begin(), known.end(), member.key) == known.end()) {
            const std::string guess = nearest(member.key, known_);
            meant.insert(guess);
            const std::string fix = guess.empty()
                                        ? fmt::format("remove it, or use one of {}", list_of(known))
                                        : fmt::format("did you mean \"{}\"?", guess);
            complain(member.at, fmt::format("{} has the unknown key {}; {}", name_, key, fix));
        }
    }
    for (const std::string& key : missing_) {
        if (!meant.contains(key))
            complain(json_.at, fmt::format("{} has no \"{}\"; add it", name_, key));
    }
}

void JsonObject::complain(Place at, std::string what) {
    if (complaints_.size() < kComplaintsMax) complaints_.push_back({at, std::move(what)});
}

}  // namespace vagus
