// The arithmetic of the standard natives on plain numbers: 16-bit angles (32768 = pi), sines
// of 1.15 bits (docs/spec/aseba-wire-and-vm.md, section 4.3). No state; every input has a defined
// result.
#pragma once

#include <stdint.h>

namespace vagus {
namespace node {

// The low 16 bits as a signed word: what a variable keeps of a larger result.
constexpr int16_t wrap16(uint32_t value) {
    return static_cast<int16_t>(static_cast<uint16_t>(value & 0xffff));
}

int16_t fixed_sin(int16_t angle);
int16_t fixed_cos(int16_t angle);

// The angle of (x, y). Coarse by design: atan2(1, 1) is 8203, and -32768 on one axis alone counts
// as vertical.
int16_t fixed_atan2(int16_t y, int16_t x);

struct Vector2 {
    int16_t x;
    int16_t y;
};

// `v` turned by `angle`; wraps where the result does not fit. Angle 0 makes (1000, 500) to (999,
// 499).
Vector2 fixed_rotate(Vector2 v, int16_t angle);

// The whole part of the square root of `value`, which is not negative.
int16_t whole_sqrt(int16_t value);

// value >> (shift & 31) on a signed 32-bit number, floor.
int32_t shift_right(uint32_t value, int16_t shift);

}  // namespace node
}  // namespace vagus
