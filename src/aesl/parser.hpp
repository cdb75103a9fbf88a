// The parser's inside: state and helpers shared by its seven files. The interface is parse.hpp.
//
// parse.cpp               program, headers, names, recovery
// parse_declarations.cpp  const, var
// parse_statements.cpp    if, when, while, for, return, assignment
// parse_calls.cpp         emit, call, callsub
// parse_expressions.cpp   conditions and expressions
// parse_hints.cpp         what an unknown name was probably meant as, and the fix
// parse_slips.cpp         the same for statements, heads and declarations
//
// Recovery. The first error of syntax in a statement sets `panic_`; while it is set, nothing more
// is reported. The statement then skips to where the next one can begin, which clears it. What was
// wrong stays in the tree as an Error node or a `bad` statement; an unknown name is declared with
// size 0, so that it is reported once.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/diagnostics.hpp"
#include "aesl/options.hpp"
#include "aesl/scan.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

// What one name means in each of the name spaces (section 3.3); an index, or -1.
struct Symbol {
    int32_t constant = -1;
    int32_t variable = -1;
    int32_t global_event = -1;
    int32_t local_event = -1;
    int32_t native = -1;
    int32_t sub = -1;
    int32_t handler = -1;            // token of the header of this event's handler
    bool is_implicit = false;        // the variable exists only because of an error that named it
    bool is_event_unknown = false;   // reported once as an unknown event
    bool is_native_unknown = false;  // reported once as an unknown native function
};

struct ConstantSymbol {
    int32_t value = 0;
    bool is_known = true;  // false: its definition has a mistake
    TokenId token = 0;     // where it is defined; 0 outside the text
};

// The statements of a block or the arguments of a call while they are read.
struct ChildList {
    NodeId first = kNoNode;
    NodeId last = kNoNode;
};

// Keywords at which the next statement, header or declaration begins, or a block ends.
bool is_boundary(TokenKind kind);

class Parser {
public:
    Parser(Tree& tree, const Target& target, const CommonDefinitions& common,
           const Options& options, Diagnostics& diagnostics);

    void program();

private:
    enum class NameSpace { Value, Variable, Constant, GlobalEvent, AnyEvent, Native, Sub };

    // parse.cpp: names
    void define_node_names();
    void define_common_names();
    Symbol& symbol(TokenId name) { return symbols_[static_cast<size_t>(tree_.tokens[name].value)]; }
    std::optional<VariableId> alias(std::string_view name) const;
    VariableId declare_implicitly(TokenId name);

    // parse.cpp: items
    void items();
    void onevent_header();
    void ontimer_header();
    void sub_header();
    void refuse_block();
    void refuse_parentheses(TokenId name);
    void begin_handler(TokenId keyword, TokenId name);
    void begin_section(Section section);
    bool at_ontimer_header() const;
    std::optional<size_t> periodic_event(TokenId keyword);
    void resolve_subs();
    void add_item(NodeId statement);

    // parse.cpp: tokens, errors, recovery
    const Token& token() const { return tree_.tokens[position_]; }
    TokenKind kind() const { return token().kind; }
    TokenKind kind_ahead(size_t ahead) const;
    bool at(TokenKind wanted) const { return kind() == wanted; }
    void advance() {
        if (!at(TokenKind::EndOfText)) ++position_;
    }
    bool accept(TokenKind wanted);
    bool expect(TokenKind wanted, Diag what, std::initializer_list<std::string_view> words,
                Extra extra = {});
    Mark mark(TokenId token) const { return mark_of(tree_.source, tree_.tokens[token]); }
    std::string name_text(TokenId token) const { return shown(tree_.text(token)); }
    std::string found() const;
    std::string line_of(TokenId token) const {
        return diagnostics_.line_text(tree_.tokens[token].line);
    }
    bool touches_bad(TokenId token) const;
    void error(Diag what, TokenId token, std::initializer_list<std::string_view> words = {},
               Extra extra = {});
    void syntax_error(Diag what, std::initializer_list<std::string_view> words = {},
                      Extra extra = {});
    void error_elsewhere(Diag what, Mark place, std::initializer_list<std::string_view> words,
                         std::optional<Fix> fix = std::nullopt);
    bool begin_panic();
    // Mistakes met so far, also those that are not worth a second report.
    size_t errors() const { return diagnostics_.errors_found() + silent_errors_; }
    bool is_first_of_line(TokenId token) const;
    bool assigns_next(TokenId token) const;
    int open_brackets() const;
    NodeId recover();
    NodeId orphan_block();
    void skip_branch_head();
    NodeId finish_simple(NodeId statement, size_t errors_before);
    void give_up();

    // parse_declarations.cpp
    void const_definition();
    bool declared_name(std::string_view keyword);
    void define_constant(TokenId name, std::optional<int32_t> value);
    std::optional<int32_t> constant_for(TokenId name, NodeId value);
    NodeId var_definition();
    struct DeclaredSize {
        bool is_given = false;  // there are brackets
        bool is_open = false;   // with nothing between them
        int32_t words = 1;      // 0: a mistake in it
    };
    DeclaredSize array_size(TokenId name);
    int32_t checked_size(TokenId name, TokenId bracket, NodeId expression);
    bool name_is_free(TokenId name);
    NodeId initialiser(bool* is_list);
    NodeId filled_with_zeros(NodeId list, int32_t size);
    VariableId declare(TokenId name, int32_t size);
    NodeId undeclared_words(size_t errors_before, TokenId start);

    // parse_statements.cpp
    NodeId statement();
    NodeId statement_by_keyword();
    NodeId assignment();
    NodeId unexpected_statement();
    NodeId misplaced_declaration();
    void statements(ChildList& list);
    NodeId block();
    NodeId if_statement();
    NodeId clause();
    void else_branches(NodeId node, ChildList& branches);
    NodeId when_or_while(NodeKind kind);
    NodeId for_statement();
    NodeId loop_variable();
    struct Bound {
        TokenId token = 0;
        std::optional<int32_t> value = std::nullopt;
    };
    Bound loop_bound(std::string_view what);
    std::optional<int32_t> named_bound();
    bool check_bounds(const Bound& first, const Bound& last, const Bound& step);
    NodeId loop_body(TokenId opener);
    void expect_opener(TokenKind opener, Diag what, TokenId keyword);
    void expect_end(TokenId opener, std::optional<TokenId> two_words);
    std::optional<Fix> instead_of_word(std::string text) const;

    // parse_calls.cpp
    NodeId emit_statement();
    NodeId emit_argument(TokenId keyword, TokenId name, NodeId node);
    void declare_as_emitted(size_t error, NodeId argument);
    void check_event_size(TokenId keyword, TokenId name, NodeId argument);
    bool unsized_takes_argument(TokenId name) const;
    NodeId call_statement();
    void unknown_native(TokenId keyword, TokenId name);
    void arguments_unchecked(ChildList& list);
    void arguments(TokenId keyword, const NativeFunction& native, ChildList& list);
    struct ArgumentSizes;
    void check_argument(TokenId keyword, const NativeFunction& native, size_t position, NodeId node,
                        ArgumentSizes& sizes);
    void check_argument_size(const NativeFunction& native, size_t position, NodeId node,
                             ArgumentSizes& sizes);
    bool reserve(int32_t words, int32_t already, TokenId at);
    NodeId callsub_statement();

    // parse_expressions.cpp
    NodeId condition();
    NodeId expression();
    NodeId binary(int level);
    NodeId negation();
    NodeId unary();
    NodeId primary();
    NodeId literal(bool is_negative);
    NodeId name_in_expression();
    NodeId reference(TokenId name, VariableId variable);
    NodeId index(TokenId name, VariableId variable);
    NodeId slice(NodeId element, NodeId first);
    NodeId tuple();
    NodeId elements(TokenId first);
    NodeId parenthesised();
    NodeId element();
    NodeId missing_operand();
    NodeId unknown_variable(TokenId name, NameSpace space);
    bool can_begin_operand() const;

    // parse_hints.cpp
    Mark marks(TokenId first, TokenId last) const;
    Fix write_before(TokenId token, std::string text) const;
    Fix write_behind_last(TokenId token, std::string text) const;
    Fix declare_first(std::string declaration) const;
    bool touches_next(TokenId token) const;
    bool belongs_to(const Symbol& symbol, NameSpace space) const;
    std::string guess(TokenId name, NameSpace space) const;
    void unknown_event(TokenId name, NameSpace space);
    bool is_sub_somewhere(TokenId name) const;
    std::string call_of(const NativeFunction& native) const;
    const NativeFunction* native_meant(TokenId name) const;
    std::string misspelt_keyword(TokenId name) const;
    std::string repeating_event() const;
    std::string advice_of(std::string_view text) const;
    std::vector<std::string> parts_of(std::string_view name) const;
    bool hint_native(TokenId name);
    bool hint_sub(TokenId name);
    bool hint_word(TokenId name);
    bool hint_call(TokenId name);
    bool hint_truth(TokenId name);
    bool hint_parts(TokenId name);
    void report_unknown_variable(TokenId name, NameSpace space);
    void report_no_statement(std::optional<int32_t> sent_nothing);
    bool hint_sign_first();
    bool hint_rest_of_line(TokenKind before);
    void hint_brackets(TokenId name);
    void missing_assignment(TokenId start);
    void report_no_opener(TokenKind opener, Diag what, TokenId keyword);
    bool hint_slip();
    bool hint_end_of_kind();
    void report_no_operand();
    void report_no_name(std::string_view keyword);
    std::optional<Fix> moved_var() const;

    // Nodes
    NodeId add(Node node);
    NodeId error_node(TokenId token) { return add({.kind = NodeKind::Error, .token = token}); }
    NodeId operation(Node node, NodeId left, NodeId right);
    void append(ChildList& list, NodeId node);

    Tree& tree_;
    const Target& target_;
    const CommonDefinitions& common_;
    const Options& options_;
    Diagnostics& diagnostics_;
    bool is_2007_ = false;

    std::vector<Symbol> symbols_;  // by NameId
    std::vector<ConstantSymbol> constants_;

    TokenId position_ = 0;
    TokenId statement_start_ = 0;
    std::optional<TokenId> first_item_;  // behind the declarations; none while they are read
    bool panic_ = false;
    size_t silent_errors_ = 0;
    std::optional<TokenId> last_syntax_error_;
    int nesting_ = 0;
    int open_ifs_ = 0;      // blocks around that could take an `else`
    int missing_ends_ = 0;  // blocks that the header at hand closes
    int late_ends_ = 0;     // their `end` may still come, in the code behind that header
    bool code_began_ = false;

    ChildList current_;  // statements of the section that is being read
    // The token of an `emit` without argument that has just been read.
    std::optional<int32_t> sent_nothing_;
};

}  // namespace vagus::aesl
