// math.*: angles, roots and random numbers (sections 4.3 and 4.4). The formulas are in
// fixed_math.hpp.
#include "isa/flash.hpp"
#include "node/fixed_math.hpp"
#include "node/natives.hpp"
#include "node/node.hpp"
#include "node/operands.hpp"

namespace vagus {
namespace node {

namespace {

VAGUS_FLASH_TEXT(kNegativeRoot, "Negative input to sqrt");

void for_each(Node& node, int16_t (*function)(int16_t)) {
    const Vectors<2> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) v.words[0][i] = function(v.words[1][i]);
}

}  // namespace

namespace natives {

void sin(Node& node) {
    for_each(node, fixed_sin);
}
void cos(Node& node) {
    for_each(node, fixed_cos);
}

void atan2(Node& node) {
    const Vectors<3> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) v.words[0][i] = fixed_atan2(v.words[1][i], v.words[2][i]);
}

void rot2(Node& node) {
    const Addresses<3> addresses(node.vm);
    int16_t* dest = vm::memory(node.vm, addresses.at[0], 2);
    const int16_t* v = vm::memory(node.vm, addresses.at[1], 2);
    const int16_t* angle = vm::memory(node.vm, addresses.at[2], 1);
    if (dest == nullptr || v == nullptr || angle == nullptr) return;
    const Vector2 turned = fixed_rotate({v[0], v[1]}, *angle);  // dest may be v, or hold the angle
    dest[0] = turned.x;
    dest[1] = turned.y;
}

void sqrt(Node& node) {
    const Vectors<2> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) {
        const int16_t value = v.words[1][i];
        if (value < 0) return vm::raise_node_error(node.vm, kNegativeRoot);
        v.words[0][i] = whole_sqrt(value);
    }
}

void rand(Node& node) {
    const Vectors<1> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) {
        node.random_state = static_cast<uint16_t>(uint32_t{25173} * node.random_state + 13849u);
        v.words[0][i] = static_cast<int16_t>(node.random_state);
    }
}

}  // namespace natives
}  // namespace node
}  // namespace vagus
