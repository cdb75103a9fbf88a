// The node of a board: the loop of section 3.6 of the specification around the machine of src/node,
// between the serial line and the memory that outlasts a restart. Knows its board only by
// board.hpp, and so runs in tests on a host, too.
//
//     start(the_firmware);  // the saved program runs, if there is one
//     for (;;) {
//         if (!turn(the_firmware)) board::sleep();
//     }
//
// Nothing here waits. An answer that is longer than the line takes at once goes in pieces, one a
// turn, and the next command is looked at behind it; events that find no room are dropped and
// counted.
#pragma once

#include <stdint.h>

#include "firmware/node/face.hpp"
#include "firmware/node/receiver.hpp"
#include "firmware/node/sender.hpp"
#include "firmware/node/store.hpp"
#include "node/node.hpp"

namespace vagus {
namespace firmware {

// Of a script in one turn: short enough that no byte is lost meanwhile; where something moves, so
// few that natives with the longest arguments do not keep a Stop waiting, nor the watchdog.
constexpr uint16_t kInstructionsAtOnce = kHasMotors ? 10 : 100;
// A script that is busy gets so many before the next event is looked at, as in most nodes of the
// reference (section 3.6).
constexpr uint16_t kInstructionsPerFrame = 1000;
// A piece of the variables, as robots with a small radio send them (section 1.3).
constexpr uint16_t kVariablesAtOnce = 47;
// No piece, and no answer to one command, is longer: a test looks at the whole description.
constexpr uint8_t kAnswerMax = 116;

// All zero at the start. Small things first: a Cortex-M reaches those with shorter instructions.
struct Firmware {
    node::Node node;
    uint8_t pending;       // local events, a bit for each
    bool restarts;         // once nothing is being saved
    bool was_halted;       // what the motors were told was ended; the script does not know yet
    uint16_t executed;     // instructions since the last frame
    uint16_t timer_began;  // when the timer fired last
    uint16_t buttons;      // as they were last looked at
    Receiver receiver;
    Store store;
    uint16_t breakpoints[vm::kBreakpointsMax];
    Sender sender;
};

// The one that there is: board.hpp has no objects either.
extern Firmware the_firmware;

void start(Firmware& firmware);
// True if there is more to do right now.
bool turn(Firmware& firmware);

}  // namespace firmware
}  // namespace vagus
