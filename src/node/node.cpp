#include "node/node.hpp"

#include "isa/flash.hpp"
#include "isa/isa.hpp"
#include "node/describe.hpp"
#include "node/identity.hpp"
#include "node/message.hpp"
#include "node/native_tables.hpp"
#include "wire/bytes.hpp"
#include "wire/checksum.hpp"

namespace vagus {
namespace node {

using wire::MessageType;

namespace {

constexpr uint16_t kLastVersionAskedByBroadcast = 4;  // section 2.1: GetDescription, up to there

// Values of GetNodeDescriptionFragment beside the number of an item (section 2.9).
constexpr int16_t kFragmentHeader = -1;
constexpr int16_t kFragmentAll = -2;

VAGUS_FLASH_TEXT(kNoSuchNative, "Native function does not exist");

Node& node_of(vm::Vm& vm) {
    return *static_cast<Node*>(vm.config->owner);
}

// ---- What the machine asks of its host ----

void send(vm::Vm& vm, uint16_t type, const uint16_t* words, uint16_t count) {
    Node& node = node_of(vm);
    begin_message(node, type);
    for (uint16_t i = 0; i < count; ++i) put_word(node, words[i]);
    end_message(node);
}

// The next piece of the variables that were asked for; an empty one if there are none.
void send_piece(Node& node) {
    uint16_t count = node.variables_left;
    if (count > node.board->variables_at_once) count = node.board->variables_at_once;
    begin_message(node, MessageType::Variables);
    put_word(node, node.next_variable);
    for (uint16_t i = 0; i < count; ++i) {
        put_word(node, static_cast<uint16_t>(node.vm.config->variables[node.next_variable]));
        ++node.next_variable;
    }
    node.variables_left = static_cast<uint16_t>(node.variables_left - count);
    end_message(node);
}

void send_variables(vm::Vm& vm, uint16_t start, uint16_t count) {
    Node& node = node_of(vm);
    node.next_variable = start;
    node.variables_left = count;
    send_piece(node);
}

void send_error(vm::Vm& vm, const char* text) {
    Node& node = node_of(vm);
    begin_message(node, MessageType::NodeSpecificError);
    put_word(node, vm.pc);
    put_text(node, text);
    end_message(node);
}

void native(vm::Vm& vm, uint16_t id) {
    if (!call_native(node_of(vm), id)) vm::raise_node_error(vm, kNoSuchNative);
}

void notify(vm::Vm& vm, vm::Notice notice) {
    Node& node = node_of(vm);
    node.board->notify(node, notice);
}

// ---- Commands about the description ----

void answer_presence(Node& node) {
    const uint16_t version = flash_read(&node.description->protocol_version);
    send(node.vm, static_cast<uint16_t>(MessageType::NodePresent), &version, 1);
}

void begin_description(Node& node) {
    send_header(node);
    node.next_item = 0;
    node.items_left = item_count(node);
}

void send_fragment(Node& node, int16_t fragment) {
    if (fragment == kFragmentAll) return begin_description(node);
    if (fragment == kFragmentHeader) return send_header(node);
    if (fragment >= 0) send_item(node, static_cast<uint16_t>(fragment));
}

}  // namespace

const vm::Host kMachineHost = {send, send_variables, send_error, native, notify};

void init(Node& node, const vm::Config& config, const Description& description, const Board& board,
          void* owner) {
    node.description = &description;
    node.board = &board;
    node.owner = owner;
    node.random_state = 0;
    node.items_left = 0;
    node.variables_left = 0;
    node.identity = {wire::kChecksumBegin, 0, 0};
    vm::init(node.vm, config);
}

void receive(Node& node, const wire::Frame& frame) {
    uint16_t words[wire::kPayloadMax / 2];
    const uint16_t count = static_cast<uint16_t>(frame.size / 2);
    wire::Reader in(frame.payload, frame.size);
    for (uint16_t i = 0; i < count; ++i) words[i] = in.u16();
    begin_receive(node, frame.source, frame.type, words, count);
    while (is_answering(node)) answer(node);
}

// The order of section 3.9.
void begin_receive(Node& node, uint16_t source, uint16_t type, const uint16_t* words,
                   uint16_t count) {
    if (wire::is_user_event(type)) return vm::receive_event(node.vm, source, type, words, count);
    const MessageType message = static_cast<MessageType>(type);
    if (message == MessageType::ListNodes) return answer_presence(node);
    if (count == 0) return;
    // The version must be there (D11): newer hosts ask each node by itself.
    const bool asks_all =
        message == MessageType::GetDescription && words[0] <= kLastVersionAskedByBroadcast;
    if (!asks_all && words[0] != node.vm.id) return;
    if (asks_all || message == MessageType::GetNodeDescription) return begin_description(node);
    if (message == MessageType::GetNodeDescriptionFragment) {
        if (count >= 3) send_fragment(node, static_cast<int16_t>(words[2]));
        return;
    }
    if (message == MessageType::SetBytecode && count >= 2) {
        note_piece(node, words[1], static_cast<uint16_t>(count - 2));
    }
    tell_program(node);
    vm::receive(node.vm, type, words, count);
}

void answer(Node& node) {
    if (is_counting(node)) return count_words(node);
    if (node.items_left == 0) return send_piece(node);
    --node.items_left;
    send_item(node, node.next_item++);
}

void local_event(Node& node, uint16_t index) {
    if (vm::is_paused_in_event(node.vm)) return;
    const vm::Config& machine = *node.vm.config;
    if (flash_read(&node.description->local_event_source) == LocalEventSource::OwnId &&
        vm::kSourceAddress < machine.variables_size) {
        machine.variables[vm::kSourceAddress] = static_cast<int16_t>(node.vm.id);
    }
    vm::start_event(node.vm, static_cast<uint16_t>(isa::kLocalEventFirst - index));
}

// The commands Reset and Run: so the program starts as after its upload, whatever its `when`s
// remembered when it was saved.
void start_program(Node& node) {
    const uint16_t id = node.vm.id;
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
