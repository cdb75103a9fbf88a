// Every limit: what lies at it is accepted, what lies beyond is an error, and no text costs more
// than it may.
#include "aesl/limits.hpp"

#include "aesl/test_node.hpp"
#include "base/rng.hpp"

namespace vagus::aesl {
namespace {

Target roomy() {
    Target target = test_target();
    target.bytecode_size = 65535;
    target.variables_size = 4096;
    target.stack_size = 4096;
    return target;
}

std::string first_code(const std::string& source) {
    const Compilation done = compile(source, roomy(), test_common(), {});
    return done.ok() ? "none" : done.errors[0].code;
}

TEST(Limits, SourceBytes) {
    EXPECT_EQ(first_code(std::string(kSourceBytesMax, ' ')), "none");
    EXPECT_EQ(first_code(std::string(kSourceBytesMax + 1, ' ')), "SCRIPT_TOO_BIG");
}

TEST(Limits, SourceLines) {
    EXPECT_EQ(first_code(std::string(kSourceLinesMax - 1, '\n')), "none");
    EXPECT_EQ(first_code(std::string(kSourceLinesMax, '\n')), "SCRIPT_TOO_BIG");
}

// The statement itself is one level.
TEST(Limits, NestingOfParenthesesBlocksAndSigns) {
    const int n = kNestingMax - 1;
    EXPECT_EQ(first_code("id = " + repeated("(", n) + "1" + repeated(")", n)), "none");
    EXPECT_EQ(first_code("id = " + repeated("(", n + 1) + "1" + repeated(")", n + 1)),
              "SCRIPT_TOO_BIG");
    EXPECT_EQ(first_code("id = " + repeated("~", n) + "id"), "none");
    EXPECT_EQ(first_code("id = " + repeated("~", n + 1) + "id"), "SCRIPT_TOO_BIG");
    EXPECT_EQ(first_code(repeated("if id == 1 then ", n + 1) + "id = 2" + repeated(" end", n + 1)),
              first_code(repeated("if id == 1 then ", n) + "id = 2" + repeated(" end", n)) == "none"
                  ? "SCRIPT_TOO_BIG"
                  : "none");
    EXPECT_EQ(first_code("id = " + repeated("prox[", n + 1)), "SCRIPT_TOO_BIG");
    EXPECT_EQ(first_code("id = " + repeated("[", 100000)), "SCRIPT_TOO_BIG");
    EXPECT_EQ(first_code(repeated("if id == 1 then ", 50000)), "SCRIPT_TOO_BIG");
    EXPECT_EQ(first_code(repeated("while id == 1 do ", 50000)), "SCRIPT_TOO_BIG");
    EXPECT_EQ(first_code(repeated("iff id == 1 then ", 50000)), "VARIABLE_NOT_DEFINED");
}

TEST(Limits, OperatorsInARow) {
    EXPECT_EQ(first_code("id = id" + repeated(" + id", kTreeDepthMax)), "none");
    EXPECT_EQ(first_code("id = id" + repeated(" + id", kTreeDepthMax + 1)), "SCRIPT_TOO_BIG");
    EXPECT_EQ(first_code("id = id" + repeated(" + id", 100000)), "SCRIPT_TOO_BIG");
}

TEST(Limits, ManyBranchesAndCallsInARowAreNoNesting) {
    const std::string chain = repeated("elseif id == 1 then id = 2 ", 5000);
    EXPECT_EQ(first_code("if id == 3 then id = 4 " + chain + "end"), "none");
    std::string subs = "callsub s0 ";
    for (int i = 0; i < 1500; ++i) {
        subs += "sub s" + std::to_string(i) + " callsub s" + std::to_string(i + 1) + "\n";
    }
    EXPECT_EQ(first_code(subs + "sub s1500 id = 1"), "none");
}

TEST(Limits, ErrorsReported) {
    const std::string line = "id = 1 / 0\n";
    EXPECT_EQ(compile_here(repeated(line, kErrorsMax)).errors.size(), kErrorsMax);
    EXPECT_EQ(compile_here(repeated(line, kErrorsMax + 1)).errors.size(), kErrorsMax);
    EXPECT_EQ(compile_here(repeated("$ ", 200000)).errors.size(), kErrorsMax);
    EXPECT_EQ(compile_here(repeated("id = 3 4\n", 30000)).errors.size(), kErrorsMax);
    std::string names;
    for (int i = 0; i < 30000; ++i) names += "call name" + std::to_string(i) + "()\n";
    EXPECT_EQ(compile_here(names).errors.size(), kErrorsMax);
    // One too many where a name is missing: nothing behind the end of the text is looked at.
    EXPECT_EQ(compile_here(repeated(line, kErrorsMax) + "var\nvar id2\n").errors.size(),
              kErrorsMax);
}

TEST(Limits, WarningsReported) {
    std::string source;
    for (size_t i = 0; i <= kWarningsMax; ++i) source += "sub s" + std::to_string(i) + "\n";
    EXPECT_EQ(compile_here(source).warnings.size(), kWarningsMax);
}

TEST(Limits, VariableMemoryAndWhatInstructionsReach) {
    const auto declared = [](int words) {
        return "var a[" + std::to_string(words) + "]\na[0] = 1";
    };
    EXPECT_EQ(errors_of(declared(160)), List{});
    EXPECT_EQ(errors_of(declared(161)), (List{"1:5 NOT_ENOUGH_SPACE"}));
    Target target = roomy();
    target.variables_size = 65535;
    EXPECT_TRUE(compile(declared(4056), target, test_common(), {}).ok());
    EXPECT_EQ(compile(declared(4057), target, test_common(), {}).errors[0].code,
              "NOT_ENOUGH_SPACE");
    target.variables.push_back({"huge", 4057});
    EXPECT_EQ(compile("", target, test_common(), {}).errors[0].code, "BROKEN_TARGET");
}

TEST(Limits, BytecodeSize) {
    Target target = test_target();
    target.bytecode_size = 6;
    EXPECT_TRUE(compile("id = 1", target, test_common(), {}).ok());
    target.bytecode_size = 5;
    const Compilation done = compile("id = 1", target, test_common(), {});
    EXPECT_EQ(done.errors[0].code, "SCRIPT_TOO_BIG");
    EXPECT_TRUE(done.program.bytecode.empty());
}

// 32767 elements declared, added, multiplied: refused, not unrolled without end.
TEST(Limits, HugeVectorsDoNotEatTheMachine) {
    EXPECT_EQ(first_code("var a[32767]\na = a * a"), "NOT_ENOUGH_SPACE");
    const std::string dead = "var v[1000]\nvar w[1000]\nif ZERO == 1 then\n" +
                             repeated("v = w + w * w - w\n", 20000) + "end\n";
    EXPECT_EQ(first_code(dead), "SCRIPT_TOO_BIG");
    const std::string list = "[" + repeated("w,", 10000) + "w]";
    EXPECT_EQ(first_code("var w[2000]\nw = " + list), "ARRAY_SIZE_MISMATCH");
    EXPECT_EQ(first_code("var w[2000]\n_emit report " + list), "NOT_ENOUGH_TEMP_SPACE");
    EXPECT_EQ(first_code("var w[4000] = [" + repeated("1,", 3999) + "1]"), "none");
}

TEST(Limits, LongNamesAreNoTrouble) {
    const std::string name(100000, 'n');
    EXPECT_EQ(first_code("var " + name + "\n" + name + " = 1"), "none");
    EXPECT_EQ(first_code("id = " + name + "\nvar " + name + "x"), "VARIABLE_NOT_DEFINED");
}

// A seeded storm of tokens: nothing to expect but that it ends and that each error has its place.
TEST(Limits, AnyRowOfTokensEnds) {
    constexpr uint64_t kSeed = 4711;
    constexpr std::string_view kPieces[] = {
        "if ",    "then ",   "else ",  "elseif ",  "end ",       "while ",  "do ",
        "for ",   "in ",     "step ",  "when ",    "onevent ",   "sub ",    "var ",
        "const ", "emit ",   "_emit ", "call ",    "callsub ",   "return ", "not ",
        "and ",   "or ",     "abs ",   "a ",       "v ",         "id ",     "prox ",
        "ping ",  "report ", "tick ",  "sys.nop ", "math.fill ", "LIMIT ",  "HUGE ",
        "( ",     ") ",      "[ ",     "] ",       ": ",         ", ",      "= ",
        "+= ",    "++ ",     "-- ",    "+ ",       "- ",         "* ",      "/ ",
        "% ",     "<< ",     "| ",     "== ",      "< ",         "! ",      "0 ",
        "1 ",     "32768 ",  "0x ",    "\n",       "ontimer ",   "args ",   "ontimer:\n",
        "#* ",    "*# ",     "# ",     "$ ",       "\xff"};
    SplitMix64 random(kSeed);
    for (int round = 0; round < 20000; ++round) {
        std::string source = random.below(2) == 0 ? "var a\nvar v[3]\n" : "";
        const uint64_t count = random.below(60);
        for (uint64_t i = 0; i < count; ++i) source += kPieces[random.below(std::size(kPieces))];
        const Compilation done = compile_here(source);
        for (const Diagnostic& d : done.errors) {
            ASSERT_GE(d.end, d.at) << "seed " << kSeed << ", round " << round;
            ASSERT_EQ(d.message.find('{'), d.message.npos) << d.message;
        }
        ASSERT_EQ(done.program.bytecode.empty(), !done.ok());
    }
}

}  // namespace
}  // namespace vagus::aesl
