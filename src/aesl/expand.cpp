#include "aesl/expand.hpp"

namespace vagus::aesl {

ScalarId Expander::element(NodeId expression, int32_t k) {
    const Node& node = tree_[expression];
    switch (node.kind) {
        case NodeKind::Number:
            return folder_.number(node.value, tree_.line_of(expression));
        case NodeKind::Variable: {
            const TreeVariable& variable = tree_.variables[static_cast<size_t>(node.value)];
            if (variable.size == 0) return folder_.unknown();
            return folder_.load(variable.address + k, tree_.line_of(expression));
        }
        case NodeKind::Slice: {
            const auto where = place(expression);
            if (!where) return missing(node.value);
            return folder_.load(where->address + k, tree_.line_of(expression));
        }
        case NodeKind::Element:
            return array_element(expression);
        case NodeKind::Tuple:
            return tuple_element(expression, k);
        case NodeKind::Unary:
            return folder_.unary(static_cast<isa::UnaryOperator>(node.op), element(node.first, k),
                                 at(expression));
        case NodeKind::Binary: {
            const ScalarId left = element(node.first, k);
            const ScalarId right = element(tree_[node.first].next, k);
            return folder_.binary(static_cast<isa::BinaryOperator>(node.op), left, right,
                                  at(expression));
        }
        case NodeKind::Not:
            return folder_.opposite(element(node.first, k));
        default:
            return folder_.unknown();
    }
}

ScalarId Expander::missing(int32_t variable) {
    const bool is_known = tree_.variables[static_cast<size_t>(variable)].size != 0;
    return is_known ? folder_.opaque() : folder_.unknown();
}

ScalarId Expander::array_element(NodeId id) {
    const TreeVariable& variable = tree_.variables[static_cast<size_t>(tree_[id].value)];
    const ScalarId index = element(tree_[id].first, 0);
    if (variable.size == 0) return folder_.unknown();
    if (!folder_.is_number(index)) {
        return folder_.load_indirect(index, variable, tree_.line_of(id));
    }
    const int32_t k = folder_[index].value;
    if (k < 0 || k >= variable.size) return folder_.opaque();
    return folder_.load(variable.address + k, tree_.line_of(id));
}

ScalarId Expander::tuple_element(NodeId id, int32_t k) {
    if (cursors_.size() < tree_.nodes.size()) cursors_.resize(tree_.nodes.size());
    Cursor cursor = cursors_[id];
    if (cursor.child == kNoNode || k < cursor.start) cursor = {tree_[id].first, 0};
    while (cursor.child != kNoNode) {
        const int32_t size = tree_[cursor.child].size;
        if (size == 0) return element(cursor.child, 0);
        if (k < cursor.start + size) break;
        cursor = {tree_[cursor.child].next, cursor.start + size};
    }
    cursors_[id] = cursor;
    if (cursor.child == kNoNode) return folder_.opaque();
    return element(cursor.child, k - cursor.start);
}

std::optional<int32_t> Expander::constant_index(NodeId element_node) {
    const NodeId index = tree_[element_node].first;
    if (tree_[index].kind == NodeKind::Variable) return std::nullopt;
    if (tree_[index].kind == NodeKind::Number) return tree_[index].value;
    const ScalarId folded = element(index, 0);
    if (!folder_.is_number(folded)) return std::nullopt;
    return folder_[folded].value;
}

std::optional<MemoryRange> Expander::place(NodeId expression) {
    const Node& node = tree_[expression];
    const bool is_reference = node.kind == NodeKind::Variable || node.kind == NodeKind::Slice ||
                              node.kind == NodeKind::Element;
    if (!is_reference) return std::nullopt;
    const TreeVariable& variable = tree_.variables[static_cast<size_t>(node.value)];
    int32_t start = 0;
    if (node.kind == NodeKind::Slice) start = tree_[node.first].value;
    if (node.kind == NodeKind::Element) {
        const auto index = constant_index(expression);
        if (!index) return std::nullopt;
        start = *index;
    }
    if (start < 0 || node.size > variable.size - start) return std::nullopt;
    return MemoryRange{variable.address + start, node.size};
}

ConstantValue constant_value(const Tree& tree, NodeId expression) {
    const Node& node = tree[expression];
    if (node.kind == NodeKind::Number) return {.value = node.value};
    if (node.kind == NodeKind::Error) return {.is_unknown = true};
    Folder folder;
    const ScalarId scalar = Expander(tree, folder).element(expression, 0);
    if (folder.problem()) return {.problem = folder.problem()};
    if (folder.met_unknown()) return {.is_unknown = true};
    if (node.size != 1 || !folder.is_number(scalar)) return {};
    return {.value = folder[scalar].value};
}

}  // namespace vagus::aesl
