#include "base/text.hpp"

#include <gtest/gtest.h>

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

TEST(Text, EncodesWhatItDecodes) {
    for (const char32_t point :
         {U'a', U'\u0080', U'é', U'\u0800', U'€', U'\U00010000', U'\U0010ffff'}) {
        const std::string bytes = to_utf8(point);
        EXPECT_EQ(first_code_point(bytes).value, point);
        EXPECT_EQ(first_code_point(bytes).bytes, bytes.size());
    }
}

TEST(Text, SplitsAtEverySeparator) {
    EXPECT_EQ(split("a;;b;", ';'), (std::vector<std::string_view>{"a", "", "b", ""}));
    EXPECT_EQ(split("", ';'), (std::vector<std::string_view>{""}));
}

TEST(Text, ListsWordsAsASentenceDoes) {
    EXPECT_EQ(list_of({"a"}), "a");
    EXPECT_EQ(list_of({"a", "b", "c"}), "a, b and c");
}

}  // namespace
}  // namespace vagus
