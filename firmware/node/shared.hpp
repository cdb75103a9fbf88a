// A number that an interrupt and the loop share. An AVR loads and stores one byte at a time: an
// interrupt between the two halves makes 511 of 255 and 256. What was written before store() is
// there for an interrupt that sees the new number, and the other way round after load().
//
//     Shared<uint16_t> end;
//     end.in_interrupt(end.in_interrupt() + 1);  // in one, or between hold() and release()
//     const uint16_t now = end.load();           // in the loop
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/board.hpp"

namespace vagus {
namespace firmware {

#if defined(__AVR__)
constexpr size_t kLoadedAtOnce = 1;  // bytes that no interrupt can part
#else
constexpr size_t kLoadedAtOnce = 4;
#endif

// The compiler may not move memory accesses over this.
inline void keep_order() {
    asm volatile("" : : : "memory");
}

// Zero at the start, as part of what is all zero.
template <typename T>
class Shared {
public:
    T load() const {
        if (sizeof(T) <= kLoadedAtOnce) return whole_load();
        const uint8_t before = board::hold();
        const T value = whole_load();
        board::release(before);
        return value;
    }
    void store(T value) {
        if (sizeof(T) <= kLoadedAtOnce) return whole_store(value);
        const uint8_t before = board::hold();
        whole_store(value);
        board::release(before);
    }
    T in_interrupt() const { return value_; }
    void in_interrupt(T value) { value_ = value; }

private:
    T whole_load() const {
        const T value = value_;
        keep_order();
        return value;
    }
    void whole_store(T value) {
        keep_order();
        value_ = value;
        keep_order();
    }

    volatile T value_;
};

}  // namespace firmware
}  // namespace vagus
