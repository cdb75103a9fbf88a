#include "cli/listing.hpp"

#include <gmock/gmock.h>

namespace vagus::cli {
namespace {

using testing::HasSubstr;

// The worked example of docs/spec/aesl-language.md, section 5.2, with the words that stand there.
TEST(Listing, NamesWhatTheWordsMean) {
    aesl::Target target{.name = "rover",
                        .bytecode_size = 512,
                        .variables_size = 1060,
                        .stack_size = 64,
                        .variables = {},
                        .local_events = {{"timer", ""}},
                        .natives = {}};
    const aesl::CommonDefinitions common{{{"setspeed", 1}, {"status", 2}}, {}};
    aesl::Program program;
    program.bytecode = {0x0007, 0x0000, 0x0007, 0xfffe, 0x000a, 0xffff, 0x000d, 0x3002, 0x4024,
                        0x0000, 0xb001, 0x0422, 0x0002, 0x1032, 0xa10d, 0x0009, 0x0000, 0xf000};
    program.lines = {0, 0, 0, 0, 0, 0, 0, 2, 2, 2, 3, 3, 3, 1, 1, 1, 1, 1};
    program.variables = {{"id", 0, 1}, {"source", 1, 1}, {"args", 2, 32}, {"speed", 36, 1}};
    program.used = {18, 40, 2};
    const std::string text =
        listing({program, target, common, "var speed\nspeed = args[0]\r\nemit status", 11});
    EXPECT_THAT(text, HasSubstr("bytecode 18 of 512, variables 40 of 1060, stack 2 of 64 words\n"));
    EXPECT_THAT(text, HasSubstr("  1  0000 0007  onevent setspeed, at 7\n"));
    EXPECT_THAT(text, HasSubstr("  3  fffe 000a  onevent timer, at 10\n"));
    EXPECT_THAT(text, HasSubstr("  5  ffff 000d  start, at 13\n"));
    EXPECT_THAT(
        text, HasSubstr("   12 | speed = args[0]\n            7  3002       Load args[0]\n"
                        "            8  4024       Store speed\n            9  0000       Stop\n"));
    EXPECT_THAT(text, HasSubstr("   13 | emit status\n"));
    EXPECT_THAT(text, HasSubstr("b001 0422 0002  Emit status, 2 words at temporary 1058\n"));
    EXPECT_THAT(text, HasSubstr("   11 | var speed\n           13  1032       SmallImm 50\n"
                                "           14  a10d 0009  Branch when >=, else to 23\n"));
    EXPECT_THAT(text, HasSubstr("f000       no instruction"));
}

TEST(Listing, WordsThatAreNoProgramAreListedToo) {
    aesl::Program program;
    const aesl::Target target;
    EXPECT_THAT(listing({program, target, {}, ""}), HasSubstr("bytecode 0 of 0"));
    program.bytecode = {0xffff, 0xb001};  // a table that is longer than the program
    EXPECT_THAT(listing({program, target, {}, ""}), HasSubstr("ffff"));
    program.bytecode = {0x0001, 0x2000};  // an instruction without its second word
    EXPECT_THAT(listing({program, target, {}, ""}), HasSubstr("LargeImm 0"));
}

}  // namespace
}  // namespace vagus::cli
