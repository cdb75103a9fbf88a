#include "firmware/node/store.hpp"

#include "firmware/board.hpp"

namespace vagus {
namespace firmware {

namespace {

constexpr uint16_t kHeaderPairs = 2;

// CRC-32 of IEEE 802.3, bit by bit: a table would fill 1 KB.
uint32_t add(uint32_t checksum, uint32_t value) {
    checksum ^= value;
    for (uint8_t bit = 0; bit < 32; ++bit) {
        checksum = (checksum >> 1) ^ ((checksum & 1) != 0 ? 0xedb88320u : 0);
    }
    return checksum;
}

constexpr uint32_t kNothing = 0xffffffff;

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
    return board::read_slot(slot, static_cast<uint16_t>(4 * at));
}

uint16_t* words_at(uint16_t at) {
    return board::kMemory.bytecode + 2 * (at - kHeaderPairs);
}

// What belongs there, `at` pairs from the begin of the slot.
uint32_t pair_at(const Store& store, uint16_t at) {
    if (at == 0) return pair(static_cast<uint16_t>(store.number + 1), store.id);
    if (at == 1) return pair(store.pairs, kSlotMark);
    const uint16_t* words = words_at(at);
    return pair(words[0], words[1]);
}

void clear() {
    for (uint16_t i = 0; i < board::kMemory.bytecode_size; ++i) board::kMemory.bytecode[i] = 0;
}

// The program of a slot goes to the bytecode; false if it is not whole.
bool load_slot(uint8_t slot) {
    const uint32_t header = read(slot, 1);
    const uint16_t pairs = low_of(header);
    if (high_of(header) != kSlotMark || pairs > board::kMemory.bytecode_size / 2) return false;
    const uint16_t end = static_cast<uint16_t>(kHeaderPairs + pairs);
    uint32_t checksum = kNothing;
    for (uint16_t at = 0; at < end; ++at) {
        const uint32_t pair = read(slot, at);
        checksum = add(checksum, pair);
        if (at < kHeaderPairs) continue;
        words_at(at)[0] = low_of(pair);
        words_at(at)[1] = high_of(pair);
    }
    if (~checksum == read(slot, end)) return true;
    clear();
    return false;
}

uint16_t number_of(uint8_t slot) {
    return low_of(read(slot, 0));
}

}  // namespace

// The later one first. Of one that is not whole the number means nothing; then the other is found
// second.
uint16_t load(Store& store) {
    const bool second_is_later = static_cast<int16_t>(number_of(1) - number_of(0)) > 0;
    for (uint8_t tried = 0; tried < kSlots; ++tried) {
        const uint8_t slot = (tried == 0) == second_is_later;
        if (!load_slot(slot)) continue;
        store.slot = slot ^ 1;
        store.number = number_of(slot);
        return high_of(read(slot, 0));
    }
    return 0;
}

void begin_save(Store& store, uint16_t id) {
    uint16_t words = board::kMemory.bytecode_size;
    while (words > 0 && board::kMemory.bytecode[words - 1] == 0) --words;
    store.pairs = static_cast<uint16_t>((words + 1) / 2);
    store.id = id;
    store.at = 0;
    store.checksum = kNothing;
    store.is_saving = true;
    board::erase_slot(store.slot);
}

bool save_step(Store& store) {
    const bool is_last = store.at == kHeaderPairs + store.pairs;
    const uint32_t value = is_last ? ~store.checksum : pair_at(store, store.at);
    board::write_slot(store.slot, static_cast<uint16_t>(4 * store.at), value);
    store.checksum = add(store.checksum, value);
    ++store.at;
    if (!is_last) return false;
    ++store.number;
    store.slot ^= 1;
    store.is_saving = false;
    return true;
}

}  // namespace firmware
}  // namespace vagus
