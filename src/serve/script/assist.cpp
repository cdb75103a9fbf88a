#include "serve/script/assist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "aesl/names.hpp"
#include "aesl/token.hpp"

namespace vagus::serve {

namespace {

using aesl::Mention;
using aesl::MentionKind;
using aesl::TokenKind;
using aesl::Wanted;

std::string size_text(size_t size) {
    return size == 1 ? "int16" : fmt::format("int16[{}]", size);
}

std::string signature_of(const aesl::NativeFunction& native) {
    std::string text = native.name + "(";
    for (const aesl::NativeParameter& parameter : native.parameters) {
        if (!text.ends_with('(')) text += ", ";
        text += parameter.name;
        if (parameter.size > 1) text += fmt::format("[{}]", parameter.size);
    }
    return text + ")";
}

class Completer {
public:
    Completer(const ScriptView& script, std::vector<Suggestion>& items)
        : script_(script), items_(items) {}

    void fill(const aesl::Cursor& cursor) {
        switch (cursor.wanted) {
            case Wanted::Handler:
                local_events();
                events();
                break;
            case Wanted::Emitted:
                events();
                break;
            case Wanted::Sub:
                subs();
                break;
            case Wanted::Native:
                natives();
                break;
            case Wanted::Statement:
                variables();
                keywords(true);
                break;
            case Wanted::Expression:
                variables();
                constants();
                keywords(false);
                break;
            case Wanted::NewName:
            case Wanted::Comment:
                break;
        }
    }

private:
    void add(std::string label, const char* kind, std::string detail, std::string help = {},
             std::string insert = {}) {
        if (!seen_.insert(label).second) return;
        if (insert.empty()) insert = label;
        items_.push_back(
            {std::move(label), kind, std::move(detail), std::move(help), std::move(insert)});
    }

    void own(MentionKind kind, const char* word, const std::string& detail) {
        for (const Mention& one : aesl::mentions(script_.source, script_.common)) {
            if (one.kind == kind && one.declares) add(one.name, word, detail);
        }
    }
    void variables() {
        own(MentionKind::Variable, "variable", "of this script");
        for (const aesl::NamedVariable& variable : script_.target.variables) {
            add(variable.name, "variable", size_text(variable.size) + " of the node");
        }
    }
    void constants() {
        own(MentionKind::Constant, "constant", "of this script");
        for (const aesl::Constant& constant : script_.common.constants) {
            add(constant.name, "constant", fmt::format("= {}", constant.value));
        }
    }
    void local_events() {
        for (const aesl::LocalEvent& event : script_.target.local_events) {
            add(event.name, "event", "of the node", event.doc);
        }
    }
    void events() {
        for (const aesl::GlobalEvent& event : script_.common.events) {
            const size_t size = event.size.value_or(0);
            add(event.name, "event", size == 1 ? "1 argument" : fmt::format("{} arguments", size));
        }
    }
    void subs() { own(MentionKind::Sub, "sub", "of this script"); }
    void natives() {
        for (const aesl::NativeFunction& native : script_.target.natives) {
            add(native.name, "native", signature_of(native), native.doc, native.name + "(");
        }
    }
    void keywords(bool statement) {
        static constexpr TokenKind kStatements[] = {
            TokenKind::Call, TokenKind::CallSub, TokenKind::Const,  TokenKind::Else,
            TokenKind::Emit, TokenKind::ElseIf,  TokenKind::End,    TokenKind::For,
            TokenKind::If,   TokenKind::OnEvent, TokenKind::Return, TokenKind::Sub,
            TokenKind::Var,  TokenKind::When,    TokenKind::While};
        static constexpr TokenKind kExpressions[] = {
            TokenKind::Abs, TokenKind::And,  TokenKind::Do, TokenKind::In,
            TokenKind::Not, TokenKind::Step, TokenKind::Or, TokenKind::Then};
        if (statement) {
            for (const TokenKind kind : kStatements) keyword(kind);
        } else {
            for (const TokenKind kind : kExpressions) keyword(kind);
        }
    }
    void keyword(TokenKind kind) { add(std::string(aesl::spelling_of(kind)), "keyword", ""); }

    const ScriptView& script_;
    std::vector<Suggestion>& items_;
    std::set<std::string> seen_;
};

bool before(aesl::Position a, aesl::Position b) {
    return a.line < b.line || (a.line == b.line && a.column < b.column);
}

std::string variable_title(const ScriptView& script, const std::string& name) {
    size_t address = 0;
    for (const aesl::NamedVariable& variable : script.target.variables) {
        if (variable.name == name) {
            return fmt::format("{}: {} of the node, at address {}", name, size_text(variable.size),
                               address);
        }
        address += variable.size;
    }
    return name + ": a variable of this script";
}

std::string event_title(const ScriptView& script, const std::string& name) {
    for (const aesl::GlobalEvent& event : script.common.events) {
        if (event.name != name) continue;
        return fmt::format("{}: an event of the project with {} arguments", name,
                           event.size.value_or(0));
    }
    return name + ": an event of the node";
}

std::string constant_title(const ScriptView& script, const std::string& name) {
    for (const aesl::Constant& constant : script.common.constants) {
        if (constant.name == name) return fmt::format("{} = {}", name, constant.value);
    }
    return name + ": a constant of this script";
}

Hover hover_of(const ScriptView& script, const Mention& mention) {
    Hover hover{mention.at, mention.end, {}, {}};
    switch (mention.kind) {
        case MentionKind::Variable:
            hover.title = variable_title(script, mention.name);
            break;
        case MentionKind::Constant:
            hover.title = constant_title(script, mention.name);
            break;
        case MentionKind::Sub:
            hover.title = mention.name + ": a sub of this script";
            break;
        case MentionKind::Event:
            hover.title = event_title(script, mention.name);
            for (const aesl::LocalEvent& event : script.target.local_events) {
                if (event.name == mention.name) hover.help = event.doc;
            }
            break;
        case MentionKind::Native:
            hover.title = mention.name + ": not a native of this node";
            for (const aesl::NativeFunction& native : script.target.natives) {
                if (native.name != mention.name) continue;
                hover.title = signature_of(native);
                hover.help = native.doc;
            }
            break;
    }
    return hover;
}

}  // namespace

Suggestions complete(const ScriptView& script, size_t offset) {
    const aesl::Cursor cursor =
        aesl::cursor_at(script.source, std::min(offset, script.source.size()));
    Suggestions suggestions;
    suggestions.from = cursor.word_begin;
    Completer(script, suggestions.items).fill(cursor);
    return suggestions;
}

std::optional<Mention> mention_at(const ScriptView& script, aesl::Position at) {
    for (const Mention& mention : aesl::mentions(script.source, script.common)) {
        if (!before(at, mention.at) && !before(mention.end, at)) return mention;
    }
    return std::nullopt;
}

std::optional<Hover> hover(const ScriptView& script, aesl::Position at) {
    const auto mention = mention_at(script, at);
    if (!mention) return std::nullopt;
    return hover_of(script, *mention);
}

std::vector<Mention> mentions_of(const ScriptView& script, const std::string& name,
                                 MentionKind kind) {
    std::vector<Mention> all = aesl::mentions(script.source, script.common);
    std::erase_if(all, [&](const Mention& one) { return one.name != name || one.kind != kind; });
    return all;
}

Owner owner_of(const ScriptView& script, const std::string& name, MentionKind kind) {
    const auto named = [&](const auto& one) { return one.name == name; };
    const auto among = [&](const auto& list) {
        return std::any_of(list.begin(), list.end(), named);
    };
    switch (kind) {
        case MentionKind::Variable:
            return among(script.target.variables) ? Owner::Node : Owner::Script;
        case MentionKind::Constant:
            return among(script.common.constants) ? Owner::Project : Owner::Script;
        case MentionKind::Event:
            return among(script.target.local_events) ? Owner::Node : Owner::Project;
        case MentionKind::Sub:
            return Owner::Script;
        case MentionKind::Native:
            return among(script.target.natives) ? Owner::Node : Owner::Script;
    }
    return Owner::Script;
}

std::string fault_of_name(const ScriptView& script, const std::string& name) {
    const auto mentions = aesl::mentions(name, {});
    if (mentions.size() != 1 || mentions[0].name != name) {
        return fmt::format(
            "“{:.60}” is no name: begin it with a letter or _, then letters, digits, "
            "_ and dots; words of the language are taken",
            name);
    }
    for (const MentionKind kind :
         {MentionKind::Variable, MentionKind::Constant, MentionKind::Event, MentionKind::Native}) {
        if (kind != MentionKind::Event && owner_of(script, name, kind) != Owner::Script) {
            return fmt::format("“{}” is the name of something else already; take another", name);
        }
    }
    for (const Mention& one : aesl::mentions(script.source, script.common)) {
        if (one.name == name && one.declares) {
            return fmt::format("line {} declares “{}” already; take another name", one.at.line,
                               name);
        }
    }
    return {};
}

}  // namespace vagus::serve
