// Statements (docs/spec/aesl-language.md, chapter 2 and section 3.8).
#include <algorithm>

#include "aesl/fix.hpp"
#include "aesl/limits.hpp"
#include "aesl/parser.hpp"

namespace vagus::aesl {
namespace {

using isa::BinaryOperator;

constexpr uint8_t kNoOperator = 0xfe;

// `op` of the Assign node that a token makes, or kNoOperator.
uint8_t assignment_operator(TokenKind kind) {
    switch (kind) {
        case TokenKind::SignAssign:
            return kPlainAssignment;
        case TokenKind::SignAddAssign:
            return static_cast<uint8_t>(BinaryOperator::Add);
        case TokenKind::SignSubtractAssign:
            return static_cast<uint8_t>(BinaryOperator::Subtract);
        case TokenKind::SignMultiplyAssign:
            return static_cast<uint8_t>(BinaryOperator::Multiply);
        case TokenKind::SignDivideAssign:
            return static_cast<uint8_t>(BinaryOperator::Divide);
        case TokenKind::SignModuloAssign:
            return static_cast<uint8_t>(BinaryOperator::Modulo);
        case TokenKind::SignShiftLeftAssign:
            return static_cast<uint8_t>(BinaryOperator::ShiftLeft);
        case TokenKind::SignShiftRightAssign:
            return static_cast<uint8_t>(BinaryOperator::ShiftRight);
        case TokenKind::SignBitOrAssign:
            return static_cast<uint8_t>(BinaryOperator::BitOr);
        case TokenKind::SignBitXorAssign:
            return static_cast<uint8_t>(BinaryOperator::BitXor);
        case TokenKind::SignBitAndAssign:
            return static_cast<uint8_t>(BinaryOperator::BitAnd);
        default:
            return kNoOperator;
    }
}

}  // namespace

NodeId Parser::statement() {
    statement_start_ = position_;
    if (++nesting_ > kNestingMax) give_up();
    const NodeId made = statement_by_keyword();
    --nesting_;
    return made;
}

NodeId Parser::statement_by_keyword() {
    switch (kind()) {
        case TokenKind::If:
            return if_statement();
        case TokenKind::When:
            return when_or_while(NodeKind::When);
        case TokenKind::While:
            return when_or_while(NodeKind::While);
        case TokenKind::For:
            return for_statement();
        case TokenKind::Emit:
        case TokenKind::EmitShort:
            return emit_statement();
        case TokenKind::Call:
            return call_statement();
        case TokenKind::CallSub:
            return callsub_statement();
        case TokenKind::Return: {
            const TokenId keyword = position_;
            advance();
            return add({.kind = NodeKind::Return, .token = keyword});
        }
        case TokenKind::Identifier:
            return assignment();
        default:
            return unexpected_statement();
    }
}

// A token that cannot begin a statement.
NodeId Parser::unexpected_statement() {
    const auto sent_nothing = sent_nothing_;
    sent_nothing_.reset();
    report_no_statement(sent_nothing);
    return recover();
}

// `var` and `const` where they are not allowed: reported, but what they declare counts.
NodeId Parser::misplaced_declaration() {
    const bool is_var = at(TokenKind::Var);
    const bool is_top = nesting_ == 0;
    if (!is_var) {
        syntax_error(Diag::MisplacedConst);
    } else if (is_top) {
        error(Diag::MisplacedVar, position_, {}, {.fix = moved_var()});
    } else {
        syntax_error(Diag::VarInBlock, {}, {.fix = moved_var()});
    }
    panic_ = false;
    if (is_var) return var_definition();
    const_definition();
    return kNoNode;
}

// The statements up to a token that closes the block, or that must not be in one.
void Parser::statements(ChildList& list) {
    while (true) {
        switch (kind()) {
            case TokenKind::EndOfText:
            case TokenKind::End:
            case TokenKind::Else:
            case TokenKind::ElseIf:
            case TokenKind::OnEvent:
            case TokenKind::Sub:
                return;
            case TokenKind::Var:
            case TokenKind::Const:
                append(list, misplaced_declaration());
                break;
            default: {
                const TokenId start = position_;
                append(list, statement());
                if (position_ == start) advance();
            }
        }
    }
}

NodeId Parser::block() {
    const TokenId before = position_ == 0 ? 0 : position_ - 1;
    ChildList list;
    statements(list);
    return add({.kind = NodeKind::Block, .token = before, .first = list.first});
}

NodeId Parser::if_statement() {
    const TokenId keyword = position_;
    ++open_ifs_;
    ChildList branches;
    append(branches, clause());
    const NodeId node = add({.kind = NodeKind::If, .token = keyword});
    else_branches(node, branches);
    tree_[node].first = branches.first;
    --open_ifs_;
    return node;
}

// `if` or `elseif`, condition, `then`, statements.
NodeId Parser::clause() {
    const TokenId keyword = position_;
    const size_t before = errors();
    statement_start_ = position_;
    advance();
    const NodeId test = condition();
    expect_opener(TokenKind::Then, Diag::ExpectedThen, keyword);
    const bool is_bad = errors() > before;
    tree_[test].next = block();
    return add({.kind = NodeKind::Clause, .bad = is_bad, .token = keyword, .first = test});
}

void Parser::else_branches(NodeId node, ChildList& branches) {
    const TokenId keyword = tree_[node].token;
    const std::string line = line_of(keyword);
    bool had_else = false;
    std::optional<TokenId> two_words;  // the `else` of an `else if`
    while (at(TokenKind::Else) || at(TokenKind::ElseIf)) {
        if (had_else) {
            syntax_error(Diag::ElseAfterElse, {found(), line});
            panic_ = false;
        }
        if (at(TokenKind::ElseIf)) {
            const NodeId branch = clause();
            if (!had_else) append(branches, branch);
            continue;
        }
        advance();
        if (at(TokenKind::If) && !is_first_of_line(position_)) two_words = position_ - 1;
        const NodeId branch = block();
        if (!had_else) append(branches, branch);
        had_else = true;
    }
    expect_end(keyword, two_words);
    tree_[node].value = static_cast<int32_t>(position_) - 1;
}

NodeId Parser::when_or_while(NodeKind node_kind) {
    const TokenId keyword = position_;
    const size_t before = errors();
    advance();
    const NodeId test = condition();
    expect_opener(TokenKind::Do, Diag::ExpectedDo, keyword);
    const bool is_bad = errors() > before;
    tree_[test].next = loop_body(keyword);
    return add({.kind = node_kind,
                .bad = is_bad,
                .token = keyword,
                .value = static_cast<int32_t>(position_) - 1,
                .first = test});
}

NodeId Parser::for_statement() {
    const TokenId keyword = position_;
    const size_t before = errors();
    advance();
    const NodeId variable = loop_variable();
    expect(TokenKind::In, Diag::ExpectedIn, {found()}, {.fix = instead_of_word("in")});
    const Bound first = loop_bound("first bound");
    expect(TokenKind::SignColon, Diag::ExpectedLoopColon, {found()}, {.fix = instead_of_word(":")});
    const Bound last = loop_bound("last bound");
    const bool has_step = !panic_ && accept(TokenKind::Step);
    const Bound step = has_step ? loop_bound("step") : Bound{.token = keyword, .value = 1};
    if (!panic_) check_bounds(first, last, step);
    const bool is_do_missing = has_step || is_first_of_line(position_);
    expect_opener(TokenKind::Do, is_do_missing ? Diag::ExpectedDo : Diag::ExpectedDoOrStep,
                  keyword);
    const bool is_bad = errors() > before;
    ChildList parts;
    append(parts, variable);
    for (const Bound& bound : {first, last, step}) {
        append(parts, add({.kind = NodeKind::Number,
                           .token = bound.token,
                           .value = bound.value.value_or(0),
                           .size = 1}));
    }
    append(parts, loop_body(keyword));
    const bool is_known = first.value && last.value && step.value;
    return add({.kind = NodeKind::For,
                .bad = is_bad || !is_known,
                .token = keyword,
                .value = static_cast<int32_t>(position_) - 1,
                .first = parts.first});
}

NodeId Parser::loop_variable() {
    const TokenId name = position_;
    if (!at(TokenKind::Identifier)) {
        syntax_error(Diag::ExpectedLoopVariable, {found()});
        return error_node(name);
    }
    const Symbol& known = symbol(name);
    if (known.variable < 0) return unknown_variable(name, NameSpace::Variable);
    advance();
    return reference(name, static_cast<VariableId>(known.variable));
}

// A number, a negated number, or the bare name of a constant (section 3.8).
Parser::Bound Parser::loop_bound(std::string_view what) {
    if (panic_) return {.token = position_};
    const bool is_negative = accept(TokenKind::SignSubtract);
    Bound bound{.token = position_};
    if (at(TokenKind::Number)) {
        const Token number = token();
        const bool is_bad = number.value == kBadNumber;
        const bool is_high = is_negative && !number.is_decimal && number.value > kInt16Max;
        advance();
        if (is_bad) return bound;
        int32_t value = number.value;
        if (!number.is_decimal && !is_negative && value > kInt16Max) value -= 0x10000;
        if (is_negative) value = -value;
        if (is_high || value > kInt16Max || value < -kInt16Max - 1) {
            const std::string sign = is_negative ? "-" : "";
            error(Diag::NumberTooLarge, bound.token, {sign + name_text(bound.token)});
        } else {
            bound.value = value;
        }
    } else if (at(TokenKind::Identifier) && !is_negative) {
        bound.value = named_bound();
    } else {
        syntax_error(Diag::ExpectedBound, {found(), what});
    }
    return bound;
}

std::optional<int32_t> Parser::named_bound() {
    const TokenId name = position_;
    const Symbol known = symbol(name);
    advance();
    if (known.constant < 0) {
        const std::string similar = guess(name, NameSpace::Constant);
        if (tree_.text(name) == "range" && at(TokenKind::SignParenOpen)) {
            error(Diag::RangeAsBound, name);
        } else if (known.variable >= 0) {
            error(Diag::VariableAsBound, name, {name_text(name)});
        } else if (similar.empty()) {
            error(Diag::UnknownConstant, name, {name_text(name)});
        } else {
            error(Diag::UnknownConstantGuess, name, {name_text(name), similar},
                  {.fix = replacing(mark(name), similar)});
        }
        return std::nullopt;
    }
    const ConstantSymbol& constant = constants_[static_cast<size_t>(known.constant)];
    if (!constant.is_known) return std::nullopt;
    if (constant.value > kInt16Max || constant.value < -kInt16Max - 1) {
        error(Diag::ConstantTooLarge, name, {name_text(name), std::to_string(constant.value)});
        return std::nullopt;
    }
    return constant.value;
}

// Step 0, then the order of start and end, then the last value (section 3.2).
bool Parser::check_bounds(const Bound& first, const Bound& last, const Bound& step) {
    if (step.value == 0) {
        error(Diag::LoopStepZero, step.token);
        return false;
    }
    if (!first.value || !last.value || !step.value) return false;
    const bool rises = *step.value > 0;
    const std::string from = std::to_string(*first.value);
    const std::string to = std::to_string(*last.value);
    if (rises && *first.value > *last.value) {
        error(Diag::LoopStartTooHigh, first.token, {from, to});
    } else if (!rises && *first.value < *last.value) {
        error(Diag::LoopStartTooLow, first.token, {from, to});
    } else if (rises && *last.value == kInt16Max) {
        error(Diag::LoopEndMax, last.token, {}, {.fix = replacing(mark(last.token), "32766")});
    } else if (!rises && *last.value == -kInt16Max - 1) {
        error(Diag::LoopEndMin, last.token);
    } else {
        return true;
    }
    return false;
}

// The block of `when`, `while` and `for`, with its `end`.
NodeId Parser::loop_body(TokenId opener) {
    const TokenId before = position_ == 0 ? 0 : position_ - 1;
    ChildList list;
    statements(list);
    // An `else` here belongs to an `if` around, whose inner block lacks its `end`; without one it
    // is out of place.
    while (open_ifs_ == 0 && (at(TokenKind::Else) || at(TokenKind::ElseIf))) {
        const std::string line = line_of(opener);
        syntax_error(Diag::ElseInLoop, {found(), tree_.text(opener), line});
        panic_ = false;
        skip_branch_head();
        statements(list);
    }
    expect_end(opener, std::nullopt);
    return add({.kind = NodeKind::Block, .token = before, .first = list.first});
}

// `then` or `do`. Where it is missing, the head ends at the other one of the two, at the next one
// before another statement, or right here.
void Parser::expect_opener(TokenKind opener, Diag what, TokenId keyword) {
    if (!panic_ && accept(opener)) return;
    report_no_opener(opener, what, keyword);
    panic_ = false;
    for (TokenId ahead = position_;; ++ahead) {
        const TokenKind next = tree_.tokens[ahead].kind;
        if (next == TokenKind::Then || next == TokenKind::Do) {
            position_ = ahead + 1;
            return;
        }
        const bool is_keyword_of_statement = is_keyword(next) && next != TokenKind::And &&
                                             next != TokenKind::Or && next != TokenKind::Not &&
                                             next != TokenKind::Abs && next != TokenKind::In &&
                                             next != TokenKind::Step;
        if (next == TokenKind::EndOfText || is_keyword_of_statement) break;
        if (is_first_of_line(ahead) && assigns_next(ahead)) break;
    }
    if (!is_first_of_line(position_) && !is_keyword(kind())) {
        statement_start_ = position_;
        recover();
    }
}

void Parser::expect_end(TokenId opener, std::optional<TokenId> two_words) {
    if (accept(TokenKind::End)) return;
    const std::string line = line_of(opener);
    const std::string word = shown(tree_.text(opener));
    if (two_words) {
        const Mark place = marks(*two_words, *two_words + 1);
        error_elsewhere(Diag::ElseIfInTwoWords, place, {found(), word, line},
                        replacing(place, "elseif"));
    } else {
        const bool is_in_line = !is_first_of_line(position_) || at(TokenKind::EndOfText);
        syntax_error(Diag::MissingEnd, {found(), word, line},
                     {.fix = is_in_line ? write_behind_last(position_, "\nend")
                                        : write_before(position_, "end\n")});
    }
    panic_ = false;
    ++missing_ends_;
}

NodeId Parser::assignment() {
    const TokenId start = position_;
    const size_t before = errors();
    const NodeId left = expression();
    const TokenId op = position_;
    const uint8_t assigns = assignment_operator(kind());
    Node node{.token = op, .first = left};
    if (panic_) return finish_simple(undeclared_words(before, start), before);
    if (assigns != kNoOperator) {
        advance();
        node.kind = NodeKind::Assign;
        node.op = assigns;
        const NodeId right = expression();
        tree_[left].next = right;
        if (tree_[right].kind == NodeKind::Error) node.bad = true;
    } else if (at(TokenKind::SignIncrement) || at(TokenKind::SignDecrement)) {
        node.kind = NodeKind::Count;
        node.op = static_cast<uint8_t>(at(TokenKind::SignIncrement) ? BinaryOperator::Add
                                                                    : BinaryOperator::Subtract);
        advance();
    } else {
        missing_assignment(start);
        return finish_simple(undeclared_words(before, start), before);
    }
    node.bad = node.bad || errors() > before;
    return finish_simple(add(node), before);
}

}  // namespace vagus::aesl
