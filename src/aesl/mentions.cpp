#include "aesl/mentions.hpp"

#include <algorithm>
#include <set>

#include "aesl/scan.hpp"

namespace vagus::aesl {

namespace {

Tokens tokens_of(std::string_view source) {
    Names names;
    Diagnostics diagnostics;
    return scan(source, names, diagnostics);
}

std::set<std::string, std::less<>> constants_of(std::string_view source, const Tokens& tokens,
                                                const CommonDefinitions& common) {
    std::set<std::string, std::less<>> constants;
    for (const Constant& constant : common.constants) constants.insert(constant.name);
    for (size_t i = 1; i < tokens.size(); ++i) {
        if (tokens[i - 1].kind == TokenKind::Const && tokens[i].kind == TokenKind::Identifier) {
            constants.emplace(text_of(source, tokens[i]));
        }
    }
    return constants;
}

// What the keyword before a name makes of it.
void take_keyword(TokenKind before, Mention& mention) {
    mention.declares =
        before == TokenKind::Var || before == TokenKind::Const || before == TokenKind::Sub;
    mention.handles = before == TokenKind::OnEvent;
    switch (before) {
        case TokenKind::Const:
            mention.kind = MentionKind::Constant;
            break;
        case TokenKind::OnEvent:
        case TokenKind::Emit:
        case TokenKind::EmitShort:
            mention.kind = MentionKind::Event;
            break;
        case TokenKind::Sub:
        case TokenKind::CallSub:
            mention.kind = MentionKind::Sub;
            break;
        case TokenKind::Call:
            mention.kind = MentionKind::Native;
            break;
        default:
            break;  // any other token says nothing about the name behind it
    }
}

Wanted wanted_behind(TokenKind before) {
    switch (before) {
        case TokenKind::OnEvent:
            return Wanted::Handler;
        case TokenKind::Emit:
        case TokenKind::EmitShort:
            return Wanted::Emitted;
        case TokenKind::CallSub:
            return Wanted::Sub;
        case TokenKind::Call:
            return Wanted::Native;
        case TokenKind::Var:
        case TokenKind::Const:
        case TokenKind::Sub:
            return Wanted::NewName;
        default:
            return Wanted::Expression;  // of a line that has begun
    }
}

bool in_comment(std::string_view source, size_t offset) {
    bool line = false, block = false;
    for (size_t i = 0; i < offset; ++i) {
        const std::string_view rest = source.substr(i);
        if (line && source[i] == '\n') line = false;
        if (block && rest.starts_with("*#")) {
            block = false;
            ++i;
        } else if (!block && !line && rest.starts_with("#*")) {
            block = true;
            ++i;
        } else if (!block && source[i] == '#') {
            line = true;
        } else {
            continue;
        }
    }
    return line || block;
}

// `call NAME(a, b|`: the native and which argument.
void find_call(std::string_view source, const Tokens& tokens, size_t end, Cursor& cursor) {
    int depth = 0;
    size_t commas = 0;
    for (size_t i = end; i-- > 0;) {
        const TokenKind kind = tokens[i].kind;
        if (kind == TokenKind::SignParenClose || kind == TokenKind::SignBracketClose) ++depth;
        if (kind == TokenKind::SignParenOpen || kind == TokenKind::SignBracketOpen) --depth;
        if (kind == TokenKind::SignComma && depth == 0) ++commas;
        if (depth >= 0) continue;
        const bool called = kind == TokenKind::SignParenOpen && i >= 2 &&
                            tokens[i - 1].kind == TokenKind::Identifier &&
                            tokens[i - 2].kind == TokenKind::Call;
        if (called) {
            cursor.native = text_of(source, tokens[i - 1]);
            cursor.argument = commas;
        }
        return;
    }
}

}  // namespace

std::vector<Mention> mentions(std::string_view source, const CommonDefinitions& common) {
    const Tokens tokens = tokens_of(source);
    const auto constants = constants_of(source, tokens, common);
    std::vector<Mention> found;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].kind != TokenKind::Identifier) continue;
        const Mark mark = mark_of(source, tokens[i]);
        Mention mention;
        mention.name = text_of(source, tokens[i]);
        mention.at = mark.at;
        mention.end = mark.end;
        mention.offset = tokens[i].offset;
        if (constants.contains(mention.name)) mention.kind = MentionKind::Constant;
        if (i > 0) take_keyword(tokens[i - 1].kind, mention);
        found.push_back(std::move(mention));
    }
    return found;
}

Cursor cursor_at(std::string_view source, size_t offset) {
    Cursor cursor;
    cursor.word_begin = offset;
    if (in_comment(source, offset)) {
        cursor.wanted = Wanted::Comment;
        return cursor;
    }
    const Tokens tokens = tokens_of(source);
    size_t before = 0;  // tokens that end before the word at the cursor
    while (before < tokens.size() && tokens[before].kind != TokenKind::EndOfText &&
           tokens[before].offset + tokens[before].length <= offset) {
        ++before;
    }
    // The word that is being typed is a token itself, or the end of one.
    if (before > 0 && tokens[before - 1].offset + tokens[before - 1].length == offset) {
        const TokenKind kind = tokens[before - 1].kind;
        if (kind == TokenKind::Identifier || is_keyword(kind)) --before;
    }
    if (before < tokens.size() && tokens[before].offset < offset) {
        cursor.word_begin = tokens[before].offset;
    }
    if (before == 0) return cursor;
    const Token& last = tokens[before - 1];
    const std::string_view between =
        source.substr(last.offset + last.length, cursor.word_begin - last.offset - last.length);
    const bool new_line = between.find('\n') != between.npos;
    const Wanted behind = wanted_behind(last.kind);
    cursor.wanted = behind != Wanted::Expression || !new_line ? behind : Wanted::Statement;
    if (last.kind == TokenKind::Then || last.kind == TokenKind::Do ||
        last.kind == TokenKind::Else) {
        cursor.wanted = Wanted::Statement;
    }
    find_call(source, tokens, before, cursor);
    if (!cursor.native.empty() && cursor.wanted == Wanted::Statement) {
        cursor.wanted = Wanted::Expression;
    }
    return cursor;
}

}  // namespace vagus::aesl
