// What the operators of scripts give (docs/spec/aseba-wire-and-vm.md, section 3.4): the compiler
// folds constants with it, and fastvm runs by it. The machine's own, in vm/arithmetic.cpp, are made
// for small code; tests compare the two for every operator.
//
//     const int32_t sum = isa::operate(isa::BinaryOperator::Add, 32767, 1);  // 32768: 32 bits
#pragma once

#include <stdint.h>

#include "isa/isa.hpp"

namespace vagus {
namespace isa {

constexpr bool divides(BinaryOperator op) {
    return op == BinaryOperator::Divide || op == BinaryOperator::Modulo;
}

// 32-bit two's complement without the undefined behaviour of signed overflow.
constexpr int32_t wrap(int64_t value) {
    return static_cast<int32_t>(static_cast<uint32_t>(value));
}

// `a` op `b` in 32 bits; a machine cuts what it gives to 16. `b` must not be 0 where the operator
// divides.
[[gnu::always_inline]] constexpr int32_t operate(BinaryOperator op, int32_t a, int32_t b) {
    switch (op) {
        case BinaryOperator::ShiftLeft:
            return static_cast<int32_t>(static_cast<uint32_t>(a) << (b & 31));
        case BinaryOperator::ShiftRight:
            return a >> (b & 31);
        case BinaryOperator::Add:
            return wrap(int64_t{a} + b);
        case BinaryOperator::Subtract:
            return wrap(int64_t{a} - b);
        case BinaryOperator::Multiply:
            return wrap(int64_t{a} * b);
        case BinaryOperator::Divide:
            return b == -1 ? wrap(-int64_t{a}) : a / b;
        case BinaryOperator::Modulo:
            return b == -1 ? 0 : a % b;
        case BinaryOperator::BitOr:
            return a | b;
        case BinaryOperator::BitXor:
            return a ^ b;
        case BinaryOperator::BitAnd:
            return a & b;
        case BinaryOperator::Equal:
            return a == b;
        case BinaryOperator::NotEqual:
            return a != b;
        case BinaryOperator::Bigger:
            return a > b;
        case BinaryOperator::BiggerEqual:
            return a >= b;
        case BinaryOperator::Smaller:
            return a < b;
        case BinaryOperator::SmallerEqual:
            return a <= b;
        case BinaryOperator::Or:
            return (a != 0) | (b != 0);
        case BinaryOperator::And:
            return (a != 0) & (b != 0);
    }
    return 0;
}

[[gnu::always_inline]] constexpr int32_t operate(UnaryOperator op, int32_t a) {
    switch (op) {
        case UnaryOperator::Negate:
            return wrap(-int64_t{a});
        case UnaryOperator::Abs:
            return a < 0 ? wrap(-int64_t{a}) : a;
        case UnaryOperator::BitNot:
            return ~a;
    }
    return 0;
}

}  // namespace isa
}  // namespace vagus
