// What a node of this firmware tells about itself, the same on every board but for its name.
#pragma once

#include "node/description.hpp"

namespace vagus {
namespace firmware {

extern const node::Description kDescription[1];

// Where the variables lie, in words.
constexpr uint16_t kIdAt = 0;
constexpr uint16_t kArguments = 32;
constexpr uint16_t kDroppedAt = 2 + kArguments;
constexpr uint16_t kSkippedAt = kDroppedAt + 1;
constexpr uint16_t kLedsAt = kSkippedAt + 1;
constexpr uint16_t kButtonsAt = kLedsAt + 1;
constexpr uint16_t kPeriodAt = kButtonsAt + 1;

// Numbers of the local events.
constexpr uint8_t kTimerEvent = 0;
constexpr uint8_t kButtonsEvent = 1;
constexpr uint8_t kLocalEvents = 2;
constexpr uint8_t kVariables = 8;

}  // namespace firmware
}  // namespace vagus
