// Findings about formulas and ranges, worked out by hand from docs/plans.md, section 5.
#include "plan/check.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vagus::plan {
namespace {

using testing::HasSubstr;

class OneFile final : public Files {
public:
    explicit OneFile(std::string text) : text_(std::move(text)) {}
    Result<std::string> read(const std::string&) const override { return text_; }

private:
    std::string text_;
};

const Library& library() {
    static const Library kLibrary = [] {
        Toolbox core{.name = "core"};
        core.templates = {
            {.name = "Assign",
             .kind = Kind::Computation,
             .inputs = {{.name = "value", .type = {}}},
             .outputs = {{.name = "result", .type = {}}},
             .outcomes = {{.name = "Done"}}},
            {.name = "Drive",
             .inputs = {{.name = "speed",
                         .type = Type::Int,
                         .fallback = Value(int64_t{0}),
                         .low = -200,
                         .high = 200},
                        {.name = "distance",
                         .type = Type::Float,
                         .fallback = Value(1.0),
                         .unit = "cm",
                         .low = 0},
                        {.name = "share", .type = Type::Float, .fallback = Value(1.0), .high = 1},
                        {.name = "word", .type = Type::String, .fallback = Value(std::string())}},
             .outcomes = {{.name = "Done"}}}};
        Library made;
        made.add(std::move(core));
        return made;
    }();
    return kLibrary;
}

// One actor of that template, its input fed with the JSON; variables of each type beside it.
Findings check_input(std::string_view actor, std::string_view input, std::string_view json,
                     std::string_view output = R"("result": "r")") {
    const std::string out =
        actor == "Assign" ? fmt::format(R"(, "out": {{ {} }})", output) : std::string();
    return check("p.plan.json",
                 OneFile(fmt::format(R"json({{
  "format": "vagus-plan/1",
  "name": "P",
  "configuration": {{
    "i": {{ "type": "int", "initial": 7 }},
    "f": {{ "type": "float", "initial": 2.5 }},
    "b": {{ "type": "bool", "initial": true }},
    "o": {{ "type": "object", "access": "in" }},
    "r": {{ "type": "int", "initial": 0, "access": "out" }},
    "t": {{ "type": "bool", "initial": false, "access": "out" }}
  }},
  "start": {{ "actor": "a" }},
  "actors": {{
    "a": {{ "template": "{}", "in": {{ "{}": {} }}{}, "states": {{ "Done": "use" }} }},
    "use": {{ "template": "Drive", "in": {{ "word": "i & f & b & (o == o)" }},
      "states": {{ "Done": "@terminate" }} }}
  }}
}})json",
                                     actor, input, json, out)),
                 library())
        .findings;
}

// "P8", "W4", "P8 P11"; empty if there is nothing.
std::string rules_of(const Findings& findings) {
    std::string rules;
    for (const Finding& finding : findings) rules += (rules.empty() ? "" : " ") + finding.rule;
    return rules;
}

std::string rules_for(std::string_view formula) {
    return rules_of(check_input("Assign", "value", fmt::format("\"{}\"", formula)));
}

TEST(CheckFormula, TakesComparisonsWordsAndFunctions) {
    for (const char* formula : {"i > f", "i and b or not f", "if(b, i, 0)", "round(f * 2)",
                                "clamp(i, 0, 5)", "o == o", "sign(sin(f))"}) {
        EXPECT_EQ(rules_for(formula), "") << formula;
    }
}

TEST(CheckFormula, SyntaxIsP8AndAnObjectAsOperandP11) {
    for (const char* formula :
         {"i = 3", "i && b", "!b", "foo(1)", "abs()", "i > 3 > 2", "zz + 1"}) {
        EXPECT_EQ(rules_for(formula), "P8") << formula;
    }
    for (const char* formula : {"o > 1", "not o", "if(b, o, 1)", "abs(o)", "o"}) {
        EXPECT_EQ(rules_for(formula), "P11") << formula;
    }
}

// P11 is for formulas without variables; what a variable may bring is seen at run time.
TEST(CheckFormula, AConstantOneThatFailsIsP11) {
    for (const char* formula : {"clamp(1, 3, 2)", "sqrt(-1)", "tan(90)", "1 / 0", "'x' and true",
                                "if('x', 1, 2)", "floor(1e300)"}) {
        EXPECT_EQ(rules_for(formula), "P11") << formula;
    }
    for (const char* formula :
         {"clamp(i, 3, 2)", "floor(sqrt(i - 100))", "false and 1 / 0", "b or 'x'"}) {
        EXPECT_EQ(rules_for(formula), "") << formula;
    }
}

// The output of Assign is of the type of its formula: float to int is W4, also where `if` makes it
// a float; a bool into an int is none.
TEST(CheckFormula, TypesOfFunctionsAndIfCountForConversions) {
    EXPECT_EQ(rules_for("f"), "W4");
    EXPECT_EQ(rules_for("floor(f)"), "");
    EXPECT_EQ(rules_for("abs(f)"), "W4");
    EXPECT_EQ(rules_for("abs(i)"), "");
    EXPECT_EQ(rules_for("sqrt(i)"), "W4");
    EXPECT_EQ(rules_for("if(b, i, f)"), "W4");
    EXPECT_EQ(rules_for("if(b, i, 1)"), "");
    EXPECT_EQ(rules_for("if(b, 'x', i)"), "W4");
    EXPECT_EQ(rules_for("i > f"), "");
    EXPECT_EQ(rules_for("f and b"), "");
}

TEST(CheckFormula, SuggestsWhatWasMeant) {
    const std::tuple<std::string_view, std::string_view> cases[] = {
        {"TRUE and b", "did you mean \\\"true\\\"?"},
        {"abs + 1", "the function is written abs(x)"},
        {"flor(f)", "did you mean \\\"floor\\\"?"},
        {"i = 3", "write == to compare"}};
    for (const auto& [formula, part] : cases) {
        const Findings findings = check_input("Assign", "value", fmt::format("\"{}\"", formula));
        ASSERT_EQ(rules_of(findings), "P8") << formula;
        std::string wanted(part);
        std::erase(wanted, '\\');
        EXPECT_THAT(findings[0].message, HasSubstr(wanted));
    }
}

TEST(CheckFormula, SaysThatAUnitIsNotWritten) {
    const Findings cm = check_input("Drive", "distance", "\"50 cm\"");
    ASSERT_EQ(rules_of(cm), "P8");
    EXPECT_EQ(cm[0].message,
              "the formula for \"distance\": expected an operator or the end at position 4, found "
              "\"cm\"; write the number without its unit, it counts in cm already");
    // Another unit is another number: nothing is promised.
    const Findings inch = check_input("Drive", "distance", "\"50 inch\"");
    ASSERT_EQ(rules_of(inch), "P8");
    EXPECT_TRUE(inch[0].message.ends_with("found \"inch\"")) << inch[0].message;
}

TEST(CheckOutput, NamesOneVariableThatIsNoWord) {
    for (const char* name : {"true", "false", "and", "or", "not", "r + 1", "r ", ""}) {
        EXPECT_EQ(
            rules_of(check_input("Assign", "value", "1", fmt::format(R"("result": "{}")", name))),
            "P13")
            << name;
    }
}

// ---- ranges ----

TEST(CheckRange, AConstantOutsideIsP11) {
    const std::tuple<std::string_view, std::string_view, std::string_view> cases[] = {
        {"speed", "201", "P11"},       {"speed", "200", ""},
        {"speed", "-200", ""},         {"speed", "\"-100 * 3\"", "P11"},
        {"speed", "200.4", ""},        {"speed", "200.5", "P11"},
        {"speed", "\"'300'\"", "P11"}, {"speed", "\"i * 100\"", ""},
        {"speed", "true", ""},         {"distance", "-0.5", "P11"},
        {"distance", "1e9", ""},       {"share", "1.5", "P11"},
        {"share", "-1e9", ""}};
    for (const auto& [input, json, rules] : cases) {
        EXPECT_EQ(rules_of(check_input("Drive", input, json)), rules) << input << " " << json;
    }
}

TEST(CheckRange, TheSentenceNamesTheInputTheRangeAndTheValue) {
    const auto message = [](std::string_view input, std::string_view json) {
        return check_input("Drive", input, json).at(0).message;
    };
    EXPECT_EQ(message("speed", "201"), "the input \"speed\" must be from -200 to 200, but is 201");
    EXPECT_EQ(message("distance", "-0.5"),
              "the input \"distance\" must be at least 0, but is -0.5");
    EXPECT_EQ(message("share", "1.5"), "the input \"share\" must be at most 1, but is 1.5");
}

}  // namespace
}  // namespace vagus::plan
