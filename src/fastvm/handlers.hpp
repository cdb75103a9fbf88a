// What cells do, and how the decoder asks for it: it names what happens, and gets the handler and
// how many words of bytecode it executes. Nobody else includes this.
#pragma once

#include "fastvm/cell.hpp"
#include "isa/isa.hpp"

namespace vagus::fastvm {

// Where a value comes from.
enum class From : uint8_t {
    Variable,  // `Load`
    Small,     // `SmallImm`
    Large,     // `LargeImm`
    Stack,     // it has been pushed before
};

// What becomes of a result.
enum class To : uint8_t {
    Stack,
    Variable,  // `Store`: variable c
    Branch,    // `Branch` instead of `Binary`: goes to word c unless it is taken
};

// [left] op [right], to [to]. The operands are in a and b; an immediate is on the right only.
struct Calculation {
    From left = From::Stack;
    From right = From::Stack;
    To to = To::Stack;
    isa::BinaryOperator op = isa::BinaryOperator::Add;
};
Handler calculation(const Calculation& which);

Handler unary(isa::UnaryOperator op);

// Pushes a, or puts it into variable c. Not from the stack to the stack.
Handler move(From from, To to);

// Reads and writes an array at variable a, of b words; the index is variable c, or on the stack.
// The array must be inside the variables.
Handler load_indirect(From index);
Handler store_indirect(From index);

Handler stop();
Handler jump();      // to word a
Handler sub_call();  // to word a; pushes b
Handler sub_ret();
Handler emit();    // event a, c variables from b, which must be inside the variables
Handler native();  // a
Handler slow();    // leaves

}  // namespace vagus::fastvm
