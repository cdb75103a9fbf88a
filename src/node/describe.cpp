#include "node/describe.hpp"

#include "isa/flash.hpp"
#include "node/message.hpp"
#include "node/native_tables.hpp"

namespace vagus {
namespace node {

using wire::MessageType;

namespace {

void send_variable(Node& node, const Variable& variable) {
    begin_message(node, MessageType::NamedVariableDescription);
    put_word(node, variable.size);
    put_text(node, variable.name);
    end_message(node);
}

void send_local_event(Node& node, const LocalEvent& event) {
    begin_message(node, MessageType::LocalEventDescription);
    put_text(node, event.name);
    put_text(node, event.doc);
    end_message(node);
}

}  // namespace

void send_header(Node& node) {
    const Description& description = *node.description;
    const vm::Config& machine = *node.vm.config;
    begin_message(node, MessageType::Description);
    put_text(node, flash_read(&description.name));
    put_word(node, flash_read(&description.protocol_version));
    put_word(node, machine.bytecode_size);
    put_word(node, machine.stack_size);
    put_word(node, machine.variables_size);
    put_word(node, flash_read(&description.variable_count));
    put_word(node, flash_read(&description.local_event_count));
    put_word(node, native_count(description));
    end_message(node);
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
