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

constexpr int16_t kHeaderFragment = -1;  // section 2.9
constexpr int16_t kAllFragments = -2;
constexpr uint16_t kLastVersionAskedByBroadcast = 4;  // section 2.1

Firmware& firmware_of(node::Node& node) {
    return *static_cast<Firmware*>(node.owner);
}

int16_t& variable(uint16_t at) {
    return board::kMemory.variables[at];
}

bool can_run(const Firmware& firmware) {
    const uint16_t flags = firmware.node.vm.flags;
    return (flags & (wire::kFlagActive | wire::kFlagStep)) == wire::kFlagActive;
}

bool is_id(uint16_t id) {
    return id != wire::kHostId && id != wire::kInvalidId;
}

// ---- What the machine asks of its board ----

void transmit(node::Node& node, const wire::Frame& frame) {
    queue(firmware_of(node).sender, frame);
    board::start_sending();
}

// Who writes another number into `_id` and saves, names the node anew from its next start on.
void save(Firmware& firmware) {
    const uint16_t wanted = static_cast<uint16_t>(variable(kIdAt));
    const uint16_t id = is_id(wanted) ? wanted : firmware.config.id;
    begin_save(firmware.store, board::kMemory.bytecode, firmware.program_words, id);
}

void notify(node::Node& node, vm::Notice notice) {
    Firmware& firmware = firmware_of(node);
    if (notice == vm::Notice::WriteBytecode) save(firmware);
    if (notice == vm::Notice::Reboot) firmware.restarts = true;
}

const node::Board kBoard = {transmit, notify};

// ---- Answers in pieces ----

void command(Firmware& firmware, MessageType type, uint16_t first, uint16_t second) {
    const uint16_t words[] = {firmware.config.id, first, second};
    node::receive_words(firmware.node, wire::kHostId, static_cast<uint16_t>(type), words, 3);
}

bool is_answering(const Firmware& firmware) {
    return firmware.next_fragment != kNoDescription || firmware.variables_count > 0;
}

uint16_t fragments() {
    const node::Description description = flash_read(kDescription);
    return static_cast<uint16_t>(kVariables + kLocalEvents + description.natives[0].count +
                                 description.natives[1].count);
}

void send_fragment(Firmware& firmware) {
    const uint16_t fragment = firmware.next_fragment++;
    command(firmware, MessageType::GetNodeDescriptionFragment, wire::kProtocolVersion, fragment);
    if (firmware.next_fragment == fragments()) firmware.next_fragment = kNoDescription;
}

void send_variables(Firmware& firmware) {
    uint16_t count = firmware.variables_count;
    if (count > kVariablesAtOnce) count = kVariablesAtOnce;
    command(firmware, MessageType::GetVariables, firmware.variables_start, count);
    firmware.variables_start = static_cast<uint16_t>(firmware.variables_start + count);
    firmware.variables_count = static_cast<uint16_t>(firmware.variables_count - count);
}

void answer(Firmware& firmware) {
    if (!has_room(firmware.sender, kAnswerMax)) return;
    if (firmware.next_fragment != kNoDescription) return send_fragment(firmware);
    send_variables(firmware);
}

// ---- Frames ----

// Version 4 asks all nodes at once, later ones each by itself.
bool asks_for_description(const Firmware& firmware, const Received& frame) {
    const MessageType type = static_cast<MessageType>(frame.type);
    if (frame.count == 0) return false;
    if (type == MessageType::GetDescription) return frame.words[0] <= kLastVersionAskedByBroadcast;
    if (frame.words[0] != firmware.config.id) return false;
    if (type == MessageType::GetNodeDescription) return true;
    return type == MessageType::GetNodeDescriptionFragment && frame.count >= 3 &&
           static_cast<int16_t>(frame.words[2]) == kAllFragments;
}

bool asks_for_variables(const Firmware& firmware, const Received& frame) {
    return static_cast<MessageType>(frame.type) == MessageType::GetVariables && frame.count >= 3 &&
           frame.words[0] == firmware.config.id && frame.words[1] < board::kMemory.variables_size;
}

void begin_variables(Firmware& firmware, uint16_t start, uint16_t count) {
    const uint16_t there = static_cast<uint16_t>(board::kMemory.variables_size - start);
    firmware.variables_start = start;
    firmware.variables_count = count < there ? count : there;
}

// A program that is being written is not the one that is being saved.
void follow_program(Firmware& firmware, const Received& frame) {
    if (static_cast<MessageType>(frame.type) != MessageType::SetBytecode || frame.count < 2 ||
        frame.words[0] != firmware.config.id) {
        return;
    }
    end_save(firmware.store);
    const uint16_t size = board::kMemory.bytecode_size;
    const uint16_t start = frame.words[1];
    const uint16_t words = static_cast<uint16_t>(frame.count - 2);
    if (start >= size) return;
    const uint16_t end = words < size - start ? static_cast<uint16_t>(start + words) : size;
    if (start == 0 || end > firmware.program_words) firmware.program_words = end;
}

void obey(Firmware& firmware, const Received& frame) {
    if (asks_for_description(firmware, frame)) {
        firmware.next_fragment = 0;
        return command(firmware, MessageType::GetNodeDescriptionFragment, wire::kProtocolVersion,
                       static_cast<uint16_t>(kHeaderFragment));
    }
    if (asks_for_variables(firmware, frame) && frame.words[2] > 0) {
        return begin_variables(firmware, frame.words[1], frame.words[2]);
    }
    follow_program(firmware, frame);
    node::receive_words(firmware.node, frame.source, frame.type, frame.words, frame.count);
}

// A command waits in the receiver until what was asked before it is answered, and there is room for
// its own answer.
void take_frame(Firmware& firmware) {
    Received frame;
    firmware.took_frame = false;
    if (can_run(firmware) && firmware.executed < kInstructionsPerFrame) return;
    const bool busy = is_answering(firmware) || !has_room(firmware.sender, kAnswerMax);
    const uint16_t node = busy ? firmware.config.id : kNobody;
    if (!next_frame(firmware.receiver, board::now_ms(), node, frame)) return;
    firmware.took_frame = true;
    firmware.executed = 0;
    obey(firmware, frame);
}

// ---- What the board feels ----

void note(Firmware& firmware, uint8_t event) {
    firmware.pending = static_cast<uint8_t>(firmware.pending | (1 << event));
}

void look_at_timer(Firmware& firmware) {
    const uint16_t now = static_cast<uint16_t>(board::now_ms());
    const int16_t asked = variable(kPeriodAt);
    const uint16_t period = asked > 0 ? static_cast<uint16_t>(asked) : 0;
    if (period != firmware.timer_period) {
        firmware.timer_period = period;
        firmware.timer_began = now;
    }
    if (period == 0 || static_cast<uint16_t>(now - firmware.timer_began) < period) return;
    firmware.timer_began = now;
    note(firmware, kTimerEvent);
}

void look_at_buttons(Firmware& firmware) {
    const uint16_t buttons = board::buttons();
    if (buttons == firmware.buttons) return;
    firmware.buttons = buttons;
    variable(kButtonsAt) = static_cast<int16_t>(buttons);
    note(firmware, kButtonsEvent);
}

// Only what has changed is written: a script that counts from 0 may write 0 there.
void show_count(uint16_t at, uint16_t now, uint16_t& shown) {
    if (now == shown) return;
    shown = now;
    variable(at) = static_cast<int16_t>(now);
}

void run_script(Firmware& firmware) {
    const uint16_t done = node::run(firmware.node, kInstructionsAtOnce);
    if (firmware.executed < kInstructionsPerFrame) {
        firmware.executed = static_cast<uint16_t>(firmware.executed + done);
    }
    if (vm::is_active(firmware.node.vm)) return;  // also while it is paused: local events wait
    for (uint8_t event = 0; event < kLocalEvents; ++event) {
        const uint8_t bit = static_cast<uint8_t>(1 << event);
        if ((firmware.pending & bit) == 0) continue;
        firmware.pending = static_cast<uint8_t>(firmware.pending & ~bit);
        return node::local_event(firmware.node, event);
    }
}

void keep(Firmware& firmware) {
    if (!is_saving(firmware.store)) {
        if (firmware.restarts) board::restart();
        return;
    }
    if (save_step(firmware.store)) node::report(firmware.node, kSaved);
}

void configure(Firmware& firmware, uint16_t id) {
    const board::Memory& memory = board::kMemory;
    firmware.config = {id,
                       memory.bytecode_size,
                       memory.variables_size,
                       memory.stack_size,
                       kArguments,
                       memory.bytecode,
                       memory.variables,
                       memory.stack,
                       firmware.breakpoints,
                       &node::kMachineHost,
                       &firmware.node};
    node::init(firmware.node, firmware.config, *kDescription, kBoard, &firmware);
    variable(kIdAt) = static_cast<int16_t>(id);
}

}  // namespace

void start(Firmware& firmware) {
    board::begin();
    firmware.next_fragment = kNoDescription;
    configure(firmware, is_id(board::first_id()) ? board::first_id() : 1);
    const Kept kept = load(firmware.store, board::kMemory.bytecode, board::kMemory.bytecode_size);
    firmware.program_words = kept.words;
    if (is_id(kept.id)) {
        firmware.config.id = kept.id;
        variable(kIdAt) = static_cast<int16_t>(kept.id);
    }
    if (kept.words > 0) node::start_program(firmware.node);
}

void turn(Firmware& firmware) {
    if (is_answering(firmware)) answer(firmware);
    take_frame(firmware);
    look_at_timer(firmware);
    look_at_buttons(firmware);
    run_script(firmware);
    show_count(kDroppedAt, firmware.sender.dropped_events, firmware.shown_dropped);
    show_count(kSkippedAt, firmware.receiver.skipped, firmware.shown_skipped);
    board::show_leds(static_cast<uint16_t>(variable(kLedsAt)));
    keep(firmware);
}

bool has_work(const Firmware& firmware) {
    return can_run(firmware) || firmware.took_frame || is_saving(firmware.store) ||
           firmware.restarts || (firmware.pending != 0 && !vm::is_active(firmware.node.vm));
}

}  // namespace firmware
}  // namespace vagus
