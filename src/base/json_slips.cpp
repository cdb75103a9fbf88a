// Walks over the text as strictly as JSON demands, one token after the other, without building
// anything; each thing that can be expected has its function, which says what replaces it.
#include "base/json_slips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "base/json.hpp"
#include "base/nearest.hpp"
#include "base/text.hpp"

namespace vagus {
namespace {

constexpr size_t kSlipShownMax = 30;  // bytes of the text that a sentence shows
constexpr std::string_view kSpaces = " \t\r\n";

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
}

// Quotes that word processors make of `"`.
bool is_typographic_quote(char32_t c) {
    return (c >= 0x2018 && c <= 0x201f) || c == 0xab || c == 0xbb || c == 0x2039 || c == 0x203a;
}

// As a text in quotes, shortened where it is long.
std::string quoted(std::string_view text) {
    size_t end = std::min(text.size(), kSlipShownMax);
    while (end < text.size() && end > 0 && (static_cast<uint8_t>(text[end]) & 0xc0u) == 0x80u)
        --end;
    return json_quote(std::string(text.substr(0, end)) + (end < text.size() ? "…" : ""));
}

class SlipFinder {
public:
    explicit SlipFinder(std::string_view text) : text_(text) {}

    std::optional<JsonSlip> find() {
        while (!slip_ && !done_) step();
        return slip_;
    }

private:
    enum class Expected { Value, FirstItem, Key, FirstKey, Colon, Comma, Nothing };
    struct Open {
        char bracket;
        size_t offset;
    };

    void step() {
        skip_spaces();
        if (slip_) return;
        if (at_ == text_.size()) return end();
        switch (expected_) {
            case Expected::Value:
            case Expected::FirstItem:
                return value();
            case Expected::Key:
            case Expected::FirstKey:
                return key();
            case Expected::Colon:
                return colon();
            case Expected::Comma:
                return comma();
            case Expected::Nothing:
                if (now() == '}' || now() == ']') return wrong_bracket();
                return refuse("the value is over, but more follows it; remove that");
        }
    }

    void refuse(std::string what) { refuse_at(at_, std::move(what)); }
    void refuse_at(size_t offset, std::string what) { slip_ = {offset, std::move(what)}; }

    char now() const { return text_[at_]; }
    char32_t code_point() const { return first_code_point(text_.substr(at_)).value; }

    std::string place_of(size_t offset) const {
        const std::string_view before = text_.substr(0, offset);
        const size_t line = before.rfind('\n');
        const size_t start = line == before.npos ? 0 : line + 1;
        return fmt::format("line {}, column {}", std::count(before.begin(), before.end(), '\n') + 1,
                           count_code_points(before.substr(start)) + 1);
    }

    void skip_spaces() {
        at_ = std::min(text_.find_first_not_of(kSpaces, at_), text_.size());
        if (at_ == text_.size()) return;
        const std::string_view rest = text_.substr(at_);
        if (rest.starts_with("//") || rest.starts_with("/*") || rest.starts_with('#')) {
            return refuse("JSON has no comments; remove this one (a \"help\" can say the same)");
        }
        const char32_t c = code_point();
        if (c == 0xa0 || is_obeyed(c) || (c >= 0x2000 && c <= 0x200b) || c == 0x3000) {
            refuse(
                fmt::format("the character U+{:04X} looks like a space, but is none in JSON; "
                            "replace it with an ordinary space",
                            static_cast<uint32_t>(c)));
        }
    }

    // ---- the end of the text ----

    void end() {
        done_ = true;
        if (expected_ == Expected::Nothing) return;
        const size_t last = text_.size();
        if (open_.empty()) return refuse_at(last, "there is nothing in it; write { … }");
        const Open& open = open_.back();
        refuse_at(last, fmt::format("the text ends, but the {} of {} is not closed; add {}",
                                    open.bracket, place_of(open.offset), closing(open)));
    }

    static char closing(const Open& open) { return open.bracket == '{' ? '}' : ']'; }

    // ---- values ----

    void value() {
        const char c = now();
        if (c == '{' || c == '[') return begin(c);
        if (c == '"') return string_then(after_value());
        if (is_digit(c) || c == '-') return number();
        if (c == '}' || c == ']') return close_early();
        if (c == ',')
            return refuse("there is nothing before this comma; remove it, or write a value");
        if (c == '+' || c == '.') return odd_number();
        if (quotes_differ()) return;
        if (is_name(c)) return word();
        refuse("a value cannot begin with " + shown() +
               "; write a text in quotes, a number, true, "
               "false, null, [ … ] or { … }");
    }

    void begin(char bracket) {
        if (open_.size() > static_cast<size_t>(kJsonDepthMax)) {
            done_ = true;  // the reader has said so before
            return;
        }
        token_ = at_++;
        open_.push_back({bracket, token_});
        expected_ = bracket == '{' ? Expected::FirstKey : Expected::FirstItem;
    }

    Expected after_value() const { return open_.empty() ? Expected::Nothing : Expected::Comma; }

    void value_is_over() {
        value_end_ = at_;
        expected_ = after_value();
    }

    // A bracket where a value is due.
    void close_early() {
        if (expected_ == Expected::FirstItem && now() == ']') return close();
        if (text_[token_] == ':') {
            return refuse(fmt::format("the key before this {} has no value; write one", now()));
        }
        comma_before_bracket();
    }

    void comma_before_bracket() {
        if (text_[token_] != ',') return wrong_bracket();
        refuse(
            fmt::format("there is a comma before this {}, and nothing behind the comma; remove "
                        "the comma of {}",
                        now(), place_of(token_)));
    }

    std::string_view name_here() const {
        size_t end = at_;
        while (end < text_.size() && is_name(text_[end])) ++end;
        return text_.substr(at_, end - at_);
    }

    void word() {
        const std::string_view name = name_here();
        if (name == "true" || name == "false" || name == "null") {
            token_ = at_;
            at_ += name.size();
            return value_is_over();
        }
        if (name == "True" || name == "TRUE") return say_word(name, "true");
        if (name == "False" || name == "FALSE") return say_word(name, "false");
        if (name == "None" || name == "nil" || name == "undefined" || name == "NULL") {
            return say_word(name, "null");
        }
        if (name == "NaN" || name == "Infinity") {
            return refuse(fmt::format("JSON has no {}; write a number", name));
        }
        const std::string near =
            nearest(name, std::vector<std::string_view>{"true", "false", "null"});
        if (!near.empty()) return say_word(name, near);
        refuse(fmt::format("a text is written in double quotes; write {}", quoted(name)));
    }

    void say_word(std::string_view found, std::string_view wanted) {
        refuse(fmt::format("JSON has no {}; write {}", found, wanted));
    }

    // Says that the text begins with a quote of another kind; false if it does not.
    bool quotes_differ() {
        const char32_t c = code_point();
        const bool single = c == U'\'' || c == U'`';
        if (!single && !is_typographic_quote(c)) return false;
        const size_t begin = at_ + first_code_point(text_.substr(at_)).bytes;
        size_t end = begin;
        while (end < text_.size() && text_[end] != '\n' && text_[end] != '"') {
            const CodePoint point = first_code_point(text_.substr(end));
            if (single ? point.value == c : is_typographic_quote(point.value)) break;
            end += std::max<size_t>(point.bytes, 1);
        }
        refuse(fmt::format("{} is written in plain double quotes, not in {} ones; write {}",
                           is_key() ? "a key" : "a text", single ? "single" : "typographic",
                           quoted(text_.substr(begin, end - begin))));
        return true;
    }

    bool is_key() const { return expected_ == Expected::Key || expected_ == Expected::FirstKey; }

    // ---- numbers ----

    size_t digits_from(size_t from) const {
        while (from < text_.size() && is_digit(text_[from])) ++from;
        return from;
    }

    std::string_view number_here() const {
        size_t end = at_;
        while (end < text_.size() && (is_name(text_[end]) || text_[end] == '.' ||
                                      text_[end] == '-' || text_[end] == '+')) {
            ++end;
        }
        return text_.substr(at_, end - at_);
    }

    void odd_number() {
        const std::string_view written = number_here();
        std::string better(now() == '+' ? written.substr(1) : written);
        if (better.starts_with('.')) better.insert(0, "0");
        refuse(fmt::format("a number begins with a digit or a minus sign; write {} for {}", better,
                           written));
    }

    void number() {
        const std::string_view written = number_here().substr(0, kSlipShownMax);
        size_t end = now() == '-' ? at_ + 1 : at_;
        const size_t first = end;
        end = digits_from(end);
        if (end == first) {
            return refuse(
                fmt::format("{} is no number; write digits behind the minus sign", written));
        }
        if (text_[first] == '0' && end - first > 1) {
            return refuse(fmt::format("{} begins with a zero; leave the zero out", written));
        }
        if (end < text_.size() && text_[end] == '.') {
            const size_t point = end;
            end = digits_from(point + 1);
            if (end == point + 1) {
                return refuse(fmt::format("{} has no digit behind its point; write {}0", written,
                                          text_.substr(at_, end - at_)));
            }
        }
        end = exponent_from(end);
        if (slip_) return;
        if (end < text_.size() && (is_name(text_[end]) || text_[end] == '.')) {
            return refuse(
                fmt::format("{} is no number of JSON; write decimal digits only, as 16 "
                            "or 0.5, or a text in quotes",
                            written));
        }
        token_ = at_;
        at_ = end;
        value_is_over();
    }

    size_t exponent_from(size_t end) {
        if (end >= text_.size() || (text_[end] != 'e' && text_[end] != 'E')) return end;
        size_t digits = end + 1;
        if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
        const size_t after = digits_from(digits);
        if (after == digits) refuse("this number has no digit in its exponent; write one, as 1e3");
        return after;
    }

    // ---- texts ----

    void string_then(Expected next) {
        token_ = at_;
        size_t at = at_ + 1;
        while (at < text_.size() && text_[at] != '"') {
            const auto byte = static_cast<uint8_t>(text_[at]);
            if (byte == '\n' || byte == '\r') {
                return refuse_at(at, fmt::format("the text that begins at {} is not closed on its "
                                                 "line; add a \" (a new line in a text is \\n)",
                                                 place_of(token_)));
            }
            if (byte < 0x20) {
                return refuse_at(at, byte == '\t' ? "a tab in a text is written \\t"
                                                  : fmt::format("this control character is written "
                                                                "\\u{:04x} in a text",
                                                                byte));
            }
            at = byte == '\\' ? escape_end(at) : at + 1;
            if (slip_) return;
        }
        if (at >= text_.size()) {
            return refuse_at(text_.size(), fmt::format("the text that begins at {} is not "
                                                       "closed; add a \"",
                                                       place_of(token_)));
        }
        at_ = at + 1;
        value_end_ = at_;
        expected_ = next;
    }

    // `at` is that of a backslash.
    size_t escape_end(size_t at) {
        const char letter = at + 1 < text_.size() ? text_[at + 1] : '"';
        if (letter == 'u') return unicode_end(at);
        if (std::string_view("\"\\/bfnrt").find(letter) != std::string_view::npos) return at + 2;
        refuse_at(at, fmt::format("JSON has no \\{}; a backslash itself is written \\\\",
                                  is_name(letter) ? std::string(1, letter) : ""));
        return at;
    }

    size_t unicode_end(size_t at) {
        const std::string_view digits = text_.substr(std::min(at + 2, text_.size()), 4);
        const bool all =
            digits.size() == 4 && std::all_of(digits.begin(), digits.end(), [](char c) {
                return std::isxdigit(static_cast<unsigned char>(c)) != 0;
            });
        if (all) return at + 6;
        refuse_at(at, "\\u has four hexadecimal digits behind it, as \\u00e9");
        return at;
    }

    // ---- objects and arrays ----

    void key() {
        const char c = now();
        if (c == '"') return string_then(Expected::Colon);
        if (c == '}' && expected_ == Expected::FirstKey) return close();
        if (c == '}') return comma_before_bracket();
        if (c == ',') return refuse("there is nothing before this comma; remove it");
        if (quotes_differ()) return;
        if (is_name(c)) {
            return refuse(
                fmt::format("a key is written in double quotes; write {}", quoted(name_here())));
        }
        if (c == ']') return wrong_bracket();
        refuse("a key cannot begin with " + shown() + "; write it in double quotes, as \"name\"");
    }

    void colon() {
        const std::string key(text_.substr(token_, value_end_ - token_).substr(0, kSlipShownMax));
        if (now() == ':') {
            token_ = at_++;
            expected_ = Expected::Value;
        } else if (now() == '=') {
            refuse(fmt::format("a colon, not =, separates a key and its value; write {}: …", key));
        } else if (now() == ',' || now() == '}') {
            refuse(fmt::format("the key {} has no value; write {}: …", key, key));
        } else {
            refuse(fmt::format("there is no colon behind the key {}; write {}: …", key, key));
        }
    }

    void comma() {
        const char c = now();
        if (c == ',') {
            token_ = at_++;
            expected_ = open_.back().bracket == '{' ? Expected::Key : Expected::Value;
        } else if (c == closing(open_.back())) {
            close();
        } else if (c == '}' || c == ']') {
            wrong_bracket();
        } else if (c == ';') {
            refuse("values are separated by commas, not by semicolons");
        } else if (c == ':') {
            refuse(
                "a key and its value belong in an object, { … }, not in an array; use braces, or "
                "a comma");
        } else if (at_ == value_end_ && text_[at_ - 1] == '"') {
            refuse("a quote inside of a text is written \\\"; or is a comma missing here?");
        } else {
            refuse(
                fmt::format("there is no comma before this; add one at {}", place_of(value_end_)));
        }
    }

    void wrong_bracket() {
        if (open_.empty()) {
            return refuse(fmt::format("this {} closes nothing; remove it", now()));
        }
        const Open& open = open_.back();
        refuse(fmt::format("this {} does not close the {} of {}; close that with {} before it",
                           now(), open.bracket, place_of(open.offset), closing(open)));
    }

    void close() {
        open_.pop_back();
        token_ = at_++;
        value_is_over();
    }

    // The character here, as it may be in a sentence.
    std::string shown() const {
        return visible(text_.substr(at_, first_code_point(text_.substr(at_)).bytes));
    }

    std::string_view text_;
    size_t at_ = 0;
    size_t token_ = 0;      // where the last token began
    size_t value_end_ = 0;  // behind the last value or key
    Expected expected_ = Expected::Value;
    std::vector<Open> open_;
    std::optional<JsonSlip> slip_;
    bool done_ = false;
};

}  // namespace

std::optional<JsonSlip> find_json_slip(std::string_view text) {
    return SlipFinder(text).find();
}

}  // namespace vagus
