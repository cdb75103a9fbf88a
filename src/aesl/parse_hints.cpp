// What a name that nobody knows was probably meant as: the sentence that helps most, and the fix.
// Nothing here decides whether something is a mistake.
#include <algorithm>
#include <array>

#include "aesl/fix.hpp"
#include "aesl/limits.hpp"
#include "aesl/parser.hpp"
#include "aesl/suggest.hpp"
#include "base/nearest.hpp"

namespace vagus::aesl {
namespace {

enum class Habit : uint8_t { None, Keyword, NoSuch };

struct HabitEntry {
    Habit kind;
    std::string_view word;
    std::string_view text;
};

constexpr std::string_view kWaiting = "waiting";
constexpr std::string_view kForEver = "for ever";

constexpr HabitEntry kHabits[] = {
#define WAITING kWaiting
#define FOR_EVER kForEver
#define KEYWORD_FOR(word, keyword) {Habit::Keyword, word, keyword},
#define NO_SUCH(word, advice) {Habit::NoSuch, word, advice},
#include "aesl/habits.def"
#undef NO_SUCH
#undef KEYWORD_FOR
#undef FOR_EVER
#undef WAITING
};

HabitEntry habit_of(std::string_view word) {
    const std::string lower = in_small_letters(word);
    for (const HabitEntry& entry : kHabits)
        if (entry.word == lower) return entry;
    return {Habit::None, {}, {}};
}

// What parameters that receive a result are called in descriptions of nodes.
bool is_result(std::string_view parameter) {
    constexpr std::array<std::string_view, 9> kResults = {
        "dest", "result", "size", "min", "argmin", "status", "written", "read", "duration"};
    return std::find(kResults.begin(), kResults.end(), parameter) != kResults.end();
}

}  // namespace

// ---- Fixes

Mark Parser::marks(TokenId first, TokenId last) const {
    return {mark(first).at, mark(last).end};
}

Fix Parser::write_before(TokenId token, std::string text) const {
    return inserting(mark(token).at, std::move(text));
}

// Behind the last token before this one.
Fix Parser::write_behind_last(TokenId token, std::string text) const {
    return inserting(token == 0 ? Position{1, 1} : mark(token - 1).end, std::move(text));
}

// Where a declaration can be put: before the first item, behind all declarations.
Fix Parser::declare_first(std::string declaration) const {
    return inserting(mark(first_item_.value_or(statement_start_)).at, declaration + "\n");
}

bool Parser::touches_next(TokenId token) const {
    const Token& it = tree_.tokens[token];
    return token + 1 < tree_.tokens.size() &&
           it.offset + it.length == tree_.tokens[token + 1].offset;
}

// ---- Names

bool Parser::belongs_to(const Symbol& known, NameSpace space) const {
    const bool is_variable = known.variable >= 0 && !known.is_implicit;
    switch (space) {
        case NameSpace::Value:
            return is_variable || known.constant >= 0;
        case NameSpace::Variable:
            return is_variable;
        case NameSpace::Constant:
            return known.constant >= 0;
        case NameSpace::GlobalEvent:
            return known.global_event >= 0;
        case NameSpace::AnyEvent:
            return known.global_event >= 0 || known.local_event >= 0;
        case NameSpace::Native:
            return known.native >= 0;
        case NameSpace::Sub:
            return known.sub >= 0;
    }
    return false;
}

// The known name that is closest to a token, or nothing. One that differs only in capitals is
// meant, however many they are.
std::string Parser::guess(TokenId name, NameSpace space) const {
    if (diagnostics_.full()) return {};
    std::vector<std::string_view> candidates;
    for (NameId id = 0; id < symbols_.size(); ++id) {
        if (belongs_to(symbols_[id], space)) candidates.push_back(tree_.names.text(id));
    }
    const std::string_view same = same_letters(tree_.text(name), candidates);
    return shown(same.empty() ? closest(tree_.text(name), candidates) : same);
}

void Parser::unknown_event(TokenId name, NameSpace space) {
    symbol(name).is_event_unknown = true;
    const std::string keyword(tree_.text(name - 1));
    const std::string text = name_text(name);
    if (belongs_to(symbol(name), NameSpace::Variable)) {
        return error(Diag::VariableAsEvent, name, {text, keyword});
    }
    const std::string similar = guess(name, space);
    if (!similar.empty()) {
        return error(Diag::UnknownEventGuess, name, {text, similar},
                     {.fix = replacing(mark(name), similar)});
    }
    error(Diag::UnknownEvent, name, {text}, {.fix = declaring(tree_.text(name), 0)});
}

// A sub may be declared further down, where the parser has not been yet.
bool Parser::is_sub_somewhere(TokenId name) const {
    const int32_t wanted = tree_.tokens[name].value;
    for (TokenId i = 0; i + 1 < tree_.tokens.size(); ++i) {
        const Token& next = tree_.tokens[i + 1];
        if (tree_.tokens[i].kind == TokenKind::Sub && next.kind == TokenKind::Identifier &&
            next.value == wanted) {
            return true;
        }
    }
    return false;
}

// "leds.top(red, green, blue)"
std::string Parser::call_of(const NativeFunction& native) const {
    std::string call = shown(native.name) + "(";
    for (const NativeParameter& parameter : native.parameters) {
        if (!call.ends_with('(')) call += ", ";
        call += shown(parameter.name);
    }
    return call + ")";
}

// The native function that a call without `call`, or with a slip in its name, was meant for:
// `sqrt(…)` is math.sqrt.
const NativeFunction* Parser::native_meant(TokenId name) const {
    const std::string text(tree_.text(name));
    for (const NativeFunction& native : target_.natives) {
        if (native.name.ends_with("." + text)) return &native;
    }
    const std::string similar = guess(name, NameSpace::Native);
    for (const NativeFunction& native : target_.natives)
        if (!similar.empty() && native.name == similar) return &native;
    return nullptr;
}

// A keyword that the first word of a statement may have been meant as: with capital letters, or one
// slip away.
std::string Parser::misspelt_keyword(TokenId name) const {
    std::vector<std::string_view> keywords;
    for (auto kind = kFirstKeyword; kind <= kLastKeyword;
         kind = static_cast<TokenKind>(static_cast<int>(kind) + 1)) {
        if (is_boundary(kind)) keywords.push_back(spelling_of(kind));
    }
    const std::string lower = in_small_letters(name_text(name));
    if (std::find(keywords.begin(), keywords.end(), lower) != keywords.end()) return lower;
    const HabitEntry habit = habit_of(lower);
    if (habit.kind == Habit::Keyword) return std::string(habit.text);
    if (habit.kind == Habit::NoSuch) return {};
    return nearest(lower, keywords);
}

// An event of the node that comes again and again, for examples.
std::string Parser::repeating_event() const {
    for (const std::string_view name : {"prox", "timer0", "timer", "tick"}) {
        for (const LocalEvent& event : target_.local_events)
            if (event.name == name) return event.name;
    }
    return target_.local_events.empty() ? "NAME" : shown(target_.local_events.front().name);
}

std::string Parser::advice_of(std::string_view text) const {
    const auto is_period = [](const NamedVariable& variable) {
        return variable.name == "timer.period";
    };
    const bool has_timer =
        std::any_of(target_.variables.begin(), target_.variables.end(), is_period);
    if (text == kWaiting && has_timer) {
        return "nothing waits: set \"timer.period[0]\" to the milliseconds and go on in \"onevent "
               "timer0\"";
    }
    if (text == kWaiting) {
        return "nothing waits: count in \"onevent " + repeating_event() + "\", and go on there";
    }
    if (text == kForEver) {
        return "put its body into the handler of an event that comes again, such as \"onevent " +
               repeating_event() + "\"";
    }
    return std::string(text);
}

// Variables whose names begin with this one and a dot: motor.left.target for motor.left.
std::vector<std::string> Parser::parts_of(std::string_view name) const {
    std::vector<std::string> parts;
    const std::string start = std::string(name) + ".";
    for (const TreeVariable& variable : tree_.variables) {
        if (variable.size > 0 && variable.name.starts_with(start))
            parts.emplace_back(variable.name);
    }
    return parts;
}

// ---- Unknown names in statements and expressions. Each gives false if it has nothing to say.

bool Parser::hint_native(TokenId name) {
    const int32_t native = symbol(name).native;
    if (native < 0) return false;
    const NativeFunction& function = target_.natives[static_cast<size_t>(native)];
    const std::string text = name_text(name);
    const std::string call = call_of(function);
    const bool is_statement = name == statement_start_;
    if (is_statement && assigns_next(name)) {
        error(Diag::NativeAssigned, name, {text, call});
    } else if (is_statement) {
        error(Diag::NativeAsStatement, name, {text, call},
              {.fix = at(TokenKind::SignParenOpen) ? std::optional(write_before(name, "call "))
                                                   : std::nullopt});
    } else {
        for (const NativeParameter& parameter : function.parameters) {
            if (!is_result(parameter.name)) continue;
            error(Diag::NativeResult, name, {text, call, parameter.name});
            return true;
        }
        error(Diag::NativeAsValue, name, {text, call});
    }
    return true;
}

bool Parser::hint_sub(TokenId name) {
    if (!is_sub_somewhere(name)) return false;
    const std::string text = name_text(name);
    if (name != statement_start_) {
        error(Diag::SubAsValue, name, {text});
        return true;
    }
    Fix fix = write_before(name, "callsub ");
    const bool is_call = at(TokenKind::SignParenOpen);
    if (is_call && kind_ahead(1) == TokenKind::SignParenClose)
        fix.edits.push_back({marks(position_, position_ + 1), ""});
    error(Diag::SubAsStatement, name, {text}, {.fix = fix});
    return true;
}

bool Parser::hint_word(TokenId name) {
    const std::string text = name_text(name);
    const bool begins = name == statement_start_ && !assigns_next(name);
    const std::string keyword = begins ? misspelt_keyword(name) : "";
    const HabitEntry habit = habit_of(text);
    const bool has_next = at(TokenKind::Identifier) && !is_first_of_line(position_);
    if (begins && text == "on" && has_next && tree_.text(position_) == "event") {
        error(Diag::MisspeltKeyword, name, {"on event", "onevent"},
              {.fix = replacing(marks(name, position_), "onevent")});
    } else if (!keyword.empty()) {
        error(Diag::MisspeltKeyword, name, {text, keyword},
              {.fix = replacing(mark(name), keyword)});
    } else if (habit.kind == Habit::NoSuch && (begins || name != statement_start_)) {
        error(Diag::ForeignWord, name, {text, advice_of(habit.text)});
    } else if (begins && has_next) {
        const std::optional<Fix> fix =
            code_began_ ? std::nullopt : std::optional(replacing(mark(name), "var"));
        error(Diag::UnknownWord, name, {text, name_text(position_)}, {.fix = fix});
    } else if (habit.kind == Habit::None && at(TokenKind::SignParenOpen)) {
        return hint_call(name);
    } else {
        return false;
    }
    return true;
}

// A word that nobody knows before a `(`.
bool Parser::hint_call(TokenId name) {
    const NativeFunction* const native = native_meant(name);
    if (native == nullptr && !guess(name, NameSpace::Value).empty()) return false;
    if (native == nullptr) {
        error(Diag::UnknownCall, name, {name_text(name)});
        return true;
    }
    const bool is_statement = name == statement_start_;
    const Fix fix = replacing(mark(name), "call " + native->name);
    error(Diag::UnknownCallGuess, name, {name_text(name), call_of(*native)},
          {.fix = is_statement ? std::optional(fix) : std::nullopt});
    return true;
}

bool Parser::hint_truth(TokenId name) {
    const std::string lower = in_small_letters(name_text(name));
    if (lower != "true" && lower != "false") return false;
    const bool is_loop = name > 0 && tree_.tokens[name - 1].kind == TokenKind::While;
    if (is_loop) {
        error(Diag::EndlessLoop, name, {name_text(name), repeating_event()});
    } else {
        const bool is_value = !at(TokenKind::Then) && !at(TokenKind::Do);
        const Fix fix = replacing(mark(name), lower == "true" ? "1" : "0");
        error(Diag::TruthValue, name, {name_text(name)},
              {.fix = is_value ? std::optional(fix) : std::nullopt});
    }
    return true;
}

// `motor.left`, where there are motor.left.target and others; `self.motor.left.target`;
// `prox.horizontal.2`.
bool Parser::hint_parts(TokenId name) {
    const std::string text = name_text(name);
    const std::vector<std::string> parts = parts_of(text);
    std::string meant;
    for (const std::string& part : parts) {
        const bool is_target = part == text + ".target" && name == statement_start_;
        if (is_target || parts.size() == 1) meant = part;
    }
    for (const TreeVariable& variable : tree_.variables) {
        const std::string known(variable.name);
        if (variable.size > 0 && text.ends_with("." + known)) meant = known;
        const bool is_index = variable.size > 1 && text.starts_with(known + ".") &&
                              text.find_first_not_of("0123456789", known.size() + 1) == text.npos &&
                              text.size() > known.size() + 1;
        if (is_index) meant = known + "[" + text.substr(known.size() + 1) + "]";
    }
    if (!meant.empty()) {
        error(Diag::PartOfNameGuess, name, {text, meant}, {.fix = replacing(mark(name), meant)});
        return true;
    }
    if (parts.empty()) return false;
    constexpr size_t kShownParts = 4;
    std::string list;
    for (size_t i = 0; i < std::min(parts.size(), kShownParts); ++i) {
        if (i > 0) list += ", ";
        list += "\"" + shown(parts[i]) + "\"";
    }
    if (parts.size() > kShownParts) list += " …";
    error(Diag::PartOfName, name, {text, list});
    return true;
}

// The sentence that helps most with a name that nobody knows.
void Parser::report_unknown_variable(TokenId name, NameSpace space) {
    if (hint_native(name) || hint_sub(name) || hint_word(name) || hint_truth(name) ||
        hint_parts(name)) {
        return;
    }
    const std::string text = name_text(name);
    const std::string similar = guess(name, space);
    const bool is_event = belongs_to(symbol(name), NameSpace::AnyEvent);
    if (!similar.empty()) {
        error(Diag::UnknownVariableGuess, name, {text, similar},
              {.fix = replacing(mark(name), similar)});
    } else if (is_event && name != statement_start_) {
        error(Diag::EventAsValue, name, {text});
    } else {
        error(space == NameSpace::Variable ? Diag::UnknownLoopVariable : Diag::UnknownVariable,
              name, {text}, {.fix = declare_first("var " + std::string(tree_.text(name)))});
    }
}

}  // namespace vagus::aesl
