#include "firmware/node/store.hpp"

#include "firmware/board.hpp"

namespace vagus {
namespace firmware {

namespace {

constexpr uint16_t kChecksumAt = 8;

// CRC-32 of IEEE 802.3, bit by bit: a table would fill 1 KB.
uint32_t add(uint32_t checksum, uint32_t value) {
    checksum ^= value;
    for (uint8_t bit = 0; bit < 32; ++bit) {
        checksum = (checksum >> 1) ^ ((checksum & 1) != 0 ? 0xedb88320u : 0);
    }
    return checksum;
}

constexpr uint32_t kNothing = 0xffffffff;

uint32_t both(uint16_t low, uint16_t high) {
    return low | (static_cast<uint32_t>(high) << 16);
}
uint16_t low_of(uint32_t value) {
    return static_cast<uint16_t>(value);
}
uint16_t high_of(uint32_t value) {
    return static_cast<uint16_t>(value >> 16);
}

// Number, id; words, mark.
struct Header {
    uint32_t first;
    uint32_t second;
    uint16_t number() const { return low_of(first); }
    uint16_t id() const { return high_of(first); }
    uint16_t words() const { return low_of(second); }
    bool is_marked() const { return high_of(second) == kSlotMark; }
    uint32_t checksum() const { return add(add(kNothing, first), second); }
};

Header header_of(uint8_t slot) {
    return {board::read_slot(slot, 0), board::read_slot(slot, 4)};
}

uint16_t place_of(uint16_t word) {
    return static_cast<uint16_t>(kSlotHeader + 2 * word);
}

bool is_whole(uint8_t slot, uint16_t room) {
    const Header header = header_of(slot);
    if (!header.is_marked() || header.words() > room) return false;
    uint32_t checksum = header.checksum();
    for (uint16_t word = 0; word < header.words(); word = static_cast<uint16_t>(word + 2)) {
        checksum = add(checksum, board::read_slot(slot, place_of(word)));
    }
    return ~checksum == board::read_slot(slot, kChecksumAt);
}

bool is_later(uint16_t number, uint16_t than) {
    return static_cast<int16_t>(number - than) > 0;
}

void choose(Store& store, uint16_t room) {
    store.slot = kSlots;
    for (uint8_t slot = 0; slot < kSlots; ++slot) {
        if (!is_whole(slot, room)) continue;
        const uint16_t number = header_of(slot).number();
        if (store.slot != kSlots && !is_later(number, store.number)) continue;
        store.slot = slot;
        store.number = number;
    }
}

uint8_t other(const Store& store) {
    return store.slot == 0 ? 1 : 0;
}

}  // namespace

Kept load(Store& store, uint16_t* program, uint16_t room) {
    choose(store, room);
    if (store.slot == kSlots) return {0, 0};
    const Header header = header_of(store.slot);
    for (uint16_t word = 0; word < header.words(); ++word) {
        const uint32_t pair =
            board::read_slot(store.slot, place_of(static_cast<uint16_t>(word & ~1)));
        program[word] = word % 2 == 0 ? low_of(pair) : high_of(pair);
    }
    return {header.id(), header.words()};
}

void begin_save(Store& store, const uint16_t* program, uint16_t words, uint16_t id) {
    store.program = program;
    store.words = words;
    store.id = id;
    store.at = 0;
    const Header header = {both(static_cast<uint16_t>(store.number + 1), id),
                           both(words, kSlotMark)};
    store.checksum = header.checksum();
    board::erase_slot(other(store));
}

bool save_step(Store& store) {
    const uint8_t slot = other(store);
    if (store.at < store.words) {
        const bool is_last = store.at + 1 == store.words;
        const uint32_t pair =
            both(store.program[store.at], is_last ? 0 : store.program[store.at + 1]);
        board::write_slot(slot, place_of(store.at), pair);
        store.checksum = add(store.checksum, pair);
        store.at = static_cast<uint16_t>(store.at + 2);
        return false;
    }
    ++store.number;
    board::write_slot(slot, 0, both(store.number, store.id));
    board::write_slot(slot, 4, both(store.words, kSlotMark));
    board::write_slot(slot, kChecksumAt, ~store.checksum);
    store.slot = slot;
    store.program = nullptr;
    return true;
}

void end_save(Store& store) {
    store.program = nullptr;
}

}  // namespace firmware
}  // namespace vagus
