#include "aesl/places.hpp"

#include "aesl/expand.hpp"
#include "aesl/scan.hpp"
#include "aesl/sizes.hpp"

namespace vagus::aesl {
namespace {

bool is_reference(NodeKind kind) {
    return kind == NodeKind::Variable || kind == NodeKind::Element || kind == NodeKind::Slice;
}

bool is_operation(NodeKind kind) {
    return kind == NodeKind::Tuple || kind == NodeKind::Unary || kind == NodeKind::Not ||
           kind == NodeKind::Binary;
}

bool mentions(const Tree& tree, NodeId id, int32_t variable) {
    const Node& node = tree[id];
    if (is_reference(node.kind) && node.value == variable) return true;
    for (NodeId child = node.first; child != kNoNode; child = tree[child].next) {
        if (mentions(tree, child, variable)) return true;
    }
    return false;
}

class PlaceCheck {
public:
    PlaceCheck(const Tree& tree, Diagnostics& diagnostics)
        : tree_(tree), diagnostics_(diagnostics), expander_(tree, folder_) {}

    bool expression(NodeId id) {
        if (!reference(id)) return false;
        const Node& node = tree_[id];
        if (node.kind == NodeKind::Slice) return true;
        for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
            if (!expression(child)) return false;
        }
        return true;
    }

    // An element or slice itself, not its index.
    bool reference(NodeId id) {
        if (tree_[id].kind == NodeKind::Slice) return slice(id);
        return tree_[id].kind != NodeKind::Element || element(id);
    }

    bool slice(NodeId id) {
        const Node& node = tree_[id];
        const int32_t size = array_size(node);
        const int32_t first = tree_[node.first].value;
        const int32_t last = tree_[tree_[node.first].next].value;
        if (size == 0 || (first >= 0 && last < size)) return true;
        return out_of_bounds(node, first < 0 ? first : last);
    }

    // Room for the copy of the right side, left side, then right side; the last two the other way
    // round where the statement reads its right side first.
    bool assignment(const Node& node) {
        const NodeId left = node.first;
        const NodeId right = tree_[left].next;
        if (!assignable(node) || !has_room(node)) return false;
        if (node.kind == NodeKind::Count) return expression(left);
        if (node.op == kPlainAssignment) return expression(right) && expression(left);
        return expression(left) && expression(right);
    }

private:
    bool element(NodeId id) {
        const Node& node = tree_[id];
        const int32_t size = array_size(node);
        folder_.clear();
        const auto index = expander_.constant_index(id);
        if (size == 0 || !index || (*index >= 0 && *index < size)) return true;
        return out_of_bounds(node, *index);
    }

    bool assignable(const Node& node) {
        const Node& left = tree_[node.first];
        if (is_reference(left.kind) || left.kind == NodeKind::Error) return true;
        const bool is_constant =
            left.kind == NodeKind::Number && tree_.tokens[left.token].kind == TokenKind::Identifier;
        const std::string why =
            is_constant ? " and \"" + shown(tree_.text(left.token)) + "\" is a constant" : "";
        return report(Diag::NotAssignable, node.token, {shown(tree_.text(node.token)), why});
    }

    // Room for the copy of the right side, at the end of the memory (section 4.5).
    bool has_room(const Node& node) {
        const int32_t words = tree_[node.first].size;
        const int32_t free_words = tree_.memory_words - tree_.variable_words;
        if (words <= free_words || !overlaps(tree_, node)) return true;
        return report(Diag::NoTemporarySpace, node.token, {words_of(words), words_of(free_words)});
    }

    int32_t array_size(const Node& node) const {
        return tree_.variables[static_cast<size_t>(node.value)].size;
    }

    bool out_of_bounds(const Node& node, int32_t index) {
        const int32_t size = array_size(node);
        return report(Diag::IndexOutOfBounds, node.token,
                      {shown(tree_.text(node.token)), words_of(size), std::to_string(size - 1),
                       std::to_string(index)});
    }

    bool report(Diag what, TokenId token, std::initializer_list<std::string_view> words) {
        diagnostics_.report(what, mark_of(tree_.source, tree_.tokens[token]), words);
        return false;
    }

    const Tree& tree_;
    Diagnostics& diagnostics_;
    Folder folder_;
    Expander expander_;
};

enum class Phase { CountedSizes, All };

class Walk {
public:
    Walk(Tree& tree, Diagnostics& diagnostics, Phase phase)
        : tree_(tree), diagnostics_(diagnostics), check_(tree, diagnostics), phase_(phase) {}

    void block(NodeId id) {
        for (NodeId child = tree_[id].first; child != kNoNode; child = tree_[child].next) {
            statement(child);
        }
    }

private:
    void statement(NodeId id) {
        if (!tree_[id].bad && !head(tree_[id])) tree_[id].bad = true;
        for (NodeId child = tree_[id].first; child != kNoNode; child = tree_[child].next) {
            if (tree_[child].kind == NodeKind::Block) block(child);
            if (tree_[child].kind == NodeKind::Clause) statement(child);
        }
    }

    bool head(const Node& node) {
        if (phase_ == Phase::CountedSizes) {
            return node.kind != NodeKind::Count || check_sizes_of(tree_, node.first, diagnostics_);
        }
        switch (node.kind) {
            case NodeKind::Assign:
            case NodeKind::Count:
                return check_.assignment(node);
            case NodeKind::Clause:
            case NodeKind::When:
            case NodeKind::While:
            case NodeKind::For:
                return check_.expression(node.first);
            case NodeKind::Emit:
            case NodeKind::Call:
                return arguments(node);
            default:
                return true;
        }
    }

    bool arguments(const Node& node) {
        for (NodeId child = node.first; child != kNoNode; child = tree_[child].next) {
            if (!check_.expression(child)) return false;
        }
        return true;
    }

    Tree& tree_;
    Diagnostics& diagnostics_;
    PlaceCheck check_;
    Phase phase_;
};

}  // namespace

void check_places(Tree& tree, Diagnostics& diagnostics) {
    for (const Phase phase : {Phase::CountedSizes, Phase::All}) {
        Walk walk(tree, diagnostics, phase);
        for (const Section& section : tree.sections) walk.block(section.block);
    }
}

bool check_first_place(const Tree& tree, NodeId expression, Diagnostics& diagnostics) {
    NodeId first = expression;
    while (is_operation(tree[first].kind)) first = tree[first].first;
    return PlaceCheck(tree, diagnostics).reference(first);
}

bool overlaps(const Tree& tree, const Node& assignment) {
    const Node& left = tree[assignment.first];
    if (left.size <= 1 || !is_reference(left.kind)) return false;
    const bool reads_left = assignment.kind == NodeKind::Count || assignment.op != kPlainAssignment;
    return reads_left || mentions(tree, left.next, left.value);
}

}  // namespace vagus::aesl
