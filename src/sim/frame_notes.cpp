#include "sim/frame_notes.hpp"

#include "wire/messages.hpp"

namespace vagus::sim {

std::optional<Emitted> emitted_in(const wire::Frame& frame) {
    if (!wire::is_user_event(frame.type)) return std::nullopt;
    Emitted emitted{{}, frame.type};
    for (size_t i = 0; i + 1 < frame.size; i += 2) {
        emitted.arguments.push_back(
            static_cast<int16_t>(frame.payload[i] | frame.payload[i + 1] << 8));
    }
    return emitted;
}

namespace {

template <typename Message, typename Say>
std::optional<Fault> fault_in(const wire::Frame& frame, const Say& say) {
    Message message;
    if (wire::decode_message(frame, message) != wire::Error::None) return std::nullopt;
    return Fault{say(message), message.pc};
}

}  // namespace

std::optional<Fault> fault_in(const wire::Frame& frame) {
    switch (static_cast<wire::MessageType>(frame.type)) {
        case wire::MessageType::DivisionByZero:
            return fault_in<wire::DivisionByZero>(
                frame, [](const auto&) { return std::string("division by zero"); });
        case wire::MessageType::ArrayAccessOutOfBounds:
            return fault_in<wire::ArrayAccessOutOfBounds>(frame, [](const auto& message) {
                return "index " + std::to_string(static_cast<int16_t>(message.index)) +
                       " of an array of " + std::to_string(message.size);
            });
        case wire::MessageType::NodeSpecificError:
            return fault_in<wire::NodeSpecificError>(frame, [](const auto& message) {
                return std::string(message.text.bytes, message.text.size);
            });
        default:  // all other messages are no faults
            return std::nullopt;
    }
}

}  // namespace vagus::sim
