// Recursive descent over the grammar of P8, by the ranks of operators. What recurses without a
// limit of its own - parentheses, functions, `not`, minuses - is counted.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "plan/formula.hpp"

namespace vagus::plan {

namespace {

bool starts_name(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}

bool continues_name(char c) {
    return starts_name(c) || (c >= '0' && c <= '9');
}

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

Error wrong(std::string what) {
    return Error{Code::BadInput, std::move(what)};
}

// What people who know other languages write, longest first, and what to write here.
struct Foreign {
    std::string_view text;
    std::string_view advice;
};

constexpr Foreign kForeignOperators[] = {
    {"===", "write == to compare"},
    {"!==", "write != to compare"},
    {"=>", "write >= for \"at least\""},
    {"=<", "write <= for \"at most\""},
    {"<>", "write != for \"differs from\""},
    {"&&", "write and"},
    {"||", "write or"},
    {"**", "there is no power; write a product, as x * x"},
    {"=", "write == to compare"},
    {"|", "write or"},
    {"!", "write not before a condition, or != to compare"},
    {"^", "there is no power; write a product, as x * x"},
    {"?", "write if(condition, a, b)"},
    {"≥", "write >="},
    {"≤", "write <="},
    {"≠", "write !="},
    {"×", "write *"},
    {"·", "write *"},
    {"÷", "write /"},
    {"–", "write - (a minus)"},
    {"−", "write - (a minus)"},
};

constexpr Foreign kForeignOperands[] = {
    {"!", "write not"},
    {"+", "a number needs no sign; delete the +"},
    {".", "write a digit before the point, as 0.5"},
    {"“", "write plain quotes, \" or '"},
    {"”", "write plain quotes, \" or '"},
    {"„", "write plain quotes, \" or '"},
    {"‘", "write plain quotes, \" or '"},
    {"’", "write plain quotes, \" or '"},
    {"–", "write - (a minus)"},
    {"−", "write - (a minus)"},
};

Rank next_rank(Rank rank) {
    return static_cast<Rank>(static_cast<int>(rank) + 1);
}

Error unknown_function(std::string_view name, size_t position) {
    std::vector<std::string_view> known;
    for (const FormulaFunction& one : formula_functions()) known.push_back(one.name);
    const std::string near = nearest(small_letters(name), known);
    return wrong(near.empty()
                     ? fmt::format("there is no function \"{}\" (position {}); there are {}", name,
                                   position, list_of(known))
                     : fmt::format("there is no function \"{}\" (position {}); did you mean "
                                   "\"{}\"?",
                                   name, position, near));
}

std::string number_of_arguments(const FormulaFunction& function) {
    if (function.arguments_max == kAnyNumber) {
        return fmt::format("{} or more arguments", function.arguments_min);
    }
    return fmt::format("{} argument{}", function.arguments_min,
                       function.arguments_min == 1 ? "" : "s");
}

}  // namespace

class FormulaParser {
public:
    explicit FormulaParser(std::string_view text) : text_(text) {}

    Result<Formula> parse() {
        if (text_.size() > kFormulaBytesMax) {
            return wrong(fmt::format("a formula of more than {} bytes", kFormulaBytesMax));
        }
        TRY(expression(Rank::Or));
        if (next() != '\0' || at_ < text_.size()) return expected("an operator or the end");
        return std::move(formula_);
    }

private:
    // ---- operators ----

    // Operands with operators of this rank and above between them.
    Status expression(Rank weakest) {
        TRY(operand_of(weakest));
        bool compared = false;
        for (;;) {
            const FormulaOperator* found = TRY(operator_here());
            if (!found || found->rank < weakest) return Status::done();
            if (compared && found->rank == Rank::Compare) return chained(*found);
            compared = found->rank == Rank::Compare;
            at_ += found->text.size();
            TRY(right_side(*found));
        }
    }

    // `not` and what follows it, or what binds more strongly.
    Status operand_of(Rank weakest) {
        skip_spaces();
        if (word_here() != "not") return unary();
        if (weakest > Rank::Not) {
            return wrong(fmt::format(
                "\"not\" at position {} needs parentheses here: write (not ...)", at_ + 1));
        }
        at_ += 3;
        TRY(deeper());
        TRY(expression(Rank::Not));
        --depth_;
        emit(FormulaOp::Not);
        return Status::done();
    }

    Status right_side(const FormulaOperator& found) {
        if (found.op != FormulaOp::And && found.op != FormulaOp::Or) {
            TRY(expression(next_rank(found.rank)));
            emit(found.op);
            return Status::done();
        }
        const size_t jump = emit(found.op);
        TRY(expression(next_rank(found.rank)));
        emit(FormulaOp::Truth);
        land(jump);
        return Status::done();
    }

    // nullptr: something else is here.
    Result<const FormulaOperator*> operator_here() {
        skip_spaces();
        for (const Foreign& foreign : kForeignOperators) {
            const bool equal = foreign.text == "=" && rest().starts_with("==");
            const bool differs = foreign.text == "!" && rest().starts_with("!=");
            if (rest().starts_with(foreign.text) && !equal && !differs) return advise(foreign);
        }
        const std::string_view word = word_here();
        const FormulaOperator* best = nullptr;
        for (const FormulaOperator& one : formula_operators()) {
            const bool here =
                starts_name(one.text[0]) ? word == one.text : rest().starts_with(one.text);
            const bool infix = one.rank != Rank::Sign && one.rank != Rank::Not;
            if (here && infix && (!best || one.text.size() > best->text.size())) best = &one;
        }
        if (best || word.empty()) return best;
        const std::string small = small_letters(word);
        if (word == small || (small != "and" && small != "or")) return best;
        return wrong(fmt::format("\"{}\" at position {} is not an operator; write {}", word,
                                 at_ + 1, small));
    }

    Error chained(const FormulaOperator& second) const {
        return wrong(fmt::format(
            "\"{}\" at position {}: a comparison cannot follow another; write a < b and b < c, or "
            "put one in parentheses",
            second.text, at_ + 1));
    }

    // ---- operands ----

    Status unary() {
        int minuses = 0;
        while (next() == '-') {
            ++at_;
            ++minuses;
            TRY(deeper());
        }
        TRY(primary());
        depth_ -= minuses;
        for (; minuses > 0; --minuses) emit(FormulaOp::Negate);
        return Status::done();
    }

    Status primary() {
        const char c = next();
        if (c == '(') return parenthesis();
        if (c == '"' || c == '\'') return string(c);
        if (c >= '0' && c <= '9') return number();
        if (starts_name(c)) return name();
        for (const Foreign& foreign : kForeignOperands) {
            if (rest().starts_with(foreign.text)) return advise(foreign);
        }
        return expected(
            "a number, a text in quotes, a variable, a function or an opening "
            "parenthesis");
    }

    Status parenthesis() {
        ++at_;
        TRY(deeper());
        TRY(expression(Rank::Or));
        if (next() != ')') return expected("an operator or a closing parenthesis");
        ++at_;
        --depth_;
        return Status::done();
    }

    Status string(char quote) {
        const size_t end = text_.find(quote, at_ + 1);
        if (end == std::string_view::npos) {
            return wrong(fmt::format("the text that begins at position {} has no closing {}",
                                     at_ + 1, quote));
        }
        constant(Value(std::string(text_.substr(at_ + 1, end - at_ - 1))));
        at_ = end + 1;
        return Status::done();
    }

    Status number() {
        const NumberText found = number_at(rest());
        const std::string_view digits = text_.substr(at_, found.length);
        const size_t end = at_ + found.length;
        if (end < text_.size() && (continues_name(text_[end]) || text_[end] == '.')) {
            return wrong(
                fmt::format("\"{}{}\" at position {} is not a number; leave a space or an "
                            "operator behind {}",
                            digits, character_at(end), at_ + 1, digits));
        }
        if (found.whole) {
            const auto value = int_from_digits(digits);
            if (!value) return too_large(digits, "an int of 64 bits");
            constant(Value(*value));
        } else {
            const auto value = double_from_digits(digits);
            if (!value) return too_large(digits, "a float");
            constant(Value(*value));
        }
        at_ = end;
        return Status::done();
    }

    // A constant, a function or a variable.
    Status name() {
        const size_t begin = at_;
        const std::string_view word = word_here();
        if (word == "and" || word == "or" || word == "not") {
            return expected(
                "a number, a text in quotes, a variable, a function or an opening "
                "parenthesis");
        }
        at_ += word.size();
        if (word == "true" || word == "false") {
            constant(Value(word == "true"));
            return Status::done();
        }
        if (next() == '(') {
            const FormulaFunction* function = find_function(word);
            if (!function) return unknown_function(word, begin + 1);
            return call(*function, begin);
        }
        variable(word);
        return Status::done();
    }

    Status call(const FormulaFunction& function, size_t begin) {
        ++at_;
        TRY(deeper());
        Call made{.function = function};
        if (next() != ')') TRY(arguments(made));
        if (next() != ')') return expected("an operator, a comma or a closing parenthesis");
        ++at_;
        --depth_;
        const size_t count = made.count;
        if (count < function.arguments_min || count > function.arguments_max) {
            return wrong(fmt::format("{} at position {} has {} argument{}, but takes {}: {}",
                                     function.name, begin + 1, count, count == 1 ? "" : "s",
                                     number_of_arguments(function), function.form));
        }
        finish(made);
        return Status::done();
    }

    struct Call {
        const FormulaFunction& function;
        size_t count = 0;
        size_t branch = 0;  // of `if`: the steps that jump
        size_t other = 0;
    };

    Status arguments(Call& made) {
        for (;;) {
            TRY(expression(Rank::Or));
            ++made.count;
            if (made.function.id == Function::If) mark_if(made);
            if (next() != ',') return Status::done();
            ++at_;
        }
    }

    void mark_if(Call& made) {
        if (made.count == 1) made.branch = emit(FormulaOp::Branch);
        if (made.count == 2) {
            made.other = emit(FormulaOp::Else);
            land(made.branch);
        }
    }

    void finish(const Call& made) {
        if (made.function.id == Function::If) {
            land(made.other);
            emit(FormulaOp::EndIf, formula_.ifs_++);
            return;
        }
        emit(FormulaOp::Call, static_cast<uint32_t>(made.function.id),
             static_cast<uint32_t>(made.count));
    }

    // ---- sentences ----

    Status deeper() {
        if (++depth_ <= kFormulaDepthMax) return Status::done();
        return wrong(
            fmt::format("parentheses, functions, \"not\" and minuses nested more than {} deep at "
                        "position {}",
                        kFormulaDepthMax, at_));
    }

    Error expected(std::string_view what) const {
        if (text_.find_first_not_of(" \t\n\r") == std::string_view::npos) {
            return wrong("the formula is empty; write a number, a text in quotes or a variable");
        }
        const std::string_view word = word_here();
        const std::string found =
            at_ >= text_.size() ? std::string("the end of the formula")
                                : fmt::format("\"{}\"", word.empty() ? character_at(at_) : word);
        return wrong(fmt::format("expected {} at position {}, found {}", what, at_ + 1, found));
    }

    Error advise(const Foreign& foreign) const {
        return wrong(fmt::format("\"{}\" at position {} is not part of formulas; {}", foreign.text,
                                 at_ + 1, foreign.advice));
    }

    Error too_large(std::string_view digits, std::string_view what) const {
        return wrong(fmt::format("the number {} does not fit {}", digits, what));
    }

    // ---- the text ----

    std::string_view rest() const { return text_.substr(at_); }

    // A whole one: a part of its bytes would make the sentence malformed.
    std::string_view character_at(size_t at) const {
        const std::string_view rest = text_.substr(at);
        return rest.substr(0, std::max<size_t>(1, first_code_point(rest).bytes));
    }

    // The word that begins here; empty if none does.
    std::string_view word_here() const {
        size_t end = at_;
        if (end < text_.size() && starts_name(text_[end])) {
            while (end < text_.size() && continues_name(text_[end])) ++end;
        }
        return text_.substr(at_, end - at_);
    }

    char next() {
        skip_spaces();
        return at_ < text_.size() ? text_[at_] : '\0';
    }

    void skip_spaces() {
        while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    }

    // ---- steps ----

    size_t emit(FormulaOp op, uint32_t index = 0, uint32_t count = 0) {
        formula_.steps_.push_back({op, index, count});
        return formula_.steps_.size() - 1;
    }

    // The jump goes to the step that comes next.
    void land(size_t jump) {
        formula_.steps_[jump].index = static_cast<uint32_t>(formula_.steps_.size());
    }

    void constant(Value value) {
        emit(FormulaOp::Constant, static_cast<uint32_t>(formula_.constants_.size()));
        formula_.constants_.push_back(std::move(value));
    }

    void variable(std::string_view word) {
        auto& names = formula_.names_;
        const auto found = std::find(names.begin(), names.end(), word);
        emit(FormulaOp::Variable, static_cast<uint32_t>(found - names.begin()));
        if (found == names.end()) names.emplace_back(word);
    }

    std::string_view text_;
    size_t at_ = 0;
    int depth_ = 0;
    Formula formula_;
};

Result<Formula> parse_formula(std::string_view text) {
    return FormulaParser(text).parse();
}

bool is_name(std::string_view text) {
    return !text.empty() && starts_name(text[0]) &&
           std::all_of(text.begin(), text.end(), continues_name);
}

bool is_variable_name(std::string_view text) {
    const auto reserved = reserved_words();
    return is_name(text) && std::find(reserved.begin(), reserved.end(), text) == reserved.end();
}

}  // namespace vagus::plan
