// What the files of the fast loop share: a decoded program, and the code that executes a part of
// it. Nobody else includes this.
//
// A cell stands for a word of bytecode: what happens when the program counter is there. It executes
// the instruction that begins at its word, or several at once: `x = y + 1` is four instructions and
// one cell. Cells call each other, always as the last thing they do, so that the compiler makes
// jumps of the calls, and what changes stays in registers:
//
//     void push_variable(const Cell* cell, int16_t* top, int16_t* variables, int left,
//                        Context& context) {
//         *top = variables[cell->a];
//         go(cell + 1, top + 1, variables, left, context);
//     }
//
// Cells check nothing that enter() has checked: whether the instructions up to the next jump are
// allowed by the limit, and whether the stack is deep enough for all of them, both ways. Whatever
// is rare is done by no cell: it calls leave(), and vm::run() executes that instruction.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vm/vm.hpp"

namespace vagus::fastvm {

struct Cell;
struct Context;

// `top` is the place of the next word to be pushed, `left` how many instructions may still be
// executed behind those that have been paid for.
using Handler = void (*)(const Cell* cell, int16_t* top, int16_t* variables, int left,
                         Context& context);

// 16 bytes. What `a`, `b` and `c` mean, only the handler knows.
struct Cell {
    Handler handler = nullptr;
    uint16_t a = 0;
    uint16_t b = 0;
    uint16_t c = 0;
    // Of the instructions from here up to the next one that goes elsewhere, that one included:
    // how many; words that they take from the stack as it is here; words by which it grows.
    // kCostMax and kStackMax at most; all 0 where vm::run() is to be called.
    uint8_t cost = 0;
    uint8_t needs : 4 = 0;
    uint8_t grows : 4 = 0;
};

constexpr int kCostMax = 255;
constexpr int kStackMax = 15;

// The cells of words 0 … n - 1, then one more, which leaves.
using Cells = std::vector<Cell>;

// One stretch of a run. The last four are filled in at its end; `over`: the event ended.
struct Context {
    vm::Vm& vm;
    const Cell* cells;
    size_t cell_count;  // with the last, which leaves
    uint16_t* bytecode;
    int16_t* stack;
    int16_t* stack_end;
    const Cell* cell = nullptr;
    int16_t* top = nullptr;
    int left = 0;
    bool over = false;
};

// Where a word leads that nobody has checked before the run; other targets were checked when the
// program was decoded.
inline const Cell* cell_at(const Context& context, uint16_t word) {
    assert(word < context.cell_count);
    return context.cells + word;
}

inline void go(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    return cell->handler(cell, top, variables, left, context);
}

// The end of the stretch: the machine is at `cell`, which has not been executed.
inline void leave(const Cell* cell, int16_t* top, int left, Context& context) {
    context.cell = cell;
    context.top = top;
    context.left = left;
}

// The same where `cell` and what follows it have been paid for.
inline void leave_paid(const Cell* cell, int16_t* top, int left, Context& context) {
    leave(cell, top, left + cell->cost, context);
}

// Goes on at a cell that is reached by a jump, and so has not been paid for.
inline void enter(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    const bool fits = left >= cell->cost && top - context.stack >= cell->needs &&
                      context.stack_end - top >= cell->grows;
    if (!fits) return leave(cell, top, left, context);
    return go(cell, top, variables, left - cell->cost, context);
}

}  // namespace vagus::fastvm
