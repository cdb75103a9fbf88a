// What a debugger is asked is a formula of plans.
#include "run/expression.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vagus::run {
namespace {

using testing::HasSubstr;

const plan::GraphPlan& a_plan() {
    static const plan::GraphPlan kPlan = [] {
        plan::GraphPlan made;
        made.name = "P";
        const std::pair<const char*, plan::Type> variables[] = {{"word", plan::Type::String},
                                                                {"limit", plan::Type::Int},
                                                                {"thing", plan::Type::Object}};
        for (const auto& [name, type] : variables) {
            plan::GraphVariable variable;
            variable.name = name;
            variable.type = type;
            made.variables.push_back(variable);
        }
        return made;
    }();
    return kPlan;
}

Result<plan::Value> ask(std::string_view text) {
    const Expression expression = TRY(Expression::parse(text, a_plan()));
    const plan::Value values[] = {plan::Value(std::string("a = b")), plan::Value(int64_t{3}),
                                  plan::Value(plan::Object())};
    std::vector<plan::Value> used;
    for (const int slot : expression.slots()) used.push_back(values[slot]);
    return expression.evaluate(used);
}

TEST(Expression, IsAFormulaOverTheVariablesOfThePlan) {
    EXPECT_EQ(ask("limit * 2").value(), plan::Value(int64_t{6}));
    EXPECT_EQ(ask("limit >= 3").value(), plan::Value(true));
    EXPECT_EQ(ask("word == 'a = b'").value(), plan::Value(true));
    EXPECT_EQ(ask("limit < 3 or limit > 2 and word != ''").value(), plan::Value(true));
    EXPECT_EQ(ask("if(limit > 2, max(limit, 7), 0)").value(), plan::Value(int64_t{7}));
    EXPECT_EQ(ask("thing == thing").value(), plan::Value(true));
}

TEST(Expression, WhatCannotBeAskedIsAnsweredWithAdvice) {
    EXPECT_THAT(ask("limit = 3").error().what, HasSubstr("write == to compare"));
    EXPECT_THAT(ask("limt > 3").error().what, HasSubstr("did you mean limit?"));
    EXPECT_THAT(ask("max + 1").error().what, HasSubstr("the function is written max(a, b, ...)"));
    EXPECT_THAT(ask("thing > 1").error().what, HasSubstr("object"));
    EXPECT_FALSE(ask("if(limit, thing, 1)").ok());
}

}  // namespace
}  // namespace vagus::run
