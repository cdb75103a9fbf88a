// Conditions and expressions (docs/spec/aesl-language.md, chapter 2: cond … element).
#include <algorithm>

#include "aesl/expand.hpp"
#include "aesl/fix.hpp"
#include "aesl/limits.hpp"
#include "aesl/parser.hpp"

namespace vagus::aesl {
namespace {

using isa::BinaryOperator;
using isa::UnaryOperator;

// Levels of precedence, loosest first. `not` is between And and Comparison.
enum Level { kNoLevel, kOr, kAnd, kComparison, kBitOr, kBitXor, kBitAnd, kShift, kSum, kProduct };

struct OperatorEntry {
    Level level;
    BinaryOperator op;
};

OperatorEntry binary_operator(TokenKind kind) {
    switch (kind) {
        case TokenKind::Or:
            return {kOr, BinaryOperator::Or};
        case TokenKind::And:
            return {kAnd, BinaryOperator::And};
        case TokenKind::SignEqual:
            return {kComparison, BinaryOperator::Equal};
        case TokenKind::SignNotEqual:
            return {kComparison, BinaryOperator::NotEqual};
        case TokenKind::SignBigger:
            return {kComparison, BinaryOperator::Bigger};
        case TokenKind::SignBiggerEqual:
            return {kComparison, BinaryOperator::BiggerEqual};
        case TokenKind::SignSmaller:
            return {kComparison, BinaryOperator::Smaller};
        case TokenKind::SignSmallerEqual:
            return {kComparison, BinaryOperator::SmallerEqual};
        case TokenKind::SignBitOr:
            return {kBitOr, BinaryOperator::BitOr};
        case TokenKind::SignBitXor:
            return {kBitXor, BinaryOperator::BitXor};
        case TokenKind::SignBitAnd:
            return {kBitAnd, BinaryOperator::BitAnd};
        case TokenKind::SignShiftLeft:
            return {kShift, BinaryOperator::ShiftLeft};
        case TokenKind::SignShiftRight:
            return {kShift, BinaryOperator::ShiftRight};
        case TokenKind::SignAdd:
            return {kSum, BinaryOperator::Add};
        case TokenKind::SignSubtract:
            return {kSum, BinaryOperator::Subtract};
        case TokenKind::SignMultiply:
            return {kProduct, BinaryOperator::Multiply};
        case TokenKind::SignDivide:
            return {kProduct, BinaryOperator::Divide};
        case TokenKind::SignModulo:
            return {kProduct, BinaryOperator::Modulo};
        default:
            return {kNoLevel, BinaryOperator::Add};
    }
}

int32_t limited(int64_t words) {
    return static_cast<int32_t>(std::min<int64_t>(words, kWordsMax));
}

}  // namespace

NodeId Parser::condition() {
    return binary(kOr);
}
NodeId Parser::expression() {
    return binary(kBitOr);
}

// An operand and the operators of at least this level behind it, all left-associative.
NodeId Parser::binary(int level) {
    NodeId left = level <= kComparison && at(TokenKind::Not) ? negation() : unary();
    while (!panic_) {
        const OperatorEntry entry = binary_operator(kind());
        if (entry.level == kNoLevel || entry.level < level) break;
        const TokenId op = position_;
        advance();
        const NodeId right = binary(entry.level + 1);
        left =
            operation({.kind = NodeKind::Binary, .op = static_cast<uint8_t>(entry.op), .token = op},
                      left, right);
    }
    return left;
}

// An even number of `not` cancels.
NodeId Parser::negation() {
    const TokenId first = position_;
    bool is_odd = false;
    while (accept(TokenKind::Not)) is_odd = !is_odd;
    const NodeId operand = binary(kComparison);
    if (!is_odd) return operand;
    return operation({.kind = NodeKind::Not, .token = first}, operand, kNoNode);
}

NodeId Parser::unary() {
    const TokenId start = position_;
    UnaryOperator op = UnaryOperator::Negate;
    if (at(TokenKind::SignBitNot)) {
        op = UnaryOperator::BitNot;
    } else if (at(TokenKind::Abs)) {
        op = UnaryOperator::Abs;
    } else if (!at(TokenKind::SignSubtract)) {
        return primary();
    }
    advance();
    if (op == UnaryOperator::Negate && at(TokenKind::Number)) return literal(true);
    if (++nesting_ > kNestingMax) give_up();
    const NodeId operand = unary();
    --nesting_;
    return operation({.kind = NodeKind::Unary, .op = static_cast<uint8_t>(op), .token = start},
                     operand, kNoNode);
}

NodeId Parser::primary() {
    if (panic_) return error_node(position_);
    switch (kind()) {
        case TokenKind::Number:
            return literal(false);
        case TokenKind::Identifier:
            return name_in_expression();
        case TokenKind::SignBracketOpen:
            return tuple();
        case TokenKind::SignParenOpen:
            return parenthesised();
        default:
            return missing_operand();
    }
}

// A number, with the minus before it where there is one: `-32768` is a literal, `-(32768)` is not
// (section 1.4).
NodeId Parser::literal(bool is_negative) {
    const Token number = token();
    const TokenId at_number = position_;
    advance();
    if (number.value == kBadNumber) return error_node(at_number);
    int32_t value = number.value;
    if (!number.is_decimal && value > kInt16Max) value -= 0x10000;
    if (is_negative) value = -value;
    if (value > kInt16Max || value < -kInt16Max - 1) {
        const std::string sign = is_negative ? "-" : "";
        error(Diag::NumberTooLarge, at_number, {sign + name_text(at_number)});
        return error_node(at_number);
    }
    return add({.kind = NodeKind::Number, .token = at_number, .value = value, .size = 1});
}

// Among the constants first, then among the variables (section 3.3).
NodeId Parser::name_in_expression() {
    const TokenId name = position_;
    const Symbol& known = symbol(name);
    if (known.constant >= 0) {
        advance();
        const ConstantSymbol constant = constants_[static_cast<size_t>(known.constant)];
        if (!constant.is_known) return error_node(name);
        if (constant.value > kInt16Max || constant.value < -kInt16Max - 1) {
            error(Diag::ConstantTooLarge, name, {name_text(name), std::to_string(constant.value)});
            return error_node(name);
        }
        return add({.kind = NodeKind::Number, .token = name, .value = constant.value, .size = 1});
    }
    if (known.variable < 0) return unknown_variable(name, NameSpace::Value);
    advance();
    return reference(name, static_cast<VariableId>(known.variable));
}

NodeId Parser::unknown_variable(TokenId name, NameSpace space) {
    advance();
    if (const auto meant = alias(tree_.text(name))) return reference(name, *meant);
    report_unknown_variable(name, space);
    // A statement that begins with a word nobody knows is one mistake, whatever follows.
    if (name == statement_start_ && !assigns_next(name)) panic_ = true;
    if (symbol(name).native >= 0 && at(TokenKind::SignParenOpen)) panic_ = true;
    return reference(name, declare_implicitly(name));
}

// The variable itself, or what follows it in brackets.
NodeId Parser::reference(TokenId name, VariableId variable) {
    tree_.variables[variable].is_used = true;
    const Node node{.token = name, .value = static_cast<int32_t>(variable)};
    if (at(TokenKind::SignBracketOpen) && !panic_) return index(name, variable);
    Node whole = node;
    whole.kind = NodeKind::Variable;
    whole.size = tree_.variables[variable].size;
    return add(whole);
}

NodeId Parser::index(TokenId name, VariableId variable) {
    const std::string line = line_of(position_);
    advance();
    if (++nesting_ > kNestingMax) give_up();
    const NodeId first = expression();
    const NodeId node = operation({.kind = NodeKind::Element,
                                   .token = name,
                                   .value = static_cast<int32_t>(variable),
                                   .size = tree_.variables[variable].size == 0 ? 0 : 1},
                                  first, kNoNode);
    const NodeId whole = at(TokenKind::SignColon) && !panic_ ? slice(node, first) : node;
    --nesting_;
    expect(TokenKind::SignBracketClose, Diag::ExpectedBracketClose, {found(), line},
           {.fix = write_behind_last(position_, "]")});
    return whole;
}

// Behind `v[first`, at the `:`.
NodeId Parser::slice(NodeId element, NodeId first) {
    const TokenId colon = position_;
    const ConstantValue start = constant_value(tree_, first);
    if (!start.value && !start.is_unknown) {
        syntax_error(Diag::SliceStartNotConstant);
        return error_node(colon);
    }
    advance();
    const NodeId last = expression();
    if (panic_) return error_node(colon);
    const ConstantValue end = constant_value(tree_, last);
    if (!end.value && !end.is_unknown) error(Diag::SliceEndNotConstant, colon);
    if (!start.value || !end.value) return error_node(tree_[element].token);
    if (*end.value < *start.value) {
        error(Diag::SliceReversed, position_,
              {std::to_string(*start.value), std::to_string(*end.value)});
        return error_node(tree_[element].token);
    }
    const int64_t words = int64_t{*end.value} - *start.value + 1;
    const NodeId from = add(
        {.kind = NodeKind::Number, .token = tree_[first].token, .value = *start.value, .size = 1});
    const NodeId to =
        add({.kind = NodeKind::Number, .token = tree_[last].token, .value = *end.value, .size = 1});
    tree_[from].next = to;
    return add({.kind = NodeKind::Slice,
                .token = tree_[element].token,
                .value = tree_[element].value,
                .size = tree_[element].size == 0 ? 0 : limited(words),
                .first = from});
}

NodeId Parser::tuple() {
    const TokenId open = position_;
    const std::string line = line_of(position_);
    advance();
    if (++nesting_ > kNestingMax) give_up();
    const NodeId whole = elements(open);
    --nesting_;
    expect(TokenKind::SignBracketClose, Diag::ExpectedTupleEnd, {found(), line});
    return whole;
}

// What is between commas, with brackets around it or without, as one tuple that begins there.
NodeId Parser::elements(TokenId first) {
    ChildList all;
    int64_t words = 0;
    bool is_known = true;
    uint16_t depth = 0;
    do {
        const NodeId next = element();
        is_known = is_known && tree_[next].size > 0;
        words = limited(words + tree_[next].size);
        depth = std::max(depth, tree_[next].depth);
        append(all, next);
    } while (!panic_ && accept(TokenKind::SignComma));
    return add({.kind = NodeKind::Tuple,
                .depth = static_cast<uint16_t>(depth + 1),
                .token = first,
                .size = is_known ? static_cast<int32_t>(words) : 0,
                .first = all.first});
}

// An element that begins with `[` is just that tuple: `[[1,2]+[3,4],5]` is an error at the `+`.
NodeId Parser::element() {
    return at(TokenKind::SignBracketOpen) ? tuple() : expression();
}

NodeId Parser::parenthesised() {
    const std::string line = line_of(position_);
    advance();
    if (++nesting_ > kNestingMax) give_up();
    const NodeId inside = condition();
    --nesting_;
    const bool assigns = at(TokenKind::SignAssign);
    const Fix fix = assigns ? replacing(mark(position_), "==") : write_behind_last(position_, ")");
    expect(TokenKind::SignParenClose, assigns ? Diag::ParenAssign : Diag::ExpectedParenClose,
           {found(), line}, {.fix = fix});
    return inside;
}

NodeId Parser::missing_operand() {
    const TokenId here = position_;
    report_no_operand();
    return error_node(here);
}

bool Parser::can_begin_operand() const {
    switch (kind()) {
        case TokenKind::Number:
        case TokenKind::Identifier:
        case TokenKind::SignSubtract:
        case TokenKind::SignBitNot:
        case TokenKind::Abs:
        case TokenKind::SignParenOpen:
        case TokenKind::SignBracketOpen:
            return true;
        default:
            return false;
    }
}

// An operator node over its operands. Its size, unless it has one: that of the operands; 0 where
// they clash.
NodeId Parser::operation(Node node, NodeId left, NodeId right) {
    int depth = tree_[left].depth;
    if (right != kNoNode) depth = std::max<int>(depth, tree_[right].depth);
    if (depth + 1 > kTreeDepthMax) {
        error(Diag::ExpressionTooLong, node.token, {std::to_string(kTreeDepthMax)});
        panic_ = true;
        return error_node(node.token);
    }
    node.depth = static_cast<uint16_t>(depth + 1);
    node.first = left;
    const int32_t size = tree_[left].size;
    if (node.kind != NodeKind::Element) {
        node.size = right == kNoNode || tree_[right].size == size ? size : 0;
    }
    if (right != kNoNode) tree_[left].next = right;
    return add(node);
}

}  // namespace vagus::aesl
