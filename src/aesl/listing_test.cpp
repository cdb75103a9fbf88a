#include "aesl/listing.hpp"

#include "aesl/compile.hpp"

#include <gtest/gtest.h>

namespace vagus::aesl {
namespace {

Target listed_rover() {
    Target target;
    target.name = "rover";
    target.bytecode_size = 600;
    target.variables_size = 200;
    target.stack_size = 32;
    target.variables = {{"id", 1}, {"prox", 3}};
    target.local_events = {{"tick", ""}};
    target.natives = {{"math.sort", "", {{"array", -1}}}};
    return target;
}

const CommonDefinitions kCommon{.events = {{"report", 1}}, .constants = {}};

// Words by hand from section 4 of the specification.
TEST(Listing, ShowsSourceLinesNamesAddressesAndWords) {
    const std::string source =
        "var n = -2000\n"
        "onevent tick\n"
        "prox[2] = prox[n] + 1\n"
        "when n > 3 do\n"
        "\temit report n * n\n"
        "end\n"
        "call math.sort(prox)\n"
        "callsub clear\n"
        "sub clear\n"
        "n = 3000\n";
    const Compilation done = compile(source, listed_rover(), kCommon, {});
    ASSERT_TRUE(done.ok());
    EXPECT_EQ(listing(done.program, source, listed_rover(), kCommon),
              "34 of 600 words of bytecode, 6 of 200 words of variables, 2 of 32 words of stack\n"
              "\n"
              "    0  0005            event table of 5 words\n"
              "    1  fffe 0005       onevent tick at 5\n"
              "    3  ffff 001b       initialisation at 27\n"
              "\n"
              "onevent tick:\n"
              "       3 | prox[2] = prox[n] + 1\n"
              "    5  3004            Load       n\n"
              "    6  5001 0003       LoadInd    prox, index below 3\n"
              "    8  1001            SmallImm   1\n"
              "    9  8002            Binary     +\n"
              "   10  4003            Store      prox[2]\n"
              "       4 | when n > 3 do\n"
              "   11  3004            Load       n\n"
              "   12  1003            SmallImm   3\n"
              "   13  a10c 0009       Branch     > becomes true, else to 22\n"
              "       5 | \temit report n * n\n"
              "   15  3004            Load       n\n"
              "   16  3004            Load       n\n"
              "   17  8004            Binary     *\n"
              "   18  40c7            Store      temporary 199\n"
              "   19  b000 00c7 0001  Emit       report, 1 word from temporary 199\n"
              "       7 | call math.sort(prox)\n"
              "   22  1003            SmallImm   3\n"
              "   23  1001            SmallImm   1\n"
              "   24  c000            Native     math.sort\n"
              "       8 | callsub clear\n"
              "   25  d01e            SubCall    clear\n"
              "   26  0000            Stop\n"
              "\n"
              "initialisation:\n"
              "       1 | var n = -2000\n"
              "   27  1830            SmallImm   -2000\n"
              "   28  4004            Store      n\n"
              "   29  0000            Stop\n"
              "\n"
              "sub clear:\n"
              "      10 | n = 3000\n"
              "   30  2000 0bb8       LargeImm   3000\n"
              "   32  4004            Store      n\n"
              "   33  e000            SubRet\n");
}

TEST(Listing, CountsLinesFromWhereTheSourceStandsInItsFile) {
    const std::string source = "id = 1\n";
    const Compilation done = compile(source, listed_rover(), kCommon, {});
    const std::string text = listing(done.program, source, listed_rover(), kCommon, 11);
    EXPECT_NE(text.find("      11 | id = 1\n"), text.npos) << text;
}

TEST(Listing, ShowsAnyWordsWithoutFallingOverThem) {
    Program program;
    program.bytecode = {3, 0xffff, 3, 0xf123, 0xb000, 1};
    const std::string text = listing(program, "", listed_rover(), kCommon);
    EXPECT_NE(text.find("no instruction"), text.npos);
    for (uint32_t word = 0; word < 0x10000; ++word) {
        program.bytecode = {1, static_cast<uint16_t>(word), 0xffff, 0xffff};
        EXPECT_FALSE(listing(program, "", listed_rover(), kCommon).empty());
    }
}

}  // namespace
}  // namespace vagus::aesl
