#include "aesl/warn.hpp"

#include <bit>
#include <string>

#include "aesl/scan.hpp"

namespace vagus::aesl {
namespace {

using isa::BinaryOperator;

class Warner {
public:
    Warner(const Tree& tree, Diagnostics& diagnostics) : tree_(tree), diagnostics_(diagnostics) {}

    void run() {
        names();
        for (const Section& section : tree_.sections) {
            const bool is_empty = tree_[section.block].first == kNoNode;
            if (section.kind == SectionKind::Event && is_empty) {
                report(Diag::EmptyHandler, section.token, {shown(section.name)});
            }
            block(section.block);
        }
    }

private:
    void names() {
        for (size_t i = tree_.node_variables; i < tree_.variables.size(); ++i) {
            const TreeVariable& variable = tree_.variables[i];
            if (variable.is_used) continue;
            report(Diag::UnusedVariable, variable.token, {shown(variable.name)});
        }
        for (const TreeSub& sub : tree_.subs) {
            if (!sub.is_called) report(Diag::UnusedSub, sub.token + 1, {shown(sub.name)});
        }
    }

    void block(NodeId id) {
        NodeId left_by = kNoNode;  // the `return` that ends the block
        for (NodeId child = tree_[id].first; child != kNoNode; child = tree_[child].next) {
            if (left_by != kNoNode) {
                const std::string line = diagnostics_.line_text(tree_.line_of(left_by));
                report(Diag::Unreachable, first_token(child), {line});
                left_by = kNoNode;
            }
            statement(child);
            const bool is_last = tree_[child].next == kNoNode;
            if (tree_[child].kind == NodeKind::Return && !is_last) left_by = child;
        }
    }

    void statement(NodeId id) {
        for (NodeId child = tree_[id].first; child != kNoNode; child = tree_[child].next) {
            const NodeKind kind = tree_[child].kind;
            if (kind == NodeKind::Block) {
                block(child);
            } else if (kind == NodeKind::Clause) {
                statement(child);
            } else if (!is_division_reported_) {
                division(child);
            }
        }
        const Node& node = tree_[id];
        const bool divides = node.kind == NodeKind::Assign && is_op(node, BinaryOperator::Divide);
        if (divides) rounds_down(node.token, node.first, tree_[node.first].next);
    }

    // `(a - b) / 2`: only where the dividend is visibly meant to become negative, and once a
    // program.
    void division(NodeId id) {
        const Node& node = tree_[id];
        if (node.kind == NodeKind::Binary && is_op(node, BinaryOperator::Divide)) {
            rounds_down(node.token, node.first, tree_[node.first].next);
        }
        for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
            division(child);
        }
    }

    void rounds_down(TokenId op, NodeId dividend, NodeId divisor) {
        const Node& by = tree_[divisor];
        if (is_division_reported_ || by.kind != NodeKind::Number || by.value < 2) return;
        if (!std::has_single_bit(static_cast<uint32_t>(by.value)) || !is_signed(dividend)) return;
        is_division_reported_ = true;
        const int bits = std::countr_zero(static_cast<uint32_t>(by.value));
        report(Diag::DivisionRoundsDown, op, {std::to_string(by.value), std::to_string(bits)});
    }

    // A difference or negation with a variable in it.
    bool is_signed(NodeId id) const {
        const Node& node = tree_[id];
        const bool is_negation = node.kind == NodeKind::Unary &&
                                 node.op == static_cast<uint8_t>(isa::UnaryOperator::Negate);
        const bool is_difference =
            node.kind == NodeKind::Binary && is_op(node, BinaryOperator::Subtract);
        return (is_negation || is_difference) && has_variable(id);
    }

    bool has_variable(NodeId id) const {
        const Node& node = tree_[id];
        if (node.kind == NodeKind::Variable || node.kind == NodeKind::Element ||
            node.kind == NodeKind::Slice) {
            return true;
        }
        for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
            if (has_variable(child)) return true;
        }
        return false;
    }

    // Where a statement begins: an assignment's own token is its operator.
    TokenId first_token(NodeId id) const {
        const Node& node = tree_[id];
        const bool is_assignment = node.kind == NodeKind::Assign || node.kind == NodeKind::Count;
        return is_assignment ? tree_[node.first].token : node.token;
    }

    static bool is_op(const Node& node, BinaryOperator op) {
        return node.op == static_cast<uint8_t>(op);
    }

    void report(Diag what, TokenId token, std::initializer_list<std::string_view> words) {
        diagnostics_.report(what, mark_of(tree_.source, tree_.tokens[token]), words);
    }

    const Tree& tree_;
    Diagnostics& diagnostics_;
    bool is_division_reported_ = false;
};

}  // namespace

void warn(const Tree& tree, Diagnostics& diagnostics) {
    Warner(tree, diagnostics).run();
}

}  // namespace vagus::aesl
