#include "serve/target/happened.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "serve/json.hpp"

namespace vagus::serve {

namespace {

Happened state_of(const debug::StateChanged& state) {
    const bool paused = state.state != debug::ProgramState::Running && state.at.line > 0;
    return {.kind = "state",
            .name = debug::name_of(state.state),
            .text = paused ? fmt::format("line {}", state.at.line) : "",
            .line = paused ? static_cast<uint32_t>(state.at.line) : 0};
}

Happened fault_of(const debug::Fault& fault) {
    const std::string place = fault.at.line > 0 ? fmt::format(" at line {}", fault.at.line) : "";
    return {.kind = "fault", .name = debug::name_of(fault.kind), .text = fault.text + place};
}

Happened event_of(const debug::UserEvent& sent) {
    return {.kind = "event", .name = shown_name(sent), .args = sent.arguments};
}

std::optional<Happened> happened_of(const debug::Happening& what, const std::string& source) {
    if (const auto* described = std::get_if<debug::NodeDescribed>(&what)) {
        return Happened{.kind = "appeared", .name = described->name};
    }
    if (std::holds_alternative<debug::NodeReconnected>(what)) {
        return Happened{.kind = "appeared", .name = source};
    }
    if (const auto* gone = std::get_if<debug::NodeDisconnected>(&what)) {
        return Happened{
            .kind = "gone", .name = source, .text = gone->forgotten ? "it said so" : ""};
    }
    if (const auto* state = std::get_if<debug::StateChanged>(&what)) return state_of(*state);
    if (const auto* fault = std::get_if<debug::Fault>(&what)) return fault_of(*fault);
    if (const auto* sent = std::get_if<debug::UserEvent>(&what)) return event_of(*sent);
    return std::nullopt;
}

}  // namespace

std::string shown_name(const debug::UserEvent& event) {
    return event.name.empty() ? fmt::format("event {}", event.number) : event.name;
}

std::optional<Happened> happened_of(const debug::Event& event, const std::string& source) {
    std::optional<Happened> happened = happened_of(event.what, source);
    if (!happened) return std::nullopt;
    happened->node = event.node;
    happened->source = source;
    return happened;
}

Happened loaded_now(uint16_t node, const std::string& source) {
    return {.kind = "loaded", .node = node, .source = source, .name = source};
}

Json happening_json(const Happened& happened) {
    return {{"t", happened.t},       {"wall", happened.wall},     {"kind", happened.kind},
            {"node", happened.node}, {"source", happened.source}, {"name", happened.name},
            {"args", happened.args}, {"text", happened.text}};
}

}  // namespace vagus::serve
