// The compiler by small programs: what they become, worked out by hand from chapters 1 to 4 of the
// specification.
#include "aesl/compile.hpp"

#include "aesl/parse.hpp"
#include "aesl/test_node.hpp"

namespace vagus::aesl {
namespace {

using Words = std::vector<uint16_t>;

// The words behind the event table of a program that is initialisation only.
Words init_words(std::string_view source) {
    const Compilation done = compile_here(source);
    EXPECT_TRUE(done.ok()) << done.errors[0].message;
    if (!done.ok() || done.program.bytecode.size() < 3) return {};
    return {done.program.bytecode.begin() + 3, done.program.bytecode.end()};
}

// The worked example of section 4.10.
TEST(Compile, TheWorkedExampleOfTheSpecification) {
    const Compilation done = compile_here(
        "var n = 0\nvar v[3] = [1, 2, 3]\nonevent tick\nn += 1\nv = v + [n, n, n]\n"
        "when v[n % 3] > 9 or n == 7 do\n\temit report n * 2\nend\ncallsub clear\nsub clear\n"
        "if n > 9 then n = 0 end\n");
    ASSERT_TRUE(done.ok());
    EXPECT_EQ(done.program.bytecode,
              (Words{0x0005, 0xfffe, 0x0005, 0xffff, 0x0030, 0x3028, 0x1001, 0x8002, 0x4028, 0x3029,
                     0x3028, 0x8002, 0x40c5, 0x302a, 0x3028, 0x8002, 0x40c6, 0x302b, 0x3028, 0x8002,
                     0x40c7, 0x30c5, 0x4029, 0x30c6, 0x402a, 0x30c7, 0x402b, 0x3028, 0x1003, 0x8006,
                     0x5029, 0x0003, 0x1009, 0x800c, 0x3028, 0x1007, 0x800a, 0xa110, 0x0009, 0x3028,
                     0x1001, 0x8000, 0x40c7, 0xb001, 0x00c7, 0x0001, 0xd039, 0x0000, 0x1000, 0x4028,
                     0x1001, 0x4029, 0x1002, 0x402a, 0x1003, 0x402b, 0x0000, 0x3028, 0x1009, 0xa00c,
                     0x0004, 0x1000, 0x4028, 0xe000}));
    EXPECT_EQ(done.program.lines,
              (Words{0, 0, 0, 0, 0, 4, 4, 4, 4, 5, 5, 5, 5, 5,  5,  5,  5,  5,  5,  5, 5, 5,
                     5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 6, 6,  6,  6,  6,  7,  7,  7, 7, 7,
                     7, 7, 9, 9, 1, 1, 2, 2, 2, 2, 2, 2, 2, 11, 11, 11, 11, 11, 11, 11}));
    // 40 words of the node, n, v, and three temporaries; the deepest is v[…] > 9 or n == 7 with
    // three words.
    EXPECT_EQ(done.program.used.bytecode, 64);
    EXPECT_EQ(done.program.used.variables, 47);
    EXPECT_EQ(done.program.used.stack, 3);
    ASSERT_EQ(done.program.subroutines.size(), 1u);
    EXPECT_EQ(done.program.subroutines[0].name, "clear");
    EXPECT_EQ(done.program.subroutines[0].address, 57);
    EXPECT_EQ(done.program.subroutines[0].line, 10);
    ASSERT_EQ(done.program.variables.size(), 8u);
    EXPECT_EQ(done.program.variables[7].name, "v");
    EXPECT_EQ(done.program.variables[7].address, 41);
    EXPECT_EQ(done.program.variables[7].size, 3);
}

TEST(Compile, AnEmptyProgramIsOneWord) {
    EXPECT_EQ(compile_here("").program.bytecode, Words{1});
    EXPECT_EQ(compile_here("onevent tick\nonevent ping\n").program.bytecode, Words{1});
    EXPECT_EQ(compile_here("if 1 == 2 then id = 1 end").program.bytecode, Words{1});
}

TEST(Compile, TheEventTableIsSortedByIdAndTheInitialisationIsLast) {
    const Compilation done = compile_here(
        "id = 1\nonevent button\nid = 2\nonevent report\nid = 3\nonevent tick\nid = 4\nonevent "
        "ping\nid = 5\n");
    ASSERT_TRUE(done.ok());
    const Words table(done.program.bytecode.begin(), done.program.bytecode.begin() + 11);
    EXPECT_EQ(table, (Words{11, 0, 11, 1, 14, 0xfffd, 17, 0xfffe, 20, 0xffff, 23}));
}

// Columns count code points; tabs count one; comments, signs of two characters and the end of the
// text are no exception.
TEST(Compile, ColumnsCountCodePoints) {
    EXPECT_EQ(errors_of("var ä\n# ö\n\tä = é\n"), (List{"3:6 VARIABLE_NOT_DEFINED"}));
    EXPECT_EQ(errors_of("id = id << [1,2]"), (List{"1:9 ARRAY_SIZE_MISMATCH"}));
    EXPECT_EQ(errors_of("#*\tä\n*# id = $"), (List{"2:9 INVALID_IDENTIFIER"}));
    EXPECT_EQ(errors_of("id = \n"), (List{"2:1 EXPECTING_ONE_OF"}));
    EXPECT_EQ(errors_of("id = "), (List{"1:6 EXPECTING_ONE_OF"}));
    EXPECT_EQ(errors_of("id = 1\r\nid = $\r\n"), (List{"2:6 INVALID_IDENTIFIER"}));
}

TEST(Compile, MalformedUtf8IsAnErrorAtItsFirstByte) {
    EXPECT_EQ(errors_of("id = 1 \xc3(\n"), (List{"1:8 INVALID_IDENTIFIER"}));
    EXPECT_EQ(errors_of("var \xf0\x9d\x94\xb8 = 1\nid = \xf0\x9d\x94\xb8"),
              List{});                                  // a letter above U+FFFF
    EXPECT_EQ(errors_of("# \xff\nid = 1").size(), 0u);  // in a comment nobody reads it
    EXPECT_EQ(errors_of(std::string_view("id = 1\0", 7)), (List{"1:7 INVALID_IDENTIFIER"}));
}

TEST(Compile, LettersAreThoseOfUnicode) {
    EXPECT_EQ(errors_of("var \xe0\xa4\x95\xe0\xa4\xbe = 1\nid = \xe0\xa4\x95\xe0\xa4\xbe"),
              List{});                                                        // ka + vowel sign
    EXPECT_EQ(errors_of("var \xe2\x85\xb7 = 1\nid = \xe2\x85\xb7"), List{});  // ⅷ
    EXPECT_EQ(errors_of("var a\xcc\x81 = 1").size(), 1u);                     // U+0301
}

TEST(Compile, PrefixesWithoutDigitsAreErrors) {
    EXPECT_EQ(errors_of("id = 0x"), (List{"1:6 INVALID_HEXA_NUMBER"}));
    EXPECT_EQ(errors_of("id = 0b"), (List{"1:6 INVALID_BINARY_NUMBER"}));
    EXPECT_EQ(errors_of("id = 99999x"), (List{"1:6 IN_NUMBER"}));
    EXPECT_EQ(errors_of("id = 0x1ffffg"), (List{"1:6 INVALID_HEXA_NUMBER"}));
}

// Exact: max(left, 1 + right). Right-leaning sums need one word a level.
TEST(Compile, StackDepthIsExact) {
    std::string flat = "id = id";
    for (int i = 0; i < 100; ++i) flat += " + id";
    EXPECT_EQ(compile_here(flat).program.used.stack, 2);
    EXPECT_EQ(compile_here("id = id / (id / (id / id))").program.used.stack, 4);
    EXPECT_EQ(compile_here("prox[id] = id").program.used.stack, 2);
    EXPECT_EQ(compile_here("prox[id + id] = id + id").program.used.stack, 3);
    // Two sizes, two addresses.
    EXPECT_EQ(compile_here("call sys.sum(id, prox)").program.used.stack, 3);
    // Return address, return address, two words.
    EXPECT_EQ(compile_here("callsub a\nsub a\ncallsub b\nsub b\nid = id / id").program.used.stack,
              4);
}

TEST(Compile, TheDeepestStackThatFitsIsAcceptedAndOneMoreIsNot) {
    Target target = test_target();
    target.stack_size = 4;
    const std::string fits = "id = id / (id / (id / id))";
    const std::string deeper = "id = id / (id / (id / (id / id)))";
    EXPECT_TRUE(compile(fits, target, test_common(), {}).ok());
    EXPECT_FALSE(compile(deeper, target, test_common(), {}).ok());
}

TEST(Compile, TemporariesAreFreeAgainAfterEachStatement) {
    Target target = test_target();
    target.variables_size = 43;
    std::string source;
    for (int i = 0; i < 20; ++i)
        source += "emit triple [id, id, id]\nif id == 1 then emit triple [1, 2, 3] end\n";
    const Compilation done = compile(source, target, test_common(), {});
    ASSERT_TRUE(done.ok());
    EXPECT_EQ(done.program.used.variables, 43);
    target.variables_size = 42;
    EXPECT_EQ(compile(source, target, test_common(), {}).errors[0].code, "NOT_ENOUGH_TEMP_SPACE");
}

TEST(Compile, EverySubEndsWithAReturnUnlessItsEndCannotBeReached) {
    const Compilation done =
        compile_here("callsub a\nsub a\nif id == 1 then return end\nsub b\nid = 1\nreturn\n");
    ASSERT_TRUE(done.ok());
    const Words code(done.program.bytecode.begin() + 3, done.program.bytecode.end());
    // SubCall 5, Stop; id == 1 → SubRet, SubRet; id = 1, SubRet.
    EXPECT_EQ(code, (Words{0xd005, 0, 0x3000, 0x1001, 0xa00a, 3, 0xe000, 0xe000, 0x1001, 0x4000,
                           0xe000}));
}

// 1100 assignments of two words are 2200: beyond the reach of JUMP. A branch on 0 == 1 goes
// instead.
TEST(Compile, AFarJumpIsABranchThatIsNeverTaken) {
    Target target = test_target();
    target.bytecode_size = 6000;
    std::string block;
    for (int i = 0; i < 1100; ++i) block += "id = 1\n";
    const Compilation done =
        compile("if id == 1 then id = 2 else\n" + block + "end\n", target, test_common(), {});
    ASSERT_TRUE(done.ok());
    const Words start(done.program.bytecode.begin() + 3, done.program.bytecode.begin() + 13);
    // The branch for `else` passes 2 + 2 + 4 words; the long one, at 11, passes itself and 2200
    // words.
    EXPECT_EQ(start,
              (Words{0x3000, 0x1001, 0xa00a, 8, 0x1002, 0x4000, 0x1000, 0x1001, 0xa00a, 2202}));
    EXPECT_EQ(done.program.used.stack, 2);

    const Compilation loop =
        compile("while id == 1 do\n" + block + "end\n", target, test_common(), {});
    ASSERT_TRUE(loop.ok());
    const Words& words = loop.program.bytecode;
    // Back from word 2209 to word 3.
    EXPECT_EQ(Words(words.end() - 5, words.end()),
              (Words{0x1000, 0x1001, 0xa00a, static_cast<uint16_t>(3 - 2209), 0}));
    EXPECT_EQ(words[6], 2 + 2200 + 4);
}

// The longest branch that JUMP reaches: a distance of 2047, which is an else part of 2046 words.
TEST(Compile, ANearJumpStaysOneWord) {
    Target target = test_target();
    target.bytecode_size = 6000;
    std::string block;
    for (int i = 0; i < 1023; ++i) block += "id = 1\n";
    const auto words = [&](const std::string& source) {
        return compile(source, target, test_common(), {}).program.bytecode;
    };
    EXPECT_EQ(words("if id == 1 then id = 2 else\n" + block + "end\n")[9], 0x97ff);
    EXPECT_EQ(words("if id == 1 then id = 2 else\n" + block + "callsub s end sub s id = 1\n")[9],
              0x1000);
}

TEST(Compile, FoldingHas32BitsAndDivisionByAPowerOfTwoIsAShift) {
    EXPECT_EQ(init_words("id = 30000 + 30000"), (Words{0x2000, 0xea60, 0x4000, 0}));
    EXPECT_EQ(init_words("id = (30000 * 4) / 8"), (Words{0x2000, 15000, 0x4000, 0}));
    EXPECT_EQ(init_words("id /= 2"), (Words{0x3000, 0x1001, 0x8001, 0x4000, 0}));
    EXPECT_EQ(init_words("id = id / -2"), (Words{0x3000, 0x1ffe, 0x8005, 0x4000, 0}));
    EXPECT_EQ(init_words("id = id * 0 + id * 1"), (Words{0x3000, 0x4000, 0}));
    EXPECT_EQ(init_words("id = (1 << 30) + (1 << 30) >> 31"), (Words{0x1fff, 0x4000, 0}));
    EXPECT_EQ(init_words("id = (1 << 30) * -2 / -1"), (Words{0x2000, 0, 0x4000, 0}));
    EXPECT_EQ(init_words("id = (1 << 30) * -2 % -1"), (Words{0x1000, 0x4000, 0}));
}

// Measured on the reference: a written `else` keeps its jump, an `elseif` that folds away does not.
TEST(Compile, AnElseIfThatFoldsAwayLeavesNoJump) {
    const Words alone = {0x3000, 0x1001, 0xa00a, 4, 0x1001, 0x4000, 0};
    EXPECT_EQ(init_words("if id == 1 then id = 1 elseif 1 == 2 then id = 2 end"), alone);
    EXPECT_EQ(init_words("if id == 1 then id = 1 elseif id == 2 then end"), alone);
    EXPECT_EQ(init_words("if id == 1 then id = 1 else end"),
              (Words{0x3000, 0x1001, 0xa00a, 5, 0x1001, 0x4000, 0x9001, 0}));
}

TEST(Compile, NotTurnsConditionsRound) {
    // not (id < 1 and source == 2)  →  id >= 1 or source != 2
    EXPECT_EQ(
        init_words("if not (id < 1 and event.source == 2) then id = 1 end"),
        (Words{0x3000, 0x1001, 0x800d, 0x3001, 0x1002, 0x800b, 0xa010, 4, 0x1001, 0x4000, 0}));
    EXPECT_EQ(init_words("if not not id == 1 then id = 1 end"),
              (Words{0x3000, 0x1001, 0xa00a, 4, 0x1001, 0x4000, 0}));
}

// Where the reference checks no types, a condition is 0 or 1 (section 3.4).
TEST(Compile, AConditionCountsAsNumberWhereTypesAreNotChecked) {
    EXPECT_EQ(init_words("emit report (id == 1)"),
              (Words{0x3000, 0x1001, 0x800a, 0x40c7, 0xb001, 199, 1, 0}));
    EXPECT_EQ(init_words("id = prox[(not id == 1)]"),
              (Words{0x3000, 0x1001, 0x800b, 0x5022, 4, 0x4000, 0}));
    EXPECT_EQ(errors_of("id = prox[(not id)]"), (List{"1:12 EXPECTING_TYPE"}));
    EXPECT_EQ(errors_of("id = [(id == 1)]"), (List{"1:4 EXPECTING_TYPE"}));
    EXPECT_EQ(errors_of("const K = (1 == 1)\nvar v[K + 1]\nv[1] = 1"), List{});
}

TEST(Compile, AVectorIsNoConstantAndNoIndex) {
    EXPECT_EQ(errors_of("const K = [7, 8]"), (List{"1:7 NOT_CONST_EXPR"}));
    EXPECT_EQ(errors_of("const K = [1, 2] + [1]"), (List{"1:7 NOT_CONST_EXPR"}));
    EXPECT_EQ(errors_of("const K = [7]\nvar v[K] = [1,2,3,4,5,6,7]\nid = v[[3]]"), List{});
    EXPECT_EQ(errors_of("id = prox[prox]"), (List{"1:6 ARRAY_ILLEGAL_ACCESS"}));
    EXPECT_EQ(errors_of("id = prox[[id, id]]"), (List{"1:6 ARRAY_ILLEGAL_ACCESS"}));
    EXPECT_EQ(errors_of("id = prox[[1,2] + [1]]"), (List{"1:6 ARRAY_ILLEGAL_ACCESS"}));
}

TEST(Compile, OrderInsidePhaseTwo) {
    EXPECT_EQ(first_error_of("var id[0"), "1:7 SIZE_IS_NULL");
    EXPECT_EQ(first_error_of("var LIMIT[] = nope_nope"), "1:5 VAR_CONST_COLLISION");
    EXPECT_EQ(first_error_of("const LIMIT 3"), "1:7 CONST_ALREADY_DEFINED");
    EXPECT_EQ(first_error_of("id = prox[3:1"), "1:14 INDEX_WRONG_END");
    EXPECT_EQ(errors_of("for id in 9:32767 step 0 do end"), (List{"1:24 FOR_NULL_STEPS"}));
    EXPECT_EQ(errors_of("call math.fill(prox,)"), (List{"1:21 FUNCTION_NO_ENOUGH_ARG"}));
    EXPECT_EQ(first_error_of("call math.fill(prox,1,)"), "1:22 FUNCTION_TOO_MANY_ARG");
    EXPECT_EQ(errors_of("id = prox[0:1/0]"), (List{"1:12 INDEX_EXPECTING_CONSTANT"}));
    EXPECT_EQ(errors_of("id = prox[1/0:2]"), (List{"1:14 EXPECTING"}));
    EXPECT_EQ(errors_of("id = prox[1/0]"), (List{"1:12 DIVISION_BY_ZERO"}));
    EXPECT_EQ(errors_of("const K = 1 / 0"), (List{"1:13 DIVISION_BY_ZERO"}));
    EXPECT_EQ(errors_of("var v[abs -32768]"), (List{"1:7 ABS_NOT_POSSIBLE"}));
}

TEST(Compile, ALoopKeepsTheLastBoundAndChecksDeadBranches) {
    EXPECT_EQ(errors_of("if ZERO == 1 then id = 1 / 0 end"), (List{"1:26 DIVISION_BY_ZERO"}));
    EXPECT_EQ(errors_of("if ZERO == 1 then while 1 == 1 do end end"), (List{"1:19 INFINITE_LOOP"}));
    EXPECT_EQ(init_words("for id in 3:3 do prox[0] = 1 end"),
              (Words{0x1003, 0x4000, 0x1001, 0x4022, 0}));
    EXPECT_EQ(errors_of("for id in 32767:32767 do end"), (List{"1:17 FOR_INVALID_INC_END_INDEX"}));
}

TEST(Compile, WarningsNameWhatIsProbablyAMistake) {
    EXPECT_EQ(warnings_of("var a\nvar b\nb = 1\n"), (List{"1:5 W_UNUSED_VARIABLE"}));
    EXPECT_EQ(warnings_of("sub s\nid = 1\nsub t\nid = 2\nonevent tick\ncallsub t"),
              (List{"1:5 W_UNUSED_SUB"}));
    EXPECT_EQ(warnings_of("if id == 1 then\nreturn\nid = 2\nid = 3\nend\nreturn"),
              (List{"3:1 W_UNREACHABLE"}));
    EXPECT_EQ(warnings_of("if 1 == 1 then id = 1 elseif 2 == 1 then id = 2 end"),
              (List{"1:1 W_CONSTANT_CONDITION", "1:23 W_CONSTANT_CONDITION"}));
    EXPECT_EQ(warnings_of("when 1 == 1 do id = 1 end"), (List{"1:1 W_CONSTANT_CONDITION"}));
    EXPECT_EQ(warnings_of("for id in 0:32766 step 1000 do end"), (List{"1:1 W_ENDLESS_LOOP"}));
    EXPECT_EQ(warnings_of("for id in 0:-32767 step -3 do end"), (List{"1:1 W_ENDLESS_LOOP"}));
    EXPECT_EQ(warnings_of("id = (id - 3) / 4\nid = -id / 2"),
              (List{"1:15 W_DIVISION_ROUNDS_DOWN"}));
    EXPECT_EQ(warnings_of("onevent tick\nonevent button\nid = 1"), (List{"1:1 W_EMPTY_HANDLER"}));
}

TEST(Compile, SensibleProgramsHaveNoWarnings) {
    EXPECT_EQ(
        warnings_of("const DEBUG = 0\nvar speed = 100\nvar i\nvar v[4]\n"
                    "if DEBUG == 1 then emit report speed end\n"
                    "when DEBUG == 1 do emit report speed end\n"
                    "for i in 0:32766 do v[i % 4] = i end\n"
                    "for i in 0:-32766 step -2 do v[0] = i end\n"
                    "onevent tick\nspeed = (prox[0] + prox[1]) / 2\nmotor.left = speed / 4 - 1\n"
                    "if speed > 3 then return end\nspeed += 1\ncallsub halt\n"
                    "sub halt\nmotor.left = 7 / 2\nreturn\n"),
        List{});
}

TEST(Compile, TheTreeIsAsTheProgramIsWritten) {
    const std::string source =
        "var a = 2\na += 1 + 2\nif not a == 3 then a++ elseif a == 4 then else return end\n";
    const Target target = test_target();
    const CommonDefinitions common = test_common();
    const CheckedTree checked = parse_and_check(source, target, common, {});
    ASSERT_TRUE(checked.errors.empty());
    const Tree& tree = checked.tree;
    ASSERT_EQ(tree.sections.size(), 1u);
    const NodeId block = tree.sections[0].block;
    EXPECT_EQ(tree[tree.child(block, 0)].kind, NodeKind::Assign);
    const NodeId compound = tree.child(block, 1);
    EXPECT_EQ(tree[compound].op, static_cast<uint8_t>(isa::BinaryOperator::Add));
    EXPECT_EQ(tree[tree.child(compound, 1)].kind, NodeKind::Binary);
    const NodeId choice = tree.child(block, 2);
    EXPECT_EQ(tree[tree.child(choice, 0)].kind, NodeKind::Clause);
    EXPECT_EQ(tree[tree.child(tree.child(choice, 0), 0)].kind, NodeKind::Not);
    EXPECT_EQ(tree[tree.child(choice, 1)].kind, NodeKind::Clause);
    EXPECT_EQ(tree[tree.child(choice, 2)].kind, NodeKind::Block);
}

// Found by comparing programs with mistakes with libasebacompiler.
TEST(Compile, ACarriageReturnEndsALineCommentButNotTheLine) {
    EXPECT_EQ(errors_of("motor.left = 1 # note\rmotor.left = \n"), (List{"2:1 EXPECTING_ONE_OF"}));
}

TEST(Compile, OnlyTheEndOfASliceIsComparedWithItsArrayInTheSizePhase) {
    EXPECT_EQ(errors_of("var z[4]\nz = [prox[-1:2], z[0]]\n"), (List{"2:3 ARRAY_SIZE_MISMATCH"}));
    EXPECT_EQ(errors_of("prox[-1:2] = prox\nprox = 1\n"),
              (List{"1:1 ARRAY_OUT_OF_BOUND", "2:6 ARRAY_SIZE_MISMATCH"}));
    EXPECT_EQ(first_error_of("prox[-2:-2] = id\nprox = 1\n"), "1:1 ARRAY_OUT_OF_BOUND");
}

TEST(Compile, OfArgumentsOnlyTheFirstPlaceIsComparedWithItsArrayWhileParsing) {
    const std::string later = "\nnothing = 1\n";
    EXPECT_EQ(first_error_of("call math.fill(prox[7] + id, 1)" + later), "1:16 ARRAY_OUT_OF_BOUND");
    EXPECT_EQ(first_error_of("call math.fill(prox[7] + [id, id], 1)" + later),
              "1:16 ARRAY_OUT_OF_BOUND");
    EXPECT_EQ(first_error_of("call math.fill(id + prox[7], 1)" + later),
              "2:1 VARIABLE_NOT_DEFINED");
    EXPECT_EQ(first_error_of("call math.fill(prox[id + prox[7]], 1)" + later),
              "2:1 VARIABLE_NOT_DEFINED");
    EXPECT_EQ(first_error_of("emit report prox[id + prox[7]]" + later), "2:1 VARIABLE_NOT_DEFINED");
    EXPECT_EQ(first_error_of("emit report prox[-1:2]" + later), "1:13 ARRAY_OUT_OF_BOUND");
}

TEST(Compile, SizesUnderCountingComeBeforeAllOtherPlaces) {
    EXPECT_EQ(first_error_of("prox[9] = 1\nid + prox++\n"), "2:4 ARRAY_SIZE_MISMATCH");
}

// 160 words are free on the test's node; `full` leaves none for the copy.
TEST(Compile, RoomForTheCopyComesBeforeThePlacesOfAnAssignment) {
    EXPECT_EQ(errors_of("var full[157]\nvar q[3]\nq = q + [q[9], 1, 2]\n"),
              (List{"3:3 NOT_ENOUGH_TEMP_SPACE"}));
    EXPECT_EQ(errors_of("var full[157]\nvar q[3]\nq[-1:1]++\n"),
              (List{"3:8 NOT_ENOUGH_TEMP_SPACE"}));
}

TEST(Compile, ASuggestionSharesACharacterWithTheName) {
    EXPECT_EQ(sentence_of("var q\na = q\n"),
              "there is no variable or constant \"a\" at this point; declare it with \"var a\" "
              "before the code");
}

}  // namespace
}  // namespace vagus::aesl
