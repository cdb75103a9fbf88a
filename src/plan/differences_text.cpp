// Differences of two plans as text for people, and as JSON.
#include <fmt/format.h>

#include "plan/differences.hpp"

namespace vagus::plan {

namespace {

using Path = std::vector<std::string>;

// An element and the part of it that a path leads to.
struct Part {
    std::string element;  // "actor drive", "supervisor touch of drive"; "plan"
    std::string part;     // "in.speed"; empty: the element itself
};

Part part_of(const Path& path) {
    size_t used = 0;
    Part part;
    const auto take = [&](const std::string& text, size_t count) {
        part.element = text;
        used = count;
    };
    const bool named = path.size() > 1;
    if (path.empty()) return {"plan", "keys"};
    if (path[0] == "configuration" && named) {
        take("variable " + path[1], 2);
    } else if (path[0] == "start" && path.size() > 2 && path[1] == "supervisors") {
        take("global supervisor " + path[2], 3);
    } else if (path[0] == "actors" && path.size() > 3 && path[2] == "supervisors") {
        take(fmt::format("supervisor {} of {}", path[3], path[1]), 4);
    } else if (path[0] == "actors" && named) {
        take("actor " + path[1], 2);
    } else {
        take("plan", 0);
    }
    part.part = fmt::format(
        "{}", fmt::join(path.begin() + static_cast<std::ptrdiff_t>(used), path.end(), "."));
    return part;
}

std::string one_line(const JsonValue& value) {
    switch (value.kind) {
        case JsonKind::Null:
            return "null";
        case JsonKind::Bool:
            return value.boolean ? "true" : "false";
        case JsonKind::Int:
        case JsonKind::Float:
            return value.text.empty() ? fmt::format("{}", value.number) : value.text;
        case JsonKind::String:
            return json_quote(value.text);
        case JsonKind::Array: {
            std::string text;
            for (const JsonValue& item : value.items) {
                text += (text.empty() ? "" : ", ") + one_line(item);
            }
            return "[" + text + "]";
        }
        case JsonKind::Object: {
            std::string text;
            for (const JsonMember& member : value.members) {
                text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", json_quote(member.key),
                                    one_line(member.value));
            }
            return "{" + text + "}";
        }
    }
    return {};
}

// A line for each part of a value that came or went; an empty object is a part of its own.
std::string lines(char sign, const std::string& part, const JsonValue& value) {
    const bool opens = value.kind == JsonKind::Object && !value.members.empty();
    if (!opens) return fmt::format("  {} {}: {}\n", sign, part, one_line(value));
    std::string text;
    for (const JsonMember& member : value.members) {
        text += lines(sign, part.empty() ? member.key : part + "." + member.key, member.value);
    }
    return text;
}

std::string order_line(char sign, const std::string& part, const JsonValue& names) {
    std::string text;
    for (const JsonValue& name : names.items) text += (text.empty() ? "" : ", ") + name.text;
    return fmt::format("  {} order of {}: {}\n", sign, part, text);
}

std::string lines_of(const Difference& one, const std::string& part) {
    switch (one.kind) {
        case DifferenceKind::Added:
            return lines('+', part, one.after);
        case DifferenceKind::Removed:
            return lines('-', part, one.before);
        case DifferenceKind::Changed:
            return lines('-', part, one.before) + lines('+', part, one.after);
        case DifferenceKind::Reordered:
            return order_line('-', part, one.before) + order_line('+', part, one.after);
    }
    return {};
}

// "+ actor turn": an element that is new as a whole.
std::string heading(const Difference& one, const Part& part) {
    const bool whole = part.part.empty();
    if (whole && one.kind == DifferenceKind::Added) return "+ " + part.element + "\n";
    if (whole && one.kind == DifferenceKind::Removed) return "- " + part.element + "\n";
    return part.element + "\n";
}

// How many elements stand elsewhere; the whole list may have come or gone.
size_t places_of(const Difference& one) {
    if (one.kind == DifferenceKind::Reordered) return 0;
    const JsonValue& spots = one.kind == DifferenceKind::Removed ? one.before : one.after;
    return one.path.size() == 1 ? spots.members.size() : 1;
}

}  // namespace

std::string format_text(const Differences& all, DifferencesText how) {
    std::string text;
    std::string above;
    size_t places = 0;
    for (const Difference& one : all) {
        if (is_place(one) && !how.places) {
            places += places_of(one);
            continue;
        }
        const Part part = part_of(one.path);
        const std::string head = heading(one, part);
        if (head != above) text += head;
        above = head;
        text += lines_of(one, part.part);
    }
    if (places > 0) {
        text += fmt::format("{} {} elsewhere (--places lists them)\n", places,
                            places == 1 ? "element stands" : "elements stand");
    }
    return text;
}

std::string format_json(const Differences& all) {
    std::string text = "[";
    for (const Difference& one : all) {
        std::string path;
        for (const std::string& key : one.path)
            path += (path.empty() ? "" : ", ") + json_quote(key);
        const Part part = part_of(one.path);
        text +=
            fmt::format("{}\n  {{\"kind\": \"{}\", \"element\": {}, \"part\": {}, \"path\": [{}]",
                        text.size() > 1 ? "," : "", name_of(one.kind), json_quote(part.element),
                        json_quote(part.part), path);
        if (one.kind != DifferenceKind::Added) text += ", \"before\": " + one_line(one.before);
        if (one.kind != DifferenceKind::Removed) text += ", \"after\": " + one_line(one.after);
        if (one.kind == DifferenceKind::Added) text += ", \"behind\": " + json_quote(one.behind);
        text += "}";
    }
    return text + (all.empty() ? "]\n" : "\n]\n");
}

}  // namespace vagus::plan
