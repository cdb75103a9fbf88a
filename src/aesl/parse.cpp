#include "aesl/parse.hpp"

#include <algorithm>
#include <utility>

#include "aesl/dialect.hpp"
#include "aesl/fix.hpp"
#include "aesl/limits.hpp"
#include "aesl/parser.hpp"

namespace vagus::aesl {

namespace {

int bracket_step(TokenKind kind) {
    if (kind == TokenKind::SignParenOpen || kind == TokenKind::SignBracketOpen) return 1;
    if (kind == TokenKind::SignParenClose || kind == TokenKind::SignBracketClose) return -1;
    return 0;
}

}  // namespace

bool is_boundary(TokenKind kind) {
    switch (kind) {
        case TokenKind::Call:
        case TokenKind::CallSub:
        case TokenKind::Const:
        case TokenKind::Else:
        case TokenKind::ElseIf:
        case TokenKind::Emit:
        case TokenKind::EmitShort:
        case TokenKind::End:
        case TokenKind::For:
        case TokenKind::If:
        case TokenKind::OnEvent:
        case TokenKind::Return:
        case TokenKind::Sub:
        case TokenKind::Var:
        case TokenKind::When:
        case TokenKind::While:
        case TokenKind::EndOfText:
            return true;
        default:
            return false;
    }
}

Tree parse(std::string_view source, const Target& target, const CommonDefinitions& common,
           const Options& options, Diagnostics& diagnostics) {
    Tree tree;
    tree.source = source;
    tree.tokens = scan(source, tree.names, diagnostics);
    tree.nodes.reserve(tree.tokens.size());
    Parser(tree, target, common, options, diagnostics).program();
    return tree;
}

Parser::Parser(Tree& tree, const Target& target, const CommonDefinitions& common,
               const Options& options, Diagnostics& diagnostics)
    : tree_(tree), target_(target), common_(common), options_(options), diagnostics_(diagnostics) {}

void Parser::program() {
    define_node_names();
    define_common_names();
    is_2007_ = is_year_2007(tree_, target_, common_, options_.dialect);
    begin_section({});
    while (at(TokenKind::Const)) const_definition();
    while (at(TokenKind::Const) || at(TokenKind::Var)) {
        add_item(at(TokenKind::Var) ? var_definition() : misplaced_declaration());
    }
    first_item_ = position_;
    items();
    begin_section({});  // closes the last one
    tree_.sections.pop_back();
    resolve_subs();
}

// ---- Names

void Parser::define_node_names() {
    for (const NamedVariable& variable : target_.variables) tree_.names.intern(variable.name);
    for (const LocalEvent& event : target_.local_events) tree_.names.intern(event.name);
    for (const NativeFunction& native : target_.natives) tree_.names.intern(native.name);
    for (const GlobalEvent& event : common_.events) tree_.names.intern(event.name);
    for (const Constant& constant : common_.constants) tree_.names.intern(constant.name);
    symbols_.resize(tree_.names.size());
    const auto of = [this](const std::string& name) -> Symbol& {
        return symbols_[tree_.names.intern(name)];
    };
    for (const NamedVariable& variable : target_.variables) {
        Symbol& known = of(variable.name);
        if (known.variable < 0) known.variable = static_cast<int32_t>(tree_.variables.size());
        tree_.variables.push_back(
            {.name = variable.name, .address = tree_.variable_words, .size = variable.size});
        tree_.variable_words += variable.size;
    }
    tree_.node_variables = static_cast<uint32_t>(tree_.variables.size());
    tree_.memory_words = std::min<int32_t>(target_.variables_size, kAddressableWords);
    for (size_t i = target_.local_events.size(); i-- > 0;) {
        of(target_.local_events[i].name).local_event = static_cast<int32_t>(i);
    }
    for (size_t i = target_.natives.size(); i-- > 0;) {
        of(target_.natives[i].name).native = static_cast<int32_t>(i);
    }
}

void Parser::define_common_names() {
    for (size_t i = common_.events.size(); i-- > 0;) {
        symbols_[tree_.names.intern(common_.events[i].name)].global_event = static_cast<int32_t>(i);
    }
    for (const Constant& constant : common_.constants) {
        Symbol& known = symbols_[tree_.names.intern(constant.name)];
        if (known.constant >= 0) continue;
        known.constant = static_cast<int32_t>(constants_.size());
        constants_.push_back({.value = constant.value});
    }
}

// 2007: `args` and `source` where there is no such variable (section 6, rule 3).
std::optional<VariableId> Parser::alias(std::string_view name) const {
    const bool is_args = name == "args";
    if (!is_2007_ || (!is_args && name != "source")) return std::nullopt;
    const std::string_view modern = is_args ? "event.args" : "event.source";
    for (VariableId id = 0; id < tree_.node_variables; ++id) {
        if (tree_.variables[id].name == modern) return id;
    }
    const VariableId by_place = is_args ? 2 : 1;
    if (by_place < tree_.node_variables) return by_place;
    return std::nullopt;
}

// Makes a name known that an error has named, so that it is reported once. Size 0 keeps all checks
// quiet about it.
VariableId Parser::declare_implicitly(TokenId name) {
    const auto id = static_cast<VariableId>(tree_.variables.size());
    tree_.variables.push_back(
        {.name = tree_.text(name), .token = name, .size = 0, .is_used = true});
    Symbol& known = symbol(name);
    if (known.variable < 0) {
        known.variable = static_cast<int32_t>(id);
        known.is_implicit = true;
    }
    return id;
}

// ---- Items

void Parser::add_item(NodeId statement) {
    if (statement == kNoNode) return;
    append(current_, statement);
}

void Parser::items() {
    while (!at(TokenKind::EndOfText)) {
        const TokenId start = position_;
        const size_t before = errors();
        if (at(TokenKind::OnEvent)) {
            onevent_header();
        } else if (at(TokenKind::Sub)) {
            sub_header();
        } else if (at_ontimer_header()) {
            ontimer_header();
        } else if (at(TokenKind::Var) && !code_began_) {
            add_item(var_definition());
        } else if (at(TokenKind::Var) || at(TokenKind::Const)) {
            add_item(misplaced_declaration());
        } else if (at(TokenKind::End) && late_ends_ > 0) {
            --late_ends_;
            advance();
        } else {
            const NodeId made = statement();
            add_item(made);
            code_began_ = code_began_ || (made != kNoNode && errors() == before);
        }
        if (position_ == start) advance();
    }
}

void Parser::begin_section(Section section) {
    if (!tree_.sections.empty()) {
        const NodeId block = tree_.sections.back().block;
        tree_[block].first = current_.first;
    }
    current_ = {};
    const TokenId before = position_ == 0 ? 0 : position_ - 1;
    section.block = add({.kind = NodeKind::Block, .token = before});
    tree_.sections.push_back(section);
    late_ends_ = missing_ends_;
    missing_ends_ = 0;
}

void Parser::onevent_header() {
    code_began_ = true;
    statement_start_ = position_;
    const TokenId keyword = position_;
    advance();
    const TokenId name = position_;
    if (!expect(TokenKind::Identifier, Diag::ExpectedEventName, {found(), "onevent"})) {
        begin_section({.kind = SectionKind::Event, .token = keyword, .is_ignored = true});
        recover();
        return;
    }
    if (is_2007_) accept(TokenKind::SignColon);
    begin_handler(keyword, name);
}

void Parser::begin_handler(TokenId keyword, TokenId name) {
    Symbol& event = symbol(name);
    const bool is_known = event.local_event >= 0 || event.global_event >= 0;
    const bool is_second = event.handler >= 0;
    if (is_second) {
        error(Diag::HandlerTwice, name,
              {name_text(name), line_of(static_cast<TokenId>(event.handler))});
    } else if (!is_known && !event.is_event_unknown) {
        unknown_event(name, NameSpace::AnyEvent);
    }
    if (is_known && !is_second) event.handler = static_cast<int32_t>(keyword);
    // A local event hides a global one of its name (section 3.3).
    const int32_t number =
        event.local_event >= 0 ? isa::kLocalEventFirst - event.local_event : event.global_event;
    begin_section({.kind = SectionKind::Event,
                   .name = tree_.text(name),
                   .token = keyword,
                   .number = number,
                   .is_ignored = !is_known || is_second});
    refuse_block();
}

// `onevent tick do … end` is one mistake: the `end` belongs to it.
void Parser::refuse_block() {
    if (!at(TokenKind::Do) && !at(TokenKind::Then)) return;
    error(Diag::HeaderOpensBlock, position_, {found()},
          {.fix = deleting(mark(position_), tree_.text(position_))});
    advance();
    ++late_ends_;
}

// `sub turn()` and `callsub turn()`, also with words between the parentheses.
void Parser::refuse_parentheses(TokenId name) {
    if (!at(TokenKind::SignParenOpen)) return;
    TokenId close = position_;
    const auto goes_on = [this, &close] {
        const Token& it = tree_.tokens[close];
        return it.kind != TokenKind::SignParenClose && it.kind != TokenKind::EndOfText &&
               tree_.tokens[close + 1].line == it.line;
    };
    while (goes_on()) ++close;
    error(Diag::SubWithParentheses, position_, {name_text(name)},
          {.fix = deleting(marks(position_, close), "()")});
    while (position_ <= close && !at(TokenKind::EndOfText)) advance();
}

// 2007: `ontimer` (section 6, rule 1): a header if it is no variable or constant or a colon
// follows; without a colon only if it does not begin an assignment.
bool Parser::at_ontimer_header() const {
    if (!is_2007_ || !at(TokenKind::Identifier) || token().length != kOntimer.size()) return false;
    if (tree_.text(position_) != kOntimer) return false;
    if (kind_ahead(1) == TokenKind::SignColon) return true;
    const Symbol& known = symbols_[static_cast<size_t>(token().value)];
    const bool is_name = (known.variable >= 0 && !known.is_implicit) || known.constant >= 0;
    return !is_name && !assigns_next(position_);
}

void Parser::ontimer_header() {
    code_began_ = true;
    statement_start_ = position_;
    const TokenId keyword = position_;
    advance();
    accept(TokenKind::SignColon);
    const auto event = periodic_event(keyword);
    Section section{.kind = SectionKind::Event, .token = keyword, .is_ignored = true};
    if (event) {
        const std::string& name = target_.local_events[*event].name;
        Symbol& known = symbols_[tree_.names.intern(name)];
        section.name = name;
        section.number = isa::kLocalEventFirst - static_cast<int32_t>(*event);
        section.is_ignored = known.handler >= 0;
        if (section.is_ignored) {
            error(Diag::HandlerTwice, keyword,
                  {shown(name), line_of(static_cast<TokenId>(known.handler))});
        } else {
            known.handler = static_cast<int32_t>(keyword);
        }
    }
    begin_section(section);
}

// Number of the local event that `ontimer` means.
std::optional<size_t> Parser::periodic_event(TokenId keyword) {
    const auto local = [this](std::string_view name) -> std::optional<size_t> {
        for (size_t i = 0; i < target_.local_events.size(); ++i) {
            if (target_.local_events[i].name == name) return i;
        }
        return std::nullopt;
    };
    if (!options_.ontimer.empty()) {
        const auto event = local(options_.ontimer);
        if (!event) {
            error(Diag::UnknownPeriodicEvent, keyword,
                  {shown(options_.ontimer), shown(target_.name)});
        }
        return event;
    }
    for (const std::string_view name : {"ontimer", "timer", "timer0"}) {
        if (const auto event = local(name)) return event;
    }
    if (target_.local_events.size() == 1) return 0;
    error(Diag::NoPeriodicEvent, keyword, {shown(target_.name)});
    return std::nullopt;
}

void Parser::sub_header() {
    code_began_ = true;
    statement_start_ = position_;
    const TokenId keyword = position_;
    advance();
    const TokenId name = position_;
    if (!expect(TokenKind::Identifier, Diag::ExpectedSubName, {found(), "sub"})) {
        begin_section({.kind = SectionKind::Sub, .token = keyword, .is_ignored = true});
        recover();
        return;
    }
    if (is_2007_) accept(TokenKind::SignColon);
    Symbol& known = symbol(name);
    Section section{.kind = SectionKind::Sub,
                    .name = tree_.text(name),
                    .token = keyword,
                    .number = static_cast<int32_t>(tree_.subs.size())};
    if (known.sub >= 0) {
        const TokenId old = tree_.subs[static_cast<size_t>(known.sub)].token;
        error(Diag::SubTwice, name, {name_text(name), line_of(old)});
        section.is_ignored = true;
    } else {
        known.sub = section.number;
        tree_.subs.push_back({.name = section.name,
                              .token = keyword,
                              .section = static_cast<uint32_t>(tree_.sections.size())});
    }
    begin_section(section);
    refuse_parentheses(name);
    refuse_block();
}

// A sub may be called before it is declared; what stays unresolved is reported in phase 6.
void Parser::resolve_subs() {
    for (Node& node : tree_.nodes) {
        if (node.kind != NodeKind::CallSub) continue;
        const Symbol& known = symbol(node.token + 1);
        node.value = known.sub;
        if (known.sub >= 0) tree_.subs[static_cast<size_t>(known.sub)].is_called = true;
    }
}

// ---- Tokens, errors, recovery

TokenKind Parser::kind_ahead(size_t ahead) const {
    const size_t wanted = position_ + ahead;
    return wanted < tree_.tokens.size() ? tree_.tokens[wanted].kind : TokenKind::EndOfText;
}

bool Parser::accept(TokenKind wanted) {
    if (!at(wanted)) return false;
    advance();
    return true;
}

// Moves over the wanted token; otherwise reports, and the rest of the statement is skipped.
bool Parser::expect(TokenKind wanted, Diag what, std::initializer_list<std::string_view> words,
                    Extra extra) {
    if (panic_) return false;
    if (accept(wanted)) return true;
    syntax_error(what, words, std::move(extra));
    return false;
}

std::string Parser::found() const {
    if (at(TokenKind::EndOfText)) return "the end of the text";
    return "\"" + shown(tree_.text(position_)) + "\"";
}

// Whether a character that the scanner has refused is part of what was meant as this word: `a²`.
bool Parser::touches_bad(TokenId token) const {
    const Token& it = tree_.tokens[token];
    const bool before =
        token > 0 && tree_.tokens[token - 1].kind == TokenKind::Bad &&
        tree_.tokens[token - 1].offset + tree_.tokens[token - 1].length == it.offset;
    const bool behind = token + 1 < tree_.tokens.size() &&
                        tree_.tokens[token + 1].kind == TokenKind::Bad &&
                        it.offset + it.length == tree_.tokens[token + 1].offset;
    return before || behind;
}

void Parser::error(Diag what, TokenId token, std::initializer_list<std::string_view> words,
                   Extra extra) {
    if (touches_bad(token)) {
        ++silent_errors_;
        return;
    }
    diagnostics_.report(what, mark(token), words, std::move(extra));
    if (diagnostics_.full()) give_up();
}

// At the current token.
void Parser::syntax_error(Diag what, std::initializer_list<std::string_view> words, Extra extra) {
    if (begin_panic()) error(what, position_, words, std::move(extra));
}

// At the current token, while a person is better shown another place.
void Parser::error_elsewhere(Diag what, Mark place, std::initializer_list<std::string_view> words,
                             std::optional<Fix> fix) {
    if (!begin_panic()) return;
    diagnostics_.report(what, place, words, {.fix = std::move(fix), .formal = mark(position_).at});
    if (diagnostics_.full()) give_up();
}

// Whether an error of syntax at the current token is worth a report. Only the first one of a
// statement, and only one for each token, is. Beside a character that the scanner has refused
// nothing is: the mistake is known.
bool Parser::begin_panic() {
    if (panic_) return false;
    panic_ = true;
    const bool is_beside_bad =
        at(TokenKind::Bad) || (position_ > 0 && tree_.tokens[position_ - 1].kind == TokenKind::Bad);
    const bool is_known = last_syntax_error_ == position_ || tree_.is_partial;
    last_syntax_error_ = position_;
    ++silent_errors_;
    return !is_beside_bad && !is_known;
}

bool Parser::is_first_of_line(TokenId token) const {
    return token == 0 || tree_.tokens[token].line > tree_.tokens[token - 1].line;
}

// Whether what follows a name makes it the left side of an assignment.
bool Parser::assigns_next(TokenId token) const {
    if (token + 1 >= tree_.tokens.size()) return false;
    const TokenKind next = tree_.tokens[token + 1].kind;
    return next == TokenKind::SignBracketOpen ||
           (next >= TokenKind::SignAssign && next <= TokenKind::SignDecrement);
}

// Brackets of the statement that are open before the current token.
int Parser::open_brackets() const {
    int depth = 0;
    for (TokenId i = statement_start_; i < position_; ++i) {
        depth += bracket_step(tree_.tokens[i].kind);
    }
    return depth;
}

// Skips to where the next statement can begin: at a keyword that begins one, or at a name that is
// the first of its line (and begins an assignment, if brackets are still open). A `then` or `do` on
// the way means that the statement was to open a block, so that block is read, with its `end`; it
// is what comes back.
NodeId Parser::recover() {
    panic_ = false;
    const TokenId start = statement_start_;
    int depth = open_brackets();
    // The token that is no statement itself must be passed, or nothing ever changes.
    if (position_ == start && (!is_boundary(kind()) || at(TokenKind::End) || at(TokenKind::Else) ||
                               at(TokenKind::ElseIf))) {
        depth += bracket_step(kind());
        advance();
    }
    while (!is_boundary(kind())) {
        if (at(TokenKind::Then) || at(TokenKind::Do)) return orphan_block();
        const bool is_new_line = is_first_of_line(position_) && position_ > start;
        const bool is_bad = at(TokenKind::Bad);
        if (is_new_line && (at(TokenKind::Identifier) || is_bad) &&
            (depth <= 0 || assigns_next(position_))) {
            break;
        }
        depth += bracket_step(kind());
        advance();
    }
    return kNoNode;
}

// The block of a statement whose head could not be read.
NodeId Parser::orphan_block() {
    advance();
    if (++nesting_ > kNestingMax) give_up();
    ChildList list;
    statements(list);
    while (at(TokenKind::Else) || at(TokenKind::ElseIf)) {
        if (open_ifs_ > 0) break;
        skip_branch_head();
        statements(list);
    }
    accept(TokenKind::End);
    --nesting_;
    return add({.kind = NodeKind::Block, .token = position_ - 1, .first = list.first});
}

// Over an `else`, or an `elseif` with its condition, that has no `if`.
void Parser::skip_branch_head() {
    advance();
    while (!is_boundary(kind()) && !at(TokenKind::Then) && !is_first_of_line(position_)) advance();
    accept(TokenKind::Then);
}

// The end of a statement without a block. After a mistake in it the rest of its line is skipped: it
// belongs to the mistake.
NodeId Parser::finish_simple(NodeId statement, size_t errors_before) {
    if (panic_) {
        const NodeId orphan = recover();
        return orphan == kNoNode ? statement : orphan;
    }
    const bool has_rest =
        errors() > errors_before && !is_first_of_line(position_) && !is_boundary(kind());
    if (!has_rest) return statement;
    const NodeId orphan = recover();
    return orphan == kNoNode ? statement : orphan;
}

// Nothing sensible can be read any more: too many errors, or nested too deep. The rest of the text
// is not looked at.
void Parser::give_up() {
    if (!tree_.is_partial && !diagnostics_.full()) {
        diagnostics_.report(Diag::NestedTooDeep, mark(position_), {std::to_string(kNestingMax)});
    }
    tree_.is_partial = true;
    panic_ = true;
    position_ = static_cast<TokenId>(tree_.tokens.size() - 1);
}

// ---- Nodes

NodeId Parser::add(Node node) {
    tree_.nodes.push_back(node);
    return static_cast<NodeId>(tree_.nodes.size() - 1);
}

void Parser::append(ChildList& list, NodeId node) {
    if (node == kNoNode) return;
    if (list.first == kNoNode) {
        list.first = node;
    } else {
        tree_[list.last].next = node;
    }
    list.last = node;
}

}  // namespace vagus::aesl
