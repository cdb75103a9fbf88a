// Expressions over single words, folded while they are built (docs/spec/aesl-language.md, section
// 3.6). Rules 1 to 7 and 11 of that section live here and nowhere else; the parser uses the same
// rules for constant expressions.
//
//     Folder folder;
//     const ScalarId a = folder.number(2, 1), b = folder.number(3, 1);
//     use(folder[folder.binary(isa::BinaryOperator::Add, a, b, at)]);  // the Number 5
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "aesl/diagnostics.hpp"
#include "aesl/tree.hpp"

namespace vagus::aesl {

using ScalarId = uint32_t;

enum class ScalarKind : uint8_t {
    Number,        // value, 32 bits
    Load,          // the word at address `value`
    LoadIndirect,  // the word at address `value` + index `left`, of an array of `right` words
    Unary,         // `op` is an isa::UnaryOperator, operand `left`
    Binary,        // `op` is an isa::BinaryOperator
    Unknown,       // something that a mistake keeps unknown
};

struct Scalar {
    ScalarKind kind = ScalarKind::Unknown;
    uint8_t op = 0;
    int32_t line = 0;  // of the word that it becomes
    int32_t value = 0;
    uint32_t left = 0;
    uint32_t right = 0;
};

// Why something could not be computed at compile time.
struct FoldProblem {
    Diag what;
    TokenId token;
};

// Where an operator is: its token, for errors, and its line, for the bytecode.
struct OperatorPlace {
    TokenId token;
    int32_t line;
};

class Folder {
public:
    ScalarId number(int32_t value, int32_t line);
    ScalarId load(int32_t address, int32_t line);
    ScalarId load_indirect(ScalarId index, const TreeVariable& array, int32_t line);
    // Unknown because of a mistake that has been reported, and because of one that will be.
    ScalarId unknown();
    ScalarId opaque() { return add({}); }
    ScalarId unary(isa::UnaryOperator op, ScalarId operand, OperatorPlace at);
    ScalarId binary(isa::BinaryOperator op, ScalarId left, ScalarId right, OperatorPlace at);
    // The opposite of a condition: the VM has no boolean `not` (rule 11).
    ScalarId opposite(ScalarId condition);

    const Scalar& operator[](ScalarId id) const { return scalars_[id]; }
    bool is_number(ScalarId id) const { return scalars_[id].kind == ScalarKind::Number; }

    // The first problem since clear(); what was built with it is Unknown.
    const std::optional<FoldProblem>& problem() const { return problem_; }
    // Whether unknown() was called since clear().
    bool met_unknown() const { return met_unknown_; }

    void clear();

    // Scalars built in all, not reset by clear(): the measure for kExpandedMax.
    size_t built() const { return built_; }

private:
    ScalarId add(Scalar scalar);
    ScalarId fail(Diag what, TokenId token);
    ScalarId compute(isa::BinaryOperator op, const Scalar& left, const Scalar& right,
                     OperatorPlace at);
    std::optional<ScalarId> simplify(isa::BinaryOperator op, ScalarId left, ScalarId right,
                                     int32_t line);
    ScalarId with_shift(isa::BinaryOperator op, ScalarId left, ScalarId right, OperatorPlace at);

    std::vector<Scalar> scalars_;
    std::optional<FoldProblem> problem_;
    bool met_unknown_ = false;
    size_t built_ = 0;
};

}  // namespace vagus::aesl
