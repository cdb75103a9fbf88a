// Every operator with the values of section 3.4 and appendix C, and at the borders of 16 bits.
#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using isa::BinaryOperator;
using isa::UnaryOperator;

struct Sum {
    int16_t left, right, result;
};

struct BinaryRow {
    const char* name;
    BinaryOperator which;
    std::vector<Sum> sums;
};

const std::vector<BinaryRow>& binary_rows() {
    static const std::vector<BinaryRow> kRows = {
        {"<<",
         BinaryOperator::ShiftLeft,
         {{1, 3, 8},
          {1, 15, -32768},
          {1, 16, 0},
          {1, 31, 0},
          {1, 32, 1},
          {5, -32, 5},
          {1, -31, 2},
          {1, -1, 0},
          {0x1234, -31, 9320}}},
        {">>",
         BinaryOperator::ShiftRight,
         {{8, 3, 1},
          {-1, 31, -1},
          {-4660, 8, -19},
          {-4660, 32, -4660},
          {32767, -31, 16383},
          {32767, 15, 0},
          {-32768, 15, -1}}},
        {"+",
         BinaryOperator::Add,
         {{2, 3, 5}, {-2, 3, 1}, {32767, 1, -32768}, {-32768, -1, 32767}}},
        {"-",
         BinaryOperator::Subtract,
         {{2, 3, -1}, {3, -2, 5}, {-32768, 1, 32767}, {0, -32768, -32768}}},
        {"*",
         BinaryOperator::Multiply,
         {{-3, 7, -21}, {300, 300, 24464}, {-32768, -32768, 0}, {-32768, -1, -32768}}},
        {"/",
         BinaryOperator::Divide,
         {{7, 2, 3}, {-7, 2, -3}, {7, -2, -3}, {-7, -2, 3}, {-32768, -1, -32768}, {0, 5, 0}}},
        {"%",
         BinaryOperator::Modulo,
         {{7, 2, 1}, {-7, 2, -1}, {7, -2, 1}, {-7, -2, -1}, {-32768, -1, 0}, {6, 3, 0}}},
        {"|", BinaryOperator::BitOr, {{0x0f0f, 0x00ff, 0x0fff}, {-32768, 1, -32767}, {0, 0, 0}}},
        {"^", BinaryOperator::BitXor, {{0x0f0f, 0x00ff, 0x0ff0}, {-1, 1, -2}, {77, 77, 0}}},
        {"&",
         BinaryOperator::BitAnd,
         {{0x0f0f, 0x00ff, 0x000f}, {-32768, -1, -32768}, {1, 2, 0}, {7, 2, 2}}},
        {"==",
         BinaryOperator::Equal,
         {{5, 5, 1}, {5, 6, 0}, {6, 5, 0}, {-32768, -32768, 1}, {-1, 1, 0}}},
        {"!=", BinaryOperator::NotEqual, {{5, 5, 0}, {5, 6, 1}, {6, 5, 1}, {-32768, 32767, 1}}},
        {">", BinaryOperator::Bigger, {{5, 5, 0}, {6, 5, 1}, {5, 6, 0}, {32767, -32768, 1}}},
        {">=", BinaryOperator::BiggerEqual, {{5, 5, 1}, {6, 5, 1}, {5, 6, 0}, {-32768, 32767, 0}}},
        {"<", BinaryOperator::Smaller, {{5, 5, 0}, {6, 5, 0}, {5, 6, 1}, {-32768, 32767, 1}}},
        {"<=", BinaryOperator::SmallerEqual, {{5, 5, 1}, {6, 5, 0}, {5, 6, 1}, {32767, -32768, 0}}},
        {"or", BinaryOperator::Or, {{0, 0, 0}, {2, 0, 1}, {0, -3, 1}, {2, 4, 1}, {3, 3, 1}}},
        {"and", BinaryOperator::And, {{0, 0, 0}, {2, 0, 0}, {0, -3, 0}, {2, 4, 1}, {4, 2, 1}}},
    };
    return kRows;
}

struct UnaryRow {
    const char* name;
    UnaryOperator which;
    std::vector<std::pair<int16_t, int16_t>> values;  // before, after
};

const std::vector<UnaryRow>& unary_rows() {
    static const std::vector<UnaryRow> kRows = {
        {"negation",
         UnaryOperator::Negate,
         {{5, -5}, {-5, 5}, {0, 0}, {32767, -32767}, {-32768, -32768}}},
        {"abs",
         UnaryOperator::Abs,
         {{5, 5}, {-5, 5}, {-1, 1}, {0, 0}, {-32767, 32767}, {-32768, -32768}}},
        {"~", UnaryOperator::BitNot, {{0, -1}, {-1, 0}, {0x0f0f, -3856}, {32767, -32768}}},
    };
    return kRows;
}

Status gives(Bench& bench, const Instructions& code, const std::string& what, int16_t expected) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {static_cast<int16_t>(~expected)}));
    Instructions whole = code;
    TRY(bench.run_to_end(program_of(whole.store(at).stop())));
    const Values found = TRY(bench.get(at, 1));
    if (found[0] == expected) return Status::done();
    return finding(what + ": expected " + std::to_string(expected) + ", found " +
                   std::to_string(found[0]));
}

Status binary(Bench& bench, const BinaryRow& row) {
    for (const Sum& sum : row.sums) {
        const std::string what =
            std::to_string(sum.left) + " " + row.name + " " + std::to_string(sum.right);
        const Instructions code = Instructions().push(sum.left).push(sum.right).binary(row.which);
        TRY(gives(bench, code, what, sum.result));
    }
    return Status::done();
}

Status unary(Bench& bench, const UnaryRow& row) {
    for (const auto& [before, after] : row.values) {
        const Instructions code = Instructions().push(before).unary(row.which);
        TRY(gives(bench, code, std::string(row.name) + " of " + std::to_string(before), after));
    }
    return Status::done();
}

// Only the low 8 bits of the word say which operator it is.
Status binary_with_other_bits(Bench& bench) {
    const Instructions code = Instructions().push(2).push(3).word(0x8f02);
    return gives(bench, code, "2 + 3, written 8f02", 5);
}

}  // namespace

void add_operator_checks(Checks& checks) {
    for (const BinaryRow& row : binary_rows()) {
        checks.push_back({"operators", std::string("operator ") + row.name, "3.4", "",
                          [&row](Bench& bench) { return binary(bench, row); }});
    }
    for (const UnaryRow& row : unary_rows()) {
        checks.push_back({"operators", std::string("operator ") + row.name, "3.4", "",
                          [&row](Bench& bench) { return unary(bench, row); }});
    }
    checks.push_back(
        {"operators", "bits 11 to 8 of Binary do not count", "3.4", "", binary_with_other_bits});
}

}  // namespace vagus::conformance
