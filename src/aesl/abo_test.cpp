#include "aesl/abo.hpp"

#include <gtest/gtest.h>

namespace vagus::aesl {
namespace {

Target small_rover() {
    Target target;
    target.name = "rover";
    target.bytecode_size = 600;
    target.variables_size = 200;
    target.stack_size = 32;
    target.variables = {{"id", 1}, {"prox", 2}};
    target.local_events = {{"tick", ""}};
    target.natives = {{"math.rand", "", {{"dest", -1}}}};
    return target;
}

const std::vector<uint16_t> kProgram = {3, 0xffff, 3, 0x1000, 0x4028, 0};

// Sums worked out with another implementation of CRC-16/XMODEM (whose check value for "123456789"
// is 31c3). "rover" is fed with one zero byte behind it, "ab" as it is.
TEST(Abo, NamesAreFedInPairsOfBytes) {
    EXPECT_EQ(crc_of_name("rover"), 0xc9b5);
    EXPECT_EQ(crc_of_name("ab"), 0x74ff);
    EXPECT_EQ(crc_of_name(""), 0);
}

// Fed: 5802 c800 2000, 0100 "id", 0200 "prox", "tick", "math.rand" 00, ffff "dest".
TEST(Abo, DescriptionIsFedInTheOrderOfTheSpecification) {
    EXPECT_EQ(crc_of_description(small_rover()), 0xddcb);
}

TEST(Abo, BytesAreThoseOfSection53) {
    const std::string bytes = format_abo(
        small_rover(), {.product_id = 8, .firmware_version = 14, .node_id = 258}, kProgram);
    const std::string expected(
        "ABO\0"
        "\0\0"      // format version
        "\5\0"      // protocol version
        "\x08\0"    // product id
        "\x0e\0"    // firmware version
        "\x02\x01"  // node id 258
        "\xb5\xc9"  // name
        "\xcb\xdd"  // description
        "\x06\0"    // words
        "\3\0\xff\xff\3\0\0\x10\x28\x40\0\0"
        "\xa9\x87",  // their sum
        34);
    EXPECT_EQ(bytes, expected);
}

TEST(Abo, ReadsWhatItWrites) {
    const AboNode node{.product_id = 8, .firmware_version = 14, .node_id = 258};
    const Abo abo = parse_abo(format_abo(small_rover(), node, kProgram), "p.abo").value();
    EXPECT_EQ(abo.protocol_version, 5);
    EXPECT_EQ(abo.node, node);
    EXPECT_EQ(abo.bytecode, kProgram);
    EXPECT_TRUE(check_abo(abo, small_rover(), "p.abo").ok());
}

TEST(Abo, AProgramForAnotherNodeIsRefused) {
    const Abo abo = parse_abo(format_abo(small_rover(), {}, kProgram), "p.abo").value();
    Target other = small_rover();
    other.name = "crawler";
    EXPECT_EQ(check_abo(abo, other, "p.abo").error().code, Code::Refused);
    other = small_rover();
    other.variables[1].size = 3;
    EXPECT_FALSE(check_abo(abo, other, "p.abo").ok());
}

TEST(Abo, EveryCutAndEveryFlippedBitOfTheProgramIsFound) {
    const std::string whole = format_abo(small_rover(), {}, kProgram);
    for (size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(parse_abo(whole.substr(0, size), "p").ok()) << size;
    EXPECT_FALSE(parse_abo(whole + '\0', "p").ok());
    for (size_t bit = 8 * 20; bit < 8 * whole.size(); ++bit) {
        std::string flipped = whole;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
        EXPECT_FALSE(parse_abo(flipped, "p").ok()) << bit;
    }
}

TEST(Abo, SaysWhatIsWrongWithTheFile) {
    EXPECT_EQ(parse_abo("ABC", "p.abo").error().what,
              "p.abo: this is no .abo file: it does not begin with \"ABO\" and a zero byte; make "
              "one with `vagus compile --format abo`");
    std::string bytes = format_abo(small_rover(), {}, kProgram);
    bytes[4] = 1;
    EXPECT_EQ(parse_abo(bytes, "p.abo").error().what,
              "p.abo: format version 1 is unknown; this program reads 0");
}

TEST(Abo, TheLongestProgramFits) {
    const std::vector<uint16_t> longest(UINT16_MAX, 0x1234);
    EXPECT_EQ(parse_abo(format_abo(small_rover(), {}, longest), "p").value().bytecode, longest);
}

}  // namespace
}  // namespace vagus::aesl
