// Constant folding by the rules of section 3.6: see evaluate_fold.hpp.
#include "reference/evaluate_fold.hpp"

#include <cstdlib>

namespace vagus::aesl {
namespace {

using isa::BinaryOperator;
using isa::UnaryOperator;

int32_t wrap32(int64_t value) {
    return static_cast<int32_t>(static_cast<uint32_t>(static_cast<uint64_t>(value)));
}

BinaryOperator binary_operator(const Node& node) {
    return static_cast<BinaryOperator>(node.op);
}

// Rule 6: the result of an operation with this number on one side, whatever the other side is.
std::optional<int32_t> absorbed(BinaryOperator op, int32_t number) {
    if (op == BinaryOperator::Multiply && number == 0) return 0;
    if (op == BinaryOperator::BitAnd && number == 0) return 0;
    if (op == BinaryOperator::BitOr && number == -1) return -1;
    if (op == BinaryOperator::And && number == 0) return 0;
    if (op == BinaryOperator::Or && number != 0) return 1;
    return std::nullopt;
}

std::optional<int32_t> constant_binary(const Tree& tree, NodeId id, int k) {
    const BinaryOperator op = binary_operator(tree[id]);
    const auto left = constant(tree, tree.child(id, 0), k);
    const auto right = constant(tree, tree.child(id, 1), k);
    if (left && right) return fold_binary(op, *left, *right);
    if (left) return absorbed(op, *left);
    if (right) return absorbed(op, *right);
    return std::nullopt;
}

// Looks for errors of phase 7 in the order of the text; inner parts before the outer ones.
class ErrorSearch {
public:
    explicit ErrorSearch(const Tree& tree) : tree_(tree) {}

    void statement(NodeId id) {
        const Node& node = tree_[id];
        switch (node.kind) {
            case NodeKind::Assign:
                assignment(id);
                break;
            case NodeKind::While:
                children(id);
                if (constant(tree_, node.first, 0).value_or(0) != 0) report(id, "INFINITE_LOOP");
                break;
            default:
                children(id);
        }
    }

    const std::optional<CompileError>& found() const { return found_; }

private:
    void report(NodeId id, const char* code) {
        if (!found_) found_ = CompileError{code, tree_.line_of(id)};
    }

    void children(NodeId id) {
        for (NodeId child = tree_[id].first; child != kNoNode; child = tree_[child].next)
            any(child);
    }

    static bool is_expression(NodeKind kind) { return kind <= NodeKind::Error; }

    void any(NodeId id) {
        const Node& node = tree_[id];
        if (!is_expression(node.kind)) return statement(id);
        for (int k = 0; k < node.size; ++k) expression(id, k);
    }

    void assignment(NodeId id) {
        const NodeId left = tree_.child(id, 0);
        const NodeId right = tree_.child(id, 1);
        for (int k = 0; k < tree_[right].size; ++k) {
            expression(right, k);
            if (tree_[id].op == kPlainAssignment) continue;
            division(id, left, right, k);
        }
        any(left);
    }

    void expression(NodeId id, int k) {
        const Node& node = tree_[id];
        switch (node.kind) {
            case NodeKind::Element:
                expression(node.first, 0);
                break;
            case NodeKind::Tuple: {
                const TupleElement element = tuple_element(tree_, id, k);
                expression(element.child, element.k);
                break;
            }
            case NodeKind::Not:
                expression(node.first, k);
                break;
            case NodeKind::Unary:
                expression(node.first, k);
                absolute(id, k);
                break;
            case NodeKind::Binary:
                expression(tree_.child(id, 0), k);
                expression(tree_.child(id, 1), k);
                division(id, tree_.child(id, 0), tree_.child(id, 1), k);
                break;
            default:
                break;  // names and numbers
        }
    }

    // Rule 4.
    void absolute(NodeId id, int k) {
        if (static_cast<UnaryOperator>(tree_[id].op) != UnaryOperator::Abs) return;
        if (constant(tree_, tree_[id].first, k) == INT16_MIN) report(id, "ABS_NOT_POSSIBLE");
    }

    // Rule 3.
    void division(NodeId id, NodeId left, NodeId right, int k) {
        const BinaryOperator op = binary_operator(tree_[id]);
        if (constant(tree_, right, k) != 0) return;
        const bool both = constant(tree_, left, k).has_value();
        if (op == BinaryOperator::Divide || (op == BinaryOperator::Modulo && both))
            report(id, "DIVISION_BY_ZERO");
    }

    const Tree& tree_;
    std::optional<CompileError> found_;
};

}  // namespace

std::optional<int32_t> fold_binary(BinaryOperator op, int32_t left, int32_t right) {
    const int64_t a = left;
    const int64_t b = right;
    const int shift = right & 31;
    switch (op) {
        case BinaryOperator::ShiftLeft:
            return wrap32(a << shift);
        case BinaryOperator::ShiftRight:
            return wrap32(a >> shift);
        case BinaryOperator::Add:
            return wrap32(a + b);
        case BinaryOperator::Subtract:
            return wrap32(a - b);
        case BinaryOperator::Multiply:
            return wrap32(a * b);
        case BinaryOperator::Divide:
            if (b == 0) return std::nullopt;
            return wrap32(a / b);
        case BinaryOperator::Modulo:
            if (b == 0) return std::nullopt;
            return wrap32(a % b);
        case BinaryOperator::BitOr:
            return left | right;
        case BinaryOperator::BitXor:
            return left ^ right;
        case BinaryOperator::BitAnd:
            return left & right;
        case BinaryOperator::Equal:
            return a == b;
        case BinaryOperator::NotEqual:
            return a != b;
        case BinaryOperator::Bigger:
            return a > b;
        case BinaryOperator::BiggerEqual:
            return a >= b;
        case BinaryOperator::Smaller:
            return a < b;
        case BinaryOperator::SmallerEqual:
            return a <= b;
        case BinaryOperator::Or:
            return a != 0 || b != 0;
        case BinaryOperator::And:
            return a != 0 && b != 0;
    }
    return std::nullopt;
}

std::optional<int16_t> run_binary(BinaryOperator op, int16_t left, int16_t right) {
    // The machine's table is the folder's on 16-bit operands, cut to 16 bits (section 4.1).
    const auto wide = fold_binary(op, left, right);
    if (!wide) return std::nullopt;
    return static_cast<int16_t>(*wide);
}

int32_t fold_unary(UnaryOperator op, int32_t value) {
    switch (op) {
        case UnaryOperator::Negate:
            return wrap32(-static_cast<int64_t>(value));
        case UnaryOperator::Abs:
            return wrap32(std::abs(static_cast<int64_t>(value)));
        case UnaryOperator::BitNot:
            return ~value;
    }
    return 0;
}

TupleElement tuple_element(const Tree& tree, NodeId tuple, int k) {
    NodeId child = tree[tuple].first;
    while (k >= tree[child].size) {
        k -= tree[child].size;
        child = tree[child].next;
    }
    return {child, k};
}

std::optional<int32_t> constant(const Tree& tree, NodeId expression, int k) {
    const Node& node = tree[expression];
    switch (node.kind) {
        case NodeKind::Number:
            return node.value;
        case NodeKind::Tuple: {
            const TupleElement element = tuple_element(tree, expression, k);
            return constant(tree, element.child, element.k);
        }
        case NodeKind::Unary: {
            const auto value = constant(tree, node.first, k);
            if (!value) return std::nullopt;
            return fold_unary(static_cast<UnaryOperator>(node.op), *value);
        }
        case NodeKind::Not: {
            const auto value = constant(tree, node.first, k);
            if (!value) return std::nullopt;
            return *value == 0 ? 1 : 0;
        }
        case NodeKind::Binary:
            return constant_binary(tree, expression, k);
        default:
            return std::nullopt;
    }
}

bool is_empty(const Tree& tree, NodeId statement) {
    const Node& node = tree[statement];
    switch (node.kind) {
        case NodeKind::Block:
            for (NodeId child = node.first; child != kNoNode; child = tree[child].next)
                if (!is_empty(tree, child)) return false;
            return true;
        case NodeKind::If:
            return is_if_empty(tree, node.first);
        case NodeKind::When:
        case NodeKind::While:
            return is_empty(tree, tree.child(statement, 1)) || constant(tree, node.first, 0) == 0;
        default:
            return false;
    }
}

bool is_if_empty(const Tree& tree, NodeId clause) {
    if (clause == kNoNode) return true;
    if (tree[clause].kind == NodeKind::Block) return is_empty(tree, clause);
    const NodeId condition = tree.child(clause, 0);
    const bool is_branch_empty = is_empty(tree, tree.child(clause, 1));
    const bool is_rest_empty = is_if_empty(tree, tree[clause].next);
    if (const auto value = constant(tree, condition, 0))
        return *value != 0 ? is_branch_empty : is_rest_empty;
    return is_branch_empty && is_rest_empty;
}

std::optional<CompileError> folding_error(const Tree& tree, NodeId block) {
    ErrorSearch search(tree);
    search.statement(block);
    return search.found();
}

}  // namespace vagus::aesl
