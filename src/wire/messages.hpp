// The fields of every protocol message, and one layout() for each: reading and writing walk the
// same list, so they cannot drift apart (docs/spec/aseba-wire-and-vm.md, sections 2.2 to 2.4
// and 2.9).
//
//     wire::GetVariables ask{{{}, 3}, 0, 10};  // destination, start, length
//     wire::Frame frame;
//     if (wire::encode_message(ask, wire::kHostId, frame) != wire::Error::None) …
//
//     wire::NodePresent present;
//     if (wire::decode_message(frame, present) == wire::Error::None) use(present.version);
//
// Texts and byte runs in a decoded message point into the frame that it was read from.
#pragma once

#include <stdint.h>

#include "wire/bytes.hpp"
#include "wire/frame.hpp"
#include "wire/protocol.hpp"

namespace vagus {
namespace wire {

enum class Error : uint8_t {
    None,
    WrongType,      // the frame carries another message
    Truncated,      // the payload ends in the middle of a field
    TooLong,        // more than fits a frame, or more list items than the limit
    TrailingBytes,  // bytes after the last field
};

// Words to the end of the payload. An odd last byte is ignored, as nodes do.
struct Words {
    uint16_t count;
    int16_t values[kArgumentsMax];
};

// Bytes to the end of the payload, borrowed.
struct Bytes {
    const uint8_t* bytes;
    uint16_t size;
};

constexpr uint16_t kParametersMax = 32;  // parameters of one native function

struct Parameter {
    int16_t size;  // > 0 words; < 0 number of a template; 0 any size
    Text name;
};

template <MessageType kTheType>
struct Typed {
    static constexpr MessageType kType = kTheType;
};

// ---- node to host ----
struct Description : Typed<MessageType::Description> {
    Text name;
    uint16_t protocol_version, bytecode_size, stack_size, variables_size;  // sizes in words
    uint16_t variable_count, local_event_count, native_count;
};
struct NamedVariableDescription : Typed<MessageType::NamedVariableDescription> {
    uint16_t size;
    Text name;
};
struct LocalEventDescription : Typed<MessageType::LocalEventDescription> {
    Text name, doc;
};
struct NativeFunctionDescription : Typed<MessageType::NativeFunctionDescription> {
    Text name, doc;
    uint16_t parameter_count;
    Parameter parameters[kParametersMax];
};
struct Disconnected : Typed<MessageType::Disconnected> {};
struct Variables : Typed<MessageType::Variables> {
    uint16_t start;
    Words values;
};
struct ArrayAccessOutOfBounds : Typed<MessageType::ArrayAccessOutOfBounds> {
    uint16_t pc, size,
        index;  // deque natives of foreign nodes send only the pc (D3): then size and index are 0
};
struct DivisionByZero : Typed<MessageType::DivisionByZero> {
    uint16_t pc;
};
struct EventExecutionKilled : Typed<MessageType::EventExecutionKilled> {
    uint16_t pc;
};
struct NodeSpecificError : Typed<MessageType::NodeSpecificError> {
    uint16_t pc;
    Text text;
};
struct ExecutionStateChanged : Typed<MessageType::ExecutionStateChanged> {
    uint16_t pc, flags;
};
struct BreakpointSetResult : Typed<MessageType::BreakpointSetResult> {
    uint16_t pc, success;
};
struct NodePresent : Typed<MessageType::NodePresent> {
    uint16_t version;
};
struct DeviceInfo : Typed<MessageType::DeviceInfo> {
    uint8_t info;
    Text value;
};
struct ChangedVariables : Typed<MessageType::ChangedVariables> {
    Bytes areas;  // repeated: u16 start, u16 count, count words
};

// ---- host to all nodes ----
struct GetDescription : Typed<MessageType::GetDescription> {
    uint16_t version;
};
struct ListNodes : Typed<MessageType::ListNodes> {
    uint16_t version;
};

// ---- host to one node ----
template <MessageType kTheType>
struct Command : Typed<kTheType> {
    uint16_t dest;
};
struct SetBytecode : Command<MessageType::SetBytecode> {
    uint16_t start;
    Words words;
};
struct Reset : Command<MessageType::Reset> {};
struct Run : Command<MessageType::Run> {};
struct Pause : Command<MessageType::Pause> {};
struct Step : Command<MessageType::Step> {};
struct Stop : Command<MessageType::Stop> {};
struct GetExecutionState : Command<MessageType::GetExecutionState> {};
struct BreakpointSet : Command<MessageType::BreakpointSet> {
    uint16_t pc;
};
struct BreakpointClear : Command<MessageType::BreakpointClear> {
    uint16_t pc;
};
struct BreakpointClearAll : Command<MessageType::BreakpointClearAll> {};
struct GetVariables : Command<MessageType::GetVariables> {
    uint16_t start, length;
};
struct SetVariables : Command<MessageType::SetVariables> {
    uint16_t start;
    Words values;
};
struct WriteBytecode : Command<MessageType::WriteBytecode> {};
struct Reboot : Command<MessageType::Reboot> {};
struct SuspendToRam : Command<MessageType::SuspendToRam> {};
struct GetNodeDescription : Command<MessageType::GetNodeDescription> {
    uint16_t version;
};
struct GetDeviceInfo : Command<MessageType::GetDeviceInfo> {
    uint16_t info;
};
struct SetDeviceInfo : Command<MessageType::SetDeviceInfo> {
    uint16_t info, size;
    Bytes value;
};
struct GetChangedVariables : Command<MessageType::GetChangedVariables> {};
struct GetNodeDescriptionFragment : Command<MessageType::GetNodeDescriptionFragment> {
    uint16_t version;
    int16_t fragment;  // -1 only the header, -2 everything, k >= 0 the k-th item
};

// ---- bootloader (section 2.4) ----
struct BootloaderReset : Command<MessageType::BootloaderReset> {};
struct BootloaderReadPage : Command<MessageType::BootloaderReadPage> {
    uint16_t page;
};
struct BootloaderWritePage : Command<MessageType::BootloaderWritePage> {
    uint16_t page;
};
struct BootloaderPageDataWrite : Command<MessageType::BootloaderPageDataWrite> {
    Bytes bytes;  // 4
};
struct BootloaderDescription : Typed<MessageType::BootloaderDescription> {
    uint16_t page_size, first_page, page_count;
};
struct BootloaderPageDataRead : Typed<MessageType::BootloaderPageDataRead> {
    Bytes bytes;  // 4
};
struct BootloaderAck : Typed<MessageType::BootloaderAck> {
    uint16_t error, address;  // the address only with error 2
};

// Fills `message` from a frame that we do not trust. ArrayAccessOutOfBounds may be short, see
// there.
template <typename Message>
[[gnu::warn_unused_result]] Error decode_message(const Frame& frame, Message& message);

// Fills `frame`. Fails only if the fields do not fit a frame.
template <typename Message>
[[gnu::warn_unused_result]] Error encode_message(const Message& message, uint16_t source,
                                                 Frame& frame);

// The name of a message type as in messages.def, or nullptr for user events and unknown types.
const char* message_name(uint16_t type);

}  // namespace wire
}  // namespace vagus

#include "wire/layout.inl"
