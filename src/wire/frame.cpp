#include "wire/frame.hpp"

#include <string.h>

namespace vagus {
namespace wire {

namespace {

uint16_t word_at(const uint8_t* bytes) {
    return static_cast<uint16_t>(bytes[0] | (bytes[1] << 8));
}

void put_word(uint8_t* bytes, uint16_t value) {
    bytes[0] = static_cast<uint8_t>(value & 0xff);
    bytes[1] = static_cast<uint8_t>(value >> 8);
}

}  // namespace

uint16_t encode(const Frame& frame, uint8_t* bytes) {
    put_word(bytes, frame.size);
    put_word(bytes + 2, frame.source);
    put_word(bytes + 4, frame.type);
    memcpy(bytes + kHeaderSize, frame.payload, frame.size);
    return static_cast<uint16_t>(kHeaderSize + frame.size);
}

uint16_t FrameReader::feed(const uint8_t* bytes, uint16_t size) {
    if (complete_) {
        complete_ = false;
        have_ = 0;
    }
    uint16_t used = 0;
    while (used < size && have_ < kHeaderSize) take_header_byte(bytes[used++]);
    if (have_ < kHeaderSize) return used;

    const uint16_t available = static_cast<uint16_t>(size - used);
    if (skip_ > 0) {
        const uint16_t skipped = available < skip_ ? available : static_cast<uint16_t>(skip_);
        skip_ -= skipped;
        if (skip_ == 0) have_ = 0;
        return static_cast<uint16_t>(used + skipped);
    }
    const uint16_t filled = static_cast<uint16_t>(have_ - kHeaderSize);
    const uint16_t missing = static_cast<uint16_t>(frame_.size - filled);
    const uint16_t copied = available < missing ? available : missing;
    memcpy(frame_.payload + filled, bytes + used, copied);
    have_ = static_cast<uint16_t>(have_ + copied);
    complete_ = copied == missing;
    return static_cast<uint16_t>(used + copied);
}

void FrameReader::take_header_byte(uint8_t byte) {
    header_[have_++] = byte;
    if (have_ < kHeaderSize) return;
    frame_.size = word_at(header_);
    frame_.source = word_at(header_ + 2);
    frame_.type = word_at(header_ + 4);
    if (frame_.size > kPayloadMax) {
        skip_ = frame_.size;
        ++dropped_;
    }
}

}  // namespace wire
}  // namespace vagus
