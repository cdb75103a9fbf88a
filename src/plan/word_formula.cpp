#include "plan/word_formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.hpp"

namespace vagus::plan {

namespace {

using Name = WordFormula::Name;

// Formulas know neither node() nor variable(): before a text is parsed, a name of our own takes the
// place of each.
class WordRewriter {
public:
    explicit WordRewriter(std::string_view text) : text_(text) {}

    Result<std::string> rewrite() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                copy_string(c);
            } else if (is_letter(c)) {
                TRY(word());
            } else {
                out_ += text_[at_++];
            }
        }
        return out_;
    }
    const std::map<std::string, Name>& names() const { return names_; }

private:
    static bool is_letter(char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_';
    }

    void copy_string(char quote) {
        const size_t end = text_.find(quote, at_ + 1);
        const size_t behind = end == std::string_view::npos ? text_.size() : end + 1;
        out_ += text_.substr(at_, behind - at_);
        at_ = behind;
    }

    Status word() {
        const size_t begin = at_;
        while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
        const std::string_view word = text_.substr(begin, at_ - begin);
        const size_t behind_word = at_;
        const bool called = peek() == '(';
        if (!called || (word != "node" && word != "variable")) {
            at_ = behind_word;
            out_ += word;
            return Status::done();
        }
        ++at_;
        std::vector<std::string> texts;
        const size_t wanted = word == "node" ? 2 : 1;
        bool good = true;
        for (size_t i = 0; good && i < wanted; ++i) {
            if (i > 0) good = take(',');
            good = good && text(texts);
        }
        if (!good || !take(')')) {
            return Error{Code::BadInput,
                         word == "node"
                             ? "expected two texts, as node(\"drive\", \"token\"), behind node"
                             : "expected a text, as variable(\"angle\"), behind variable"};
        }
        Name name{.shown = std::string(text_.substr(begin, at_ - begin))};
        TRY(fill(name, word == "node", texts));
        const std::string own = fmt::format("name_{}_of_the_text", names_.size() + 1);
        names_.emplace(own, std::move(name));
        out_ += own;
        return Status::done();
    }

    static Status fill(Name& name, bool of_node, const std::vector<std::string>& texts) {
        name.of = of_node ? Name::Of::Word : Name::Of::Variable;
        name.variable = texts.back();
        if (!of_node) return Status::done();
        name.node = texts.front();
        const size_t bracket = name.variable.find('[');
        if (bracket == std::string::npos) return Status::done();
        const std::string digits = name.variable.substr(
            bracket + 1, name.variable.size() - std::min(name.variable.size(), bracket + 2));
        const auto element = decimal_number(digits);
        if (!name.variable.ends_with(']') || !element || *element > UINT16_MAX) {
            return Error{Code::BadInput,
                         fmt::format("\"{}\": expected the number of an element in brackets, as "
                                     "\"touch.sectors[2]\"",
                                     name.variable)};
        }
        name.element = static_cast<uint16_t>(*element);
        name.variable.resize(bracket);
        return Status::done();
    }

    char peek() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }
    bool text(std::vector<std::string>& to) {
        const char quote = peek();
        if (quote != '"' && quote != '\'') return false;
        const size_t end = text_.find(quote, at_ + 1);
        if (end == std::string_view::npos) return false;
        to.emplace_back(text_.substr(at_ + 1, end - at_ - 1));
        at_ = end + 1;
        return true;
    }

    std::string_view text_;
    size_t at_ = 0;
    std::string out_;
    std::map<std::string, Name> names_;
};

}  // namespace

Result<WordFormula> WordFormula::parse(std::string_view text) {
    WordRewriter rewriter(text);
    const std::string rewritten = TRY(rewriter.rewrite());
    // Its own sentence counts bytes in the text that it was given.
    Result<Formula> formula = parse_formula(rewritten);
    if (!formula.ok()) return formula.error();
    WordFormula made(std::string(text), std::move(formula.value()));
    for (const std::string& name : made.formula_.names()) {
        const auto own = rewriter.names().find(name);
        made.names_.push_back(
            own != rewriter.names().end() ? own->second : Name{.shown = name, .variable = name});
    }
    return made;
}

Result<bool> WordFormula::holds(std::span<const Value> values) const {
    const Value value = TRY(formula_.evaluate(values));
    const Value truth = TRY(convert(value, Type::Bool));
    return truth.boolean();
}

}  // namespace vagus::plan
