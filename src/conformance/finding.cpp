#include "conformance/finding.hpp"

#include "base/text.hpp"
#include "wire/reports.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

constexpr size_t kValuesShown = 24;

std::string words_of(const wire::Frame& frame) {
    std::string text;
    for (uint16_t i = 0; i < wire::argument_count(frame); i++)
        text += " " + std::to_string(static_cast<uint16_t>(wire::argument(frame, i)));
    return text;
}

std::string text_of_error(const wire::Frame& frame) {
    wire::NodeSpecificError error;
    if (wire::decode_message(frame, error) != wire::Error::None) return " (malformed)";
    const std::string said(error.text.bytes, error.text.size);
    return " " + std::to_string(error.pc) + " \"" + visible(said) + "\"";
}

}  // namespace

std::string text_of(const Values& values) {
    std::string text;
    for (size_t i = 0; i < values.size() && i < kValuesShown; i++)
        text += (i > 0 ? ", " : "") + std::to_string(values[i]);
    if (values.size() > kValuesShown) text += ", … (" + std::to_string(values.size()) + " in all)";
    return text;
}

std::string text_of_flags(uint16_t flags) {
    const bool active = (flags & wire::kFlagActive) != 0;
    const bool step = (flags & wire::kFlagStep) != 0;
    const char* const meaning = active ? (step ? "paused in an event" : "in an event")
                                       : (step ? "stopped" : "waiting for events");
    return std::string(meaning) + " (" + std::to_string(flags) + ")";
}

std::string text_of(const wire::Frame& frame) {
    if (wire::is_user_event(frame.type)) {
        return "event " + std::to_string(frame.type) + " (" +
               text_of(wire::arguments_of<Values>(frame)) + ")";
    }
    const char* const name = wire::message_name(frame.type);
    std::string text = name == nullptr ? "message " + std::to_string(frame.type) : name;
    const bool error = frame.type == static_cast<uint16_t>(MessageType::NodeSpecificError);
    text += error ? text_of_error(frame) : words_of(frame);
    if (!error && frame.size % 2 != 0) text += " and a byte";
    return text;
}

}  // namespace vagus::conformance
