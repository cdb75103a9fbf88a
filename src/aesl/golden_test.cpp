// The golden vectors, compile side: every case has the error it must have, or none
// (testdata/golden/aesl/README.md). Bytecode and lines are those of the reference word for word,
// except in the cases listed here with the reason.
#include <algorithm>
#include <filesystem>
#include <map>

#include "aesl/compile.hpp"
#include "aesl/node_file.hpp"
#include "base/file.hpp"
#include "base/json.hpp"
#include "base/test_places.hpp"
#include "gtest/gtest.h"

namespace vagus::aesl {
namespace {

const std::string kFolder = test::testdata("golden/aesl/");

struct Case {
    std::string name;
    std::string source;
    JsonValue expected;
};

NodeFile golden_node() {
    const auto text = read_file(kFolder + "node.json");
    EXPECT_TRUE(text.ok());
    return parse_node_file(text.value(), "node.json").value();
}

std::vector<Case> golden_cases() {
    std::vector<Case> cases;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
        if (entry.path().extension() != ".aesl") continue;
        const std::string name = entry.path().stem().string();
        const auto expected = read_file(kFolder + name + ".expected.json");
        const auto source = read_file(entry.path().string());
        EXPECT_TRUE(expected.ok() && source.ok()) << name;
        cases.push_back({name, source.value(), parse_json(expected.value(), name).value()});
    }
    std::sort(cases.begin(), cases.end(),
              [](const Case& a, const Case& b) { return a.name < b.name; });
    return cases;
}

Compilation compile_golden(const Case& golden, const NodeFile& node) {
    return compile(golden.source, node.target, node.common, {});
}

// X and X_GUESS count as equal.
std::string category(std::string code) {
    const std::string suffix = "_GUESS";
    if (code.ends_with(suffix)) code.resize(code.size() - suffix.size());
    return code;
}

std::vector<uint16_t> words_of_json(const JsonValue& list) {
    std::vector<uint16_t> words;
    for (const JsonValue& item : list.items) words.push_back(static_cast<uint16_t>(item.integer));
    return words;
}

TEST(Golden, EveryCaseHasTheErrorItMustHaveOrNone) {
    const NodeFile node = golden_node();
    const std::vector<Case> cases = golden_cases();
    EXPECT_EQ(cases.size(), 266u);
    for (const Case& golden : cases) {
        const Compilation done = compile_golden(golden, node);
        const JsonValue* error = golden.expected.find("error");
        if (error == nullptr) {
            EXPECT_TRUE(done.ok())
                << golden.name << ": " << done.errors[0].at.line << ": " << done.errors[0].message;
            continue;
        }
        ASSERT_FALSE(done.ok()) << golden.name;
        EXPECT_EQ(category(done.first_error().code), category(error->find("code")->text))
            << golden.name;
        EXPECT_EQ(done.first_error().formal_place().line, error->find("line")->integer)
            << golden.name << ": " << done.first_error().message;
    }
}

// Programs made to hold several mistakes, to fix the order of the phases; all others hold one.
const std::map<std::string, size_t> kSeveralMistakes = {
    {"224-err-order-scan-before-parse", 2},        {"225-err-order-emit-size-before-sizes", 2},
    {"226-err-order-sizes-before-bounds", 2},      {"227-err-order-sizes-before-subs", 2},
    {"228-err-order-bounds-before-types", 2},      {"229-err-order-types-before-folding", 2},
    {"230-err-order-body-before-endless-loop", 2}, {"231-err-order-space-after-initialiser", 2},
};

TEST(Golden, OneMistakeGivesOneError) {
    const NodeFile node = golden_node();
    for (const Case& golden : golden_cases()) {
        const Compilation done = compile_golden(golden, node);
        if (done.ok()) continue;
        const auto several = kSeveralMistakes.find(golden.name);
        const size_t mistakes = several == kSeveralMistakes.end() ? 1 : several->second;
        std::string all;
        for (const Diagnostic& d : done.errors) {
            all += std::to_string(d.at.line) + ":" + std::to_string(d.at.column) + " " + d.message +
                   "\n";
        }
        EXPECT_EQ(done.errors.size(), mistakes) << golden.name << "\n" << all;
    }
}

// The reference's columns are wrong in the ways of section 1.6; these are right, counted by hand.
const std::map<std::string, int> kRightColumns = {
    {"013-err-lex-uppercase-base", 5},    // behind a comment's line
    {"070-err-expr-missing-operand", 1},  // end of the text behind a line feed
    {"095-err-vec-index-above", 1},       // behind a comment's line
    {"118-err-if-missing-end", 1},        // end of the text behind a line feed
    {"218-err-limit-temporary", 1},       // behind a comment's line
};

TEST(Golden, ColumnsAreThoseOfTheReferenceOrRight) {
    const NodeFile node = golden_node();
    for (const Case& golden : golden_cases()) {
        const Compilation done = compile_golden(golden, node);
        if (done.ok()) continue;
        const auto right = kRightColumns.find(golden.name);
        const auto expected = right != kRightColumns.end()
                                  ? right->second
                                  : golden.expected.find("error")->find("column")->integer;
        EXPECT_EQ(done.first_error().formal_place().column, expected) << golden.name;
    }
}

// Where our code differs from the reference's, and why.
const std::map<std::string, std::string> kOtherCode = {
    {"083-vec-compound-and-step", "temporaries are free again after each statement (4.5)"},
    {"085-vec-overlap", "temporaries are free again after each statement (4.5)"},
    {"086-vec-overlap-rotate", "temporaries are free again after each statement (4.5)"},
};

TEST(Golden, BytecodeIsThatOfTheReferenceExceptWhereListed) {
    const NodeFile node = golden_node();
    size_t equal = 0;
    for (const Case& golden : golden_cases()) {
        const JsonValue* bytecode = golden.expected.find("bytecode");
        if (bytecode == nullptr) continue;
        const Compilation done = compile_golden(golden, node);
        if (!done.ok()) continue;  // the first test tells
        const bool is_equal = done.program.bytecode == words_of_json(*bytecode);
        equal += is_equal;
        EXPECT_EQ(is_equal, !kOtherCode.contains(golden.name)) << golden.name;
    }
    RecordProperty("equal", static_cast<int>(equal));
    std::cout << equal << " programs with the reference's bytecode\n";
}

const std::map<std::string, std::string> kOtherLines = {
    {"223-prog-state-machine", "the reference's line is arbitrary behind an elseif chain (4.11)"},
    {"246-sub-ends-in-if-with-return", "the same"},
};

TEST(Golden, LinesAreThoseOfTheReferenceExceptWhereListed) {
    const NodeFile node = golden_node();
    size_t equal = 0;
    for (const Case& golden : golden_cases()) {
        const JsonValue* lines = golden.expected.find("lines");
        if (lines == nullptr) continue;
        const Compilation done = compile_golden(golden, node);
        if (!done.ok()) continue;  // the first test tells
        const bool is_equal = done.program.lines == words_of_json(*lines);
        equal += is_equal;
        EXPECT_EQ(is_equal, !kOtherLines.contains(golden.name)) << golden.name;
    }
    std::cout << equal << " programs with the reference's lines\n";
}

}  // namespace
}  // namespace vagus::aesl
