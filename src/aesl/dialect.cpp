#include "aesl/dialect.hpp"

#include <algorithm>

namespace vagus::aesl {
namespace {

bool is_word(const Tree& tree, TokenId token, std::string_view word) {
    return tree.tokens[token].kind == TokenKind::Identifier && tree.text(token) == word;
}

// Whether a variable or constant of the name `ontimer` exists anywhere: then only a colon makes it
// a header.
bool is_ontimer_a_name(const Tree& tree, const Target& target, const CommonDefinitions& common) {
    const auto is_it = [](const auto& named) { return named.name == kOntimer; };
    if (std::any_of(target.variables.begin(), target.variables.end(), is_it)) return true;
    if (std::any_of(common.constants.begin(), common.constants.end(), is_it)) return true;
    for (TokenId i = 0; i + 1 < tree.tokens.size(); ++i) {
        const TokenKind kind = tree.tokens[i].kind;
        const bool declares = kind == TokenKind::Var || kind == TokenKind::Const;
        if (declares && is_word(tree, i + 1, kOntimer)) return true;
    }
    return false;
}

// Whether an item can begin behind this token: it can end the item before.
bool can_end_item(TokenKind kind) {
    switch (kind) {
        case TokenKind::Identifier:
        case TokenKind::Number:
        case TokenKind::SignParenClose:
        case TokenKind::SignBracketClose:
        case TokenKind::SignIncrement:
        case TokenKind::SignDecrement:
        case TokenKind::End:
        case TokenKind::Return:
            return true;
        default:
            return false;
    }
}

bool assigns(TokenKind kind) {
    return kind == TokenKind::SignBracketOpen ||
           (kind >= TokenKind::SignAssign && kind <= TokenKind::SignDecrement);
}

// One pass over the tokens that keeps track of where an item can begin.
class DialectGuess {
public:
    DialectGuess(const Tree& tree, bool is_name) : tree_(tree), is_name_(is_name) {}

    bool finds_2007() {
        for (TokenId i = 0; i + 1 < tree_.tokens.size(); ++i) {
            if (is_sign(i)) return true;
            count_brackets(tree_.tokens[i].kind);
        }
        return false;
    }

private:
    TokenKind kind(TokenId i) const { return tree_.tokens[i].kind; }

    bool is_sign(TokenId i) const {
        if (kind(i) != TokenKind::Identifier) return false;
        const bool has_colon = kind(i + 1) == TokenKind::SignColon;
        const TokenKind before = i == 0 ? TokenKind::End : kind(i - 1);
        const bool is_header = before == TokenKind::OnEvent || before == TokenKind::Sub;
        if (is_header) return has_colon;
        if (!is_word(tree_, i, kOntimer) || brackets_ > 0 || !item_can_begin(i)) return false;
        return has_colon || (!is_name_ && !assigns(kind(i + 1)));
    }

    bool item_can_begin(TokenId i) const {
        if (i == 0) return true;
        if (!can_end_item(kind(i - 1))) return false;
        if (i < 2) return true;
        // Behind `emit NAME`, on its line, it is the argument; with a colon it is a header all the
        // same.
        const TokenKind two_before = kind(i - 2);
        const bool is_argument =
            (two_before == TokenKind::Emit || two_before == TokenKind::EmitShort) &&
            tree_.tokens[i].line == tree_.tokens[i - 1].line;
        return !is_argument || kind(i + 1) == TokenKind::SignColon;
    }

    void count_brackets(TokenKind k) {
        if (k == TokenKind::SignParenOpen || k == TokenKind::SignBracketOpen) ++brackets_;
        if (k == TokenKind::SignParenClose || k == TokenKind::SignBracketClose) --brackets_;
        if (brackets_ < 0 || is_header_keyword(k)) brackets_ = 0;
    }

    static bool is_header_keyword(TokenKind k) {
        return k == TokenKind::OnEvent || k == TokenKind::Sub;
    }

    const Tree& tree_;
    bool is_name_;
    int brackets_ = 0;
};

}  // namespace

bool is_year_2007(const Tree& tree, const Target& target, const CommonDefinitions& common,
                  Dialect dialect) {
    if (dialect != Dialect::Auto) return dialect == Dialect::Year2007;
    return DialectGuess(tree, is_ontimer_a_name(tree, target, common)).finds_2007();
}

}  // namespace vagus::aesl
