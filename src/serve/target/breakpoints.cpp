#include "serve/target/breakpoints.hpp"

#include "serve/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace vagus::serve {

static constexpr int kLineMax = 10'000'000;  // as the protocol has it

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

bool ScriptBreakpoints::follow(const std::string& doc, const LineMap& lines) {
    bool changed = false;
    std::set<int> taken;
    std::vector<ScriptBreakpoint> kept;
    for (ScriptBreakpoint& one : all_) {
        const auto line = one.doc == doc ? lines.after(one.line) : one.line;
        // Two that have come to one line are one.
        const bool stays = line && (one.doc != doc || taken.insert(*line).second);
        changed |= !stays || *line != one.line;
        if (!stays) continue;
        one.line = *line;
        kept.push_back(std::move(one));
    }
    all_ = std::move(kept);
    return changed;
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
            !json.contains("line") || !json["line"].is_number_unsigned() || json["line"] < 1 ||
            json["line"] > kLineMax) {
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
