#include "aesl/emit.hpp"

#include <algorithm>

#include "aesl/code_writer.hpp"
#include "aesl/expand.hpp"
#include "aesl/limits.hpp"
#include "aesl/places.hpp"
#include "aesl/scan.hpp"

namespace vagus::aesl {
namespace {

using isa::BinaryOperator;
using isa::Opcode;

uint8_t code_of(BinaryOperator op) {
    return static_cast<uint8_t>(op);
}

class Emitter {
public:
    Emitter(const Tree& tree, const Target& target, Diagnostics& diagnostics, Code& code,
            CodeSection& section, Folder& folder, bool is_sub)
        : tree_(tree),
          target_(target),
          diagnostics_(diagnostics),
          code_(code),
          folder_(folder),
          expander_(tree, folder),
          out_(section),
          is_sub_(is_sub) {}

    void section(const Section& section) {
        const NodeId first = tree_[section.block].first;
        for (NodeId child = first; child != kNoNode; child = tree_[child].next) {
            const uint32_t before = out_.here();
            statement(child);
            if (out_.here() > before) last_statement_ = child;
        }
        if (out_.here() > 0 || is_sub_) finish(section);
        if (out_.longest_branch() > kBranchDistanceMax && out_.here() <= kProgramWordsMax) {
            diagnostics_.report(
                Diag::BlockTooLong, {},
                {diagnostics_.line_text(out_.longest_branch_line()),
                 std::to_string(out_.longest_branch()), std::to_string(kBranchDistanceMax)});
        }
    }

private:
    // The Stop or SubRet at the end, on the line that section 4.11 gives it.
    void finish(const Section& section) {
        if (is_sub_ && out_.here() > 0 && last_statement_ != kNoNode &&
            tree_[last_statement_].kind == NodeKind::Return) {
            return;  // the end cannot be reached
        }
        int32_t line = out_.last_line();
        if (out_.here() == 0) line = tree_.tokens[section.token].line;
        if (last_statement_ != kNoNode) {
            const Node& last = tree_[last_statement_];
            const bool has_end = last.kind == NodeKind::If || last.kind == NodeKind::When;
            if (has_end) line = tree_.tokens[static_cast<size_t>(last.value)].line;
        }
        out_.instruction(is_sub_ ? Opcode::SubRet : Opcode::Stop, 0, line);
    }

    void block(NodeId id) {
        for (NodeId child = tree_[id].first; child != kNoNode; child = tree_[child].next) {
            statement(child);
        }
    }

    void statement(NodeId id) {
        if (is_over_limit()) return;
        const Node& node = tree_[id];
        folder_.clear();
        switch (node.kind) {
            case NodeKind::Block:
                block(id);
                break;
            case NodeKind::If:
                if_statement(node);
                break;
            case NodeKind::When:
                when_statement(node);
                break;
            case NodeKind::While:
                while_statement(node);
                break;
            case NodeKind::For:
                for_statement(node);
                break;
            case NodeKind::Return:
                out_.instruction(is_sub_ ? Opcode::SubRet : Opcode::Stop, 0, tree_.line_of(id));
                break;
            case NodeKind::CallSub:
                if (node.value != kUnresolved) out_.call(node.value, tree_.line_of(id));
                break;
            default:
                if (!node.bad) simple_statement(node);
        }
    }

    void simple_statement(const Node& node) {
        switch (node.kind) {
            case NodeKind::Assign:
            case NodeKind::Count:
                assignment(node);
                break;
            case NodeKind::Emit:
                emit_statement(node);
                break;
            case NodeKind::Call:
                call_statement(node);
                break;
            default:
                break;
        }
    }

    // ---- Assignments (section 4.4)

    void assignment(const Node& node) {
        const NodeId left = node.first;
        const int32_t words = tree_[left].size;
        const int32_t line = tree_.line_of(left);
        const auto place = expander_.place(left);
        if (!place) return computed_assignment(node);
        const bool is_copied = overlaps(tree_, node);
        const int32_t target = is_copied ? temporary(words, 0) : place->address;
        for (int32_t k = 0; k < words && !is_over_limit(); ++k) {
            folder_.clear();
            const ScalarId value = assigned_value(node, k);
            if (!report_problem()) return;
            out_.expression(folder_, value, 0);
            out_.instruction(Opcode::Store, target + k, line);
        }
        if (!is_copied) return;
        for (int32_t k = 0; k < words && !is_over_limit(); ++k) {
            out_.instruction(Opcode::Load, target + k, line);
            out_.instruction(Opcode::Store, place->address + k, line);
        }
    }

    // v[i] = e: the value first, then the index.
    void computed_assignment(const Node& node) {
        const Node& left = tree_[node.first];
        if (left.kind != NodeKind::Element) return;
        const TreeVariable& array = tree_.variables[static_cast<size_t>(left.value)];
        if (array.size == 0) return;
        folder_.clear();
        const ScalarId value = assigned_value(node, 0);
        const ScalarId index = expander_.element(left.first, 0);
        if (!report_problem()) return;
        const int32_t line = tree_.line_of(node.first);
        out_.expression(folder_, value, 0);
        out_.expression(folder_, index, 1);
        out_.instruction(Opcode::StoreInd, array.address, line);
        out_.word(static_cast<uint16_t>(array.size), line);
    }

    //     x op= e  →  x op e        x++  →  x + 1
    ScalarId assigned_value(const Node& node, int32_t k) {
        const NodeId right = tree_[node.first].next;
        if (node.kind == NodeKind::Assign && node.op == kPlainAssignment) {
            return expander_.element(right, k);
        }
        const int32_t line = tree_.tokens[node.token].line;
        const ScalarId old = expander_.element(node.first, k);
        const ScalarId operand =
            node.kind == NodeKind::Count ? folder_.number(1, line) : expander_.element(right, k);
        return folder_.binary(static_cast<BinaryOperator>(node.op), old, operand,
                              {node.token, line});
    }

    // ---- Conditions (section 4.6)

    ScalarId condition(NodeId test) {
        folder_.clear();
        const ScalarId folded = expander_.element(test, 0);
        return report_problem() ? folded : folder_.opaque();
    }

    uint32_t branch(ScalarId test, uint16_t flags, int32_t line) {
        const Scalar& scalar = folder_[test];
        if (scalar.kind == ScalarKind::Binary) {
            out_.expression(folder_, scalar.left, 0);
            out_.expression(folder_, scalar.right, 1);
        }
        return out_.branch(scalar.op, flags, line);
    }

    void rewound(NodeId block_node) {
        const auto before = out_.checkpoint();
        block(block_node);
        out_.rewind(before);
    }

    // One branch of an `if` that is decided while the program runs.
    struct OpenBranch {
        CodeWriter::Checkpoint start;
        CodeWriter::Checkpoint body_end = {};
        uint32_t branch = 0;
        uint32_t body = 0;
        uint32_t jump = 0;
        uint32_t rest = 0;  // where the `else` part begins
        bool has_jump = false;
        bool has_else =
            false;  // a written one, not an `elseif`: its jump stays, even if it is empty
    };

    void if_statement(const Node& node) {
        std::vector<OpenBranch> open;
        bool is_decided = false;  // a condition before is always true: the rest is checked only
        for (NodeId part = node.first; part != kNoNode; part = tree_[part].next) {
            const NodeId body =
                tree_[part].kind == NodeKind::Clause ? tree_[tree_[part].first].next : part;
            if (body == part || tree_[part].bad) {
                is_decided ? rewound(body) : block(body);
                continue;
            }
            const ScalarId test = condition(tree_[part].first);
            const bool is_number = folder_.is_number(test);
            const bool is_false = is_number && folder_[test].value == 0;
            if (is_number) warn_condition(part, is_false);
            if (is_decided || is_false) {
                rewound(body);
            } else if (is_number) {
                block(body);
                is_decided = true;
            } else {
                open.push_back(open_branch(part, test, body));
            }
        }
        close_branches(open);
    }

    OpenBranch open_branch(NodeId clause, ScalarId test, NodeId body) {
        OpenBranch made{.start = out_.checkpoint()};
        made.branch = branch(test, 0, tree_.line_of(clause));
        made.body = out_.here();
        block(body);
        made.body_end = out_.checkpoint();
        const NodeId next = tree_[clause].next;
        made.has_jump = next != kNoNode;
        made.has_else = made.has_jump && tree_[next].kind == NodeKind::Block;
        if (made.has_jump) made.jump = out_.jump_placeholder(out_.last_line());
        made.rest = out_.here();
        return made;
    }

    //     BRANCH 3+|T|   T   JUMP |E|+1   E
    // From the last branch to the first: what has become longer then lies behind what is still to
    // be measured.
    void close_branches(std::vector<OpenBranch>& open) {
        for (size_t i = open.size(); i-- > 0;) {
            OpenBranch& part = open[i];
            const bool is_rest_empty = out_.here() == part.rest;
            if (is_rest_empty && part.body_end.words == part.body) {
                out_.rewind(part.start);
                continue;
            }
            if (is_rest_empty && part.has_jump && !part.has_else) {
                out_.rewind(part.body_end);
                part.rest = part.body_end.words;
                part.has_jump = false;
            }
            if (part.has_jump) part.rest += out_.patch_jump(part.jump, out_.here());
            out_.patch_branch(part.branch, part.rest);
        }
    }

    void when_statement(const Node& node) {
        const NodeId body = tree_[node.first].next;
        if (node.bad) return block(body);
        const auto start = out_.checkpoint();
        const ScalarId test = condition(node.first);
        if (folder_.is_number(test)) {
            const bool is_false = folder_[test].value == 0;
            warn_condition(tree_[node.first].next, is_false, node.token);
            return is_false ? rewound(body) : block(body);
        }
        const uint32_t at = branch(test, isa::kBranchIsWhen, tree_.tokens[node.token].line);
        const uint32_t body_start = out_.here();
        block(body);
        if (out_.here() == body_start) return out_.rewind(start);
        out_.patch_branch(at, out_.here());
    }

    void while_statement(const Node& node) {
        const NodeId body = tree_[node.first].next;
        if (node.bad) return block(body);
        const auto start = out_.checkpoint();
        const ScalarId test = condition(node.first);
        if (folder_.is_number(test)) {
            const bool is_true = folder_[test].value != 0;
            rewound(body);
            if (is_true) report(Diag::InfiniteLoop, node.token, {});
            return;
        }
        const int32_t line = tree_.tokens[node.token].line;
        const uint32_t at = branch(test, 0, line);
        const uint32_t body_start = out_.here();
        block(body);
        if (out_.here() == body_start) return out_.rewind(start);
        out_.jump_back(start.words, line);
        out_.patch_branch(at, out_.here());
    }

    //     for v in a:b step s do B end  →  v = a   while v <= b do B   v = v + s   end
    void for_statement(const Node& node) {
        const NodeId variable = node.first;
        const NodeId first = tree_[variable].next;
        const NodeId last = tree_[first].next;
        const NodeId step = tree_[last].next;
        const NodeId body = tree_[step].next;
        if (node.bad) return block(body);
        folder_.clear();
        store_loop_variable(variable, folder_.number(tree_[first].value, tree_.line_of(first)));
        if (tree_[first].value == tree_[last].value) return block(body);
        warn_endless(node.token, tree_[first].value, tree_[last].value, tree_[step].value);
        const uint32_t start = out_.here();
        const bool falls = tree_[first].value > tree_[last].value;
        const int32_t line = tree_.tokens[node.token].line;
        folder_.clear();
        out_.expression(folder_, expander_.element(variable, 0), 0);
        out_.immediate(tree_[last].value, tree_.line_of(last), 1);
        const uint32_t at = out_.branch(
            code_of(falls ? BinaryOperator::BiggerEqual : BinaryOperator::SmallerEqual), 0, line);
        block(body);
        folder_.clear();
        const int32_t variable_line = tree_.line_of(variable);
        const ScalarId old = expander_.element(variable, 0);
        const ScalarId more = folder_.number(tree_[step].value, variable_line);
        store_loop_variable(
            variable, folder_.binary(BinaryOperator::Add, old, more, {node.token, variable_line}));
        out_.jump_back(start, line);
        out_.patch_branch(at, out_.here());
    }

    void store_loop_variable(NodeId variable, ScalarId value) {
        const int32_t line = tree_.line_of(variable);
        out_.expression(folder_, value, 0);
        if (const auto place = expander_.place(variable)) {
            out_.instruction(Opcode::Store, place->address, line);
            return;
        }
        const TreeVariable& array = tree_.variables[static_cast<size_t>(tree_[variable].value)];
        out_.expression(folder_, expander_.element(tree_[variable].first, 0), 1);
        report_problem();
        out_.instruction(Opcode::StoreInd, array.address, line);
        out_.word(static_cast<uint16_t>(array.size), line);
    }

    // ---- Events and native functions (section 4.8)

    void emit_statement(const Node& node) {
        const int32_t line = tree_.tokens[node.token].line;
        MemoryRange place;
        if (node.first != kNoNode) {
            const auto in_place = expander_.place(node.first);
            if (!report_problem()) return;
            if (in_place) {
                place = *in_place;
            } else {
                place = {temporary(tree_[node.first].size, 0), tree_[node.first].size};
                if (!fill_temporary(node.first, place, {0, line})) return;
            }
        }
        if (node.value >= isa::kArgumentLimit) {
            return report(Diag::NumberTooHigh, node.token + 1,
                          {shown(tree_.text(node.token + 1)), std::to_string(node.value),
                           std::to_string(isa::kArgumentLimit - 1)});
        }
        out_.instruction(Opcode::Emit, node.value, line);
        out_.word(static_cast<uint16_t>(place.address), line);
        out_.word(static_cast<uint16_t>(place.size), line);
    }

    // Where an argument is computed: the stack below, and the line of the statement.
    struct Pushing {
        int base;
        int32_t line;
    };

    bool fill_temporary(NodeId expression, MemoryRange place, Pushing at) {
        for (int32_t k = 0; k < place.size && !is_over_limit(); ++k) {
            folder_.clear();
            const ScalarId value = expander_.element(expression, k);
            if (!report_problem()) return false;
            out_.expression(folder_, value, at.base);
            out_.instruction(Opcode::Store, place.address + k, at.line);
        }
        return true;
    }

    struct Argument {
        NodeId node = kNoNode;
        MemoryRange place = {};
        enum { InPlace, Computed, Temporary } kind = InPlace;
    };

    // Sizes, then addresses, both from the last to the first; the function pops them in order.
    void call_statement(const Node& node) {
        const NativeFunction& native = target_.natives[static_cast<size_t>(node.value)];
        const int32_t line = tree_.tokens[node.token].line;
        const std::vector<Argument> arguments = place_arguments(node);
        const std::vector<int32_t> sizes = pushed_sizes(native, arguments);
        int base = 0;
        for (size_t i = sizes.size(); i-- > 0;) out_.immediate(sizes[i], line, base++);
        for (size_t i = arguments.size(); i-- > 0;) {
            if (!push_argument(arguments[i], {base++, line})) return;
        }
        if (node.value >= isa::kArgumentLimit) {
            return report(Diag::NumberTooHigh, node.token + 1,
                          {shown(native.name), std::to_string(node.value),
                           std::to_string(isa::kArgumentLimit - 1)});
        }
        out_.instruction(Opcode::Native, node.value, line);
    }

    std::vector<Argument> place_arguments(const Node& node) {
        std::vector<Argument> arguments;
        int32_t used = 0;
        for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
            Argument argument{.node = child};
            const int32_t words = tree_[child].size;
            if (const auto in_place = expander_.place(child)) {
                argument.place = *in_place;
            } else {
                argument.kind = tree_[child].kind == NodeKind::Element ? Argument::Computed
                                                                       : Argument::Temporary;
                argument.place = {temporary(words, used), words};
                used += words;
            }
            arguments.push_back(argument);
        }
        return arguments;
    }

    // Those of parameters of any size, then those bound to the templates 1, 2, …
    static std::vector<int32_t> pushed_sizes(const NativeFunction& native,
                                             const std::vector<Argument>& arguments) {
        std::vector<int32_t> sizes;
        std::vector<std::pair<int32_t, int32_t>> templates;
        for (size_t i = 0; i < arguments.size(); ++i) {
            const int32_t parameter = native.parameters[i].size;
            const int32_t words = arguments[i].place.size;
            if (parameter == 0) sizes.push_back(words);
            if (parameter >= 0) continue;
            const bool is_bound =
                std::any_of(templates.begin(), templates.end(),
                            [parameter](const auto& bound) { return bound.first == -parameter; });
            if (!is_bound) templates.emplace_back(-parameter, words);
        }
        std::sort(templates.begin(), templates.end());
        for (const auto& [number, words] : templates) sizes.push_back(words);
        return sizes;
    }

    // Pushes the address of one argument.
    bool push_argument(const Argument& argument, Pushing at) {
        const int32_t line = tree_.line_of(argument.node);
        switch (argument.kind) {
            case Argument::InPlace:
                break;
            case Argument::Computed:
                return push_element(argument, at.base);
            case Argument::Temporary:
                if (!fill_temporary(argument.node, argument.place, at)) return false;
                break;
        }
        out_.immediate(argument.place.address, line, at.base);
        return true;
    }

    //     e   STORE t   LOAD t   LOAD t   LOAD_INDIRECT v   STORE t   v   +
    // The load only checks the bound.
    bool push_element(const Argument& argument, int base) {
        const Node& node = tree_[argument.node];
        const TreeVariable& array = tree_.variables[static_cast<size_t>(node.value)];
        const int32_t line = tree_.line_of(argument.node);
        const int32_t spare = argument.place.address;
        folder_.clear();
        const ScalarId index = expander_.element(node.first, 0);
        if (!report_problem()) return false;
        out_.expression(folder_, index, base);
        out_.instruction(Opcode::Store, spare, line);
        folder_.clear();
        out_.expression(folder_, folder_.load(spare, line), base);
        const ScalarId again = folder_.load(spare, line);
        out_.expression(folder_, folder_.load_indirect(again, array, line), base + 1);
        out_.instruction(Opcode::Store, spare, line);
        out_.immediate(array.address, line, base + 1);
        out_.instruction(Opcode::Binary, code_of(BinaryOperator::Add), line);
        return true;
    }

    // ---- Odds and ends

    // Temporaries lie at the end of the memory, downwards; each statement has them all to itself.
    int32_t temporary(int32_t words, int32_t already) {
        code_.temporaries = std::max(code_.temporaries, already + words);
        return tree_.memory_words - already - words;
    }

    // False if folding found something wrong.
    bool report_problem() {
        if (!folder_.problem()) return true;
        const TokenId token = folder_.problem()->token;
        report(folder_.problem()->what, token, {shown(tree_.text(token))});
        return false;
    }

    void report(Diag what, TokenId token, std::initializer_list<std::string_view> words) {
        diagnostics_.report(what, mark_of(tree_.source, tree_.tokens[token]), words);
    }

    bool is_over_limit() {
        if (folder_.built() <= kExpandedMax) return false;
        if (!code_.is_cut) {
            code_.is_cut = true;
            diagnostics_.report(Diag::UnrollsTooFar, {}, {std::to_string(kExpandedMax)});
        }
        return true;
    }

    void warn_condition(NodeId clause, bool is_false);
    void warn_condition(NodeId body, bool is_false, TokenId when);
    void warn_endless(TokenId loop, int64_t first, int64_t last, int64_t step);

    const Tree& tree_;
    const Target& target_;
    Diagnostics& diagnostics_;
    Code& code_;
    Folder& folder_;
    Expander expander_;
    CodeWriter out_;
    bool is_sub_;
    NodeId last_statement_ = kNoNode;  // of the section itself that has left code
};

// `if`, `elseif`: constants are switches that people set on purpose, so a condition with a name in
// it is left alone.
void Emitter::warn_condition(NodeId clause, bool is_false) {
    const TokenId keyword = tree_[clause].token;
    for (TokenId i = keyword; tree_.tokens[i].kind != TokenKind::Then; ++i) {
        if (tree_.tokens[i].kind == TokenKind::Identifier) return;
    }
    report(is_false ? Diag::AlwaysFalse : Diag::AlwaysTrue, keyword, {tree_.text(keyword)});
}

void Emitter::warn_condition(NodeId body, bool is_false, TokenId when) {
    for (TokenId i = when; i < tree_[body].token; ++i) {
        if (tree_.tokens[i].kind == TokenKind::Identifier) return;
    }
    report(is_false ? Diag::AlwaysFalse : Diag::WhenAlwaysTrue, when, {tree_.text(when)});
}

// The last value within the bounds, plus the step, must still fit a variable; otherwise it wraps
// and goes on.
void Emitter::warn_endless(TokenId loop, int64_t first, int64_t last, int64_t step) {
    constexpr int64_t kMin = -32768;
    constexpr int64_t kMax = 32767;
    const int64_t reached = first + (last - first) / step * step;
    const int64_t next = reached + step;
    if (next >= kMin && next <= kMax) return;
    report(Diag::LoopNeverEnds, loop,
           {std::to_string(reached), std::to_string(next), std::to_string(last)});
}

}  // namespace

Code emit(const Tree& tree, const Target& target, Diagnostics& diagnostics) {
    Code code;
    code.sections.resize(tree.sections.size());
    Folder folder;
    for (size_t i = 0; i < tree.sections.size(); ++i) {
        const Section& section = tree.sections[i];
        CodeSection unused;
        CodeSection& into = section.is_ignored ? unused : code.sections[i];
        Emitter(tree, target, diagnostics, code, into, folder, section.kind == SectionKind::Sub)
            .section(section);
    }
    return code;
}

}  // namespace vagus::aesl
