#include "fastvm/handlers.hpp"

#include <array>
#include <cstddef>
#include <utility>

#include "isa/operate.hpp"

namespace vagus::fastvm {

namespace {

using isa::BinaryOperator;
using isa::UnaryOperator;

// Words of bytecode that the instruction takes which brings a value.
constexpr int words_of(From from) {
    return from == From::Stack ? 0 : from == From::Large ? 2 : 1;
}
constexpr int pops_of(From from) {
    return from == From::Stack ? 1 : 0;
}

// `top` is behind the value, if that is on the stack.
template <From from>
int16_t value(uint16_t operand, const int16_t* top, const int16_t* variables) {
    if constexpr (from == From::Stack) return top[-1];
    if constexpr (from == From::Variable) return variables[operand];
    return static_cast<int16_t>(operand);
}

// The end of a condition that gave `result`, `words` behind the cell (section 3.5).
template <int words>
void branch(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context,
            int16_t result) {
    uint16_t& word = context.bytecode[cell - context.cells + words - 2];
    const unsigned before = word;
    const bool seen = (~before & (isa::kBranchIsWhen | isa::kBranchWasTrue)) == 0;
    constexpr unsigned kOthers = 0xffffu ^ isa::kBranchWasTrue;
    word = static_cast<uint16_t>((before & kOthers) | (result ? isa::kBranchWasTrue : 0u));
    if (result && !seen) return enter(cell + words, top, variables, left, context);
    return enter(context.cells + cell->c, top, variables, left, context);
}

template <From left_from, From right_from, To to, BinaryOperator op>
void calculate(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    constexpr int kOperands = words_of(left_from) + words_of(right_from);
    constexpr int kPops = pops_of(left_from) + pops_of(right_from);
    const int16_t b = value<right_from>(cell->b, top, variables);
    const int16_t a = value<left_from>(cell->a, top - pops_of(right_from), variables);
    if (isa::divides(op) && b == 0) return leave_paid(cell, top, left, context);
    const auto result = static_cast<int16_t>(isa::operate(op, a, b));
    if constexpr (to == To::Branch) {
        return branch<kOperands + 2>(cell, top - kPops, variables, left, context, result);
    } else if constexpr (to == To::Variable) {
        variables[cell->c] = result;
        return go(cell + kOperands + 2, top - kPops, variables, left, context);
    } else {
        top[-kPops] = result;
        return go(cell + kOperands + 1, top - kPops + 1, variables, left, context);
    }
}

template <UnaryOperator op>
void change(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    top[-1] = static_cast<int16_t>(isa::operate(op, top[-1]));
    return go(cell + 1, top, variables, left, context);
}

template <From from, To to>
void carry(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    const int16_t carried = value<from>(cell->a, top, variables);
    if constexpr (to == To::Variable) {
        variables[cell->c] = carried;
        return go(cell + words_of(from) + 1, top - pops_of(from), variables, left, context);
    } else {
        *top = carried;
        return go(cell + words_of(from), top + 1, variables, left, context);
    }
}

template <From index_from>
void load_from_array(const Cell* cell, int16_t* top, int16_t* variables, int left,
                     Context& context) {
    const auto index = static_cast<uint16_t>(value<index_from>(cell->c, top, variables));
    if (index >= cell->b) return leave_paid(cell, top, left, context);
    top -= pops_of(index_from);
    *top = variables[cell->a + index];
    return go(cell + words_of(index_from) + 2, top + 1, variables, left, context);
}

template <From index_from>
void store_to_array(const Cell* cell, int16_t* top, int16_t* variables, int left,
                    Context& context) {
    const auto index = static_cast<uint16_t>(value<index_from>(cell->c, top, variables));
    if (index >= cell->b) return leave_paid(cell, top, left, context);
    top -= pops_of(index_from) + 1;
    variables[cell->a + index] = *top;
    return go(cell + words_of(index_from) + 2, top, variables, left, context);
}

void end_event(const Cell* cell, int16_t* top, int16_t*, int left, Context& context) {
    context.over = true;
    return leave(cell, top, left, context);
}

void jump_to(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    return enter(context.cells + cell->a, top, variables, left, context);
}

void call_sub(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    *top = static_cast<int16_t>(cell->b);
    return enter(context.cells + cell->a, top + 1, variables, left, context);
}

void return_from_sub(const Cell* cell, int16_t* top, int16_t* variables, int left,
                     Context& context) {
    const auto target = static_cast<uint16_t>(top[-1]);
    if (target >= context.cell_count) return leave_paid(cell, top, left, context);
    return enter(cell_at(context, target), top - 1, variables, left, context);
}

// The Host sees the machine as it is at the instruction.
void show(const Cell* cell, const int16_t* top, Context& context) {
    context.vm.pc = static_cast<uint16_t>(cell - context.cells);
    context.vm.depth = static_cast<uint16_t>(top - context.stack);
}

// Goes on behind a call of the Host, which may have stopped the script, and taken from the stack.
void come_back(const Cell* next, int16_t* variables, int left, Context& context) {
    int16_t* const top = context.stack + context.vm.depth;
    if (!vm::is_active(context.vm)) return leave(next, top, left, context);
    return enter(next, top, variables, left, context);
}

void send_event(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    show(cell, top, context);
    const auto* const words = reinterpret_cast<const uint16_t*>(variables + cell->b);
    context.vm.config->host->send(context.vm, cell->a, words, cell->c);
    return come_back(cell + 3, variables, left, context);
}

void call_native(const Cell* cell, int16_t* top, int16_t* variables, int left, Context& context) {
    show(cell, top, context);
    context.vm.config->host->native(context.vm, cell->a);
    return come_back(cell + 1, variables, left, context);
}

void leave_here(const Cell* cell, int16_t* top, int16_t*, int left, Context& context) {
    return leave_paid(cell, top, left, context);
}

// ---- Which handler: tables of all there are, by the numbers of their enumerators ----

using Row = std::array<Handler, isa::kBinaryOperatorCount>;

template <From left, From right, To to, size_t... op>
constexpr Row make_row(std::index_sequence<op...>) {
    return {calculate<left, right, to, static_cast<BinaryOperator>(op)>...};
}
template <From left, From right>
constexpr std::array<Row, 3> make_rows() {
    constexpr auto kAll = std::make_index_sequence<isa::kBinaryOperatorCount>{};
    return {make_row<left, right, To::Stack>(kAll), make_row<left, right, To::Variable>(kAll),
            make_row<left, right, To::Branch>(kAll)};
}

constexpr std::array<std::array<Row, 3>, 3> kWithVariable = {
    make_rows<From::Variable, From::Variable>(), make_rows<From::Variable, From::Small>(),
    make_rows<From::Variable, From::Large>()};
constexpr std::array<std::array<Row, 3>, 4> kWithStack = {
    make_rows<From::Stack, From::Variable>(), make_rows<From::Stack, From::Small>(),
    make_rows<From::Stack, From::Large>(), make_rows<From::Stack, From::Stack>()};

}  // namespace

Handler calculation(const Calculation& which) {
    const auto right = static_cast<size_t>(which.right);
    const auto& rows =
        which.left == From::Variable ? kWithVariable.at(right) : kWithStack.at(right);
    return rows[static_cast<size_t>(which.to)][static_cast<size_t>(which.op)];
}

Handler unary(UnaryOperator op) {
    static constexpr Handler kAll[] = {
#define UNARY(name, code, symbol) change<UnaryOperator::name>,
#include "isa/operators.def"
#undef UNARY
    };
    return kAll[static_cast<size_t>(op)];
}

Handler move(From from, To to) {
    switch (from) {
        case From::Variable:
            return to == To::Variable ? carry<From::Variable, To::Variable>
                                      : carry<From::Variable, To::Stack>;
        case From::Small:
            return to == To::Variable ? carry<From::Small, To::Variable>
                                      : carry<From::Small, To::Stack>;
        case From::Large:
            return to == To::Variable ? carry<From::Large, To::Variable>
                                      : carry<From::Large, To::Stack>;
        case From::Stack:
            return carry<From::Stack, To::Variable>;
    }
    return slow();
}

Handler load_indirect(From index) {
    return index == From::Variable ? load_from_array<From::Variable> : load_from_array<From::Stack>;
}
Handler store_indirect(From index) {
    return index == From::Variable ? store_to_array<From::Variable> : store_to_array<From::Stack>;
}

Handler stop() {
    return end_event;
}
Handler jump() {
    return jump_to;
}
Handler sub_call() {
    return call_sub;
}
Handler sub_ret() {
    return return_from_sub;
}
Handler emit() {
    return send_event;
}
Handler native() {
    return call_native;
}
Handler slow() {
    return leave_here;
}

}  // namespace vagus::fastvm
