// Numbers of the Aseba wire protocol, version 5 (docs/spec/aseba-wire-and-vm.md, sections 1 and 2).
// Freestanding: nodes on microcontrollers use this header too.
#pragma once

#include <stdint.h>

namespace vagus {
namespace wire {

enum class MessageType : uint16_t {
#define MESSAGE(name, type, sender) name = type,
#include "wire/messages.def"
#undef MESSAGE
};

constexpr uint16_t kProtocolVersion = 5;     // what Vagus nodes announce
constexpr uint16_t kProtocolVersionMin = 4;  // hosts accept nodes from here …
constexpr uint16_t kProtocolVersionMax =
    9;  // … to here (versions 6 to 9: the later fork, section 2.1)

constexpr uint16_t kDefaultPort = 33333;

constexpr uint16_t kHeaderSize = 6;    // bytes: length, source, type
constexpr uint16_t kPayloadMax = 516;  // bytes
constexpr uint16_t kFrameMax = kHeaderSize + kPayloadMax;
constexpr uint16_t kArgumentsMax = 258;            // words of a user event
constexpr uint16_t kBytecodeWordsMax = 256;        // words in one SetBytecode
constexpr uint16_t kVariablesReplyWordsMax = 257;  // words in one Variables reply
constexpr uint16_t kSetVariablesWordsMax = 256;    // words in one SetVariables

constexpr uint16_t kHostId = 0;  // source of frames from hosts
constexpr uint16_t kInvalidId = 0xffff;

constexpr bool is_user_event(uint16_t type) {
    return type < 0x8000;
}
// Has a destination as first payload word (section 2.1). The range is that of fork M, which
// contains that of C and D.
constexpr bool is_command(uint16_t type) {
    return (type >= 0x8000 && type <= 0x8003) ||
           (type >= 0xa001 && type <= 0xa015 && type != 0xa011);
}

// Flags of ExecutionStateChanged, and of the VM itself (section 3.2).
constexpr uint16_t kFlagActive = 1;   // an event is being executed
constexpr uint16_t kFlagStep = 2;     // paused: step by step
constexpr uint16_t kFlagRunning = 4;  // inside the run loop; may be left set after a breakpoint

}  // namespace wire
}  // namespace vagus
