#include "serve/robot/breakpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace vagus::serve {

using Json = nlohmann::json;

ScriptBreakpoint* ScriptBreakpoints::find(const std::string& doc, int line) {
    for (ScriptBreakpoint& one : all_) {
        if (one.doc == doc && one.line == line) return &one;
    }
    return nullptr;
}

Result<ScriptBreakpoint*> ScriptBreakpoints::set(const std::string& doc, int line) {
    if (ScriptBreakpoint* found = find(doc, line)) return found;
    if (all_.size() >= kBreakpointsMax) {
        return Error{Code::Limit,
                     fmt::format("there are {} breakpoints; remove some first", kBreakpointsMax)};
    }
    ScriptBreakpoint made;
    made.doc = doc;
    made.line = line;
    all_.push_back(std::move(made));
    return &all_.back();
}

void ScriptBreakpoints::clear(const std::optional<std::string>& doc, std::optional<int> line) {
    std::erase_if(all_, [&](const ScriptBreakpoint& one) {
        return (!doc || one.doc == *doc) && (!line || one.line == *line);
    });
}

Status ScriptBreakpoints::set_once(const std::string& doc, int line) {
    if (find(doc, line)) return Status::done();
    TRY(set(doc, line))->once = true;
    return Status::done();
}

bool ScriptBreakpoints::clear_once() {
    return std::erase_if(all_, [](const ScriptBreakpoint& one) { return one.once; }) > 0;
}

bool ScriptBreakpoints::waits_for_once() const {
    return std::any_of(all_.begin(), all_.end(), [](const ScriptBreakpoint& one) {
        return one.once && !one.set && one.why.empty();
    });
}

void ScriptBreakpoints::move_lines(const std::string& doc, int at, int lines) {
    for (ScriptBreakpoint& one : all_) {
        if (one.doc == doc && one.line >= at) one.line = std::max(at, one.line + lines);
    }
    // Two that have come to one line are one.
    for (size_t i = 0; i < all_.size(); ++i) {
        const ScriptBreakpoint first = all_[i];
        all_.erase(std::remove_if(all_.begin() + static_cast<std::ptrdiff_t>(i) + 1, all_.end(),
                                  [&](const ScriptBreakpoint& other) {
                                      return other.doc == first.doc && other.line == first.line;
                                  }),
                   all_.end());
    }
}

void ScriptBreakpoints::rename(const std::string& from, const std::string& to) {
    for (ScriptBreakpoint& one : all_) {
        const std::string rest = one.doc.substr(std::min(from.size(), one.doc.size()));
        const bool meant = one.doc.starts_with(from) &&
                           (rest.empty() || rest.front() == '#' || rest.front() == '/');
        if (meant) one.doc = to + rest;
    }
}

Json ScriptBreakpoints::to_json() const {
    Json list = Json::array();
    for (const ScriptBreakpoint& one : all_) {
        if (one.once) continue;
        Json json = {{"doc", one.doc}, {"line", one.line}};
        if (!one.condition.empty()) json["condition"] = one.condition;
        if (one.ignore > 0) json["ignore"] = one.ignore;
        if (!one.enabled) json["enabled"] = false;
        list.push_back(std::move(json));
    }
    return list;
}

// What does not fit was not written by us and is passed over.
void ScriptBreakpoints::from_json(const Json& kept) {
    if (!kept.is_array()) return;
    for (const Json& json : kept) {
        if (!json.is_object() || !json.contains("doc") || !json["doc"].is_string() ||
            !json.contains("line") || !json["line"].is_number_unsigned()) {
            continue;
        }
        const auto made = set(json["doc"], json["line"]);
        if (!made.ok()) return;
        ScriptBreakpoint& one = *made.value();
        if (json.contains("condition") && json["condition"].is_string()) {
            one.condition = json["condition"];
        }
        if (json.contains("ignore") && json["ignore"].is_number_unsigned()) {
            one.ignore = json["ignore"];
        }
        one.enabled = !json.contains("enabled") || json["enabled"] != false;
    }
}

}  // namespace vagus::serve
