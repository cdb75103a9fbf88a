#include "node/native_tables.hpp"

#include "isa/flash.hpp"
#include "node/message.hpp"
#include "wire/messages.hpp"

namespace vagus {
namespace node {

namespace {

bool find(const Node& node, uint16_t id, Native& native) {
    for (const NativeTable& in_flash : node.description->natives) {
        const NativeTable table = flash_read(&in_flash);
        if (id < table.count) {
            native = flash_read(table.natives + id);
            return true;
        }
        id = static_cast<uint16_t>(id - table.count);
    }
    return false;
}

void put_native(Node& node, const Native& native, uint16_t text_limit) {
    const uint16_t count = native.parameter_count < wire::kParametersMax ? native.parameter_count
                                                                         : wire::kParametersMax;
    put_text(node, native.name, text_limit);
    put_text(node, native.doc, text_limit);
    put_word(node, count);
    for (uint16_t i = 0; i < count; ++i) {
        const Parameter parameter = flash_read(native.parameters + i);
        put_word(node, static_cast<uint16_t>(parameter.size));
        put_text(node, parameter.name, text_limit);
    }
}

}  // namespace

uint16_t native_count(const Description& description) {
    return static_cast<uint16_t>(flash_read(&description.natives[0].count) +
                                 flash_read(&description.natives[1].count));
}

// Long names of many parameters do not fit one frame. Then all texts are cut, until they do: at 7
// bytes each, 32 parameters need 338 of the 516 bytes.
void send_native(Node& node, uint16_t id) {
    Native native;
    if (!find(node, id, native)) return;
    for (uint16_t limit = kTextMax;; limit = static_cast<uint16_t>(limit / 2)) {
        begin_message(node, wire::MessageType::NativeFunctionDescription);
        put_native(node, native, limit);
        if (fits(node)) return end_message(node);
    }
}

bool call_native(Node& node, uint16_t id) {
    Native native;
    if (!find(node, id, native)) return false;
    native.function(node);
    return true;
}

}  // namespace node
}  // namespace vagus
