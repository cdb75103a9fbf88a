#include "firmware/node/store.hpp"

#include "firmware/board.hpp"
#include "wire/checksum.hpp"

namespace vagus {
namespace firmware {

namespace {

constexpr uint32_t kWhole = 0xdebb20e3;  // of bytes and their own checksum behind them

constexpr uint16_t kHeadUnits = kHeadWords / 2;

void begin(Store& store) {
    store.at = 0;
    store.checksum = wire::kChecksumBegin;
}

bool is_at_checksum(const Store& store) {
    return store.at == kHeadUnits + board::kMachine.bytecode_size / 2;
}

// One unit from memory to the slot, or from the slot to memory. True if it was the checksum.
[[gnu::noinline]] bool move_unit(Store& store, bool saves) {
    const bool is_last = is_at_checksum(store);
    const uint16_t place = static_cast<uint16_t>(4 * store.at);
    uint16_t* const words = store.at < kHeadUnits
                                ? store.head + 2 * store.at
                                : board::kMachine.bytecode + 2 * (store.at - kHeadUnits);
    uint32_t unit = ~store.checksum;
    if (!is_last) unit = words[0] | (static_cast<uint32_t>(words[1]) << 16);
    if (saves) {
        board::write_slot(store.slot, place, ~unit);
    } else {
        unit = ~board::read_slot(store.slot, place);
    }
    if (!saves && !is_last) {
        words[0] = static_cast<uint16_t>(unit);
        words[1] = static_cast<uint16_t>(unit >> 16);
    }
    store.checksum = wire::add_to_checksum(store.checksum, static_cast<uint16_t>(unit));
    store.checksum = wire::add_to_checksum(store.checksum, static_cast<uint16_t>(unit >> 16));
    ++store.at;
    return is_last;
}

// A slot to head and bytecode; false if it is not whole.
[[gnu::noinline]] bool load_slot(Store& store, uint8_t slot) {
    store.slot = slot;
    begin(store);
    while (!move_unit(store, false)) {
    }
    return store.checksum == kWhole;
}

uint16_t number_of(uint8_t slot) {
    return static_cast<uint16_t>(~board::read_slot(slot, 0));
}

}  // namespace

// The later one first. Of one that is not whole the number means nothing; then the other is found
// second. The next save goes to the one that does not count.
uint16_t load(Store& store, uint32_t& program) {
    const uint8_t later = static_cast<int16_t>(number_of(1) - number_of(0)) > 0;
    const bool found = load_slot(store, later) || load_slot(store, later ^ 1);
    store.slot ^= 1;
    if (found) {
        program = store.head[kProgram] | (static_cast<uint32_t>(store.head[kProgram + 1]) << 16);
        return store.head[kId];
    }
    program = 0;
    board::kMachine.bytecode[0] = 0;
    return 0;
}

void begin_save(Store& store, uint16_t id, uint32_t program) {
    ++store.head[kNumber];
    store.head[kId] = id;
    store.head[kProgram] = static_cast<uint16_t>(program);
    store.head[kProgram + 1] = static_cast<uint16_t>(program >> 16);
    store.is_saving = true;
    begin(store);
    board::erase_slot(store.slot);
}

bool save_step(Store& store) {
    if (!move_unit(store, true)) return false;
    store.slot ^= 1;
    store.is_saving = false;
    return true;
}

}  // namespace firmware
}  // namespace vagus
