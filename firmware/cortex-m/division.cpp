// Division for a Cortex-M0, which has no instruction for it: bit by bit, in a tenth of the flash
// that the compiler's library takes. By the names and registers of ARM's run-time ABI (IHI 0043,
// section 4.3.1): quotient in r0, remainder in r1, which a result of 64 bits is. As in that
// library, nothing asks for a division by zero.
#include <stdint.h>

extern "C" __attribute__((used)) uint64_t __aeabi_idivmod(int32_t dividend, int32_t divisor) {
    const auto magnitude = [](int32_t a) {
        return a < 0 ? 0u - static_cast<uint32_t>(a) : static_cast<uint32_t>(a);
    };
    const uint32_t below = magnitude(divisor);
    uint32_t quotient =
        magnitude(dividend);  // its bits leave above, those of the result come below
    uint32_t rest = 0;
    for (uint8_t bit = 0; bit < 32; ++bit) {
        rest = (rest << 1) | (quotient >> 31);
        quotient <<= 1;
        if (rest < below) continue;
        rest -= below;
        quotient |= 1;
    }
    if ((dividend ^ divisor) < 0) quotient = 0 - quotient;
    if (dividend < 0) rest = 0 - rest;
    return (static_cast<uint64_t>(rest) << 32) | quotient;
}

// The remainder is in a register that the caller does not look at.
extern "C" __attribute__((used, nothrow, alias("__aeabi_idivmod"))) uint64_t __aeabi_idiv(
    int32_t dividend, int32_t divisor);
