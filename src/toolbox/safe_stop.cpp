#include "toolbox/safe_stop.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string_view>

namespace vagus::toolbox {

namespace {

constexpr std::string_view kKey = "safe_stop";

class Reader {
public:
    explicit Reader(Complaints& complaints) : complaints_(complaints) {}

    SafeStop nodes(const JsonValue& list);

private:
    SafeStopNode node(const JsonValue& json, const std::string& name);
    void set(JsonObject& in, SafeStopNode& node);
    void read(JsonObject& in, SafeStopNode& node);
    std::vector<int16_t> values(const JsonValue& json, const std::string& variable);
    std::optional<int16_t> value(const JsonValue& json, const std::string& variable);

    void complain(Place at, std::string what) {
        if (complaints_.size() < kComplaintsMax) complaints_.push_back({at, std::move(what)});
    }
    bool fits(Place at, size_t found, size_t max, const std::string& what);
    bool is_name(Place at, const std::string& name, std::string_view of);

    Complaints& complaints_;
};

bool Reader::fits(Place at, size_t found, size_t max, const std::string& what) {
    if (found <= max) return true;
    complain(at, fmt::format("{}, found {}; remove some", what, found));
    return false;
}

bool Reader::is_name(Place at, const std::string& name, std::string_view of) {
    if (!name.empty() && name.size() <= kSafeStopNameBytesMax) return true;
    complain(at, fmt::format("a name in \"{}\" has {} bytes; expected the name of {}, 1 to {} "
                             "bytes",
                             kKey, name.size(), of, kSafeStopNameBytesMax));
    return false;
}

std::optional<int16_t> Reader::value(const JsonValue& json, const std::string& variable) {
    const bool whole = json.kind == JsonKind::Int;
    if (whole && json.integer >= INT16_MIN && json.integer <= INT16_MAX) {
        return static_cast<int16_t>(json.integer);
    }
    const std::string found = json.is_number() ? json.text : std::string(name_of(json.kind));
    complain(json.at, fmt::format("the value of {} in \"{}\" is {}; write a whole number from {} "
                                  "to {}, or a list of them for an array",
                                  variable, kKey, found, INT16_MIN, INT16_MAX));
    return std::nullopt;
}

std::vector<int16_t> Reader::values(const JsonValue& json, const std::string& variable) {
    std::vector<int16_t> values;
    if (json.kind != JsonKind::Array) {
        if (const auto one = value(json, variable)) values.push_back(*one);
        return values;
    }
    const std::string range =
        fmt::format("{} in \"{}\": expected 1 to {} values", variable, kKey, kSafeStopValuesMax);
    if (json.items.empty()) complain(json.at, range + ", found none; write the value to set");
    if (!fits(json.at, json.items.size(), kSafeStopValuesMax, range)) return values;
    for (const JsonValue& item : json.items) {
        if (const auto one = value(item, variable)) values.push_back(*one);
    }
    return values;
}

void Reader::set(JsonObject& in, SafeStopNode& node) {
    const JsonValue* json = in.find("set", JsonKind::Object, Need::Optional);
    if (!json) return;
    if (!fits(json->at, json->members.size(), kSafeStopVariablesMax,
              fmt::format("\"set\" of {}: expected at most {} variables", in.name(),
                          kSafeStopVariablesMax))) {
        return;
    }
    std::set<std::string_view> seen;
    for (const JsonMember& member : json->members) {
        if (!is_name(member.at, member.key, "a variable")) continue;
        if (!seen.insert(member.key).second) {
            complain(member.at, fmt::format("\"set\" of {} has the variable {} a second time; "
                                            "remove one",
                                            in.name(), json_quote(member.key)));
            continue;
        }
        node.set.emplace_back(member.key, values(member.value, json_quote(member.key)));
    }
}

void Reader::read(JsonObject& in, SafeStopNode& node) {
    const std::vector<JsonValue>& items = in.items("read", Need::Optional);
    if (items.empty()) return;
    if (!fits(in.find("read", Need::Optional)->at, items.size(), kSafeStopVariablesMax,
              fmt::format("\"read\" of {}: expected at most {} variables", in.name(),
                          kSafeStopVariablesMax))) {
        return;
    }
    std::set<std::string_view> seen;
    for (const JsonValue& item : items) {
        if (item.kind != JsonKind::String) {
            complain(item.at, fmt::format("\"read\" of {} holds names of variables in quotes, not "
                                          "{}",
                                          in.name(), name_of(item.kind)));
        } else if (!is_name(item.at, item.text, "a variable")) {
            continue;
        } else if (!seen.insert(item.text).second) {
            complain(item.at, fmt::format("\"read\" of {} names {} twice; keep one of them",
                                          in.name(), json_quote(item.text)));
        } else {
            node.read.push_back(item.text);
        }
    }
}

SafeStopNode Reader::node(const JsonValue& json, const std::string& name) {
    JsonObject in(json, fmt::format("{} in \"{}\"", json_quote(name), kKey), complaints_);
    SafeStopNode node;
    set(in, node);
    read(in, node);
    in.finish();
    return node;
}

SafeStop Reader::nodes(const JsonValue& list) {
    SafeStop safe;
    if (!fits(list.at, list.members.size(), kSafeStopNodesMax,
              fmt::format("\"{}\": expected at most {} nodes", kKey, kSafeStopNodesMax))) {
        return safe;
    }
    for (const JsonMember& member : list.members) {
        if (!is_name(member.at, member.key, "a node")) continue;
        if (safe.contains(member.key)) {
            complain(member.at, fmt::format("\"{}\" has the node {} a second time; remove one",
                                            kKey, json_quote(member.key)));
            continue;
        }
        safe.emplace(member.key, node(member.value, member.key));
    }
    return safe;
}

}  // namespace

SafeStop read_safe_stop(JsonObject& in, Complaints& complaints) {
    const JsonValue* list = in.find(kKey, JsonKind::Object, Need::Optional);
    return list ? Reader(complaints).nodes(*list) : SafeStop();
}

void overlay(SafeStop& safe, const SafeStop& stronger) {
    for (const auto& [name, node] : stronger) safe[name] = node;
}

}  // namespace vagus::toolbox
