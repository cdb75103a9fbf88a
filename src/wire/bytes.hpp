// Reading and writing little-endian fields in a buffer of known size. Errors are sticky: after the
// first one a reader yields zeros and a writer writes nothing, so one check at the end is enough.
#pragma once

#include <stdint.h>
#include <string.h>

namespace vagus {
namespace wire {

// Text inside a message: borrowed, not terminated. `size` is a byte count (UTF-8).
struct Text {
    const char* bytes;
    uint8_t size;
};

class Reader {
public:
    Reader(const uint8_t* bytes, uint16_t size) : at_(bytes), left_(size), failed_(false) {}

    uint8_t u8() {
        if (!take(1)) return 0;
        return at_[-1];
    }
    uint16_t u16() {
        if (!take(2)) return 0;
        return static_cast<uint16_t>(at_[-2] | (at_[-1] << 8));
    }
    int16_t i16() { return static_cast<int16_t>(u16()); }
    // The text stays in the buffer that is read.
    Text text() {
        const uint8_t size = u8();
        if (!take(size)) return Text{"", 0};
        return Text{reinterpret_cast<const char*>(at_ - size), size};
    }
    uint16_t left() const { return left_; }
    bool failed() const { return failed_; }

private:
    bool take(uint16_t size) {
        if (failed_ || left_ < size) {
            failed_ = true;
            left_ = 0;
            return false;
        }
        at_ += size;
        left_ = static_cast<uint16_t>(left_ - size);
        return true;
    }

    const uint8_t* at_;
    uint16_t left_;
    bool failed_;
};

class Writer {
public:
    Writer(uint8_t* bytes, uint16_t capacity)
        : begin_(bytes), size_(0), capacity_(capacity), failed_(false) {}

    void u8(uint8_t value) {
        if (!room(1)) return;
        begin_[size_] = value;
        size_ = static_cast<uint16_t>(size_ + 1);
    }
    void u16(uint16_t value) {
        if (!room(2)) return;
        begin_[size_] = static_cast<uint8_t>(value & 0xff);
        begin_[size_ + 1] = static_cast<uint8_t>(value >> 8);
        size_ = static_cast<uint16_t>(size_ + 2);
    }
    void i16(int16_t value) { u16(static_cast<uint16_t>(value)); }
    void text(Text value) {
        u8(value.size);
        if (!room(value.size)) return;
        // An empty text may have no bytes at all, which memcpy() must not be shown.
        if (value.size > 0) memcpy(begin_ + size_, value.bytes, value.size);
        size_ = static_cast<uint16_t>(size_ + value.size);
    }
    uint16_t size() const { return size_; }
    bool failed() const { return failed_; }

private:
    bool room(uint16_t size) {
        if (failed_ || capacity_ - size_ < size) failed_ = true;
        return !failed_;
    }

    uint8_t* begin_;
    uint16_t size_;
    uint16_t capacity_;
    bool failed_;
};

}  // namespace wire
}  // namespace vagus
