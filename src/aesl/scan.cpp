#include "aesl/scan.hpp"

#include <cstdio>
#include <optional>

#include "aesl/fix.hpp"
#include "aesl/limits.hpp"
#include "aesl/unicode.hpp"

namespace vagus::aesl {
namespace {

constexpr size_t kShownBytes = 60;
constexpr int32_t kNumberLimit = 65536;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_hex_digit(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}
int32_t digit_value(char c) {
    return is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10;
}

// What may follow in a word, for the bytes that are ASCII.
bool is_ascii_word(char c) {
    return is_digit(c) || ((c | 0x20) >= 'a' && (c | 0x20) <= 'z') || c == '_' || c == '.';
}

constexpr uint32_t pack(std::string_view text) {
    uint32_t packed = 0;
    for (const char c : text) packed = packed << 8 | static_cast<uint8_t>(c);
    return packed;
}

// The sign that the first `length` characters are, or Bad.
TokenKind sign_of(std::string_view text, size_t length) {
    if (text.size() < length || text[0] == '\0') return TokenKind::Bad;
    switch (pack(text)) {
#define SIGN(name, spelling) \
    case pack(spelling):     \
        return TokenKind::Sign##name;
#include "aesl/tokens.def"
#undef SIGN
    }
    return TokenKind::Bad;
}

// What a character that looks like a sign stands for; empty for all others.
std::string_view sign_that_looks_like(uint32_t character) {
    switch (character) {
#define LOOKS_LIKE(code_point, sign) \
    case code_point:                 \
        return sign;
#include "aesl/characters.def"
#undef LOOKS_LIKE
    }
    return {};
}

// The quote that ends what begins with this one; 0 if it is no quote.
uint32_t closing_quote(uint32_t character) {
    switch (character) {
        case '"':
        case '\'':
        case '`':
            return character;
        case 0x201c:  // English double, single, German double, single, French
        case 0x201e:
            return 0x201d;
        case 0x2018:
        case 0x201a:
            return 0x2019;
        case 0x00ab:
            return 0x00bb;
        default:
            return 0;
    }
}

class Scanner {
public:
    Scanner(std::string_view source, Names& names, Diagnostics& diagnostics)
        : source_(source), names_(names), diagnostics_(diagnostics) {
        tokens_.reserve(source.size() / 4 + 16);
    }

    Tokens run() {
        while (skip_blanks() && !diagnostics_.full()) one_token();
        begin();
        finish(TokenKind::EndOfText);
        return std::move(tokens_);
    }

private:
    char peek(size_t ahead = 0) const {
        return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0';
    }

    void new_line() {
        ++line_;
        line_start_ = at_;
        continuation_bytes_ = 0;
    }

    // Over one character of any kind.
    void step() {
        const bool is_line_feed = source_[at_] == '\n';
        const uint32_t length = decode(source_, at_).length;
        continuation_bytes_ += length - 1;
        at_ += length;
        if (is_line_feed) new_line();
    }

    // Moves to the next token; false at the end of the text.
    bool skip_blanks() {
        while (at_ < source_.size()) {
            const char c = source_[at_];
            if (c == '\n') {
                ++at_;
                new_line();
            } else if (c == ' ' || c == '\t' || c == '\r') {
                ++at_;
            } else if (c == '#') {
                skip_comment();
            } else {
                return true;
            }
        }
        return false;
    }

    void skip_comment() {
        if (peek(1) != '*') {
            // A bare carriage return ends the comment, though not the line: the reference reads on
            // behind it.
            while (at_ < source_.size() && source_[at_] != '\n' && source_[at_] != '\r') step();
            return;
        }
        begin();
        at_ += 2;
        while (at_ < source_.size() && !(source_[at_] == '*' && peek(1) == '#')) step();
        if (at_ < source_.size()) {
            at_ += 2;
            return;
        }
        Position end = token_position();
        end.column += 2;
        diagnostics_.report(Diag::OpenComment, {token_position(), end});
    }

    // Notes where the token starts.
    void begin() {
        token_.line = line_;
        token_.column = static_cast<int32_t>(at_ - line_start_ - continuation_bytes_) + 1;
        token_.offset = static_cast<uint32_t>(at_);
        token_.value = 0;
        token_.is_decimal = true;
    }

    Position token_position() const { return {token_.line, token_.column}; }

    void finish(TokenKind kind) {
        token_.kind = kind;
        token_.length = static_cast<uint32_t>(at_) - token_.offset;
        tokens_.push_back(token_);
    }

    void one_token() {
        begin();
        const char c = source_[at_];
        if (is_digit(c)) {
            number();
        } else if (starts_word()) {
            skip_word();
            word();
        } else {
            sign();
        }
    }

    bool starts_word() const {
        const char c = source_[at_];
        if (static_cast<uint8_t>(c) < 0x80) return is_ascii_word(c) && c != '.';
        const CodePoint point = decode(source_, at_);
        return point.valid && is_letter_or_digit(point.value);
    }

    void skip_word() {
        while (at_ < source_.size()) {
            if (is_ascii_word(source_[at_])) {
                ++at_;
                continue;
            }
            if (static_cast<uint8_t>(source_[at_]) < 0x80) return;
            const CodePoint point = decode(source_, at_);
            if (!point.valid || !is_letter_or_digit(point.value)) return;
            at_ += point.length;
            continuation_bytes_ += point.length - 1;
        }
    }

    std::string_view token_text() const {
        return source_.substr(token_.offset, at_ - token_.offset);
    }

    void word() {
        const NameId name = names_.intern(token_text());
        token_.value = static_cast<int32_t>(name);
        finish(keyword_of(name));
    }

    void number() {
        skip_word();
        const std::string_view text = token_text();
        if (text.size() > 1 && text[0] == '0' && text[1] == 'x') {
            read_digits(text.substr(2), 16, Diag::BadHexadecimal);
        } else if (text.size() > 1 && text[0] == '0' && text[1] == 'b') {
            read_digits(text.substr(2), 2, Diag::BadBinary);
        } else if (text.size() > 1 && text[0] == '0' && !is_digit(text[1])) {
            bad_number(Diag::BadBase);
        } else {
            read_digits(text, 10, Diag::BadNumber);
        }
        token_.is_decimal = text.size() < 2 || is_digit(text[1]);
        finish(TokenKind::Number);
    }

    // A word both malformed and too large is malformed (section 1.4).
    void read_digits(std::string_view digits, int32_t base, Diag malformed) {
        int32_t value = 0;
        bool fits = true;
        bool well_formed = !digits.empty();
        for (const char c : digits) {
            well_formed = well_formed && is_hex_digit(c) && digit_value(c) < base;
            if (!well_formed) break;
            value = value * base + digit_value(c);
            fits = fits && value < kNumberLimit;
            if (!fits) value = 0;
        }
        token_.value = value;
        if (!well_formed) bad_number(malformed);
        if (well_formed && !fits) bad_number(Diag::NumberTooLarge);
    }

    void bad_number(Diag what) {
        token_.value = kBadNumber;
        const std::string_view text = token_text();
        const size_t dot = text.find('.');
        const bool is_dotted = dot != text.npos && dot + 1 < text.size() &&
                               text.find_first_not_of("0123456789.") == text.npos;
        const bool is_range = is_dotted && text[dot + 1] == '.';
        Extra extra;
        if (is_range) {
            what = what == Diag::BadBase ? Diag::DotsFromZero : Diag::Dots;
            const std::string bounds = std::string(text.substr(0, dot)) + ":" +
                                       std::string(text.substr(text.find_last_of('.') + 1));
            extra.fix = replacing(token_mark(), bounds);
        } else if (is_dotted) {
            what = what == Diag::BadBase ? Diag::FractionBelowOne : Diag::Fraction;
        }
        diagnostics_.report(what, token_mark(), {shown(text)}, std::move(extra));
    }

    // The longest sign that fits here. `=`, `<`, `>` lead to the signs of several characters.
    void sign() {
        for (uint32_t length = 3; length >= 1; --length) {
            const TokenKind kind = sign_of(source_.substr(at_, length), length);
            if (kind == TokenKind::Bad) continue;
            at_ += length;
            finish(kind);
            return;
        }
        bad_character();
    }

    Mark token_mark() const {
        const int width = count_code_points(token_text());
        return {token_position(), {token_.line, token_.column + width}};
    }

    void bad_character() {
        const CodePoint point = decode(source_, at_);
        if (point.valid && closing_quote(point.value) != 0) return quoted_text(point.value);
        step();
        const Mark mark = token_mark();
        const std::string_view sign = sign_that_looks_like(point.value);
        char code[24];
        std::snprintf(code, sizeof code, point.valid ? "U+%04X" : "0x%02X", point.value);
        if (!point.valid) {
            diagnostics_.report(Diag::BadUtf8, mark, {code});
        } else if (!sign.empty()) {
            return look_alike(sign, code);
        } else if (point.value == '!') {
            diagnostics_.report(Diag::LoneBang, mark, {}, {.fix = replacing(mark, "not ")});
        } else if (point.value == '.') {
            const bool is_number = is_digit(peek());
            diagnostics_.report(is_number ? Diag::FractionWithoutZero : Diag::LeadingDot, mark);
        } else {
            const std::string name = name_of(point.value, code);
            diagnostics_.report(Diag::BadCharacter, mark, {name, advice(point.value)},
                                {.fix = fix_of(point.value, mark)});
        }
        finish(TokenKind::Bad);
    }

    std::string name_of(uint32_t character, const std::string& code) const {
        const bool printable = character > ' ' && character != 0x7f && character < 0x2000;
        return printable ? "\"" + std::string(token_text()) + "\" (" + code + ")" : code;
    }

    // `≥` is reported, and then read as the `>=` that it was meant as: one mistake stays one.
    void look_alike(std::string_view sign, const std::string& code) {
        const Mark mark = token_mark();
        const bool is_blank = sign == " ";
        const Fix fix =
            is_blank ? Fix{"Write a space", {{mark, " "}}} : replacing(mark, std::string(sign));
        const std::string shown_sign = is_blank ? code : std::string(token_text());
        diagnostics_.report(is_blank ? Diag::StrangeSpace : Diag::StrangeSign, mark,
                            {shown_sign, code, sign}, {.fix = fix});
        if (is_blank) return;
        TokenKind kind = sign_of(sign, sign.size());
        if (kind == TokenKind::Bad) kind = keyword_of(names_.intern(sign));
        finish(kind);
    }

    // A text in quotes, to its end or that of the line, is one mistake.
    void quoted_text(uint32_t quote) {
        const uint32_t closing = closing_quote(quote);
        step();
        while (at_ < source_.size() && source_[at_] != '\n') {
            const bool is_end = decode(source_, at_).value == closing;
            step();
            if (is_end) break;
        }
        diagnostics_.report(Diag::QuotedText, token_mark(), {shown(token_text())});
        finish(TokenKind::Bad);
    }

    static std::optional<Fix> fix_of(uint32_t character, Mark mark) {
        if (character == ';') return deleting(mark, ";");
        if (character == '}') return replacing(mark, "end");
        return std::nullopt;
    }

    static std::string_view advice(uint32_t character) {
        switch (character) {
            case ';':
                return ": statements need no separator; delete it";
            case '{':
                return ": a block begins with \"then\" or \"do\"; write that word instead";
            case '}':
                return ": a block ends with \"end\"; write that word instead";
            case '?':
                return ": there is no choice inside an expression; write \"if … then … else … "
                       "end\"";
            case 0x00b2:
            case 0x00b3:
                return ": there are no powers; multiply, as in \"x * x\"";
            case 0xfeff:
                return ": it is a byte-order mark inside the text; delete it";
            default:
                return "; delete it";
        }
    }

    std::string_view source_;
    Names& names_;
    Diagnostics& diagnostics_;
    Tokens tokens_;
    Token token_;
    size_t at_ = 0;
    size_t line_start_ = 0;
    size_t continuation_bytes_ =
        0;  // on this line, before at_: bytes that are no column of their own
    int32_t line_ = 1;
};

}  // namespace

Tokens scan(std::string_view source, Names& names, Diagnostics& diagnostics) {
    return Scanner(source, names, diagnostics).run();
}

Mark mark_of(std::string_view source, const Token& token) {
    const int width = count_code_points(text_of(source, token));
    return {{token.line, token.column}, {token.line, token.column + width}};
}

std::string shown(std::string_view text) {
    if (text.size() <= kShownBytes) return std::string(text);
    size_t cut = 0;
    while (cut < kShownBytes) cut += decode(text, cut).length;
    return std::string(text.substr(0, cut)) + "…";
}

}  // namespace vagus::aesl
