// The operators of scripts (docs/spec/aseba-wire-and-vm.md, section 3.4), apart from the machine
// because they have the most edges: everything wraps to 16 bits and nothing may be undefined,
// whatever the width of int.
#include "vm/internal.hpp"

namespace vagus {
namespace vm {

using isa::BinaryOperator;
using isa::UnaryOperator;

namespace {

// The three ways in which two numbers can compare, and for each comparison, in the order of their
// codes, those for which it holds. A table is smaller than six comparisons.
constexpr uint8_t kLess = 1;
constexpr uint8_t kSame = 2;
constexpr uint8_t kMore = 4;
VAGUS_FLASH_TABLE(uint8_t, kHoldsFor, 6) = {kSame,         kLess | kMore, kMore,
                                            kSame | kMore, kLess,         kLess | kSame};

int16_t compare(uint8_t code, int16_t a, int16_t b) {
    const uint8_t is = a < b ? kLess : a == b ? kSame : kMore;
    return (flash_read(&kHoldsFor[code - static_cast<uint8_t>(BinaryOperator::Equal)]) & is) != 0;
}

}  // namespace

int16_t binary(Vm& vm, uint8_t code, int16_t a, int16_t b) {
    // Counts are taken modulo 32, on every processor: 1 << 16 is 0, 1 << 32 is 1.
    const uint8_t count = static_cast<uint8_t>(b & 31);
    // Unsigned, and at least as wide as int: sums and products wrap instead of being undefined.
    const unsigned wide_a = static_cast<uint16_t>(a);
    const unsigned wide_b = static_cast<uint16_t>(b);
    switch (static_cast<BinaryOperator>(code)) {
        case BinaryOperator::ShiftLeft:
            return static_cast<int16_t>(uint32_t{wide_a} << count);
        case BinaryOperator::ShiftRight:
            return static_cast<int16_t>(int32_t{a} >> count);
        case BinaryOperator::Add:
            return static_cast<int16_t>(wide_a + wide_b);
        case BinaryOperator::Subtract:
            return static_cast<int16_t>(wide_a - wide_b);
        case BinaryOperator::Multiply:
            return static_cast<int16_t>(wide_a * wide_b);
        case BinaryOperator::Divide:
        case BinaryOperator::Modulo:
            if (b == 0) {
                raise_division_by_zero(vm);
                return 0;
            }
            // In 32 bits, where -32768 / -1 exists; it is then cut to -32768.
            if (static_cast<BinaryOperator>(code) == BinaryOperator::Divide) {
                return static_cast<int16_t>(int32_t{a} / b);
            }
            return static_cast<int16_t>(int32_t{a} % b);
        case BinaryOperator::BitOr:
            return a | b;
        case BinaryOperator::BitXor:
            return a ^ b;
        case BinaryOperator::BitAnd:
            return a & b;
        case BinaryOperator::Equal:
        case BinaryOperator::NotEqual:
        case BinaryOperator::Bigger:
        case BinaryOperator::BiggerEqual:
        case BinaryOperator::Smaller:
        case BinaryOperator::SmallerEqual:
            return compare(code, a, b);
        case BinaryOperator::Or:
            return a || b;
        case BinaryOperator::And:
            return a && b;
    }
    return 0;
}

int16_t unary(uint8_t code, int16_t a) {
    if (static_cast<UnaryOperator>(code) == UnaryOperator::BitNot) return static_cast<int16_t>(~a);
    if (static_cast<UnaryOperator>(code) == UnaryOperator::Abs && a >= 0) return a;
    return static_cast<int16_t>(0u - static_cast<uint16_t>(a));  // -(-32768) is -32768
}

}  // namespace vm
}  // namespace vagus
