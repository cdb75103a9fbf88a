#include "node/node.hpp"

#include "isa/flash.hpp"
#include "isa/isa.hpp"
#include "node/describe.hpp"
#include "node/flash_text.hpp"
#include "wire/bytes.hpp"
#include "wire/messages.hpp"

namespace vagus {
namespace node {

namespace {

constexpr uint16_t kLastVersionAskedByBroadcast = 4;  // section 2.1: GetDescription, up to there

VAGUS_FLASH_TEXT(kNoSuchNative, "Native function does not exist");

Node& node_of(vm::Vm& vm) {
    return *static_cast<Node*>(vm.config->owner);
}

// Fills in the header and sends: the payload is what `out` has written into `frame`.
void transmit(Node& node, uint16_t type, wire::Frame& frame, const wire::Writer& out) {
    frame.source = node.vm.config->id;
    frame.type = type;
    frame.size = out.size();
    node.board->transmit(node, frame);
}

void send(vm::Vm& vm, uint16_t type, const uint16_t* words, uint16_t count) {
    wire::Frame frame;
    wire::Writer out(frame.payload, wire::kPayloadMax);
    for (uint16_t i = 0; i < count; ++i) out.u16(words[i]);
    transmit(node_of(vm), type, frame, out);
}

void send_variables(vm::Vm& vm, uint16_t start, uint16_t count) {
    wire::Frame frame;
    wire::Writer out(frame.payload, wire::kPayloadMax);
    out.u16(start);
    const int16_t* values = vm.config->variables + start;
    for (uint16_t i = 0; i < count; ++i) out.i16(values[i]);
    transmit(node_of(vm), static_cast<uint16_t>(wire::MessageType::Variables), frame, out);
}

void send_error(vm::Vm& vm, const char* text) {
    wire::Frame frame;
    wire::Writer out(frame.payload, wire::kPayloadMax);
    out.u16(vm.pc);
    write_text(out, text, kTextMax);
    transmit(node_of(vm), static_cast<uint16_t>(wire::MessageType::NodeSpecificError), frame, out);
}

void call_native(vm::Vm& vm, uint16_t id) {
    Node& node = node_of(vm);
    const Description description = flash_read(node.description);
    for (const NativeTable& table : description.natives) {
        if (id < table.count) return flash_read(table.natives + id).function(node);
        id = static_cast<uint16_t>(id - table.count);
    }
    vm::raise_node_error(vm, kNoSuchNative);
}

void notify(vm::Vm& vm, vm::Notice notice) {
    Node& node = node_of(vm);
    node.board->notify(node, notice);
}

void answer_presence(Node& node) {
    const uint16_t version = flash_read(node.description).protocol_version;
    send(node.vm, static_cast<uint16_t>(wire::MessageType::NodePresent), &version, 1);
}

// Commands about the description; true if it was one of them.
bool answer_description(Node& node, wire::MessageType type, const uint16_t* words, uint16_t count) {
    if (type == wire::MessageType::GetNodeDescription) {
        send_description(node);
        return true;
    }
    if (type == wire::MessageType::GetNodeDescriptionFragment) {
        if (count >= 3) send_description_fragment(node, static_cast<int16_t>(words[2]));
        return true;
    }
    return false;
}

}  // namespace

const vm::Host kMachineHost = {send, send_variables, send_error, call_native, notify};

void init(Node& node, const vm::Config& config, const Description& description, const Board& board,
          void* owner) {
    node.description = &description;
    node.board = &board;
    node.owner = owner;
    node.random_state = 0;
    vm::init(node.vm, config);
}

void receive(Node& node, const wire::Frame& frame) {
    uint16_t words[wire::kPayloadMax / 2];
    const uint16_t count = static_cast<uint16_t>(frame.size / 2);
    wire::Reader in(frame.payload, frame.size);
    for (uint16_t i = 0; i < count; ++i) words[i] = in.u16();
    receive_words(node, frame.source, frame.type, words, count);
}

// The order of section 3.9.
void receive_words(Node& node, uint16_t source, uint16_t type, const uint16_t* words,
                   uint16_t count) {
    if (wire::is_user_event(type)) return vm::receive_event(node.vm, source, type, words, count);
    const wire::MessageType message = static_cast<wire::MessageType>(type);
    if (message == wire::MessageType::GetDescription) {
        // The version must be there (D11): newer hosts ask each node by itself.
        if (count >= 1 && words[0] <= kLastVersionAskedByBroadcast) send_description(node);
        return;
    }
    if (message == wire::MessageType::ListNodes) return answer_presence(node);
    if (count == 0 || words[0] != node.vm.config->id) return;
    if (answer_description(node, message, words, count)) return;
    vm::receive(node.vm, type, words, count);
}

void local_event(Node& node, uint16_t index) {
    if (vm::is_paused_in_event(node.vm)) return;
    const vm::Config& machine = *node.vm.config;
    const Description description = flash_read(node.description);
    if (description.local_event_source == LocalEventSource::OwnId &&
        vm::kSourceAddress < machine.variables_size) {
        machine.variables[vm::kSourceAddress] = static_cast<int16_t>(machine.id);
    }
    vm::local_event(node.vm, index);
}

// The commands Reset and Run: so the program starts as after its upload, whatever its `when`s
// remembered when it was saved.
void start_program(Node& node) {
    const uint16_t id = node.vm.config->id;
    vm::receive(node.vm, static_cast<uint16_t>(wire::MessageType::Reset), &id, 1);
    vm::receive(node.vm, static_cast<uint16_t>(wire::MessageType::Run), &id, 1);
}

uint16_t run(Node& node, uint16_t limit) {
    return vm::run(node.vm, limit);
}

void host_left(Node& node) {
    node.vm.breakpoint_count = 0;
}

void report(Node& node, const char* text) {
    send_error(node.vm, text);
}

}  // namespace node
}  // namespace vagus
