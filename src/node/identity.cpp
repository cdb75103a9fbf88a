#include "node/identity.hpp"

#include "isa/flash.hpp"
#include "wire/checksum.hpp"

namespace vagus {
namespace node {

namespace {

constexpr uint16_t kNowhere =
    0xffff;  // `end` of a program that is not known: no piece begins there
constexpr uint16_t kCountedAtOnce = 32;  // half a millisecond of an AVR

}  // namespace

// A host sends a program from its first word to its last. What leaves a gap, or writes something a
// second time, makes a program of which this node knows only some words.
void note_piece(Node& node, uint16_t start, uint16_t count) {
    Identity& identity = node.identity;
    const uint16_t size = node.vm.config->bytecode_size;
    if (start >= size) return;
    if (count > size - start) count = static_cast<uint16_t>(size - start);
    if (count == 0) return;
    if (start == 0) identity = {wire::kChecksumBegin, 0, 0};
    if (start != identity.end) return identify_as(node, wire::kProgramUnknown);
    identity.end = static_cast<uint16_t>(start + count);
}

void count_words(Node& node) {
    Identity& identity = node.identity;
    for (uint16_t left = kCountedAtOnce; left > 0 && is_counting(node); --left) {
        const uint16_t word = node.vm.config->bytecode[identity.counted++];
        identity.checksum = wire::add_to_checksum(identity.checksum, word);
    }
}

void identify(Node& node, uint16_t count) {
    note_piece(node, 0, count);
    while (is_counting(node)) count_words(node);
}

void identify_as(Node& node, uint32_t mark) {
    node.identity = {~mark, kNowhere, kNowhere};
}

uint32_t program(const Node& node) {
    return wire::program_mark(node.vm.config->bytecode[0], node.identity.checksum);
}

void tell_program(Node& node) {
    const uint16_t at = flash_read(&node.description->program_at);
    if (at == 0) return;
    const uint32_t mark = program(node);
    int16_t* const words = node.vm.config->variables + at;
    words[0] = static_cast<int16_t>(mark & 0xffff);
    words[1] = static_cast<int16_t>(mark >> 16);
}

}  // namespace node
}  // namespace vagus
