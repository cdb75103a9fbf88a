#include "plan/differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "plan/file.hpp"

namespace vagus::plan {

namespace {

using Path = std::vector<std::string>;

// Strings by their characters, numbers as they are written: 1 and 1.0 are not of one type (P0).
bool same(const JsonValue& a, const JsonValue& b) {
    if (a.kind != b.kind) return false;
    switch (a.kind) {
        case JsonKind::Null:
            return true;
        case JsonKind::Bool:
            return a.boolean == b.boolean;
        case JsonKind::Int:
        case JsonKind::Float:
        case JsonKind::String:
            return a.text == b.text;
        case JsonKind::Array:
            return std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same);
        case JsonKind::Object:
            return std::equal(a.members.begin(), a.members.end(), b.members.begin(),
                              b.members.end(), [](const JsonMember& x, const JsonMember& y) {
                                  return x.key == y.key && same(x.value, y.value);
                              });
    }
    return false;
}

// Where a plan file has objects whose members are compared one by one: the keys from the root, "*"
// for a name. All else is one value.
constexpr std::string_view kLooksInto[] = {
    "",
    "configuration",
    "configuration/*",
    "start",
    "start/supervisors",
    "start/supervisors/*",
    "start/supervisors/*/in",
    "start/supervisors/*/out",
    "start/supervisors/*/events",
    "actors",
    "actors/*",
    "actors/*/in",
    "actors/*/out",
    "actors/*/states",
    "actors/*/supervisors",
    "actors/*/supervisors/*",
    "actors/*/supervisors/*/in",
    "actors/*/supervisors/*/out",
    "actors/*/supervisors/*/events",
    "layout",
};

bool has_names(std::string_view form) {
    for (const std::string_view list : {"configuration", "actors", "supervisors"}) {
        if (form == list || form.ends_with("/" + std::string(list))) return true;
    }
    return false;
}

// The path with "*" for each name of an element.
std::string form_of(const Path& path) {
    std::string form;
    for (const std::string& key : path) {
        const bool is_name = has_names(form);
        if (!form.empty()) form += "/";
        form += is_name ? "*" : key;
    }
    return form;
}

bool looks_into(const Path& path) {
    const std::string form = form_of(path);
    return std::find(std::begin(kLooksInto), std::end(kLooksInto), form) != std::end(kLooksInto);
}

JsonValue names(const std::vector<std::string>& keys) {
    std::vector<JsonValue> items;
    for (const std::string& key : keys) items.push_back(json_string(key));
    return json_array(std::move(items));
}

using Members = std::map<std::string_view, const JsonValue*>;

Members members_of(const JsonValue& object) {
    Members members;
    for (const JsonMember& member : object.members) members.emplace(member.key, &member.value);
    return members;
}

// The keys of `a` that `b` has too, in the order of `a`.
std::vector<std::string> common_keys(const JsonValue& a, const JsonValue& b) {
    const Members of_b = members_of(b);
    std::vector<std::string> keys;
    for (const JsonMember& member : a.members) {
        if (of_b.contains(member.key)) keys.push_back(member.key);
    }
    return keys;
}

class Comparer {
public:
    Differences compare(const JsonValue& before, const JsonValue& after) {
        compare_members(before, after, {});
        return std::move(all_);
    }

private:
    static Path below(Path path, const std::string& key) {
        path.push_back(key);
        return path;
    }

    void compare_members(const JsonValue& before, const JsonValue& after, const Path& path) {
        const Members was = members_of(before);
        const Members is = members_of(after);
        for (const JsonMember& member : before.members) {
            const auto now = is.find(member.key);
            if (now != is.end()) {
                compare_value(member.value, *now->second, below(path, member.key));
            } else {
                all_.push_back({.kind = DifferenceKind::Removed,
                                .path = below(path, member.key),
                                .before = member.value,
                                .after = {},
                                .behind = {}});
            }
        }
        compare_order(before, after, path);
        std::string behind;
        for (const JsonMember& member : after.members) {
            if (!was.contains(member.key)) {
                all_.push_back({.kind = DifferenceKind::Added,
                                .path = below(path, member.key),
                                .before = {},
                                .after = member.value,
                                .behind = behind});
            }
            behind = member.key;
        }
    }

    void compare_value(const JsonValue& before, const JsonValue& after, const Path& path) {
        if (same(before, after)) return;
        const bool objects =
            before.kind == JsonKind::Object && after.kind == JsonKind::Object && looks_into(path);
        if (objects) return compare_members(before, after, path);
        all_.push_back({.kind = DifferenceKind::Changed,
                        .path = path,
                        .before = before,
                        .after = after,
                        .behind = {}});
    }

    void compare_order(const JsonValue& before, const JsonValue& after, const Path& path) {
        const std::vector<std::string> old_order = common_keys(before, after);
        const std::vector<std::string> new_order = common_keys(after, before);
        if (old_order == new_order) return;
        all_.push_back({.kind = DifferenceKind::Reordered,
                        .path = path,
                        .before = names(old_order),
                        .after = names(new_order),
                        .behind = {}});
    }

    Differences all_;
};

// ---- applying ----

std::string words_of(const Path& path) {
    return fmt::format("\"{}\"", fmt::join(path, "."));
}

Error does_not_fit(const Difference& difference, std::string_view why) {
    return Error{Code::BadInput, fmt::format("{} cannot be {}: {}", words_of(difference.path),
                                             name_of(difference.kind), why)};
}

JsonValue* member_of(JsonValue& object, std::string_view key) {
    for (JsonMember& member : object.members) {
        if (member.key == key) return &member.value;
    }
    return nullptr;
}

Status add(const Difference& difference, JsonValue& object) {
    const std::string& key = difference.path.back();
    if (object.find(key)) return does_not_fit(difference, "it is there already");
    auto place = object.members.begin();
    if (!difference.behind.empty()) {
        place = std::find_if(place, object.members.end(), [&difference](const JsonMember& member) {
            return member.key == difference.behind;
        });
        if (place == object.members.end()) {
            return does_not_fit(difference,
                                fmt::format("there is no \"{}\" before it", difference.behind));
        }
        ++place;
    }
    object.members.insert(place, json_member(key, difference.after));
    return Status::done();
}

Status reorder(const Difference& difference, JsonValue& object) {
    std::vector<JsonMember> sorted;
    for (const JsonValue& name : difference.after.items) {
        const auto member =
            std::find_if(object.members.begin(), object.members.end(),
                         [&name](const JsonMember& m) { return m.key == name.text; });
        if (member == object.members.end()) {
            return does_not_fit(difference, fmt::format("there is no \"{}\"", name.text));
        }
        sorted.push_back(std::move(*member));
        object.members.erase(member);
    }
    if (!object.members.empty()) {
        return does_not_fit(difference,
                            fmt::format("it also has \"{}\"", object.members.front().key));
    }
    object.members = std::move(sorted);
    return Status::done();
}

Status apply_one(const Difference& difference, JsonValue& root) {
    const bool is_list = difference.kind == DifferenceKind::Reordered;
    JsonValue* object = &root;
    for (size_t i = 0; i + (is_list ? 0 : 1) < difference.path.size(); ++i) {
        object = member_of(*object, difference.path[i]);
        if (!object) {
            return does_not_fit(difference, fmt::format("there is no \"{}\"", difference.path[i]));
        }
    }
    if (is_list) return reorder(difference, *object);
    if (difference.kind == DifferenceKind::Added) return add(difference, *object);
    const std::string& key = difference.path.back();
    JsonValue* const value = member_of(*object, key);
    if (!value) return does_not_fit(difference, "it is not there");
    if (!same(*value, difference.before)) return does_not_fit(difference, "it is another one");
    if (difference.kind == DifferenceKind::Changed) {
        *value = difference.after;
    } else {
        std::erase_if(object->members, [&key](const JsonMember& m) { return m.key == key; });
    }
    return Status::done();
}

}  // namespace

std::string_view name_of(DifferenceKind kind) {
    switch (kind) {
        case DifferenceKind::Added:
            return "added";
        case DifferenceKind::Removed:
            return "removed";
        case DifferenceKind::Changed:
            return "changed";
        case DifferenceKind::Reordered:
            return "reordered";
    }
    return {};
}

bool is_place(const Difference& difference) {
    return !difference.path.empty() && difference.path.front() == "layout";
}

Result<JsonValue> read_plan_tree(std::string_view text, std::string_view path) {
    const PlanFile file = parse_plan(text, path);
    for (const Finding& finding : file.findings) {
        if (finding.severity != Severity::Error) continue;
        return Error{Code::BadInput,
                     at_place(path, {finding.line, finding.column}, finding.message)};
    }
    return parse_json(TRY(format_plan(text, path)), path);
}

Differences differences(const JsonValue& before, const JsonValue& after) {
    return Comparer().compare(before, after);
}

Result<JsonValue> apply_differences(const Differences& all, JsonValue before) {
    for (const Difference& one : all) TRY(apply_one(one, before));
    return before;
}

}  // namespace vagus::plan
