// Every operator at its edges. Expected values are worked out by hand from the specification,
// section 3.4 and appendix C.
#include <gtest/gtest.h>

#include "isa/isa.hpp"
#include "vm/test_machine.hpp"

namespace vagus::vm {

namespace {

using isa::BinaryOperator;
using isa::Opcode;
using isa::UnaryOperator;

constexpr int16_t kMin = -32768;

uint16_t word(int value) {
    return static_cast<uint16_t>(value);
}

// a op b, computed by a script. -1 in `sent` would be a fault: there must be none.
int16_t compute(BinaryOperator op, int16_t a, int16_t b) {
    TestMachine machine;
    const uint16_t large = isa::instruction(Opcode::LargeImm, 0);
    const auto sent = machine.execute({large, word(a), large, word(b),
                                       isa::instruction(Opcode::Binary, static_cast<uint16_t>(op)),
                                       isa::instruction(Opcode::Store, 100), 0});
    EXPECT_TRUE(sent.empty());
    return machine.variables[100];
}

int16_t compute(UnaryOperator op, int16_t a) {
    TestMachine machine;
    machine.execute({isa::instruction(Opcode::LargeImm, 0), word(a),
                     isa::instruction(Opcode::Unary, static_cast<uint16_t>(op)),
                     isa::instruction(Opcode::Store, 100), 0});
    return machine.variables[100];
}

struct BinaryCase {
    BinaryOperator op;
    int16_t a, b, result;
};

class Binary : public testing::TestWithParam<BinaryCase> {};

TEST_P(Binary, IsAsInTheSpecification) {
    const BinaryCase& c = GetParam();
    EXPECT_EQ(compute(c.op, c.a, c.b), c.result) << "a " << c.a << ", b " << c.b;
}

using O = BinaryOperator;

INSTANTIATE_TEST_SUITE_P(Shifts, Binary,
                         testing::ValuesIn(std::vector<BinaryCase>{
                             {O::ShiftLeft, 1, 0, 1},           {O::ShiftLeft, 1, 4, 16},
                             {O::ShiftLeft, 1, 15, kMin},       {O::ShiftLeft, 1, 16, 0},
                             {O::ShiftLeft, 1, 31, 0},          {O::ShiftLeft, 1, 32, 1},
                             {O::ShiftLeft, 1, -1, 0},          {O::ShiftLeft, 1, -31, 2},
                             {O::ShiftLeft, 5, -32, 5},         {O::ShiftLeft, 0x1234, -31, 9320},
                             {O::ShiftLeft, -1, 1, -2},         {O::ShiftLeft, kMin, 1, 0},
                             {O::ShiftRight, -1, 31, -1},       {O::ShiftRight, -4660, 8, -19},
                             {O::ShiftRight, -4660, 32, -4660}, {O::ShiftRight, 32767, -31, 16383},
                             {O::ShiftRight, 32767, 15, 0},     {O::ShiftRight, 32767, 16, 0},
                             {O::ShiftRight, kMin, 15, -1},     {O::ShiftRight, kMin, 31, -1},
                             {O::ShiftRight, 40, -31, 20},      {O::ShiftRight, -7, 1, -4},
                         }));

INSTANTIATE_TEST_SUITE_P(
    Arithmetic, Binary,
    testing::ValuesIn(std::vector<BinaryCase>{
        {O::Add, 32767, 1, kMin},       {O::Add, kMin, -1, 32767},    {O::Add, -3, 5, 2},
        {O::Subtract, kMin, 1, 32767},  {O::Subtract, 0, kMin, kMin}, {O::Subtract, 3, 5, -2},
        {O::Multiply, 300, 300, 24464}, {O::Multiply, kMin, kMin, 0}, {O::Multiply, kMin, -1, kMin},
        {O::Multiply, -1, -1, 1},       {O::Multiply, -7, 3, -21},    {O::Divide, 7, 2, 3},
        {O::Divide, -7, 2, -3},         {O::Divide, 7, -2, -3},       {O::Divide, kMin, -1, kMin},
        {O::Divide, kMin, 1, kMin},     {O::Divide, 32767, kMin, 0},  {O::Modulo, -7, 2, -1},
        {O::Modulo, 7, -2, 1},          {O::Modulo, kMin, -1, 0},     {O::Modulo, kMin, 32767, -1},
        {O::Modulo, 7, 7, 0},
    }));

INSTANTIATE_TEST_SUITE_P(BitsAndLogic, Binary,
                         testing::ValuesIn(std::vector<BinaryCase>{
                             {O::BitOr, 0x0f0f, 0x00ff, 0x0fff},
                             {O::BitXor, 0x0f0f, 0x00ff, 0x0ff0},
                             {O::BitAnd, 0x0f0f, 0x00ff, 0x000f},
                             {O::BitAnd, -1, kMin, kMin},
                             {O::Or, 0, 0, 0},
                             {O::Or, 0, kMin, 1},
                             {O::Or, 256, 0, 1},
                             {O::And, 256, 1, 1},
                             {O::And, 256, 0, 0},
                             {O::And, 0, 1, 0},
                             {O::And, kMin, 2, 1},
                         }));

// Signed: -32768 is the smallest. Each comparison on less, same, more.
INSTANTIATE_TEST_SUITE_P(Comparisons, Binary,
                         testing::ValuesIn(std::vector<BinaryCase>{
                             {O::Equal, kMin, 32767, 0},
                             {O::Equal, 5, 5, 1},
                             {O::Equal, 32767, kMin, 0},
                             {O::NotEqual, kMin, 32767, 1},
                             {O::NotEqual, 5, 5, 0},
                             {O::NotEqual, 32767, kMin, 1},
                             {O::Bigger, kMin, 32767, 0},
                             {O::Bigger, 5, 5, 0},
                             {O::Bigger, 32767, kMin, 1},
                             {O::BiggerEqual, kMin, 32767, 0},
                             {O::BiggerEqual, 5, 5, 1},
                             {O::BiggerEqual, 32767, kMin, 1},
                             {O::Smaller, kMin, 32767, 1},
                             {O::Smaller, 5, 5, 0},
                             {O::Smaller, 32767, kMin, 0},
                             {O::SmallerEqual, kMin, 32767, 1},
                             {O::SmallerEqual, 5, 5, 1},
                             {O::SmallerEqual, 32767, kMin, 0},
                         }));

}  // namespace

TEST(Unary, IsAsInTheSpecification) {
    EXPECT_EQ(compute(UnaryOperator::Negate, 5), -5);
    EXPECT_EQ(compute(UnaryOperator::Negate, kMin), kMin);
    EXPECT_EQ(compute(UnaryOperator::Abs, 5), 5);
    EXPECT_EQ(compute(UnaryOperator::Abs, -5), 5);
    EXPECT_EQ(compute(UnaryOperator::Abs, 0), 0);
    EXPECT_EQ(compute(UnaryOperator::Abs, kMin), kMin);
    EXPECT_EQ(compute(UnaryOperator::BitNot, 0), -1);
    EXPECT_EQ(compute(UnaryOperator::BitNot, kMin), 32767);
}

}  // namespace vagus::vm
