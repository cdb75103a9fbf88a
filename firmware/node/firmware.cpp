#include "firmware/node/firmware.hpp"

#include "firmware/board.hpp"
#include "firmware/node/face.hpp"
#include "isa/flash.hpp"
#include "isa/isa.hpp"

namespace vagus {
namespace firmware {

namespace {

using wire::MessageType;

VAGUS_FLASH_TEXT(kSaved, "Flashing OK");

// Of Firmware::pending.
constexpr uint8_t kTimerBit = 1 << kTimerEvent;
constexpr uint8_t kButtonsBit = 1 << kButtonsEvent;
constexpr uint8_t kHaltedBit = 1 << kHaltedEvent;

Firmware& firmware_of(node::Node& node) {
    return *static_cast<Firmware*>(node.owner);
}

int16_t& variable(uint16_t at) {
    return board::kMachine.variables[at];
}

void count(uint16_t at, uint16_t more) {
    variable(at) = static_cast<int16_t>(static_cast<uint16_t>(variable(at)) + more);
}

bool can_run(const Firmware& firmware) {
    const uint16_t flags = firmware.node.vm.flags;
    return (flags & (wire::kFlagActive | wire::kFlagStep)) == wire::kFlagActive;
}

// Something drives this node: a program, and nobody has stopped it. After a fault, a breakpoint, a
// new program, Stop, Pause and Reset that is over until Run; while it is stepped, too.
bool is_in_command(const Firmware& firmware) {
    return (firmware.node.vm.flags & wire::kFlagStep) == 0 && board::kMachine.bytecode[0] != 0;
}

bool is_id(uint16_t id) {
    return id != wire::kHostId && id != wire::kInvalidId;
}

// ---- What the machine asks of its board ----

void begin(node::Node& node, uint16_t type) {
    begin_message(firmware_of(node).sender, node.vm.id, type);
}

void put(node::Node& node, uint8_t byte) {
    put_byte(firmware_of(node).sender, byte);
}

void end(node::Node& node) {
    if (!end_message(firmware_of(node).sender)) count(kDroppedAt, 1);
    board::start_sending();
}

// Another number that is written into `_id` and saved renames the node at its next start.
void save(Firmware& firmware) {
    const uint16_t wanted = static_cast<uint16_t>(variable(kIdAt));
    begin_save(firmware.store, is_id(wanted) ? wanted : firmware.node.vm.id,
               node::program(firmware.node));
}

void notify(node::Node& node, vm::Notice notice) {
    Firmware& firmware = firmware_of(node);
    if (notice == vm::Notice::WriteBytecode) save(firmware);
    if (notice == vm::Notice::Reboot) firmware.restarts = true;
}

const node::Board kBoard = {begin, put, end, notify, kVariablesAtOnce};

// ---- Frames ----

// A program that is being written is not the one that is being saved.
bool writes_program(const Firmware& firmware, const Received& frame) {
    return frame.type == static_cast<uint16_t>(MessageType::SetBytecode) && frame.count > 0 &&
           frame.words[0] == firmware.node.vm.id;
}

// A command waits in the receiver until what was asked before it is answered, and there is room for
// its own answer; an event, until a script that is busy had its time. True if a frame was taken:
// then there may be more.
[[gnu::noinline]] bool take_frame(Firmware& firmware, uint16_t now_ms) {
    const bool has_room_to_answer = has_room(firmware.sender, kAnswerMax);
    if ((has_room_to_answer || node::is_counting(firmware.node)) &&
        node::is_answering(firmware.node)) {
        node::answer(firmware.node);
    }
    if (!next_frame(firmware.receiver, now_ms)) return false;
    const Received frame = front(firmware.receiver);
    const bool is_command = frame.type >= kCommands;
    const bool can_answer = has_room_to_answer && !node::is_answering(firmware.node);
    if (is_command && !can_answer) return false;
    if (!is_command && can_run(firmware) && firmware.executed < kInstructionsPerFrame) return false;
    firmware.executed = 0;
    if (writes_program(firmware, frame)) end_save(firmware.store);
    node::begin_receive(firmware.node, frame.source, frame.type, frame.words, frame.count);
    drop_front(firmware.receiver, now_ms);
    return true;
}

// ---- What the board feels ----

void look_at_timer(Firmware& firmware, uint16_t now_ms) {
    const int16_t period = variable(kPeriodAt);
    const uint16_t elapsed = static_cast<uint16_t>(now_ms - firmware.timer_began);
    if (period > 0 && elapsed < static_cast<uint16_t>(period)) return;
    firmware.timer_began = now_ms;
    if (period > 0) firmware.pending |= kTimerBit;
}

void look_at_buttons(Firmware& firmware) {
    const uint16_t buttons = board::buttons();
    if (buttons == firmware.buttons) return;
    firmware.buttons = buttons;
    variable(kButtonsAt) = static_cast<int16_t>(buttons);
    firmware.pending |= kButtonsBit;
}

// What is told to the motors while nothing is in command is over at once and for good: the variable
// itself is 0 again, so only what is written afterwards moves anything.
void look_at_motors(Firmware& firmware) {
    int16_t* const targets = &variable(kMotorsAt);
    if (is_in_command(firmware)) {
        if (firmware.was_halted) firmware.pending |= kHaltedBit;
        firmware.was_halted = false;
    } else if ((targets[0] | targets[1]) != 0) {
        firmware.was_halted = true;
        targets[0] = targets[1] = 0;
    }
    board::set_motors(targets[0], targets[1]);
}

void raise(Firmware& firmware, uint8_t bit, uint8_t event) {
    firmware.pending = static_cast<uint8_t>(firmware.pending ^ bit);
    node::local_event(firmware.node, event);
}

void run_script(Firmware& firmware) {
    const uint16_t done = node::run(firmware.node, kInstructionsAtOnce);
    if (firmware.executed < kInstructionsPerFrame) {
        firmware.executed = static_cast<uint16_t>(firmware.executed + done);
    }
    // Also while it is paused, local events wait.
    if (firmware.pending == 0 || vm::is_active(firmware.node.vm)) return;
    if ((firmware.pending & kTimerBit) != 0) return raise(firmware, kTimerBit, kTimerEvent);
    if (kHasMotors && (firmware.pending & kHaltedBit) != 0) {
        return raise(firmware, kHaltedBit, kHaltedEvent);
    }
    raise(firmware, kButtonsBit, kButtonsEvent);
}

void keep(Firmware& firmware) {
    if (!firmware.store.is_saving) {
        if (firmware.restarts) board::restart();
        return;
    }
    if (save_step(firmware.store)) node::report(firmware.node, kSaved);
}

}  // namespace

Firmware the_firmware;

void start(Firmware& firmware) {
    board::begin();
    node::init(firmware.node, board::kMachine, *kDescription, kBoard, &firmware);
    uint32_t program = 0;
    uint16_t id = load(firmware.store, program);
    node::identify_as(firmware.node, program);
    if (!is_id(id)) id = board::first_id();
    if (!is_id(id)) id = 1;
    firmware.node.vm.id = id;
    variable(kIdAt) = static_cast<int16_t>(id);
    if (board::kMachine.bytecode[0] != 0) node::start_program(firmware.node);
}

bool turn(Firmware& firmware) {
    const uint16_t now_ms = board::now_ms();
    const bool took_frame = take_frame(firmware, now_ms);
    look_at_timer(firmware, now_ms);
    look_at_buttons(firmware);
    run_script(firmware);
    if (kHasMotors) look_at_motors(firmware);
    count(kSkippedAt, firmware.receiver.skipped);
    firmware.receiver.skipped = 0;
    board::show_leds(static_cast<uint16_t>(variable(kLedsAt)));
    keep(firmware);
    return took_frame || node::is_counting(firmware.node) || can_run(firmware) ||
           firmware.store.is_saving || firmware.restarts ||
           (firmware.pending != 0 && !vm::is_active(firmware.node.vm));
}

}  // namespace firmware
}  // namespace vagus
