#include "node/describe.hpp"

#include "isa/flash.hpp"
#include "node/message.hpp"
#include "node/native_tables.hpp"

namespace vagus {
namespace node {

using wire::MessageType;

namespace {

void send_variable(Node& node, const Variable& variable) {
    Message message(node, MessageType::NamedVariableDescription);
    message.word(variable.size);
    message.text(variable.name);
    message.send();
}

void send_local_event(Node& node, const LocalEvent& event) {
    Message message(node, MessageType::LocalEventDescription);
    message.text(event.name);
    message.text(event.doc);
    message.send();
}

}  // namespace

void send_header(Node& node) {
    const Description& description = *node.description;
    const vm::Config& machine = *node.vm.config;
    Message message(node, MessageType::Description);
    message.text(flash_read(&description.name));
    message.word(flash_read(&description.protocol_version));
    message.word(machine.bytecode_size);
    message.word(machine.stack_size);
    message.word(machine.variables_size);
    message.word(flash_read(&description.variable_count));
    message.word(flash_read(&description.local_event_count));
    message.word(native_count(description));
    message.send();
}

uint16_t item_count(const Node& node) {
    const Description& description = *node.description;
    return static_cast<uint16_t>(flash_read(&description.variable_count) +
                                 flash_read(&description.local_event_count) +
                                 native_count(description));
}

void send_item(Node& node, uint16_t item) {
    const Description& description = *node.description;
    const uint16_t variables = flash_read(&description.variable_count);
    if (item < variables)
        return send_variable(node, flash_read(flash_read(&description.variables) + item));
    item = static_cast<uint16_t>(item - variables);
    const uint16_t events = flash_read(&description.local_event_count);
    if (item < events)
        return send_local_event(node, flash_read(flash_read(&description.local_events) + item));
    send_native(node, static_cast<uint16_t>(item - events));
}

}  // namespace node
}  // namespace vagus
