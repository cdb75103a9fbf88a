#include "aesl/fold.hpp"

#include <bit>

#include "isa/operate.hpp"

namespace vagus::aesl {
namespace {

using isa::BinaryOperator;
using isa::UnaryOperator;

constexpr int32_t kInt16Min = -32768;

BinaryOperator opposite_of(BinaryOperator op) {
    switch (op) {
        case BinaryOperator::Equal:
            return BinaryOperator::NotEqual;
        case BinaryOperator::NotEqual:
            return BinaryOperator::Equal;
        case BinaryOperator::Bigger:
            return BinaryOperator::SmallerEqual;
        case BinaryOperator::BiggerEqual:
            return BinaryOperator::Smaller;
        case BinaryOperator::Smaller:
            return BinaryOperator::BiggerEqual;
        case BinaryOperator::SmallerEqual:
            return BinaryOperator::Bigger;
        case BinaryOperator::Or:
            return BinaryOperator::And;
        case BinaryOperator::And:
            return BinaryOperator::Or;
        default:
            return op;  // arithmetic has no opposite; the type check keeps it out of conditions
    }
}

// An operand that decides the operation whatever the other one is (rule 6): the result then.
std::optional<int32_t> absorbed(BinaryOperator op, int32_t operand) {
    switch (op) {
        case BinaryOperator::Multiply:
        case BinaryOperator::BitAnd:
            if (operand == 0) return 0;
            break;
        case BinaryOperator::BitOr:
            if (operand == -1) return -1;
            break;
        case BinaryOperator::And:
            if (operand == 0) return 0;
            break;
        case BinaryOperator::Or:
            if (operand != 0) return 1;
            break;
        default:
            break;
    }
    return std::nullopt;
}

// Whether an operand changes nothing (rule 5), on the right and on the left.
bool is_neutral_right(BinaryOperator op, int32_t operand) {
    switch (op) {
        case BinaryOperator::Multiply:
        case BinaryOperator::Divide:
            return operand == 1;
        case BinaryOperator::Add:
        case BinaryOperator::Subtract:
        case BinaryOperator::BitOr:
        case BinaryOperator::Or:
            return operand == 0;
        case BinaryOperator::BitAnd:
            return operand == -1;
        case BinaryOperator::And:
            return operand != 0;
        default:
            return false;
    }
}

bool is_neutral_left(BinaryOperator op, int32_t operand) {
    const bool is_symmetric = op != BinaryOperator::Divide && op != BinaryOperator::Subtract;
    return is_symmetric && is_neutral_right(op, operand);
}

bool is_power_of_two(int32_t value) {
    return value > 1 && std::has_single_bit(static_cast<uint32_t>(value));
}

}  // namespace

ScalarId Folder::add(Scalar scalar) {
    ++built_;
    scalars_.push_back(scalar);
    return static_cast<ScalarId>(scalars_.size() - 1);
}

ScalarId Folder::number(int32_t value, int32_t line) {
    return add({.kind = ScalarKind::Number, .line = line, .value = value});
}

ScalarId Folder::load(int32_t address, int32_t line) {
    return add({.kind = ScalarKind::Load, .line = line, .value = address});
}

ScalarId Folder::load_indirect(ScalarId index, const TreeVariable& array, int32_t line) {
    return add({.kind = ScalarKind::LoadIndirect,
                .line = line,
                .value = array.address,
                .left = index,
                .right = static_cast<uint32_t>(array.size)});
}

ScalarId Folder::unknown() {
    met_unknown_ = true;
    return add({});
}

ScalarId Folder::fail(Diag what, TokenId token) {
    if (!problem_) problem_ = FoldProblem{what, token};
    return add({});
}

ScalarId Folder::unary(UnaryOperator op, ScalarId operand, OperatorPlace at) {
    if (!is_number(operand)) {
        return add({.kind = ScalarKind::Unary,
                    .op = static_cast<uint8_t>(op),
                    .line = at.line,
                    .left = operand});
    }
    const int32_t value = scalars_[operand].value;
    if (op == UnaryOperator::Abs && value == kInt16Min) return fail(Diag::AbsOfMinimum, at.token);
    return number(isa::operate(op, value), at.line);
}

ScalarId Folder::binary(BinaryOperator op, ScalarId left, ScalarId right, OperatorPlace at) {
    const Scalar a = scalars_[left];
    const Scalar b = scalars_[right];
    if (a.kind == ScalarKind::Number && b.kind == ScalarKind::Number) return compute(op, a, b, at);
    if (op == BinaryOperator::Divide && b.kind == ScalarKind::Number && b.value == 0) {
        return fail(Diag::DivisionByZero, at.token);
    }
    if (const auto simple = simplify(op, left, right, at.line)) return *simple;
    return with_shift(op, left, right, at);
}

// Both operands are numbers (rules 1 to 3).
ScalarId Folder::compute(BinaryOperator op, const Scalar& left, const Scalar& right,
                         OperatorPlace at) {
    if (isa::divides(op) && right.value == 0) return fail(Diag::DivisionByZero, at.token);
    return number(isa::operate(op, left.value, right.value), at.line);
}

// One operand is a number at most: rules 5 and 6.
std::optional<ScalarId> Folder::simplify(BinaryOperator op, ScalarId left, ScalarId right,
                                         int32_t line) {
    const Scalar a = scalars_[left];
    const Scalar b = scalars_[right];
    if (b.kind == ScalarKind::Number) {
        if (const auto result = absorbed(op, b.value)) return number(*result, line);
        if (is_neutral_right(op, b.value)) return left;
    }
    if (a.kind == ScalarKind::Number) {
        if (const auto result = absorbed(op, a.value)) return number(*result, line);
        if (is_neutral_left(op, a.value)) return right;
    }
    return std::nullopt;
}

// Rule 7:  x * 8  →  x << 3;  x / 8  →  x >> 3, which rounds toward minus infinity, as programs
// observe.
ScalarId Folder::with_shift(BinaryOperator op, ScalarId left, ScalarId right, OperatorPlace at) {
    const Scalar b = scalars_[right];
    if (b.kind == ScalarKind::Number && is_power_of_two(b.value)) {
        const BinaryOperator shift = op == BinaryOperator::Multiply ? BinaryOperator::ShiftLeft
                                     : op == BinaryOperator::Divide ? BinaryOperator::ShiftRight
                                                                    : op;
        if (shift != op) {
            op = shift;
            right = number(std::countr_zero(static_cast<uint32_t>(b.value)), b.line);
        }
    }
    return add({.kind = ScalarKind::Binary,
                .op = static_cast<uint8_t>(op),
                .line = at.line,
                .left = left,
                .right = right});
}

ScalarId Folder::opposite(ScalarId condition) {
    Scalar scalar = scalars_[condition];
    if (scalar.kind == ScalarKind::Number) return number(scalar.value == 0, scalar.line);
    if (scalar.kind != ScalarKind::Binary) return opaque();
    if (is_logical(scalar.op)) {
        scalar.left = opposite(scalar.left);
        scalar.right = opposite(scalar.right);
    }
    scalar.op = static_cast<uint8_t>(opposite_of(static_cast<BinaryOperator>(scalar.op)));
    return add(scalar);
}

void Folder::clear() {
    scalars_.clear();
    problem_.reset();
    met_unknown_ = false;
}

}  // namespace vagus::aesl
