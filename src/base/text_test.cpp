#include "base/text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace vagus {
namespace {

TEST(Text, DecodesOneToFourBytes) {
    EXPECT_EQ(first_code_point("a").value, U'a');
    EXPECT_EQ(first_code_point("é").value, U'é');
    EXPECT_EQ(first_code_point("€x").value, U'€');
    EXPECT_EQ(first_code_point("€x").bytes, 3u);
    EXPECT_EQ(first_code_point("\xf0\x9f\xa4\x96").value, U'\U0001F916');
    EXPECT_EQ(first_code_point("\xf0\x9f\xa4\x96").bytes, 4u);
}

TEST(Text, RefusesMalformedUtf8) {
    EXPECT_EQ(first_code_point("").bytes, 0u);
    EXPECT_EQ(first_code_point("\x80").bytes, 0u);              // continuation without a lead
    EXPECT_EQ(first_code_point("\xc0\xaf").bytes, 0u);          // overlong "/"
    EXPECT_EQ(first_code_point("\xe0\x9f\xbf").bytes, 0u);      // overlong U+07FF
    EXPECT_EQ(first_code_point("\xed\xa0\x80").bytes, 0u);      // U+D800, a surrogate
    EXPECT_EQ(first_code_point("\xf4\x90\x80\x80").bytes, 0u);  // U+110000
    EXPECT_EQ(first_code_point("\xe2\x82").bytes, 0u);          // cut
}

TEST(Text, FindsTheFirstMalformedByte) {
    EXPECT_EQ(malformed_utf8_at("aé€"), std::nullopt);
    EXPECT_EQ(malformed_utf8_at("aé\xff"), 3u);
}

TEST(Text, NumbersAreAppendedInDecimalDigits) {
    std::string text = "n=";
    append_number(text, 0);
    append_number(text, -32768);
    EXPECT_EQ(text, "n=0-32768");
    text.clear();
    append_number(text, std::numeric_limits<int64_t>::min());
    EXPECT_EQ(text, "-9223372036854775808");
}

TEST(Text, EncodesWhatItDecodes) {
    for (const char32_t point :
         {U'a', U'\u0080', U'é', U'\u0800', U'€', U'\U00010000', U'\U0010ffff'}) {
        const std::string bytes = to_utf8(point);
        EXPECT_EQ(first_code_point(bytes).value, point);
        EXPECT_EQ(first_code_point(bytes).bytes, bytes.size());
    }
}

TEST(Text, ShowsWhatATerminalWouldObey) {
    EXPECT_EQ(visible("\x1b[31mred\x07"), "\\u001b[31mred\\u0007");
    EXPECT_EQ(visible("a\x7f\xc2\x9b"
                      "b"),
              "a\\u007f\\u009b"
              "b");
    EXPECT_EQ(visible("\u202eabc\u202c \u2066x\u2069 \u200e\u200f\u061c"),
              "\\u202eabc\\u202c \\u2066x\\u2069 \\u200e\\u200f\\u061c");
    EXPECT_EQ(visible("a\xef\xbb\xbf"
                      "b\u2028\u2029"),
              "a\\ufeffb\\u2028\\u2029");
    EXPECT_EQ(visible("a\nb\tc\r"), "a\\u000ab\\u0009c\\u000d");
    // 0x9b alone is what an eight-bit terminal takes for ESC [.
    EXPECT_EQ(visible("\x9b"
                      "31m"),
              "\\x9b31m");
}

// The neighbours of each range, and the writing systems that must stay legible.
TEST(Text, LeavesAllOtherTextAsItIs) {
    const std::string text =
        " ~\u00a0\u061b\u061d\u200d\u2010\u2027\u202f\u2065\u206a\ufefeé世שלום🤖";
    EXPECT_EQ(visible(text), text);
    EXPECT_EQ(visible_lines("a\n\tb\r\x1b\n"), "a\n\tb\\u000d\\u001b\n");
}

TEST(Text, SplitsAtEverySeparator) {
    EXPECT_EQ(split("a;;b;", ';'), (std::vector<std::string_view>{"a", "", "b", ""}));
    EXPECT_EQ(split("", ';'), (std::vector<std::string_view>{""}));
}

TEST(Text, IsTrimmedAtBothEnds) {
    EXPECT_EQ(trimmed(" \ta b\t "), "a b");
    EXPECT_EQ(trimmed(" \t "), "");
    EXPECT_EQ(trimmed(""), "");
    EXPECT_EQ(trimmed("\ta ", " "), "\ta");
}

TEST(Text, CutsNoCharacterInTwo) {
    EXPECT_EQ(utf8_prefix("a\xc3\xa9", 2), "a");
    EXPECT_EQ(utf8_prefix("a\xc3\xa9", 3), "a\xc3\xa9");
    EXPECT_EQ(utf8_prefix("\xf0\x9f\x98\x80", 3), "");
    EXPECT_EQ(utf8_prefix("ab", 2), "ab");
}

TEST(Text, WritesBytesAsHexDigits) {
    EXPECT_EQ(hex_of(std::string_view("\x00\x0f\xff", 3)), "000fff");
    EXPECT_EQ(hex_of(""), "");
}

TEST(Text, ListsWordsAsASentenceDoes) {
    EXPECT_EQ(list_of({"a"}), "a");
    EXPECT_EQ(list_of({"a", "b", "c"}), "a, b and c");
}

}  // namespace
}  // namespace vagus
