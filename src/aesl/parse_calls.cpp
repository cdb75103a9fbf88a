// Events, native functions and subs: emit, call, callsub, with the checks of their arguments
// (docs/spec/aesl-language.md, sections 2.2, 3.2 and 3.8).
#include "aesl/expand.hpp"
#include "aesl/fix.hpp"
#include "aesl/limits.hpp"
#include "aesl/parser.hpp"
#include "aesl/places.hpp"
#include "aesl/sizes.hpp"

namespace vagus::aesl {

NodeId Parser::emit_statement() {
    const TokenId keyword = position_;
    const size_t before = errors();
    advance();
    const TokenId name = position_;
    const bool has_name =
        expect(TokenKind::Identifier, Diag::ExpectedEventName, {found(), tree_.text(keyword)});
    if (!has_name) return finish_simple(kNoNode, before);
    Symbol& event = symbol(name);
    const size_t reported = diagnostics_.errors_found();
    if (event.global_event < 0 && event.local_event >= 0) {
        error(Diag::EmitLocalEvent, name, {name_text(name)});
    } else if (event.global_event < 0 && !event.is_event_unknown) {
        unknown_event(name, NameSpace::GlobalEvent);
    }
    const NodeId node =
        add({.kind = NodeKind::Emit, .token = keyword, .value = event.global_event});
    const NodeId argument = emit_argument(keyword, name, node);
    tree_[node].first = argument;
    if (event.global_event < 0 && argument != kNoNode) declare_as_emitted(reported, argument);
    tree_[node].bad = errors() > before || event.global_event < 0;
    return finish_simple(node, before);
}

// The event that nobody declares is to have as many words as it is emitted with.
void Parser::declare_as_emitted(size_t error, NodeId argument) {
    const int32_t words = tree_[argument].size;
    if (words < 1 || words > kEventArgumentsMax) return;
    diagnostics_.set_declared(error, static_cast<uint16_t>(words));
}

// Whether there is an argument depends on the size that the event declares (section 2.2).
NodeId Parser::emit_argument(TokenId keyword, TokenId name, NodeId node) {
    const int32_t event = tree_[node].value;
    if (event < 0) return unsized_takes_argument(name) ? expression() : kNoNode;
    const GlobalEvent& declared = common_.events[static_cast<size_t>(event)];
    const bool is_unsized = !declared.size && is_2007_;
    const int32_t words = declared.size.value_or(0);
    if (is_unsized ? !unsized_takes_argument(name) : words == 0) {
        sent_nothing_ = static_cast<int32_t>(name);
        return kNoNode;
    }
    if (!can_begin_operand() && !at(TokenKind::SignAdd) && !at(TokenKind::Not)) {
        syntax_error(Diag::MissingEventArgument, {found(), name_text(name), words_of(words)});
        return kNoNode;
    }
    const NodeId argument = expression();
    if (!panic_) check_event_size(keyword, name, argument);
    return argument;
}

// Sizes inside the argument, then room for its temporary, then its size (section 3.2).
void Parser::check_event_size(TokenId keyword, TokenId name, NodeId argument) {
    if (!check_sizes_of(tree_, argument, diagnostics_)) return;
    const int32_t words = tree_[argument].size;
    if (words == 0) return;
    const NodeKind kind = tree_[argument].kind;
    const bool is_place = kind == NodeKind::Element || kind == NodeKind::Slice;
    if (is_place && !check_first_place(tree_, argument, diagnostics_)) return;
    Folder folder;
    const bool needs_temporary = !Expander(tree_, folder).place(argument);
    if (needs_temporary && !reserve(words, 0, keyword)) return;
    const GlobalEvent& event = common_.events[static_cast<size_t>(symbol(name).global_event)];
    const bool may_be_short = tree_.tokens[keyword].kind == TokenKind::EmitShort || !event.size;
    const int32_t declared = event.size.value_or(kEventArgumentsMax);
    if (words > declared && may_be_short) {
        error(Diag::EventArgumentTooBig, keyword,
              {name_text(name), words_of(declared), words_of(words)});
    } else if (words != declared && !may_be_short) {
        error(Diag::EventArgumentSize, keyword,
              {name_text(name), words_of(declared), words_of(words)});
    }
}

// 2007, and events nobody knows: an operand on the line of the name is the argument (section 6,
// rule 5).
bool Parser::unsized_takes_argument(TokenId name) const {
    return can_begin_operand() && token().line == tree_.tokens[name].line;
}

// Whether `words` of temporaries fit behind those that the statement has already.
bool Parser::reserve(int32_t words, int32_t already, TokenId at) {
    const int32_t free_words = tree_.memory_words - tree_.variable_words;
    if (already + words <= free_words) return true;
    error(Diag::NoTemporarySpace, at, {words_of(already + words), words_of(free_words)});
    return false;
}

struct Parser::ArgumentSizes {
    // Words, position of the argument; by template number.
    std::vector<std::pair<int32_t, size_t>> templates;
    int32_t temporaries = 0;
    bool is_bad = false;
};

NodeId Parser::call_statement() {
    const TokenId keyword = position_;
    const size_t before = errors();
    advance();
    const TokenId name = position_;
    if (!expect(TokenKind::Identifier, Diag::ExpectedNativeName, {found()})) {
        return finish_simple(kNoNode, before);
    }
    const int32_t native = symbol(name).native;
    if (native < 0 && !symbol(name).is_native_unknown) unknown_native(keyword, name);
    const NodeId node = add({.kind = NodeKind::Call, .token = keyword, .value = native});
    ChildList list;
    if (expect(TokenKind::SignParenOpen, Diag::ExpectedArguments, {found(), name_text(name)})) {
        if (native < 0) {
            arguments_unchecked(list);
        } else {
            arguments(keyword, target_.natives[static_cast<size_t>(native)], list);
        }
    }
    tree_[node].first = list.first;
    tree_[node].bad = native < 0 || errors() > before;
    return finish_simple(node, before);
}

void Parser::unknown_native(TokenId keyword, TokenId name) {
    const std::string text = name_text(name);
    symbol(name).is_native_unknown = true;
    if (is_sub_somewhere(name)) {
        Fix fix = replacing(mark(keyword), "callsub");
        const bool is_call = at(TokenKind::SignParenOpen);
        if (is_call && kind_ahead(1) == TokenKind::SignParenClose)
            fix.edits.push_back({marks(position_, position_ + 1), ""});
        error(Diag::SubNotNative, keyword, {text}, {.fix = fix});
        if (!is_call) panic_ = true;  // its missing parentheses are no second mistake
    } else if (const NativeFunction* const meant = native_meant(name)) {
        error(Diag::UnknownNativeGuess, keyword, {text, shown(meant->name)},
              {.fix = replacing(mark(name), meant->name)});
    } else {
        error(Diag::UnknownNative, keyword, {text, shown(target_.name)});
    }
}

// Behind the `(`, where nothing is known about the parameters, or too much has been found wrong
// already.
void Parser::arguments_unchecked(ChildList& list) {
    if (accept(TokenKind::SignParenClose)) return;
    do {
        append(list, expression());
    } while (!panic_ && accept(TokenKind::SignComma));
    expect(TokenKind::SignParenClose, Diag::ExpectedCallEnd, {found(), "the function"});
}

void Parser::arguments(TokenId keyword, const NativeFunction& native, ChildList& list) {
    const size_t count = native.parameters.size();
    const std::string takes = std::to_string(count) + (count == 1 ? " argument" : " arguments");
    if (count == 0 && !at(TokenKind::SignParenClose)) {
        error(Diag::NativeTakesNothing, position_, {shown(native.name)});
        return arguments_unchecked(list);
    }
    ArgumentSizes sizes;
    for (size_t i = 0; i < count && !panic_; ++i) {
        if (at(TokenKind::SignParenClose)) {
            error(Diag::TooFewArguments, position_,
                  {shown(native.name), takes, std::to_string(i), shown(native.parameters[i].name)});
            break;
        }
        const NodeId argument = expression();
        append(list, argument);
        if (panic_) return;
        check_argument(keyword, native, i, argument, sizes);
        if (i + 1 == count || at(TokenKind::SignParenClose)) continue;
        expect(TokenKind::SignComma, Diag::ExpectedNextArgument,
               {found(), shown(native.parameters[i + 1].name), shown(native.name)});
    }
    if (!panic_ && at(TokenKind::SignComma)) {
        error(Diag::TooManyArguments, position_, {shown(native.name), takes});
        advance();
        return arguments_unchecked(list);
    }
    expect(TokenKind::SignParenClose, Diag::ExpectedCallEnd, {found(), shown(native.name)},
           {.fix = write_behind_last(position_, ")")});
}

// The element with which the argument begins and the sizes inside it, then room for its temporary,
// then its size (section 3.2).
void Parser::check_argument(TokenId keyword, const NativeFunction& native, size_t position,
                            NodeId node, ArgumentSizes& sizes) {
    const bool is_sound =
        check_first_place(tree_, node, diagnostics_) && check_sizes_of(tree_, node, diagnostics_);
    const int32_t words = tree_[node].size;
    if (!is_sound || words == 0 || sizes.is_bad) {
        sizes.is_bad = true;
        return;
    }
    Folder folder;
    if (!Expander(tree_, folder).place(node)) {
        const bool is_computed = tree_[node].kind == NodeKind::Element;
        if (!reserve(words, sizes.temporaries, is_computed ? tree_[node].token : keyword)) {
            sizes.is_bad = true;
            return;
        }
        sizes.temporaries += words;
    }
    check_argument_size(native, position, node, sizes);
}

void Parser::check_argument_size(const NativeFunction& native, size_t position, NodeId node,
                                 ArgumentSizes& sizes) {
    const NativeParameter& parameter = native.parameters[position];
    const int32_t words = tree_[node].size;
    if (parameter.size == 0) return;
    // A binary operation begins with its left operand, not with its operator.
    NodeId leftmost = node;
    while (tree_[leftmost].kind == NodeKind::Binary) leftmost = tree_[leftmost].first;
    const TokenId at = tree_[leftmost].token;
    if (parameter.size > 0) {
        if (words == parameter.size) return;
        error(
            Diag::NativeArgumentSize, at,
            {shown(parameter.name), shown(native.name), words_of(parameter.size), words_of(words)});
        return;
    }
    const auto number = static_cast<size_t>(-(parameter.size + 1));
    if (sizes.templates.size() <= number) sizes.templates.resize(number + 1);
    auto& [common_words, first] = sizes.templates[number];
    if (common_words == 0) {
        common_words = words;
        first = position;
    } else if (common_words != words) {
        error(Diag::NativeTemplateSize, at,
              {shown(parameter.name), shown(native.name), words_of(common_words), words_of(words),
               shown(native.parameters[first].name)});
    }
}

NodeId Parser::callsub_statement() {
    const TokenId keyword = position_;
    const size_t before = errors();
    advance();
    const bool has_name =
        expect(TokenKind::Identifier, Diag::ExpectedSubName, {found(), "callsub"});
    if (!has_name) return finish_simple(kNoNode, before);
    const NodeId node = add({.kind = NodeKind::CallSub, .token = keyword, .value = kUnresolved});
    refuse_parentheses(position_ - 1);
    return finish_simple(node, before);
}

}  // namespace vagus::aesl
