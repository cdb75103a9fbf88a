#include "serve/history/trace_line.hpp"

#include <fmt/format.h>

#include "base/seconds.hpp"
#include "serve/json.hpp"
#include "serve/plan_value.hpp"

namespace vagus::serve {

namespace {

constexpr double kTimeMax = 1e12;  // seconds; what comes later never comes (docs/plans.md)
constexpr int64_t kDurationMax = 1'000'000'000'000'000;

// A member that is missing or of another type reads as empty: no line of a file may do harm.
std::string_view text_in(const Json& line, const char* key) {
    const auto found = line.find(key);
    if (found == line.end() || !found->is_string()) return {};
    return found->get_ref<const std::string&>();
}

uint64_t count_in(const Json& line, const char* key) {
    const auto found = line.find(key);
    return found != line.end() && found->is_number_unsigned() ? found->get<uint64_t>() : 0;
}

bool is_set(const Json& line, const char* key) {
    const auto found = line.find(key);
    return found != line.end() && found->is_boolean() && found->get<bool>();
}

Duration duration_in(const Json& line, const char* key) {
    const auto found = line.find(key);
    if (found == line.end() || !found->is_number_integer()) return Duration{};
    const auto ticks = found->get<int64_t>();
    return Duration(std::min(std::max(ticks, -kDurationMax), kDurationMax));
}

plan::PlanResult result_of(std::string_view name) {
    for (const auto result : {plan::PlanResult::Ok, plan::PlanResult::Interrupted}) {
        if (plan::name_of(result) == name) return result;
    }
    return plan::PlanResult::Error;
}

plan::ActorStarted start_of(const Json& line) {
    plan::ActorStarted start{text_in(line, "actor"), count_in(line, "activation"), {}};
    const auto in = line.find("in");
    if (in == line.end() || !in->is_object()) return start;
    for (auto one = in->begin(); one != in->end(); ++one) {
        start.in.emplace_back(std::string_view(one.key()), plan_value(one.value()));
    }
    return start;
}

}  // namespace

Result<TraceLine> TraceLine::read(std::string_view text) {
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) {
        return Error{Code::BadInput, "expected a line of a trace, {\"t\":…,\"plan\":…,\"kind\":…}"};
    }
    const auto t = json.find("t");
    const bool timed =
        t != json.end() && t->is_number() && t->get<double>() >= 0 && t->get<double>() <= kTimeMax;
    if (!timed) {
        return Error{Code::BadInput,
                     "expected “t”, the seconds since the start of the run: a number from 0 on"};
    }
    for (const char* key : {"plan", "kind"}) {
        if (!text_in(json, key).empty()) continue;
        return Error{Code::BadInput, fmt::format("expected “{}”, a text", key)};
    }
    return TraceLine(std::move(json));
}

std::optional<plan::TraceEvent> TraceLine::event() const {
    const std::string_view kind = text_in(json_, "kind");
    plan::TraceEvent event;
    event.at = from_seconds(t());
    event.plan = std::string(text_in(json_, "plan"));
    if (kind == "plan-start") {
        event.what = plan::PlanStarted{};
    } else if (kind == "plan-end") {
        event.what = plan::PlanEnded{result_of(text_in(json_, "result")),
                                     std::string(text_in(json_, "message"))};
    } else if (kind == "actor-start") {
        event.what = start_of(json_);
    } else if (kind == "actor-end") {
        event.what = plan::ActorEnded{text_in(json_, "actor"), count_in(json_, "activation"),
                                      text_in(json_, "state"), text_in(json_, "target")};
    } else if (kind == "event") {
        event.what = plan::EventRaised{text_in(json_, "supervisor"), text_in(json_, "event"),
                                       text_in(json_, "target"), is_set(json_, "global"),
                                       count_in(json_, "activation")};
    } else if (kind == "interrupted") {
        event.what = plan::ActorInterrupted{text_in(json_, "actor"), count_in(json_, "activation"),
                                            is_set(json_, "ran"), duration_in(json_, "stop_us")};
    } else if (kind == "write") {
        const auto value = json_.find("value");
        event.what = plan::VariableWritten{text_in(json_, "variable"),
                                           plan_value(value == json_.end() ? Json() : *value),
                                           text_in(json_, "by")};
    } else if (kind == "late") {
        event.what = plan::CheckLate{text_in(json_, "supervisor"), duration_in(json_, "by_us")};
    } else if (kind == "log") {
        event.what = plan::TextLogged{text_in(json_, "actor"), std::string(text_in(json_, "text"))};
    } else if (kind == "error") {
        event.what =
            plan::ErrorFound{text_in(json_, "element"), std::string(text_in(json_, "message"))};
    } else if (kind == "change") {
        event.what = plan::PlanChanged{};  // a line does not say to what
    } else {
        return std::nullopt;
    }
    return event;
}

}  // namespace vagus::serve
