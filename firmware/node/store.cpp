#include "firmware/node/store.hpp"

#include "firmware/board.hpp"

namespace vagus {
namespace firmware {

namespace {

constexpr uint32_t kNoBytes = 0xffffffff;  // the checksum of none

// CRC-32 of IEEE 802.3, bit by bit: a table would fill 1 KB.
__attribute__((noinline)) uint32_t add(uint32_t checksum, uint32_t value) {
    checksum ^= value;
    for (uint8_t bit = 0; bit < 32; ++bit) {
        checksum = (checksum >> 1) ^ ((checksum & 1) != 0 ? 0xedb88320u : 0);
    }
    return checksum;
}

uint32_t pair(uint16_t low, uint16_t high) {
    return low | (static_cast<uint32_t>(high) << 16);
}
uint16_t low_of(uint32_t pair) {
    return static_cast<uint16_t>(pair);
}
uint16_t high_of(uint32_t pair) {
    return static_cast<uint16_t>(pair >> 16);
}

uint32_t read(uint8_t slot, uint16_t at) {
    return ~board::read_slot(slot, static_cast<uint16_t>(4 * at));
}

// Where the checksum is.
uint16_t last_unit() {
    return static_cast<uint16_t>(1 + board::kMachine.bytecode_size / 2);
}

uint16_t* words_of(uint16_t unit) {
    return board::kMachine.bytecode + 2 * (unit - 1);
}

// A slot to the bytecode; false if it is not whole.
bool load_slot(uint8_t slot) {
    const uint16_t last = last_unit();
    uint32_t checksum = add(kNoBytes, read(slot, 0));
    for (uint16_t at = 1; at < last; ++at) {
        const uint32_t unit = read(slot, at);
        checksum = add(checksum, unit);
        words_of(at)[0] = low_of(unit);
        words_of(at)[1] = high_of(unit);
    }
    return ~checksum == read(slot, last);
}

}  // namespace

// The later one first. Of one that is not whole the number means nothing; then the other is found
// second.
uint16_t load(Store& store) {
    const uint32_t first = read(0, 0);
    const uint32_t second = read(1, 0);
    uint8_t slot = static_cast<int16_t>(low_of(second) - low_of(first)) > 0;
    for (uint8_t tried = 0; tried < kSlots; ++tried, slot ^= 1) {
        if (!load_slot(slot)) continue;
        const uint32_t unit = slot != 0 ? second : first;
        store.slot = slot ^ 1;
        store.number = low_of(unit);
        return high_of(unit);
    }
    board::kMachine.bytecode[0] = 0;
    return 0;
}

void begin_save(Store& store, uint16_t id) {
    store.id = id;
    store.at = 0;
    store.checksum = kNoBytes;
    store.is_saving = true;
    ++store.number;
    board::erase_slot(store.slot);
}

bool save_step(Store& store) {
    const uint16_t at = store.at++;
    const bool is_last = at == last_unit();
    uint32_t unit = ~store.checksum;
    if (at == 0) unit = pair(store.number, store.id);
    if (at != 0 && !is_last) unit = pair(words_of(at)[0], words_of(at)[1]);
    board::write_slot(store.slot, static_cast<uint16_t>(4 * at), ~unit);
    store.checksum = add(store.checksum, unit);
    if (!is_last) return false;
    store.slot ^= 1;
    store.is_saving = false;
    return true;
}

}  // namespace firmware
}  // namespace vagus
