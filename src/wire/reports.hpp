// What frames tell people: the arguments of a user event, and the faults of scripts. Read here and
// nowhere else. Freestanding.
//
//     if (is_user_event(frame.type)) show(arguments_of<std::vector<int16_t>>(frame));
//     Fault fault;
//     if (read_fault(frame, fault)) {
//         char text[kFaultTextMax];
//         show(fault.pc, std::string_view(text, write_fault_text(fault, text)));
//     }
#pragma once

#include "wire/messages.hpp"

namespace vagus {
namespace wire {

// ---- events ----

// An odd last byte does not count.
inline uint16_t argument_count(const Frame& event) {
    return static_cast<uint16_t>(event.size / 2);
}
inline int16_t argument(const Frame& event, uint16_t index) {
    const uint8_t* const at = event.payload + 2 * index;
    return static_cast<int16_t>(static_cast<uint16_t>(at[0] | (at[1] << 8)));
}
// `Words` is a std::vector<int16_t> or the like.
template <typename Words>
Words arguments_of(const Frame& event) {
    Words words;
    for (uint16_t i = 0; i < argument_count(event); ++i) words.push_back(argument(event, i));
    return words;
}
// Behind those that are there; at most kArgumentsMax in all.
inline void add_argument(Frame& event, int16_t word) {
    event.payload[event.size] = static_cast<uint8_t>(word & 0xff);
    event.payload[event.size + 1] = static_cast<uint8_t>((word >> 8) & 0xff);
    event.size = static_cast<uint16_t>(event.size + 2);
}

// ---- faults ----

enum class FaultKind : uint8_t {
    ArrayAccess,
    DivisionByZero,
    Killed,        // an event was still being worked on when the next one came: the script goes on
    NodeSpecific,  // with a text of the node; reports that are no faults come as this, too (2.3)
};

struct Fault {
    FaultKind kind;
    uint16_t pc;
    uint16_t size;  // ArrayAccess: of the array; 0 if the node did not say
    int16_t index;  // ArrayAccess
    Text text;      // NodeSpecific: borrowed from the frame
};

// False if the frame is no fault, or is malformed.
bool read_fault(const Frame& frame, Fault& fault);

// One sentence without the place, into room for kFaultTextMax bytes; gives its size.
constexpr uint16_t kFaultTextMax = 256;
uint16_t write_fault_text(const Fault& fault, char* text);

}  // namespace wire
}  // namespace vagus
