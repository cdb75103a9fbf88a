#include "plan/trace.hpp"

#include <fmt/format.h>

#include "base/json.hpp"
#include "base/seconds.hpp"

namespace vagus::plan {

namespace {

std::string json_of(const Value& value) {
    switch (value.type()) {
        case Type::Bool:
            return value.boolean() ? "true" : "false";
        case Type::Int:
            return std::to_string(value.integer());
        case Type::Float:
            return text_of(value.number());
        case Type::String:
            return json_quote(value.string());
        case Type::Object:
            break;
    }
    return "null";
}

// Appends the kind and what it adds.
class Members {
public:
    explicit Members(std::string& line) : line_(line) {}

    void operator()(const PlanStarted&) { kind("plan-start"); }
    void operator()(const PlanEnded& e) {
        kind("plan-end");
        text("result", name_of(e.result));
        if (e.result == PlanResult::Error) text("message", e.message);
    }
    void operator()(const ActorStarted& e) {
        kind("actor-start");
        text("actor", e.actor);
        raw("activation", std::to_string(e.activation));
        std::string in = "{";
        for (const auto& [name, value] : e.in) {
            in +=
                fmt::format("{}{}:{}", in.size() > 1 ? "," : "", json_quote(name), json_of(value));
        }
        raw("in", in + "}");
    }
    void operator()(const ActorEnded& e) {
        kind("actor-end");
        text("actor", e.actor);
        raw("activation", std::to_string(e.activation));
        text("state", e.state);
        text("target", e.target);
    }
    void operator()(const EventRaised& e) {
        kind("event");
        text("supervisor", e.supervisor);
        text("event", e.event);
        text("target", e.target);
        raw("global", e.global ? "true" : "false");
        raw("activation", std::to_string(e.activation));
    }
    void operator()(const ActorInterrupted& e) {
        kind("interrupted");
        text("actor", e.actor);
        raw("activation", std::to_string(e.activation));
        raw("ran", e.ran ? "true" : "false");
        raw("stop_us", std::to_string(e.stop.count()));
    }
    void operator()(const VariableWritten& e) {
        kind("write");
        text("variable", e.variable);
        raw("value", json_of(e.value));
        text("by", e.by);
    }
    void operator()(const CheckLate& e) {
        kind("late");
        text("supervisor", e.supervisor);
        raw("by_us", std::to_string(e.by.count()));
    }
    void operator()(const TextLogged& e) {
        kind("log");
        text("actor", e.actor);
        text("text", e.text);
    }
    void operator()(const ErrorFound& e) {
        kind("error");
        text("element", e.element);
        text("message", e.message);
    }
    void operator()(const PlanChanged&) { kind("change"); }

private:
    void kind(std::string_view name) { text("kind", name); }
    void text(std::string_view key, std::string_view value) { raw(key, json_quote(value)); }
    void raw(std::string_view key, std::string_view value) {
        line_ += fmt::format(",\"{}\":{}", key, value);
    }

    std::string& line_;
};

}  // namespace

std::string_view name_of(PlanResult result) {
    switch (result) {
        case PlanResult::Ok:
            return "OK";
        case PlanResult::Interrupted:
            return "Interrupted";
        case PlanResult::Error:
            break;
    }
    return "Error";
}

std::string format_trace(const TraceEvent& event, std::string_view robot) {
    std::string line(kTraceBegins);
    line += seconds_text(event.at);
    if (!robot.empty()) line += ",\"robot\":" + json_quote(robot);
    line += ",\"plan\":" + json_quote(event.plan);
    std::visit(Members(line), event.what);
    return line + "}";
}

}  // namespace vagus::plan
