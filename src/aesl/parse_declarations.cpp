// Constants and variables (docs/spec/aesl-language.md, sections 2.1, 3.7 and 6, rule 4).
#include "aesl/expand.hpp"
#include "aesl/limits.hpp"
#include "aesl/parser.hpp"
#include "aesl/places.hpp"
#include "aesl/sizes.hpp"

namespace vagus::aesl {

void Parser::const_definition() {
    statement_start_ = position_;
    const size_t before = errors();
    advance();
    const TokenId name = position_;
    if (!declared_name("const")) {
        recover();
        return;
    }
    const ConstantSymbol* old = symbol(name).constant < 0
                                    ? nullptr
                                    : &constants_[static_cast<size_t>(symbol(name).constant)];
    if (old != nullptr) {
        const std::string where =
            old->token == 0 ? " for the whole network" : " in line " + line_of(old->token);
        error(Diag::ConstantTwice, name, {name_text(name), where});
    }
    std::optional<int32_t> value;
    if (expect(TokenKind::SignAssign, Diag::ExpectedConstAssign, {found(), name_text(name)},
               {.fix = write_before(position_, "= ")})) {
        const NodeId expression_node = expression();
        if (!panic_) value = constant_for(name, expression_node);
    }
    if (old == nullptr) define_constant(name, value);
    finish_simple(kNoNode, before);
}

bool Parser::declared_name(std::string_view keyword) {
    if (accept(TokenKind::Identifier)) return true;
    report_no_name(keyword);
    return false;
}

void Parser::define_constant(TokenId name, std::optional<int32_t> value) {
    symbol(name).constant = static_cast<int32_t>(constants_.size());
    constants_.push_back({value.value_or(0), value.has_value(), name});
}

std::optional<int32_t> Parser::constant_for(TokenId name, NodeId value) {
    const ConstantValue result = constant_value(tree_, value);
    if (result.problem) {
        error(result.problem->what, result.problem->token, {name_text(result.problem->token)});
    } else if (!result.value && !result.is_unknown &&
               check_first_place(tree_, value, diagnostics_)) {
        error(Diag::ConstantNotConstant, name, {name_text(name)});
    }
    return result.value;
}

// The order of the checks is that of section 3.2: size, name, initialiser, space. Gives the
// assignment of the initial value, if there is one.
NodeId Parser::var_definition() {
    statement_start_ = position_;
    const size_t before = errors();
    advance();
    const TokenId name = position_;
    if (!declared_name("var")) {
        return recover();
    }
    DeclaredSize size = array_size(name);
    const bool is_free = !panic_ && name_is_free(name);
    const TokenId assign = position_;
    NodeId value = kNoNode;
    bool is_list = false;
    if (!panic_ && accept(TokenKind::SignAssign)) value = initialiser(&is_list);
    if (size.is_open && value != kNoNode && !panic_) {
        check_sizes_of(tree_, value, diagnostics_);
        size.words = tree_[value].size;
    }
    if (size.is_open && value == kNoNode && is_free && !panic_) {
        error(Diag::UndefinedSize, name, {name_text(name)});
    }
    if (!is_free && !panic_) return finish_simple(kNoNode, before);
    const VariableId variable = declare(name, size.is_open && value == kNoNode ? 0 : size.words);
    if (value != kNoNode && at(TokenKind::SignComma)) syntax_error(Diag::ListWithoutBrackets);
    if (value == kNoNode || panic_) return finish_simple(kNoNode, before);
    if (is_2007_ && size.is_given && !size.is_open && is_list) {
        value = filled_with_zeros(value, size.words);
    }
    const NodeId left = add({.kind = NodeKind::Variable,
                             .token = name,
                             .value = static_cast<int32_t>(variable),
                             .size = tree_.variables[variable].size});
    tree_[left].next = value;
    const NodeId node = add({.kind = NodeKind::Assign,
                             .op = kPlainAssignment,
                             .bad = errors() > before,
                             .token = assign,
                             .first = left});
    return finish_simple(node, before);
}

Parser::DeclaredSize Parser::array_size(TokenId name) {
    const TokenId bracket = position_;
    if (!accept(TokenKind::SignBracketOpen)) return {};
    if (accept(TokenKind::SignBracketClose)) return {.is_given = true, .is_open = true};
    DeclaredSize size{.is_given = true};
    const NodeId words = expression();
    if (!panic_) size.words = checked_size(name, bracket, words);
    expect(TokenKind::SignBracketClose, Diag::ExpectedBracketClose, {found(), line_of(bracket)});
    return size;
}

int32_t Parser::checked_size(TokenId name, TokenId bracket, NodeId expression_node) {
    const ConstantValue size = constant_value(tree_, expression_node);
    if (size.problem) {
        error(size.problem->what, size.problem->token, {name_text(size.problem->token)});
    } else if (size.value && *size.value < 0) {
        error(Diag::SizeNegative, bracket, {name_text(name), std::to_string(*size.value)});
    } else if (size.value == 0) {
        error(Diag::SizeZero, bracket, {name_text(name)});
    } else if (size.value) {
        return *size.value;
    } else if (!size.is_unknown && check_first_place(tree_, expression_node, diagnostics_)) {
        error(Diag::SizeNotConstant, bracket, {name_text(name)});
    }
    return 0;
}

bool Parser::name_is_free(TokenId name) {
    const Symbol& known = symbol(name);
    if (known.variable >= 0 && !known.is_implicit) {
        const TokenId old = tree_.variables[static_cast<size_t>(known.variable)].token;
        const std::string where = old == 0 ? " by the node" : " in line " + line_of(old);
        error(Diag::VariableTwice, name, {name_text(name), where});
        return false;
    }
    if (known.constant >= 0) {
        error(Diag::VariableIsConstant, name, {name_text(name)});
        return false;
    }
    return true;
}

// The list form is taken if, and only if, a comma follows the next token, or the one behind a minus
// (section 2.1).
NodeId Parser::initialiser(bool* is_list) {
    const bool is_minus = at(TokenKind::SignSubtract);
    if (kind_ahead(is_minus ? 2 : 1) == TokenKind::SignComma) {
        *is_list = true;
        return elements(position_);
    }
    const NodeId value = expression();
    *is_list = tree_[value].kind == NodeKind::Tuple || tree_[value].size == 1;
    return value;
}

// 2007:  var v[4] = 1, 2  is  var v[4] = [1, 2, 0, 0]  (section 6, rule 4). Other lists stay as
// they are.
NodeId Parser::filled_with_zeros(NodeId list, int32_t size) {
    const int32_t given = tree_[list].size;
    if (given <= 0 || given >= size || size > kAddressableWords) return list;
    const TokenId start = tree_[list].token;
    ChildList elements;
    append(elements, list);
    for (int32_t i = given; i < size; ++i) {
        append(elements, add({.kind = NodeKind::Number, .token = start, .value = 0, .size = 1}));
    }
    return add({.kind = NodeKind::Tuple,
                .depth = static_cast<uint16_t>(tree_[list].depth + 1),
                .token = start,
                .size = size,
                .first = elements.first});
}

VariableId Parser::declare(TokenId name, int32_t size) {
    const int32_t free_words = tree_.memory_words - tree_.variable_words;
    if (size > free_words) {
        error(Diag::NotEnoughSpace, name,
              {name_text(name), words_of(size), words_of(free_words),
               std::to_string(tree_.memory_words)});
        size = 0;
    }
    const auto id = static_cast<VariableId>(tree_.variables.size());
    tree_.variables.push_back(
        {.name = tree_.text(name), .token = name, .address = tree_.variable_words, .size = size});
    tree_.variable_words += size;
    symbol(name).variable = static_cast<int32_t>(id);
    symbol(name).is_implicit = false;
    return id;
}

// `int speed = 3`, `vra speed`: the word in front is unknown, what follows is meant as a
// declaration. It is declared, so that the one mistake stays one.
NodeId Parser::undeclared_words(size_t errors_before, TokenId start) {
    const bool looks_declared =
        errors() > errors_before && tree_.tokens[start].kind == TokenKind::Identifier &&
        tree_.tokens[start + 1].kind == TokenKind::Identifier && !is_first_of_line(start + 1);
    if (!looks_declared) return kNoNode;
    const Symbol& known = symbol(start + 1);
    if (known.variable < 0 && known.constant < 0) declare_implicitly(start + 1);
    return kNoNode;
}

}  // namespace vagus::aesl
