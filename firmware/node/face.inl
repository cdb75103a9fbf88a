// The tables of face.hpp; the file that includes this says which natives there are: VAGUS_NATIVES.
#include "firmware/board.hpp"
#include "firmware/node/face.hpp"
#include "isa/flash.hpp"
#include "wire/protocol.hpp"

namespace vagus {
namespace firmware {

namespace {

VAGUS_FLASH_TEXT(kId, "_id");
VAGUS_FLASH_TEXT(kSource, "event.source");
VAGUS_FLASH_TEXT(kArgs, "event.args");
VAGUS_FLASH_TEXT(kDropped, "_dropped");
VAGUS_FLASH_TEXT(kSkipped, "_skipped");
VAGUS_FLASH_TEXT(kLeds, "leds");
VAGUS_FLASH_TEXT(kButtons, "buttons");
VAGUS_FLASH_TEXT(kPeriod, "timer.period");
VAGUS_FLASH_TEXT(kProgram, "_program");
#if defined(VAGUS_MOTORS)
VAGUS_FLASH_TEXT(kLeft, "motor.left.target");
VAGUS_FLASH_TEXT(kRight, "motor.right.target");
#endif
VAGUS_FLASH_TABLE(node::Variable, kVariableTable, kVariables) = {
    {1, kId},      {1, kSource}, {kArguments, kArgs}, {1, kDropped},
    {1, kSkipped}, {1, kLeds},   {1, kButtons},       {1, kPeriod},
#if defined(VAGUS_MOTORS)
    {1, kLeft},    {1, kRight},
#endif
    {2, kProgram}};

VAGUS_FLASH_TEXT(kTimer, "timer");
VAGUS_FLASH_TEXT(kTimerSays, "every timer.period ms");
VAGUS_FLASH_TEXT(kButtonsSay, "pressed or let go");
#if defined(VAGUS_MOTORS)
VAGUS_FLASH_TEXT(kHalted, "halted");
VAGUS_FLASH_TEXT(kHaltedSays, "a stop ended what the motors did");
#endif
VAGUS_FLASH_TABLE(node::LocalEvent, kEventTable, kLocalEvents) = {
    {kTimer, kTimerSays},
    {kButtons, kButtonsSay},
#if defined(VAGUS_MOTORS)
    {kHalted, kHaltedSays},
#endif
};

}  // namespace

VAGUS_FLASH_TABLE(node::Description, kDescription, 1) = {{board::kName,
                                                          wire::kProtocolVersion,
                                                          node::LocalEventSource::OwnId,
                                                          kVariables,
                                                          kVariableTable,
                                                          kLocalEvents,
                                                          kEventTable,
                                                          {VAGUS_NATIVES, {nullptr, 0}},
 kProgramAt}};

}  // namespace firmware
}  // namespace vagus
