// The one list of operators and functions, and what is made from it.
#include "plan/formula_words.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "base/json.hpp"
#include "base/test_places.hpp"
#include "base/text.hpp"
#include "plan/formula.hpp"

namespace vagus::plan {
namespace {

TEST(FormulaWords, AreInTheOrderOfTheirNumbers) {
    size_t index = 0;
    for (const FormulaFunction& one : formula_functions()) {
        EXPECT_EQ(static_cast<size_t>(one.id), index++);
        EXPECT_EQ(find_function(one.name), &one);
        EXPECT_TRUE(one.form.starts_with(one.name)) << one.form;
        EXPECT_LE(one.arguments_min, one.arguments_max);
    }
    EXPECT_EQ(find_function("ABS"), nullptr);
}

// How a function or operator is shown is how it can be written.
TEST(FormulaWords, FormsAreFormulas) {
    for (const FormulaOperator& one : formula_operators()) {
        EXPECT_TRUE(parse_formula(one.form).ok()) << one.form;
    }
    for (const FormulaFunction& one : formula_functions()) {
        std::string form(one.form);
        const size_t dots = form.find(", ...");
        if (dots != std::string::npos) form.erase(dots, 5);
        EXPECT_TRUE(parse_formula(form).ok()) << form;
    }
}

TEST(FormulaWords, ReservedWordsAreNoNamesOfVariables) {
    for (const char* word : {"true", "false", "and", "or", "not"}) {
        EXPECT_TRUE(is_name(word)) << word;
        EXPECT_FALSE(is_variable_name(word)) << word;
    }
    for (const char* word : {"if", "min", "And", "_", "a1"}) {
        EXPECT_TRUE(is_variable_name(word)) << word;
    }
    for (const char* word : {"", "1a", "a b", "a-b", "ä"}) {
        EXPECT_FALSE(is_variable_name(word)) << word;
    }
}

TEST(FormulaWords, AreJsonForEditors) {
    const auto read = read_json(format_formula_words_json());
    ASSERT_TRUE(std::holds_alternative<JsonValue>(read));
    const JsonValue& json = std::get<JsonValue>(read);
    EXPECT_EQ(json.find("operators")->items.size(), 16u);
    EXPECT_EQ(json.find("words")->items.size(), 5u);
    const auto& functions = json.find("functions")->items;
    ASSERT_EQ(functions.size(), 16u);
    EXPECT_EQ(functions[4].find("name")->text, "clamp");
    EXPECT_EQ(functions[4].find("form")->text, "clamp(x, low, high)");
    EXPECT_EQ(functions[4].find("arguments")->items[1].integer, 3);
    EXPECT_EQ(functions[2].find("arguments")->items[1].kind, JsonKind::Null);
}

// The rows of the page's tables, which are made from the list.
TEST(FormulaWords, ThePageIsCurrent) {
    std::vector<std::string> wanted;
    for (const FormulaOperator& one : formula_operators()) {
        wanted.push_back(fmt::format("| `{}` | {} |", one.form, one.help));
    }
    for (const FormulaFunction& one : formula_functions()) {
        wanted.push_back(fmt::format("| `{}` | {} |", one.form, one.help));
    }
    const std::string page = test::docs("formulas.md");
    std::ifstream file(page);
    std::vector<std::string> rows;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("| `")) rows.push_back(line);
    }
    EXPECT_EQ(rows, wanted) << "docs/formulas.md must have these rows, in this order";
}

}  // namespace
}  // namespace vagus::plan
