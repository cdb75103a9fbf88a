// The syntax tree of one program, as the parser leaves it: names are resolved, sizes are known,
// nothing is rewritten or folded (docs/spec/aesl-language.md, chapter 2). All phases behind the
// parser read it; none changes it, but for the mark `bad` on a statement with a mistake.
//
// Nodes lie in one array and name each other by index. A node's children form a list: `first`, then
// `next` of each.
//
//     for (NodeId child = tree[id].first; child != kNoNode; child = tree[child].next) …
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/names.hpp"
#include "aesl/target.hpp"
#include "aesl/token.hpp"
#include "isa/isa.hpp"

namespace vagus::aesl {

using NodeId = uint32_t;
using VariableId = uint32_t;
constexpr NodeId kNoNode = 0xffffffff;

// Kind, then: value; children; token. "variable" is an index into Tree::variables.
enum class NodeKind : uint8_t {
    // Expressions
    Number,    // the number (a named constant is one too: its token is an Identifier); -; itself
    Variable,  // variable; -; name
    Element,   // variable; index; name
    Slice,     // variable; two Numbers, first and last element; name
    Tuple,     // -; elements; `[`
    Unary,     // -; operand; operator, `op` is an isa::UnaryOperator
    // -; left, right; operator, `op` is an isa::BinaryOperator: arithmetic, comparisons, `and`,
    // `or`.
    Binary,
    Not,    // -; operand; the first `not` of an odd number of them
    Error,  // takes the place of what was wrong
    // Statements
    // -; left, right; operator. `op` is the isa::BinaryOperator of `+=` …, kPlainAssignment for
    // `=`.
    Assign,
    Count,   // -; left; `++` or `--`, `op` is Add or Subtract
    If,      // token of the closing `end`; Clauses, then perhaps a Block for `else`; `if`
    Clause,  // -; condition, Block; `if` or `elseif`
    When,    // token of the closing `end`; condition, Block; `when`
    While,   // -; condition, Block; `while`
    For,     // -; variable reference, then Numbers first, last, step, then Block; `for`
    Emit,    // number of the global event; nothing or the argument; `emit` or `_emit`
    Call,    // number of the native; arguments; `call`
    // Index into Tree::subs, kUnresolved if there is none; -; `callsub` (the name is the token
    // behind it).
    CallSub,
    Return,  // -; -; `return`
    Block,   // -; statements; the token before the first of them
};

constexpr uint8_t kPlainAssignment = 0xff;
constexpr int32_t kUnresolved = -1;

struct Node {
    NodeKind kind = NodeKind::Error;
    uint8_t op = 0;
    bool bad = false;    // statements: an error was found in it (in its head, where it has a body)
    uint16_t depth = 0;  // expressions: operators above each other
    TokenId token = 0;
    int32_t value = 0;
    int32_t size = 0;  // expressions: words; 0 where a mistake keeps them unknown
    NodeId first = kNoNode;
    NodeId next = kNoNode;
};

struct TreeVariable {
    std::string_view name = {};
    TokenId token = 0;  // where it is declared; 0 for the node's variables
    int32_t address = 0;
    int32_t size = 1;  // 0: a mistake in the declaration, or a variable that was used without one
    bool is_used = false;  // it occurs in the code
};

enum class SectionKind : uint8_t { Init, Event, Sub };

// The code of the initialisation, of one handler or of one sub.
struct Section {
    SectionKind kind = SectionKind::Init;
    std::string_view name = {};
    TokenId token = 0;   // `onevent`, `sub` or `ontimer`
    int32_t number = 0;  // Event: id in bytecode; Sub: index into Tree::subs
    NodeId block = kNoNode;
    // Second handler or sub of a name, or one of an unknown event: checked, not compiled.
    bool is_ignored = false;
};

struct TreeSub {
    std::string_view name = {};
    TokenId token = 0;  // `sub`
    uint32_t section = 0;
    bool is_called = false;
};

struct Tree {
    // Borrowed: the text must outlive the tree, as must target and common definitions.
    std::string_view source;
    Tokens tokens;
    Names names;
    std::vector<Node> nodes;
    std::vector<TreeVariable> variables;  // the node's, then the user's
    uint32_t node_variables = 0;          // how many of them are the node's
    std::vector<Section> sections;  // in the order of the text; the first is the initialisation
    std::vector<TreeSub> subs;      // in the order of the text
    int32_t memory_words = 0;       // of variables that a program can address on this node
    int32_t variable_words = 0;     // in use by variables
    bool is_partial = false;        // the parser stopped before the end of the text

    const Node& operator[](NodeId id) const { return nodes[id]; }
    Node& operator[](NodeId id) { return nodes[id]; }
    const Token& token_of(NodeId id) const { return tokens[nodes[id].token]; }
    int line_of(NodeId id) const { return tokens[nodes[id].token].line; }
    // The text of a token: for CallSub and names.
    std::string_view text(TokenId id) const {
        return source.substr(tokens[id].offset, tokens[id].length);
    }

    // Children by position; asking for one that is not there is a bug.
    NodeId child(NodeId id, int position) const {
        NodeId found = nodes[id].first;
        while (position-- > 0) found = nodes[found].next;
        return found;
    }
};

constexpr bool is_comparison(uint8_t op) {
    return op >= static_cast<uint8_t>(isa::BinaryOperator::Equal) &&
           op <= static_cast<uint8_t>(isa::BinaryOperator::SmallerEqual);
}
constexpr bool is_logical(uint8_t op) {
    return op == static_cast<uint8_t>(isa::BinaryOperator::Or) ||
           op == static_cast<uint8_t>(isa::BinaryOperator::And);
}

}  // namespace vagus::aesl
