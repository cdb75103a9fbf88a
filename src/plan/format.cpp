// The saved form of a plan file: the format's keys in its order, names as they are.
#include <algorithm>

#include "base/json.hpp"
#include "plan/file.hpp"
#include "plan/keys.hpp"

namespace vagus::plan {

namespace {

void order_by(JsonValue& object, Keys keys) {
    const auto rank = [keys](const JsonMember& member) {
        return std::find(keys.begin(), keys.end(), member.key) - keys.begin();
    };
    std::stable_sort(
        object.members.begin(), object.members.end(),
        [&rank](const JsonMember& a, const JsonMember& b) { return rank(a) < rank(b); });
}

JsonValue* find(JsonValue& object, std::string_view key) {
    for (JsonMember& member : object.members) {
        if (member.key == key) return &member.value;
    }
    return nullptr;
}

void order_supervisors(JsonValue& holder) {
    JsonValue* supervisors = find(holder, "supervisors");
    if (!supervisors) return;
    for (JsonMember& supervisor : supervisors->members) {
        order_by(supervisor.value, kSupervisorKeys);
    }
}

void order_plan(JsonValue& plan) {
    order_by(plan, kPlanKeys);
    if (JsonValue* configuration = find(plan, "configuration")) {
        for (JsonMember& variable : configuration->members) order_by(variable.value, kVariableKeys);
    }
    if (JsonValue* start = find(plan, "start")) {
        order_by(*start, kStartKeys);
        order_supervisors(*start);
    }
    if (JsonValue* actors = find(plan, "actors")) {
        for (JsonMember& actor : actors->members) {
            order_by(actor.value, kActorKeys);
            order_supervisors(actor.value);
        }
    }
}

}  // namespace

Result<std::string> format_plan(std::string_view text, std::string_view path) {
    const PlanFile file = parse_plan(text, path);
    if (!file.readable) {
        const Finding& first = file.findings.front();
        return Error{Code::BadInput, at_place(path, {first.line, first.column}, first.message)};
    }
    JsonValue json = TRY(parse_json(text, path));
    order_plan(json);
    return format_json(json);
}

}  // namespace vagus::plan
