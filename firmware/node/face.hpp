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

// A board that has two motors is built with VAGUS_MOTORS (tools/firmware_build).
#if defined(VAGUS_MOTORS)
constexpr bool kHasMotors = true;
#else
constexpr bool kHasMotors = false;
#endif
constexpr uint16_t kMotorsAt = kPeriodAt + 1;  // left, then right
constexpr uint16_t kMotors = kHasMotors ? 2 : 0;
constexpr uint16_t kProgramAt = kMotorsAt + kMotors;

// Numbers of the local events.
constexpr uint8_t kTimerEvent = 0;
constexpr uint8_t kButtonsEvent = 1;
constexpr uint8_t kHaltedEvent = 2;
constexpr uint8_t kLocalEvents = kHasMotors ? 3 : 2;
constexpr uint8_t kVariables = 9 + kMotors;

}  // namespace firmware
}  // namespace vagus
