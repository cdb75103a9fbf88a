// See mutate.hpp. The text is cut into pieces (words, operators, comments, white space) that
// together are the text again; a change is made to the list of pieces.
#include "mutate.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>
#include <vector>

namespace vagus::aesl {
namespace {

using Pieces = std::vector<std::string>;

constexpr int kChangesMax = 3;

constexpr std::string_view kOperators[] = {
    "<<=", ">>=", "+=", "-=", "*=", "/=", "%=", "|=", "^=", "&=", "++", "--",
    "<<",  ">>",  "==", "!=", "<=", ">=", "(",  ")",  "[",  "]",  ":",  ",",
    "=",   "+",   "-",  "*",  "/",  "%",  "|",  "^",  "&",  "~",  "<",  ">"};
constexpr std::string_view kWords[] = {
    "abs",         "and",         "call",       "callsub",    "const",        "do",     "else",
    "elseif",      "emit",        "_emit",      "end",        "for",          "if",     "in",
    "not",         "onevent",     "or",         "return",     "step",         "sub",    "then",
    "var",         "when",        "while",      "tick",       "button",       "ping",   "report",
    "triple",      "wide",        "setlimit",   "LIMIT",      "NEG",          "ZERO",   "HUGE",
    "sensor.prox", "motor.left",  "event.args", "math.fill",  "math.copy",    "id",     "math.dot",
    "sys.nop",     "sys.sum",     "deque.size", "math.stat",  "nothing",      "a",      "v",
    "[1,2]",       "[0]",         "[0:1]",      "(1 == 2)",   "[[1,2],3]",    "v[0]",   "= 1",
    "var zz[2]",   "const Q = 1", "emit ping",  "callsub zz", "onevent tick", "sub zz", "a = 1"};
constexpr std::string_view kNumbers[] = {"0",       "1",
                                         "2",       "3",
                                         "4",       "5",
                                         "8",       "32",
                                         "33",      "100",
                                         "2047",    "2048",
                                         "2049",    "32766",
                                         "32767",   "32768",
                                         "32769",   "65535",
                                         "65536",   "0x7fff",
                                         "0x8000",  "0x8001",
                                         "0xffff",  "0x10000",
                                         "0b1",     "0b1000000000000000",
                                         "-1",      "-2047",
                                         "-2048",   "-32767",
                                         "-32768",  "-32769",
                                         "-0x8000", "00",
                                         "0009",    "99999999999999999999",
                                         "12a",     "0x1g",
                                         "0b2",     "0X1",
                                         "1.5",     "-0"};
constexpr std::string_view kOddities[] = {"!",      "$",      ";",  "@",  "\"", "é",
                                          "\u00a0", "\ufeff", "\r", "#*", "*#", "#",
                                          ".",      "{",      "}",  "'",  "?",  "\t"};

bool is_space(char character) {
    return std::isspace(static_cast<unsigned char>(character)) != 0;
}

bool is_ascii(char character) {
    return static_cast<unsigned char>(character) < 0x80;
}

bool is_word(char character) {
    const auto byte = static_cast<unsigned char>(character);
    return std::isalnum(byte) != 0 || character == '_' || character == '.' || byte >= 0x80;
}

bool is_number(const std::string& piece) {
    return !piece.empty() && std::isdigit(static_cast<unsigned char>(piece[0])) != 0;
}

size_t run_of(std::string_view text, bool (*belongs)(char)) {
    return static_cast<size_t>(std::find_if_not(text.begin(), text.end(), belongs) - text.begin());
}

size_t comment_length(std::string_view text) {
    const bool is_block = text.starts_with("#*");
    const size_t end = is_block ? text.find("*#", 2) : text.find('\n');
    if (end == std::string_view::npos) return text.size();
    return is_block ? end + 2 : end;
}

size_t piece_length(std::string_view text) {
    if (is_space(text[0])) return run_of(text, is_space);
    if (text[0] == '#') return comment_length(text);
    if (is_word(text[0])) return run_of(text, is_word);
    for (const std::string_view each : kOperators)
        if (text.starts_with(each)) return each.size();
    return 1;
}

Pieces cut(std::string_view text) {
    Pieces pieces;
    while (!text.empty()) {
        const size_t length = piece_length(text);
        pieces.emplace_back(text.substr(0, length));
        text.remove_prefix(length);
    }
    return pieces;
}

std::string joined(const Pieces& pieces) {
    std::string text;
    for (const std::string& piece : pieces) text += piece;
    return text;
}

bool is_token(const std::string& piece) {
    return !piece.empty() && !is_space(piece[0]) && piece[0] != '#';
}

// The piece of a random token that `fits`; nullptr if there is none.
template <typename Fits>
std::string* some(Pieces& pieces, Dice& dice, Fits fits) {
    std::vector<std::string*> found;
    for (std::string& piece : pieces)
        if (is_token(piece) && fits(piece)) found.push_back(&piece);
    return found.empty() ? nullptr : dice.pick(found);
}

std::string* any(Pieces& pieces, Dice& dice) {
    return some(pieces, dice, [](const std::string&) { return true; });
}

std::string made_up(Pieces& pieces, Dice& dice) {
    switch (dice.below(5)) {
        case 0:
            return std::string(dice.pick(kOperators));
        case 1:
            return std::string(dice.pick(kNumbers));
        case 2:
            return std::string(dice.pick(kWords));
        case 3:
            return std::string(dice.pick(kOddities));
        default:
            break;
    }
    const std::string* piece = any(pieces, dice);
    return piece == nullptr ? "end" : *piece;
}

// ---- the changes ----

void drop(Pieces& pieces, Dice& dice) {
    if (std::string* piece = any(pieces, dice)) piece->clear();
}

void repeat(Pieces& pieces, Dice& dice) {
    if (std::string* piece = any(pieces, dice)) *piece += " " + *piece;
}

void exchange(Pieces& pieces, Dice& dice) {
    std::string* one = any(pieces, dice);
    std::string* other = any(pieces, dice);
    if (one != nullptr && one != other) std::swap(*one, *other);
}

void exchange_neighbours(Pieces& pieces, Dice& dice) {
    std::vector<std::string*> tokens;
    for (std::string& piece : pieces)
        if (is_token(piece)) tokens.push_back(&piece);
    if (tokens.size() < 2) return;
    const auto first = static_cast<size_t>(dice.below(static_cast<int>(tokens.size()) - 1));
    std::swap(*tokens[first], *tokens[first + 1]);
}

void replace(Pieces& pieces, Dice& dice) {
    const std::string other = made_up(pieces, dice);
    if (std::string* piece = any(pieces, dice)) *piece = other;
}

void insert(Pieces& pieces, Dice& dice) {
    const std::string other = made_up(pieces, dice);
    if (std::string* piece = any(pieces, dice)) *piece += " " + other;
}

void renumber(Pieces& pieces, Dice& dice) {
    if (std::string* piece = some(pieces, dice, is_number)) *piece = dice.pick(kNumbers);
}

void misspell(Pieces& pieces, Dice& dice) {
    // Only ASCII words: a change inside a longer code point would make malformed UTF-8, which the
    // specification wants reported and the reference drops (section 1.1).
    std::string* piece = some(pieces, dice, [](const std::string& each) {
        return run_of(each, is_word) == each.size() && run_of(each, is_ascii) == each.size();
    });
    if (piece == nullptr) return;
    const auto at = static_cast<size_t>(dice.below(static_cast<int>(piece->size())));
    switch (dice.below(4)) {
        case 0:
            piece->erase(at, 1);
            break;
        case 1:
            piece->insert(at, 1, (*piece)[at]);
            break;
        case 2:
            std::swap((*piece)[at], piece->front());
            break;
        default:
            (*piece)[at] =
                static_cast<char>(std::toupper(static_cast<unsigned char>((*piece)[at])));
            break;
    }
}

// What beginners forget.
void forget(Pieces& pieces, Dice& dice) {
    constexpr std::string_view kForgotten[] = {"end", "then", "do", "(",  ")", "[",    "]",
                                               "var", ",",    "=",  "in", ":", "call", "emit"};
    const std::string_view chosen = dice.pick(kForgotten);
    if (std::string* piece =
            some(pieces, dice, [&](const std::string& each) { return each == chosen; }))
        piece->clear();
}

void join_words(Pieces& pieces, Dice& dice) {
    std::vector<std::string*> gaps;
    for (std::string& piece : pieces)
        if (!piece.empty() && is_space(piece[0])) gaps.push_back(&piece);
    if (!gaps.empty()) dice.pick(gaps)->clear();
}

Pieces lines_of(const Pieces& pieces) {
    Pieces lines{""};
    for (const char character : joined(pieces)) {
        lines.back() += character;
        if (character == '\n') lines.emplace_back();
    }
    return lines;
}

void change_lines(Pieces& pieces, Dice& dice) {
    Pieces lines = lines_of(pieces);
    const int count = static_cast<int>(lines.size());
    const auto from = static_cast<size_t>(dice.below(count));
    const auto to = static_cast<size_t>(dice.below(count));
    const std::string line = lines[from];
    const int act = dice.below(3);
    if (act != 0) lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(to), line);
    if (act != 1) {
        const size_t moved = act == 2 && to <= from ? from + 1 : from;
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(moved));
    }
    pieces = cut(joined(lines));
}

void cut_off(Pieces& pieces, Dice& dice) {
    if (!pieces.empty())
        pieces.resize(static_cast<size_t>(dice.below(static_cast<int>(pieces.size()))));
}

using Change = void (*)(Pieces&, Dice&);
// Some stand twice: they give the more telling programs.
constexpr Change kChanges[] = {
    drop,       drop,         repeat,       exchange, exchange_neighbours,
    replace,    replace,      insert,       insert,   renumber,
    renumber,   renumber,     misspell,     forget,   forget,
    join_words, change_lines, change_lines, cut_off};

}  // namespace

std::string mutate(const std::string& source, Dice& dice) {
    Pieces pieces = cut(source);
    for (int i = dice.from_to(1, kChangesMax); i > 0; --i) dice.pick(kChanges)(pieces, dice);
    return joined(pieces);
}

}  // namespace vagus::aesl
