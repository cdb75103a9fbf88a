#include "serve/run/plan_breakpoints.hpp"

#include "serve/json.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vagus::serve {

namespace {

constexpr auto& kKinds = talk::Words<talk::BreakpointKind>::kAll;

talk::BreakpointKind breakpoint_kind_of(const std::string& word) {
    const auto found = std::find(std::begin(kKinds), std::end(kKinds), word);
    return static_cast<talk::BreakpointKind>(found - std::begin(kKinds));
}

bool same_place(const PlanBreakpoint& one, const PlanBreakpoint& other) {
    if (one.doc != other.doc || one.kind != other.kind) return false;
    if (one.kind == "condition") return one.condition == other.condition;
    return one.element == other.element && one.outcome == other.outcome;
}

std::string text_of(const Json& json, const char* key) {
    return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

}  // namespace

PlanBreakpoint* PlanBreakpoints::find(const PlanBreakpoint& wanted) {
    for (PlanBreakpoint& one : all_) {
        if (wanted.number > 0 ? one.number == wanted.number : same_place(one, wanted)) return &one;
    }
    return nullptr;
}

bool PlanBreakpoints::stands_at(const PlanBreakpoint& place) const {
    return std::any_of(all_.begin(), all_.end(),
                       [&](const PlanBreakpoint& one) { return same_place(one, place); });
}

bool PlanBreakpoints::has_condition(const PlanBreakpoint& wanted) const {
    return std::any_of(all_.begin(), all_.end(), [&](const PlanBreakpoint& one) {
        const bool meant =
            wanted.number > 0 ? one.number == wanted.number : same_place(one, wanted);
        return meant && one.condition == wanted.condition;
    });
}

Result<PlanBreakpoint*> PlanBreakpoints::set(const PlanBreakpoint& wanted) {
    const bool lacks_condition = wanted.kind == "condition" && wanted.condition.empty();
    if (lacks_condition) {
        return Error{Code::BadInput, "a breakpoint on a condition needs one, as distance < 5"};
    }
    const bool lacks_element = wanted.kind != "condition" && wanted.element.empty();
    if (lacks_element) {
        return Error{Code::BadInput, fmt::format("a breakpoint on {} {} needs the name of the {}",
                                                 wanted.kind == "actor" ? "an" : "the", wanted.kind,
                                                 wanted.kind == "event" ? "supervisor" : "actor")};
    }
    PlanBreakpoint* found = find(wanted);
    if (!found && wanted.number > 0) {
        return Error{Code::NotFound, fmt::format("there is no breakpoint {} any more; set it again",
                                                 wanted.number)};
    }
    if (!found && all_.size() >= kPlanBreakpointsMax) {
        return Error{Code::Limit,
                     fmt::format("there are {} breakpoints of plans; remove some first",
                                 kPlanBreakpointsMax)};
    }
    if (!found) found = &all_.emplace_back();
    const uint64_t number = found->number > 0 ? found->number : ++last_;
    *found = wanted;
    found->number = number;
    return found;
}

void PlanBreakpoints::clear(std::optional<uint64_t> number, const std::optional<std::string>& doc) {
    std::erase_if(all_, [&](const PlanBreakpoint& one) {
        return (!number || one.number == *number) && (!doc || one.doc == *doc);
    });
}

void PlanBreakpoints::rename(const std::string& from, const std::string& to) {
    for (PlanBreakpoint& one : all_) {
        const std::string rest = one.doc.substr(std::min(from.size(), one.doc.size()));
        const bool meant = one.doc.starts_with(from) && (rest.empty() || rest.front() == '/');
        if (meant) one.doc = to + rest;
    }
}

std::vector<talk::BreakpointOrder> PlanBreakpoints::orders(
    const std::function<std::string(const std::string& doc)>& path_of) const {
    std::vector<talk::BreakpointOrder> list;
    for (const PlanBreakpoint& one : all_) {
        list.push_back({.number = one.number,
                        .plan = path_of(one.doc),
                        .kind = breakpoint_kind_of(one.kind),
                        .element = one.element,
                        .outcome = one.outcome,
                        .condition = one.condition,
                        .stop_at = one.stop_at,
                        .enabled = one.enabled});
    }
    return list;
}

bool PlanBreakpoints::note(const std::vector<talk::BreakpointNow>& list) {
    const Json before = this->list();
    for (PlanBreakpoint& one : all_) one.set = false;
    for (const talk::BreakpointNow& told : list) {
        for (PlanBreakpoint& one : all_) {
            if (told.number != one.number) continue;
            one.hits = told.hits;
            one.set = told.set;
            one.why = told.why;
        }
    }
    return this->list() != before;
}

Json PlanBreakpoints::list() const {
    Json list = Json::array();
    for (const PlanBreakpoint& one : all_) {
        Json json = {{"number", one.number},   {"doc", one.doc},
                     {"kind", one.kind},       {"element", one.element},
                     {"outcome", one.outcome}, {"condition", one.condition},
                     {"stop_at", one.stop_at}, {"enabled", one.enabled},
                     {"hits", one.hits},       {"set", one.set}};
        if (!one.why.empty()) json["why"] = one.why;
        list.push_back(std::move(json));
    }
    return list;
}

Json PlanBreakpoints::to_json() const {
    Json list = Json::array();
    for (const PlanBreakpoint& one : all_) {
        Json json = {{"doc", one.doc}, {"kind", one.kind}};
        if (!one.element.empty()) json["element"] = one.element;
        if (!one.outcome.empty()) json["outcome"] = one.outcome;
        if (!one.condition.empty()) json["condition"] = one.condition;
        if (one.stop_at > 1) json["stop_at"] = one.stop_at;
        if (!one.enabled) json["enabled"] = false;
        list.push_back(std::move(json));
    }
    return list;
}

// What does not fit was not written by us and is passed over.
void PlanBreakpoints::from_json(const Json& kept) {
    if (!kept.is_array()) return;
    for (const Json& json : kept) {
        if (!json.is_object()) continue;
        PlanBreakpoint one;
        one.doc = text_of(json, "doc");
        one.kind = text_of(json, "kind");
        one.element = text_of(json, "element");
        one.outcome = text_of(json, "outcome");
        one.condition = text_of(json, "condition");
        if (json.contains("stop_at") && json["stop_at"].is_number_unsigned()) {
            one.stop_at = std::max<uint64_t>(1, json["stop_at"]);
        }
        one.enabled = !json.contains("enabled") || json["enabled"] != false;
        const bool known =
            std::find(std::begin(kKinds), std::end(kKinds), one.kind) != std::end(kKinds);
        if (known && !one.doc.empty()) (void)set(one).ok();
    }
}

}  // namespace vagus::serve
