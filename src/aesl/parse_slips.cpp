// What a statement, head or declaration that cannot be read was probably meant as, and its fix.
#include "aesl/fix.hpp"
#include "aesl/parser.hpp"
#include "aesl/suggest.hpp"
#include "base/nearest.hpp"

namespace vagus::aesl {
namespace {

// Two signs that are one in other languages, written without a space between them.
struct Slip {
    TokenKind first;
    TokenKind second;
    std::string_view meant;
};
constexpr Slip kSlips[] = {
    {TokenKind::SignEqual, TokenKind::SignAssign, "=="},
    {TokenKind::SignNotEqual, TokenKind::SignAssign, "!="},
    {TokenKind::SignSmaller, TokenKind::SignBigger, "!="},
    {TokenKind::SignAssign, TokenKind::SignBigger, ">="},
    {TokenKind::SignAssign, TokenKind::SignSmaller, "<="},
    {TokenKind::SignMultiply, TokenKind::SignMultiply, "*"},
    {TokenKind::SignDivide, TokenKind::SignDivide, "#"},
    {TokenKind::SignDivide, TokenKind::SignMultiply, "#*"},
    {TokenKind::SignBitAnd, TokenKind::SignBitAnd, "and"},
    {TokenKind::SignBitOr, TokenKind::SignBitOr, "or"},
};

std::string_view slip_of(TokenKind first, TokenKind second) {
    for (const Slip& slip : kSlips)
        if (slip.first == first && slip.second == second) return slip.meant;
    return {};
}

}  // namespace

// ---- Statements

// A token that cannot begin a statement: `found()` at the current one.
void Parser::report_no_statement(std::optional<int32_t> sent_nothing) {
    const std::string what = found();
    const bool is_same_line = !is_first_of_line(position_);
    const TokenKind before =
        position_ == 0 ? TokenKind::EndOfText : tree_.tokens[position_ - 1].kind;
    if (at(TokenKind::End)) {
        syntax_error(Diag::StrayEnd, {}, {.fix = deleting(mark(position_), "end")});
    } else if (at(TokenKind::Else) || at(TokenKind::ElseIf)) {
        syntax_error(Diag::StrayElse, {what});
    } else if (is_same_line && sent_nothing && can_begin_operand()) {
        const std::string event = name_text(static_cast<TokenId>(*sent_nothing));
        syntax_error(Diag::EventTakesNoArgument, {what, event});
    } else if (at(TokenKind::SignBracketOpen) && before == TokenKind::SignBracketClose) {
        syntax_error(Diag::IndexOfExpression, {what});
    } else if (at(TokenKind::SignBracketOpen)) {
        syntax_error(Diag::LeftTuple, {what});
    } else if (at(TokenKind::SignDivide) && !is_same_line) {
        const Fix fix = replacing(marks(position_, position_ + 1), "#");
        const bool is_line = kind_ahead(1) == TokenKind::SignDivide;
        syntax_error(
            Diag::SlashComment,
            {is_line || kind_ahead(1) == TokenKind::SignMultiply
                 ? std::string(tree_.text(position_)) + std::string(tree_.text(position_ + 1))
                 : "/"},
            {.fix = is_line ? std::optional(fix) : std::nullopt});
    } else if (kind() >= TokenKind::SignEqual) {
        syntax_error(Diag::ComparedInAssignment, {what});
    } else if (!(is_same_line ? hint_rest_of_line(before) : hint_sign_first())) {
        syntax_error(Diag::ExpectedStatement, {what});
    }
}

// `++i`
bool Parser::hint_sign_first() {
    const bool counts = at(TokenKind::SignIncrement) || at(TokenKind::SignDecrement);
    if (!counts || kind_ahead(1) != TokenKind::Identifier) return false;
    const std::string sign(tree_.text(position_));
    const std::string name(tree_.text(position_ + 1));
    syntax_error(Diag::CountBefore, {found(), name_text(position_ + 1) + sign},
                 {.fix = replacing(marks(position_, position_ + 1), name + sign)});
    return true;
}

// What is behind a whole statement on its line.
bool Parser::hint_rest_of_line(TokenKind before) {
    const TokenId last = position_ - 1;
    const bool is_name = before == TokenKind::Identifier;
    const bool is_declared = position_ >= 2 && tree_.tokens[last - 1].kind == TokenKind::Var;
    if (before == TokenKind::Return) {
        syntax_error(Diag::ReturnWithNumber, {found()});
    } else if (at(TokenKind::SignColon) && before == TokenKind::Else) {
        syntax_error(Diag::NeedlessColon, {"else"}, {.fix = deleting(mark(position_), ":")});
    } else if ((at(TokenKind::Then) || at(TokenKind::Do)) && before == TokenKind::Else) {
        syntax_error(Diag::NeedlessThen, {found()},
                     {.fix = deleting(mark(position_), tree_.text(position_))});
    } else if (at(TokenKind::SignParenOpen) && is_name && touches_next(last)) {
        hint_brackets(last);
    } else if ((at(TokenKind::SignIncrement) || at(TokenKind::SignDecrement)) && is_name) {
        syntax_error(Diag::CountInExpression, {found(), name_text(last) + name_text(position_)});
    } else if (at(TokenKind::SignAssign) && is_name && is_first_of_line(last) && last > 1 &&
               assigns_next(last - 2)) {
        const Position behind = mark(last - 1).end;
        error_elsewhere(Diag::ValueMissing, {behind, behind}, {name_text(last - 1)});
    } else if (at(TokenKind::SignAssign) && is_name) {
        syntax_error(Diag::SecondAssignment);
    } else if (at(TokenKind::SignComma) && is_name && is_declared &&
               kind_ahead(1) == TokenKind::Identifier) {
        const std::string name(tree_.text(position_ + 1));
        syntax_error(Diag::CommaInVar, {name_text(position_ + 1)},
                     {.fix = replacing(marks(position_, position_ + 1), "\nvar " + name)});
    } else if (at(TokenKind::SignSubtract) && is_name && is_declared && touches_next(last) &&
               kind_ahead(1) == TokenKind::Identifier) {
        const std::string whole =
            std::string(tree_.text(last)) + "_" + std::string(tree_.text(position_ + 1));
        syntax_error(Diag::DashInName, {name_text(last), name_text(position_ + 1)},
                     {.fix = replacing(marks(last, position_ + 1), whole)});
    } else {
        return false;
    }
    return true;
}

// `prox.horizontal(2)`
void Parser::hint_brackets(TokenId name) {
    std::optional<Fix> fix;
    if (kind_ahead(2) == TokenKind::SignParenClose) {
        const std::string index(tree_.text(position_ + 1));
        fix = replacing(marks(name, position_ + 2),
                        std::string(tree_.text(name)) + "[" + index + "]");
    }
    syntax_error(Diag::BracketsWanted, {name_text(name)}, {.fix = fix});
    // The statement before is part of the mistake: its sizes say nothing.
    for (size_t i = tree_.nodes.size(); i-- > 0;) {
        if (tree_.nodes[i].kind != NodeKind::Assign) continue;
        tree_.nodes[i].bad = true;
        break;
    }
}

// A statement that begins with a variable and then does not assign to it.
void Parser::missing_assignment(TokenId start) {
    const std::string name = name_text(start);
    const TokenId before = position_ - 1;
    const bool is_call = at(TokenKind::SignParenOpen) && symbol(start).native >= 0;
    const bool is_alone = start == before && is_first_of_line(position_);
    const bool is_after_return =
        start > 0 && !is_first_of_line(start) && tree_.tokens[start - 1].kind == TokenKind::Return;
    const Mark behind{mark(before).end, mark(before).end};
    if (kind() == TokenKind::SignEqual) {
        syntax_error(Diag::ComparisonAsStatement, {found(), name},
                     {.fix = replacing(mark(position_), "=")});
    } else if (is_call) {
        syntax_error(Diag::CallWithoutKeyword, {found(), name, "call"},
                     {.fix = write_before(start, "call ")});
    } else if (is_after_return) {
        error_elsewhere(Diag::ReturnWithValue, marks(start, before), {name});
    } else if (is_sub_somewhere(start)) {
        syntax_error(Diag::SubNameAlone, {name, found()}, {.fix = write_before(start, "callsub ")});
    } else if (is_alone) {
        error_elsewhere(Diag::NameAlone, behind, {name});
    } else if (at(TokenKind::SignComma)) {
        syntax_error(Diag::PairAssigned, {name});
    } else if (at(TokenKind::SignColon)) {
        const bool is_walrus = kind_ahead(1) == TokenKind::SignAssign;
        syntax_error(Diag::ColonAssigned, {name},
                     {.fix = replacing(marks(position_, position_ + (is_walrus ? 1 : 0)), "=")});
    } else if (at(TokenKind::Number) && !is_first_of_line(position_)) {
        syntax_error(Diag::SignMissing, {name, found()}, {.fix = write_before(position_, "= ")});
    } else {
        syntax_error(Diag::ExpectedAssignment, {found(), name});
    }
}

// ---- Heads and expressions

// For a sign or keyword that is missing: a word or sign is in its place, as in `for i from 1`.
std::optional<Fix> Parser::instead_of_word(std::string text) const {
    const bool is_in_place = at(TokenKind::Identifier) || at(TokenKind::SignAssign) ||
                             at(TokenKind::SignComma) || at(TokenKind::SignColon);
    if (!is_in_place || is_first_of_line(position_)) return std::nullopt;
    return replacing(mark(position_), std::move(text));
}

// `then` or `do` is missing at the current token.
void Parser::report_no_opener(TokenKind opener, Diag what, TokenId keyword) {
    const std::string word(spelling_of(opener));
    const TokenId next = position_ + 1;
    const std::string_view slip = slip_of(kind(), kind_ahead(1));
    const bool is_slip = at(TokenKind::SignAssign) && !slip.empty() && touches_next(position_);
    if (is_slip && what != Diag::ExpectedDoOrStep) {
        const std::string found_slip = "\"" + name_text(position_) + name_text(next) + "\"";
        return syntax_error(Diag::ThenAfterSlip, {found_slip, word, slip},
                            {.fix = replacing(marks(position_, next), std::string(slip))});
    }
    if (at(TokenKind::Identifier) && tree_.text(position_) == "is") {
        return syntax_error(Diag::ThenAfterSlip, {found(), word, "=="},
                            {.fix = replacing(mark(position_), "==")});
    }
    if (at(TokenKind::SignAssign) && what != Diag::ExpectedDoOrStep) {
        return syntax_error(Diag::ThenAfterAssign, {found(), word},
                            {.fix = replacing(mark(position_), "==")});
    }
    const bool is_other_word =
        at(TokenKind::Then) || at(TokenKind::Do) || at(TokenKind::SignColon) ||
        (at(TokenKind::Identifier) && nearest(in_small_letters(tree_.text(position_)),
                                              std::vector<std::string_view>{word}) == word);
    const std::string space = position_ > 0 && touches_next(position_ - 1) ? " " : "";
    syntax_error(what, {found(), shown(tree_.text(keyword))},
                 {.fix = is_other_word ? replacing(mark(position_), space + word)
                                       : write_behind_last(position_, " " + word)});
}

// A second sign where a value is wanted: `&&`, `===`, `**`, `//`.
bool Parser::hint_slip() {
    const TokenId last = position_ - 1;
    const std::string_view meant =
        position_ == 0 ? std::string_view{} : slip_of(tree_.tokens[last].kind, kind());
    if (meant.empty() || !touches_next(last)) return false;
    const std::string whole = name_text(last) + name_text(position_);
    const Mark both = marks(last, position_);
    const bool is_word = meant == "and" || meant == "or";
    if (meant == "#" || meant == "#*") {
        const Fix fix = replacing(both, std::string(meant));
        syntax_error(Diag::CommentInExpression, {found()},
                     {.fix = meant == "#" ? std::optional(fix) : std::nullopt});
    } else if (meant == "*") {
        syntax_error(Diag::NoPower, {found(), whole});
    } else if (is_word) {
        const std::string left = last > 0 && touches_next(last - 1) ? " " : "";
        const std::string right = touches_next(position_) ? " " : "";
        syntax_error(Diag::DoubledOperator, {name_text(position_), meant},
                     {.fix = replacing(both, left + std::string(meant) + right)});
    } else {
        syntax_error(Diag::OperatorSlip, {found(), whole, meant},
                     {.fix = replacing(both, std::string(meant))});
    }
    return true;
}

// `end if`, with the next statement where its condition should be.
bool Parser::hint_end_of_kind() {
    if (position_ < 2) return false;
    const TokenId keyword = position_ - 1;
    const TokenKind kind_before = tree_.tokens[keyword].kind;
    const bool opens = kind_before == TokenKind::If || kind_before == TokenKind::While ||
                       kind_before == TokenKind::When;
    const bool is_end = tree_.tokens[keyword - 1].kind == TokenKind::End;
    if (!opens || !is_end || is_first_of_line(keyword)) return false;
    syntax_error(Diag::EndOfKind, {found(), name_text(keyword)},
                 {.fix = deleting(mark(keyword), tree_.text(keyword))});
    return true;
}

void Parser::report_no_operand() {
    switch (kind()) {
        case TokenKind::SignAdd:
            return syntax_error(Diag::UnaryPlus, {}, {.fix = deleting(mark(position_), "+")});
        case TokenKind::Not:
            return syntax_error(Diag::NotInExpression);
        case TokenKind::SignBracketClose: {
            const bool has_comma =
                position_ > 0 && tree_.tokens[position_ - 1].kind == TokenKind::SignComma;
            return syntax_error(
                Diag::EmptyTuple, {},
                {.fix =
                     has_comma ? std::optional(deleting(mark(position_ - 1), ",")) : std::nullopt});
        }
        default:
            if (!hint_slip() && !hint_end_of_kind()) syntax_error(Diag::ExpectedOperand, {found()});
    }
}

// ---- Declarations

// A name is wanted and something else is there.
void Parser::report_no_name(std::string_view keyword) {
    if (!is_keyword(kind())) return syntax_error(Diag::ExpectedDeclaredName, {found(), keyword});
    const std::string other = "my_" + std::string(tree_.text(position_));
    syntax_error(Diag::KeywordAsName, {found(), keyword, other},
                 {.fix = replacing(mark(position_), other)});
    // The rest of the line was meant as the declaration. Nothing is left of the text where that was
    // one error too many.
    const TokenId name = position_;
    const bool has_more =
        !at(TokenKind::EndOfText) && !is_first_of_line(name) && !is_first_of_line(name + 1);
    if (has_more) advance();
    while (has_more && !at(TokenKind::EndOfText) && !is_first_of_line(position_)) advance();
}

// The `var` at the current token moves to the start of the program; where it has an initial value,
// the assignment stays.
std::optional<Fix> Parser::moved_var() const {
    if (kind_ahead(1) != TokenKind::Identifier) return std::nullopt;
    const TokenId name = position_ + 1;
    TokenId last = name;
    if (kind_ahead(2) == TokenKind::SignBracketOpen) {
        if (kind_ahead(4) != TokenKind::SignBracketClose) return std::nullopt;
        last = position_ + 4;
    }
    const bool has_value = tree_.tokens[last + 1].kind == TokenKind::SignAssign;
    const Mark declaration = marks(name, last);
    const Token& first = tree_.tokens[name];
    const Token& end = tree_.tokens[last];
    const std::string text(
        tree_.source.substr(first.offset, end.offset + end.length - first.offset));
    Fix fix = declare_first("var " + text);
    fix.label = "Move \"var " + text + "\" to the start";
    if (!has_value) {
        fix.edits.push_back({{mark(position_).at, declaration.end}, ""});
    } else {
        fix.edits.push_back({{mark(position_).at, mark(name).at}, ""});
        if (last != name) fix.edits.push_back({{mark(name).end, declaration.end}, ""});
    }
    return fix;
}

}  // namespace vagus::aesl
