// Several mistakes in one text: each is reported, at its place, and none twice.
#include "aesl/test_node.hpp"
#include "base/rng.hpp"

namespace vagus::aesl {
namespace {

TEST(Recovery, EachOfSixMistakesIsReportedOnce) {
    EXPECT_EQ(errors_of("var speed = 1\n"
                        "var v[3]\n"
                        "speed = sped + 1\n"  // misspelt variable
                        "if speed == 1\n"     // no `then`
                        "  speed = 2\n"
                        "end\n"
                        "v = 3 * \n"          // no operand
                        "onevent tik\n"       // misspelt event
                        "emit triple v[0]\n"  // wrong size
                        "v[3] = 1\n"          // out of bounds
                        "onevent button\n"
                        "speed = 2\n"),
              (List{"3:9 VARIABLE_NOT_DEFINED_GUESS", "5:3 EXPECTING", "8:1 EXPECTING_ONE_OF",
                    "8:9 EVENT_NOT_DEFINED_GUESS", "9:1 EVENT_WRONG_ARG_SIZE",
                    "10:1 ARRAY_OUT_OF_BOUND"}));
}

TEST(Recovery, ErrorsStandInTheOrderOfTheTextAndTheFirstIsThatOfTheEarliestPhase) {
    const std::string source =
        "var v[2]\n"
        "callsub nope\n"
        "v = 1\n"
        "emit nothing\n"
        "v[0] = $ 3\n";
    EXPECT_EQ(errors_of(source), (List{"2:1 SUBROUTINE_NOT_DEFINED", "3:3 ARRAY_SIZE_MISMATCH",
                                       "4:6 EVENT_NOT_DEFINED", "5:8 INVALID_IDENTIFIER"}));
    EXPECT_EQ(first_error_of(source), "5:8 INVALID_IDENTIFIER");
}

TEST(Recovery, AnUnknownNameIsReportedOnceHoweverOftenItIsUsed) {
    EXPECT_EQ(errors_of("onevent tick\nspeed = 1\nspeed++\nmotor.left = speed * speed\n"
                        "if speed > 3 then speed[2] = 0 end\n"),
              (List{"2:1 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("emit nothing\nemit nothing 3\nonevent nothing\ncallsub no\ncallsub no\n"),
              (List{"1:6 EVENT_NOT_DEFINED", "4:1 SUBROUTINE_NOT_DEFINED"}));
}

TEST(Recovery, ADeclarationWithAMistakeStillDeclares) {
    EXPECT_EQ(errors_of("const K = prox[0]\nvar a[0]\nvar b = [1,2]\nvar c[K]\n"
                        "a = [1,2]\nb = K\nc[3] = a[1]\n"),
              (List{"1:7 NOT_CONST_EXPR", "2:6 SIZE_IS_NULL", "3:7 ARRAY_SIZE_MISMATCH"}));
    EXPECT_EQ(errors_of("motor.left = 1\nvar a = 2\nmotor.left = a\n"),
              (List{"2:1 MISPLACED_VARDEF"}));
    EXPECT_EQ(errors_of("var a\nconst K = 2\nvar b = K\na = b\n"), (List{"2:1 EXPECTING"}));
}

TEST(Recovery, AWordThatShouldDeclareIsOneMistake) {
    EXPECT_EQ(errors_of("vra speed = 3\nvar b = 1\nspeed = b\n"),
              (List{"1:1 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("int speed = 3\nvar b = 1\nspeed = b\n"),
              (List{"1:1 VARIABLE_NOT_DEFINED"}));
}

TEST(Recovery, AMisspeltKeywordIsOneMistakeAlsoWhereItOpensABlock) {
    EXPECT_EQ(
        errors_of("iff id == 1 then\nmotor.left = 1\nelse\nmotor.left = 2\nend\nmotor.right = 3\n"),
        (List{"1:1 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("onevent tick\nWhile id < 3 do\nmotor.left++\nend\nonevent button\n"),
              (List{"2:1 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("onevnt tick\nmotor.left = 1\n"), (List{"1:1 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(
        errors_of("if id == 1 then\nmotor.left = 1\nesle\nmotor.left = 2\nend\nmotor.left++\n"),
        (List{"3:1 VARIABLE_NOT_DEFINED"}));
}

TEST(Recovery, AMissingEndIsOneMistake) {
    EXPECT_EQ(errors_of("onevent tick\nif id == 1 then\nwhile id > 3 do\nmotor.left = 1\n"
                        "onevent button\nmotor.left = 2\n"),
              (List{"5:1 EXPECTING"}));
    EXPECT_EQ(errors_of("if id == 1 then\nwhile id > 3 do\nmotor.left++\n"),
              (List{"4:1 EXPECTING"}));
    EXPECT_EQ(errors_of("if id == 1 then\nonevent tick\nmotor.left = 1\nend\n"),
              (List{"2:1 EXPECTING"}));
    EXPECT_EQ(
        errors_of("if id == 1 then\nwhile id == 2 do\nmotor.left++\nelse\nmotor.left = 0\nend\n"),
        (List{"4:1 EXPECTING"}));
}

TEST(Recovery, AWrongHeadKeepsItsBlock) {
    EXPECT_EQ(errors_of("if id = 1 then\nmotor.left = 1\nend\nmotor.left++\n"),
              (List{"1:7 EXPECTING"}));
    EXPECT_EQ(errors_of("while id > do\nmotor.left = 1\nend\nmotor.left++\n"),
              (List{"1:12 EXPECTING_ONE_OF"}));
    EXPECT_EQ(errors_of("for i = 0:3 do\nmotor.left = i\nend\n"),
              (List{"1:5 VARIABLE_NOT_DEFINED", "1:7 EXPECTING"}));
    EXPECT_EQ(errors_of("if id == 1 do\nmotor.left = 1\nelseif id == 2 do\nmotor.left = 2\nend\n"),
              (List{"1:12 EXPECTING", "3:16 EXPECTING"}));
    EXPECT_EQ(errors_of("when id == 1\nmotor.left = 1\nend\n"), (List{"2:1 EXPECTING"}));
}

TEST(Recovery, ACharacterThatMeansNothingIsOneMistake) {
    EXPECT_EQ(errors_of("var a = 1;\na = 2;\na++;\ncall sys.nop();\n").size(), 4u);
    EXPECT_EQ(errors_of("var a$ = 1\na = a$ + 2\n").size(), 2u);
    EXPECT_EQ(errors_of("var a\nif a == 1 && a == 2 then a = 2 end\n"),
              (List{"2:12 EXPECTING_ONE_OF"}));
    EXPECT_EQ(errors_of("var a\nif a == 1 { a = 2 }\nend\n").size(), 2u);
}

TEST(Recovery, ABrokenCallOrEmitIsOneMistake) {
    EXPECT_EQ(errors_of("call math.fill prox, 1\nmotor.left = 1\n"), (List{"1:16 EXPECTING"}));
    EXPECT_EQ(errors_of("call math.fill(prox 1)\nmotor.left = 1\n"), (List{"1:21 EXPECTING"}));
    EXPECT_EQ(errors_of("call math.fill(prox, 1\nmotor.left = 1\n"), (List{"2:1 EXPECTING"}));
    EXPECT_EQ(errors_of("math.fill(prox, 1)\nmotor.left = 1\n"),
              (List{"1:1 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("call mathfill(prox, nope)\nmotor.left = 1\n"),
              (List{"1:1 FUNCTION_NOT_DEFINED_GUESS", "1:21 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("emit ping 3\nemit report\nmotor.left = 1\n"),
              (List{"1:11 EXPECTING", "3:12 EXPECTING"}));
}

TEST(Recovery, HabitsOfOtherLanguagesAreOneMistakeEach) {
    EXPECT_EQ(errors_of("onevent tick do\nmotor.left = 1\nend\nonevent button\nmotor.left = 2\n"),
              (List{"1:14 EXPECTING"}));
    EXPECT_EQ(errors_of("callsub turn(3)\nsub turn()\nmotor.left = 1\n"),
              (List{"1:13 EXPECTING", "2:9 EXPECTING"}));
    EXPECT_EQ(errors_of("call turn(1)\ncall turn(2)\nmotor.left = 1\n"),
              (List{"1:1 FUNCTION_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("motor.left = true\nmotor.left = true\n"),
              (List{"1:14 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("// turn left\nmotor.left = 1\n"), (List{"1:1 EXPECTING"}));
}

// Lines without a mistake, and lines with exactly one, which does not spread to other lines.
constexpr std::string_view kSound[] = {
    "a = a + 1",
    "if a == 1 then b = 2 else b = 3 end",
    "when b > 2 do emit report a end",
    "while a < 3 do a++ end",
    "for i in 0:9 do v[i % 3] = i end",
    "v = v + [1,2,3]",
    "call math.fill(v, 3)",
    "emit triple v",
};

struct Mistake {
    std::string_view line;
    int column;
    std::string_view code;
};

constexpr Mistake kMistakes[] = {
    {"a = zzzzzz + 1", 5, "VARIABLE_NOT_DEFINED"},
    {"a = bb1 + 1", 5, "VARIABLE_NOT_DEFINED_GUESS"},
    {"v = a", 3, "ARRAY_SIZE_MISMATCH"},
    {"v[3] = 1", 1, "ARRAY_OUT_OF_BOUND"},
    {"a = 1 / 0", 7, "DIVISION_BY_ZERO"},
    {"a = (b == 1)", 3, "EXPECTING_TYPE"},
    {"if a then b = 1 end", 1, "EXPECTING_TYPE"},
    {"a + 1 = 2", 7, "INCORRECT_LEFT_VALUE"},
    {"a b", 3, "EXPECTING_ASSIGNMENT"},
    {"a == 1", 3, "EXPECTING_ASSIGNMENT"},
    {"a = 3 3", 7, "EXPECTING"},
    {"a = +3", 5, "EXPECTING_ONE_OF"},
    {"a = [1,]", 8, "EXPECTING_ONE_OF"},
    {"a = 40000", 5, "INT16_OUT_OF_RANGE"},
    {"a = 0xg", 5, "INVALID_HEXA_NUMBER"},
    {"a = 3 ? 4", 7, "INVALID_IDENTIFIER"},
    {"emit tick", 6, "EMIT_LOCAL_EVENT"},
    {"emit triple a", 1, "EVENT_WRONG_ARG_SIZE"},
    {"emit report 1 + ", 17, "EXPECTING_ONE_OF"},
    {"call math.fill(v)", 17, "FUNCTION_NO_ENOUGH_ARG"},
    {"call math.fill(v, 1, 2)", 20, "FUNCTION_TOO_MANY_ARG"},
    {"call math.copy(v, a)", 19, "FUNCTION_WRONG_ARG_SIZE_TEMPLATE"},
    {"call sys.nop(3)", 14, "FUNCTION_HAS_NO_ARG"},
    {"for i in 5:0 do a = i end", 10, "FOR_START_HIGHER_THAN_END"},
    {"for i in 0:a do b = i end", 12, "CONSTANT_NOT_DEFINED"},
    {"while 1 == 1 do a++ end", 1, "INFINITE_LOOP"},
    {"a = v[0:a]", 8, "INDEX_EXPECTING_CONSTANT"},
    {"a = v[2:1]", 10, "INDEX_WRONG_END"},
    {"if a = 1 then b = 2 end", 6, "EXPECTING"},
    {"end", 1, "EXPECTING"},
    {"var later", 1, "MISPLACED_VARDEF"},
    {"const LATER = 1", 1, "EXPECTING"},
};

// Random programs in which we know every mistake: the compiler must find these and no others.
TEST(Recovery, ProgramsWithKnownMistakesGiveTheseErrorsAndNoOthers) {
    constexpr uint64_t kSeed = 20070101;
    SplitMix64 random(kSeed);
    for (int round = 0; round < 2000; ++round) {
        std::string source = "var a = 1\nvar b = 2\nvar v[3]\nvar i\nonevent tick\n";
        List expected;
        bool has_unknown = false;
        const int lines = 5 + static_cast<int>(random.below(20));
        for (int line = 6; line < 6 + lines; ++line) {
            const Mistake& mistake = kMistakes[random.below(std::size(kMistakes))];
            // An unknown name is reported once; `1 +` at the end of a line takes the next line in.
            const bool is_unknown = mistake.line.find("zzzzzz") != mistake.line.npos ||
                                    mistake.line.find("bb1") != mistake.line.npos;
            const bool runs_on = mistake.line.ends_with("+ ");
            const bool is_wrong =
                random.below(3) == 0 && !(is_unknown && has_unknown) && !runs_on &&
                (mistake.line.find("LATER") == mistake.line.npos || round % 7 == 0);
            const bool declares =
                mistake.line.starts_with("var") || mistake.line.starts_with("const");
            if (!is_wrong || (declares && source.find(mistake.line) != source.npos)) {
                source += std::string(kSound[random.below(std::size(kSound))]) + "\n";
                continue;
            }
            has_unknown = has_unknown || is_unknown;
            source += std::string(mistake.line) + "\n";
            expected.push_back(std::to_string(line) + ":" + std::to_string(mistake.column) + " " +
                               std::string(mistake.code));
        }
        List found = errors_of(source);
        std::sort(found.begin(), found.end());
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(found, expected) << "seed " << kSeed << ", round " << round << "\n" << source;
    }
}

}  // namespace
}  // namespace vagus::aesl
