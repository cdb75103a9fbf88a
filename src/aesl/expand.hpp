// Vector expressions to single words: element k of any expression, folded
// (docs/spec/aesl-language.md, 4.3).
//
//     v + [a, 2, w[i]]      element 2  →  LOAD v+2, LOAD_INDIRECT w[i], +
#pragma once

#include <optional>
#include <vector>

#include "aesl/fold.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

// Words that lie side by side in memory.
struct MemoryRange {
    int32_t address = 0;
    int32_t size = 0;
};

class Expander {
public:
    Expander(const Tree& tree, Folder& folder) : tree_(tree), folder_(folder) {}

    // Element `k` of an expression, built in the folder. A mistake inside gives Unknown.
    ScalarId element(NodeId expression, int32_t k);

    // Where a variable, a slice, or an element with constant index lies; nothing for all other
    // expressions and for those out of bounds.
    std::optional<MemoryRange> place(NodeId expression);

    // The number that the index of an Element folds to.
    std::optional<int32_t> constant_index(NodeId element_node);

private:
    ScalarId missing(int32_t variable);
    ScalarId array_element(NodeId id);
    ScalarId tuple_element(NodeId id, int32_t k);
    OperatorPlace at(NodeId id) const { return {tree_[id].token, tree_.line_of(id)}; }

    // Where the last walk through a tuple stopped, so that asking for each element in turn takes
    // linear time.
    struct Cursor {
        NodeId child = kNoNode;
        int32_t start = 0;
    };

    const Tree& tree_;
    Folder& folder_;
    std::vector<Cursor> cursors_;
};

// What a constant expression comes to (section 3.6).
struct ConstantValue {
    std::optional<int32_t> value = std::nullopt;
    std::optional<FoldProblem> problem = std::nullopt;  // why it cannot be computed
    bool is_unknown = false;  // there was a mistake inside, which has been reported
};
ConstantValue constant_value(const Tree& tree, NodeId expression);

}  // namespace vagus::aesl
