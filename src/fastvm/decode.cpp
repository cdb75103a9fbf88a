#include "fastvm/decode.hpp"

#include <algorithm>
#include <optional>

#include "fastvm/handlers.hpp"
#include "isa/isa.hpp"

namespace vagus::fastvm {

namespace {

using isa::Opcode;

constexpr size_t kInstructionWordsMax = 3;

struct Shape {
    int words, pops, pushes;
};

Shape shape_of(uint16_t word) {
    static constexpr Shape kShapes[] = {
#define OP(name, opcode, words, popped, pushed) {words, popped, pushed},
#include "isa/opcodes.def"
#undef OP
        {0, 0, 0}};
    return kShapes[word >> 12];
}

// Where the program counter goes on is not simply behind it, or the Host is called.
bool ends_stretch(Opcode opcode) {
    switch (opcode) {
        case Opcode::Stop:
        case Opcode::Jump:
        case Opcode::Branch:
        case Opcode::Emit:
        case Opcode::Native:
        case Opcode::SubCall:
        case Opcode::SubRet:
            return true;
        case Opcode::SmallImm:
        case Opcode::LargeImm:
        case Opcode::Load:
        case Opcode::Store:
        case Opcode::LoadInd:
        case Opcode::StoreInd:
        case Opcode::Unary:
        case Opcode::Binary:
            return false;
    }
    return true;
}

// A value that an instruction brings without taking anything from the stack.
struct Operand {
    From from = From::Stack;
    uint16_t value = 0;
    size_t words = 0;
};
constexpr Operand kOnStack;

class Decoder {
public:
    Decoder(std::span<const uint16_t> bytecode, uint16_t variables_size,
            std::span<const uint16_t> breakpoints)
        : bytecode_(bytecode),
          variables_size_(variables_size),
          breakpoints_(breakpoints),
          cells_(count() + 1) {}

    Cells decode() {
        cells_.back().handler = slow();
        // From the end: what a cell costs follows from the next one.
        for (size_t at = cells_.size() - 1; at-- > 0;) price(at);
        for (size_t at = 0; at + 1 < cells_.size(); ++at) fill(at);
        return std::move(cells_);
    }

private:
    // Zeros at the end are no program. A few of them stay, as the last words of an instruction.
    size_t count() const {
        size_t end = bytecode_.size();
        while (end > 0 && bytecode_[end - 1] == 0) --end;
        return std::min(bytecode_.size(), end + kInstructionWordsMax - 1);
    }

    uint16_t word(size_t at) const { return bytecode_[at]; }
    Opcode opcode(size_t at) const { return isa::opcode_of(word(at)); }
    uint16_t argument(size_t at) const { return isa::argument_of(word(at)); }
    bool is_target(uint16_t at) const { return at + size_t{1} < cells_.size(); }
    bool is_variable(uint16_t address, uint16_t size) const {
        return size_t{address} + size <= variables_size_;
    }
    uint16_t jump_target(size_t at) const {
        return static_cast<uint16_t>(at + static_cast<size_t>(isa::signed_argument_of(word(at))));
    }
    uint16_t branch_target(size_t at) const { return static_cast<uint16_t>(at + word(at + 1)); }

    // The words behind the first must stay what they are. But who jumps into the middle of an
    // instruction may find a Branch there, which changes its word.
    bool has_fixed_words(size_t at, size_t words) const {
        for (size_t i = at + 1; i < at + words; ++i) {
            if (opcode(i) == Opcode::Branch) return false;
        }
        return true;
    }

    bool is_breakpoint(size_t at) const {
        return std::find(breakpoints_.begin(), breakpoints_.end(), at) != breakpoints_.end();
    }

    // It can do nothing wrong but divide by zero or leave an array: all else is known beforehand.
    bool is_sound(size_t at) const {
        switch (opcode(at)) {
            case Opcode::Load:
            case Opcode::Store:
                return is_variable(argument(at), 1);
            case Opcode::LoadInd:
            case Opcode::StoreInd:
                return is_variable(argument(at), word(at + 1));
            case Opcode::Unary:
                return isa::operator_of(word(at)) < isa::kUnaryOperatorCount;
            case Opcode::Binary:
                return isa::operator_of(word(at)) < isa::kBinaryOperatorCount;
            case Opcode::Branch:
                return isa::operator_of(word(at)) < isa::kBinaryOperatorCount &&
                       is_target(branch_target(at));
            case Opcode::Jump:
                return is_target(jump_target(at));
            case Opcode::SubCall:
                return is_target(argument(at));
            case Opcode::Emit:
                return word(at + 2) <= wire::kArgumentsMax &&
                       is_variable(word(at + 1), word(at + 2));
            case Opcode::Stop:
            case Opcode::SmallImm:
            case Opcode::LargeImm:
            case Opcode::Native:
            case Opcode::SubRet:
                return true;
        }
        return false;
    }

    // Leaves the cell at no cost, so that vm::run() is called there, if the instruction is not for
    // cells or has a breakpoint, or if the stretch would become too long.
    void price(size_t at) {
        const Shape shape = shape_of(word(at));
        const auto words = static_cast<size_t>(shape.words);
        if (words == 0 || at + words > bytecode_.size() || is_breakpoint(at)) return;
        if (!has_fixed_words(at, words) || !is_sound(at)) return;
        Cell after;
        if (!ends_stretch(opcode(at))) after = cells_[at + words];
        const int growth = shape.pushes - shape.pops;
        const int cost = 1 + after.cost;
        const int needs = std::max(shape.pops, after.needs - growth);
        const int grows = std::max(0, growth + after.grows);
        if (cost > kCostMax || needs > kStackMax || grows > kStackMax) return;
        cells_[at].cost = static_cast<uint8_t>(cost);
        cells_[at].needs = static_cast<uint8_t>(needs) & kStackMax;
        cells_[at].grows = static_cast<uint8_t>(grows) & kStackMax;
    }

    bool is(size_t at, Opcode expected) const {
        return cells_[at].cost > 0 && opcode(at) == expected;
    }

    std::optional<Operand> operand(size_t at) const {
        if (is(at, Opcode::Load)) return Operand{From::Variable, argument(at), 1};
        if (is(at, Opcode::LargeImm)) return Operand{From::Large, word(at + 1), 2};
        if (!is(at, Opcode::SmallImm)) return std::nullopt;
        return Operand{From::Small, static_cast<uint16_t>(isa::signed_argument_of(word(at))), 1};
    }

    // As many instructions as there is a handler for.
    void fill(size_t at) {
        Cell& cell = cells_[at];
        const std::optional<Operand> first = operand(at);
        if (!first) return fill_one(at);
        const size_t behind = at + first->words;
        const std::optional<Operand> second = operand(behind);
        if (second && first->from == From::Variable &&
            calculate(cell, *first, *second, behind + second->words))
            return;
        if (calculate(cell, kOnStack, *first, behind)) return;
        if (first->from == From::Variable && reach_array(cell, *first, behind)) return;
        cell.a = first->value;
        cell.handler = move(first->from, is(behind, Opcode::Store) ? To::Variable : To::Stack);
        if (is(behind, Opcode::Store)) cell.c = argument(behind);
    }

    // False, and nothing done, if there is no operator at `at`.
    bool calculate(Cell& cell, const Operand& left, const Operand& right, size_t at) const {
        const bool branch = is(at, Opcode::Branch);
        if (!branch && !is(at, Opcode::Binary)) return false;
        const bool store = !branch && is(at + 1, Opcode::Store);
        cell.a = left.value;
        cell.b = right.value;
        if (branch) cell.c = branch_target(at);
        if (store) cell.c = argument(at + 1);
        cell.handler =
            calculation({.left = left.from,
                         .right = right.from,
                         .to = branch ? To::Branch : (store ? To::Variable : To::Stack),
                         .op = static_cast<isa::BinaryOperator>(isa::operator_of(word(at)))});
        return true;
    }

    bool reach_array(Cell& cell, const Operand& index, size_t at) const {
        const bool load = is(at, Opcode::LoadInd);
        if (!load && !is(at, Opcode::StoreInd)) return false;
        cell.a = argument(at);
        cell.b = word(at + 1);
        cell.c = index.value;
        cell.handler = load ? load_indirect(index.from) : store_indirect(index.from);
        return true;
    }

    // One instruction, whose operands are on the stack; a Binary with the Store behind it.
    void fill_one(size_t at) {
        Cell& cell = cells_[at];
        cell.handler = slow();
        if (cell.cost == 0 || calculate(cell, kOnStack, kOnStack, at) ||
            reach_array(cell, kOnStack, at))
            return;
        cell.a = argument(at);
        switch (opcode(at)) {
            case Opcode::Stop:
                cell.handler = stop();
                return;
            case Opcode::Store:
                cell.c = argument(at);
                cell.handler = move(From::Stack, To::Variable);
                return;
            case Opcode::Unary:
                cell.handler = unary(static_cast<isa::UnaryOperator>(isa::operator_of(word(at))));
                return;
            case Opcode::Jump:
                cell.a = jump_target(at);
                cell.handler = jump();
                return;
            case Opcode::Emit:
                cell.b = word(at + 1);
                cell.c = word(at + 2);
                cell.handler = emit();
                return;
            case Opcode::Native:
                cell.handler = native();
                return;
            case Opcode::SubCall:
                cell.b = static_cast<uint16_t>(at + 1);
                cell.handler = sub_call();
                return;
            case Opcode::SubRet:
                cell.handler = sub_ret();
                return;
            case Opcode::SmallImm:
            case Opcode::LargeImm:
            case Opcode::Load:
            case Opcode::LoadInd:
            case Opcode::StoreInd:
            case Opcode::Binary:
            case Opcode::Branch:
                return;  // operands and operators: done above
        }
    }

    std::span<const uint16_t> bytecode_;
    uint16_t variables_size_;
    std::span<const uint16_t> breakpoints_;
    Cells cells_;
};

}  // namespace

Cells decode(std::span<const uint16_t> bytecode, uint16_t variables_size,
             std::span<const uint16_t> breakpoints) {
    return Decoder(bytecode, variables_size, breakpoints).decode();
}

}  // namespace vagus::fastvm
