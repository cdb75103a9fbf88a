#include "node/native_tables.hpp"

namespace vagus {
namespace node {

uint16_t native_count(const Description&) {
    return 0;
}

void send_native(Node&, uint16_t) {}

bool call_native(Node&, uint16_t) {
    return false;
}

}  // namespace node
}  // namespace vagus
