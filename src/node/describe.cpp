#include "node/describe.hpp"

#include "isa/flash.hpp"
#include "node/flash_text.hpp"
#include "wire/bytes.hpp"
#include "wire/messages.hpp"

namespace vagus {
namespace node {

namespace {

wire::Frame empty_frame(const Node& node, wire::MessageType type) {
    wire::Frame frame;
    frame.source = node.vm.config->id;
    frame.type = static_cast<uint16_t>(type);
    return frame;
}

void transmit(Node& node, wire::Frame& frame, const wire::Writer& payload) {
    frame.size = payload.size();
    node.board->transmit(node, frame);
}

uint16_t native_count(const Description& description) {
    return static_cast<uint16_t>(description.natives[0].count + description.natives[1].count);
}

void send_header(Node& node, const Description& description) {
    wire::Frame frame = empty_frame(node, wire::MessageType::Description);
    wire::Writer out(frame.payload, wire::kPayloadMax);
    const vm::Config& machine = *node.vm.config;
    write_text(out, description.name, kTextMax);
    out.u16(description.protocol_version);
    out.u16(machine.bytecode_size);
    out.u16(machine.stack_size);
    out.u16(machine.variables_size);
    out.u16(description.variable_count);
    out.u16(description.local_event_count);
    out.u16(native_count(description));
    transmit(node, frame, out);
}

void send_variable(Node& node, const Variable& variable) {
    wire::Frame frame = empty_frame(node, wire::MessageType::NamedVariableDescription);
    wire::Writer out(frame.payload, wire::kPayloadMax);
    out.u16(variable.size);
    write_text(out, variable.name, kTextMax);
    transmit(node, frame, out);
}

void send_local_event(Node& node, const LocalEvent& event) {
    wire::Frame frame = empty_frame(node, wire::MessageType::LocalEventDescription);
    wire::Writer out(frame.payload, wire::kPayloadMax);
    write_text(out, event.name, kTextMax);
    write_text(out, event.doc, kTextMax);
    transmit(node, frame, out);
}

void write_native(wire::Writer& out, const Native& native, uint16_t text_limit) {
    const uint16_t count = native.parameter_count < wire::kParametersMax ? native.parameter_count
                                                                         : wire::kParametersMax;
    write_text(out, native.name, text_limit);
    write_text(out, native.doc, text_limit);
    out.u16(count);
    for (uint16_t i = 0; i < count; ++i) {
        const Parameter parameter = flash_read(native.parameters + i);
        out.i16(parameter.size);
        write_text(out, parameter.name, text_limit);
    }
}

// Long names of many parameters do not fit one frame. Then all texts are cut, until they do: at 7
// bytes each, 32 parameters need 338 of the 516 bytes.
void send_native(Node& node, const Native& native) {
    wire::Frame frame = empty_frame(node, wire::MessageType::NativeFunctionDescription);
    for (uint16_t limit = kTextMax;; limit = static_cast<uint16_t>(limit / 2)) {
        wire::Writer out(frame.payload, wire::kPayloadMax);
        write_native(out, native, limit);
        if (out.failed()) continue;
        transmit(node, frame, out);
        return;
    }
}

// Sends item `k`, if there is one.
void send_item(Node& node, const Description& description, uint16_t k) {
    if (k < description.variable_count)
        return send_variable(node, flash_read(description.variables + k));
    k = static_cast<uint16_t>(k - description.variable_count);
    if (k < description.local_event_count) {
        return send_local_event(node, flash_read(description.local_events + k));
    }
    k = static_cast<uint16_t>(k - description.local_event_count);
    for (const NativeTable& table : description.natives) {
        if (k < table.count) return send_native(node, flash_read(table.natives + k));
        k = static_cast<uint16_t>(k - table.count);
    }
}

}  // namespace

void send_description(Node& node) {
    const Description description = flash_read(node.description);
    send_header(node, description);
    const uint32_t items = uint32_t{description.variable_count} + description.local_event_count +
                           native_count(description);
    for (uint32_t k = 0; k < items; ++k) send_item(node, description, static_cast<uint16_t>(k));
}

void send_description_fragment(Node& node, int16_t fragment) {
    if (fragment == kFragmentAll) return send_description(node);
    const Description description = flash_read(node.description);
    if (fragment == kFragmentHeader) return send_header(node, description);
    if (fragment >= 0) send_item(node, description, static_cast<uint16_t>(fragment));
}

}  // namespace node
}  // namespace vagus
