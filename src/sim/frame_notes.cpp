#include "sim/frame_notes.hpp"

#include "wire/reports.hpp"

namespace vagus::sim {

std::optional<Emitted> emitted_in(const wire::Frame& frame) {
    if (!wire::is_user_event(frame.type)) return std::nullopt;
    return Emitted{wire::arguments_of<std::vector<int16_t>>(frame), frame.type};
}

// Of a script that is paused: one of which an event was killed continues.
std::optional<Fault> fault_in(const wire::Frame& frame) {
    wire::Fault fault;
    if (!wire::read_fault(frame, fault)) return std::nullopt;
    if (fault.kind == wire::FaultKind::Killed) return std::nullopt;
    char text[wire::kFaultTextMax];
    const uint16_t size = wire::write_fault_text(fault, text);
    return Fault{std::string(text, size), fault.pc};
}

}  // namespace vagus::sim
