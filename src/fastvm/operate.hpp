// The operators of scripts once more (docs/spec/aseba-wire-and-vm.md, section 3.4), each known when
// this is compiled. The machine's own, in vm/arithmetic.cpp, are made for small code; the tests
// compare the two for every operator. Nobody else includes this.
#pragma once

#include <cstdint>

#include "isa/isa.hpp"

namespace vagus::fastvm {

constexpr bool divides(isa::BinaryOperator op) {
    return op == isa::BinaryOperator::Divide || op == isa::BinaryOperator::Modulo;
}

// `a` op `b`. `b` must not be 0 where the operator divides. Everything is computed in 32 bits,
// where it exists, and then cut.
template <isa::BinaryOperator op>
constexpr int16_t operate(int32_t a, int32_t b) {
    using isa::BinaryOperator;
    const auto cut = [](int64_t value) { return static_cast<int16_t>(value); };
    switch (op) {
        case BinaryOperator::ShiftLeft:
            return cut(static_cast<int32_t>(static_cast<uint32_t>(a) << (b & 31)));
        case BinaryOperator::ShiftRight:
            return cut(a >> (b & 31));
        case BinaryOperator::Add:
            return cut(a + b);
        case BinaryOperator::Subtract:
            return cut(a - b);
        case BinaryOperator::Multiply:
            return cut(a * b);
        case BinaryOperator::Divide:
            return cut(a / b);
        case BinaryOperator::Modulo:
            return cut(a % b);
        case BinaryOperator::BitOr:
            return cut(a | b);
        case BinaryOperator::BitXor:
            return cut(a ^ b);
        case BinaryOperator::BitAnd:
            return cut(a & b);
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

template <isa::UnaryOperator op>
constexpr int16_t operate(int32_t a) {
    switch (op) {
        case isa::UnaryOperator::Negate:
            return static_cast<int16_t>(-a);
        case isa::UnaryOperator::Abs:
            return static_cast<int16_t>(a < 0 ? -a : a);
        case isa::UnaryOperator::BitNot:
            return static_cast<int16_t>(~a);
    }
    return 0;
}

}  // namespace vagus::fastvm
