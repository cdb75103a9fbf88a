// What an editor asks about a script: what may be here, what is this, where is it declared and
// used. Values in, values out; scripts that do not compile are answered, too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "aesl/compile.hpp"
#include "aesl/mentions.hpp"
#include "aesl/target.hpp"

namespace vagus::serve {

// A script with what it is compiled for.
struct ScriptView {
    std::string_view source;
    const aesl::Target& target;
    const aesl::CommonDefinitions& common;
};

struct Suggestion {
    std::string label;
    std::string kind;    // as in the protocol: variable, constant, event, native, sub, keyword
    std::string detail;  // "int16[7], node"
    std::string help;
    std::string insert;
};

struct Suggestions {
    size_t from = 0;  // byte offset at which the word begins that is replaced
    std::vector<Suggestion> items;
};

// `offset` in bytes.
Suggestions complete(const ScriptView& script, size_t offset);

struct Hover {
    aesl::Position at, end;
    std::string title;  // "prox.horizontal: 7 words of the node, from address 60"
    std::string help;
};
std::optional<Hover> hover(const ScriptView& script, aesl::Position at);

// The mention that covers a place; nothing if there is none.
std::optional<aesl::Mention> mention_at(const ScriptView& script, aesl::Position at);

// Mentions of the same thing.
std::vector<aesl::Mention> mentions_of(const ScriptView& script, const std::string& name,
                                       aesl::MentionKind kind);

// Whether it belongs to the node, the project's file, or to the script alone; what belongs to the
// node cannot be renamed.
enum class Owner { Node, Project, Script };
Owner owner_of(const ScriptView& script, const std::string& name, aesl::MentionKind kind);

// Why a text cannot be a name that is new in this script; empty if it can.
std::string fault_of_name(const ScriptView& script, const std::string& name);

}  // namespace vagus::serve
