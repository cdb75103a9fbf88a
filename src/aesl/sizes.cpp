#include "aesl/sizes.hpp"

#include "aesl/scan.hpp"

namespace vagus::aesl {
namespace {

// Whether a mistake that has been reported keeps the size unknown.
bool contains_error(const Tree& tree, NodeId id) {
    const Node& node = tree[id];
    if (node.kind == NodeKind::Error) return true;
    const bool is_reference = node.kind == NodeKind::Variable || node.kind == NodeKind::Element ||
                              node.kind == NodeKind::Slice;
    if (is_reference && tree.variables[static_cast<size_t>(node.value)].size == 0) return true;
    for (NodeId child = node.first; child != kNoNode; child = tree[child].next) {
        if (contains_error(tree, child)) return true;
    }
    return false;
}

class SizeCheck {
public:
    SizeCheck(const Tree& tree, Diagnostics& diagnostics)
        : tree_(tree), diagnostics_(diagnostics) {}

    // False if something was reported: the first thing only.
    bool expression(NodeId id) {
        const Node& node = tree_[id];
        if (node.kind == NodeKind::Element) return single_index(id);
        if (node.kind == NodeKind::Slice) return slice(id);
        for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
            if (!expression(child)) return false;
        }
        if (node.kind != NodeKind::Binary) return true;
        return equal_sizes(node.token, node.first, tree_[node.first].next);
    }

    bool equal_sizes(TokenId op, NodeId left, NodeId right) {
        const int32_t a = tree_[left].size;
        const int32_t b = tree_[right].size;
        if (a == b || a == 0 || b == 0) return true;
        return report(Diag::SizeMismatch, op, {shown(tree_.text(op)), words_of(a), words_of(b)});
    }

    bool condition(NodeId test, TokenId keyword, Diag what) {
        if (!expression(test)) return false;
        const int32_t size = tree_[test].size;
        if (size <= 1) return true;
        return report(what, keyword, {tree_.text(keyword), words_of(size)});
    }

    bool loop_variable(NodeId variable) {
        if (!expression(variable)) return false;
        const Node& node = tree_[variable];
        if (node.size <= 1) return true;
        return report(Diag::LoopVariableIsArray, tree_[node.next].token,
                      {shown(tree_.text(node.token)), words_of(node.size)});
    }

    // Every index must be one word; nothing else is looked at inside.
    bool single_index(NodeId id) {
        const Node& node = tree_[id];
        if (node.kind == NodeKind::Element) {
            const int32_t size = tree_[node.first].size;
            if (size > 1 || (size == 0 && !contains_error(tree_, node.first))) {
                return report(Diag::IndexNotSingle, node.token, {shown(tree_.text(node.token))});
            }
        }
        for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
            if (!single_index(child)) return false;
        }
        return true;
    }

private:
    bool slice(NodeId id) {
        const Node& node = tree_[id];
        const TreeVariable& variable = tree_.variables[static_cast<size_t>(node.value)];
        // Only the end: a start below 0 waits for phase 5, as in the reference.
        const int32_t last = tree_[tree_[node.first].next].value;
        if (variable.size == 0 || (last >= 0 && last < variable.size)) return true;
        return report(Diag::IndexOutOfBounds, node.token,
                      {shown(variable.name), words_of(variable.size),
                       std::to_string(variable.size - 1), std::to_string(last)});
    }

    bool report(Diag what, TokenId token, std::initializer_list<std::string_view> words) {
        diagnostics_.report(what, mark_of(tree_.source, tree_.tokens[token]), words);
        return false;
    }

    const Tree& tree_;
    Diagnostics& diagnostics_;
};

void check_block(Tree& tree, NodeId block, SizeCheck& check);

bool check_head(const Tree& tree, const Node& node, SizeCheck& check) {
    switch (node.kind) {
        case NodeKind::Assign: {
            const NodeId right = tree[node.first].next;
            return check.expression(node.first) && check.expression(right) &&
                   check.equal_sizes(node.token, node.first, right);
        }
        case NodeKind::Count:
            return check.single_index(node.first);
        case NodeKind::Clause:
        case NodeKind::When:
            return check.condition(node.first, node.token, Diag::VectorCondition);
        case NodeKind::While:
            return check.condition(node.first, node.token, Diag::VectorWhile);
        case NodeKind::For:
            return check.loop_variable(node.first);
        default:
            return true;  // arguments were checked while they were read
    }
}

void check_statement(Tree& tree, NodeId id, SizeCheck& check) {
    if (!tree[id].bad && !check_head(tree, tree[id], check)) tree[id].bad = true;
    for (NodeId child = tree[id].first; child != kNoNode; child = tree[child].next) {
        const NodeKind kind = tree[child].kind;
        if (kind == NodeKind::Block) check_block(tree, child, check);
        if (kind == NodeKind::Clause) check_statement(tree, child, check);
    }
}

void check_block(Tree& tree, NodeId block, SizeCheck& check) {
    for (NodeId id = tree[block].first; id != kNoNode; id = tree[id].next) {
        check_statement(tree, id, check);
    }
}

}  // namespace

void check_sizes(Tree& tree, Diagnostics& diagnostics) {
    SizeCheck check(tree, diagnostics);
    for (const Section& section : tree.sections) check_block(tree, section.block, check);
}

bool check_sizes_of(const Tree& tree, NodeId expression, Diagnostics& diagnostics) {
    return SizeCheck(tree, diagnostics).expression(expression);
}

}  // namespace vagus::aesl
