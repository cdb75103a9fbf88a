#include "serve/access.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

TEST(Access, ATokenIs128BitsAsHexadecimalDigits) {
    EXPECT_EQ(token_of({0x00, 0x01, 0xfe, 0xff}), "0001feff000000000000000000000000");
}

TEST(Access, ATokenFileHoldsOneLine) {
    EXPECT_EQ(token_in("0123456789abcdef\n", "t").value(), "0123456789abcdef");
    EXPECT_FALSE(token_in("0123456789abcde\n", "t").ok());  // 15 letters
    EXPECT_FALSE(token_in("0123456789 abcdef\n", "t").ok());
    EXPECT_FALSE(token_in(std::string(201, 'a'), "t").ok());
}

TEST(Access, TwoTokensTwoGrades) {
    const Access access("drive-drive-drive", "look-look-look-look");
    EXPECT_EQ(access.grade("drive-drive-drive"), Access::Grade::Drive);
    EXPECT_EQ(access.grade("look-look-look-look"), Access::Grade::Look);
    for (const char* wrong : {"", "drive", "drive-drive-drivedrive-drive-drive", "d"}) {
        EXPECT_EQ(access.grade(wrong), Access::Grade::Refused) << wrong;
    }
}

TEST(Access, ANewTokenCountsForAllCopies) {
    const Access access("drive-drive-drive", "look-look-look-look");
    const Access copy = access;
    access.renew("other-other-other");
    EXPECT_EQ(copy.grade("other-other-other"), Access::Grade::Drive);
    EXPECT_EQ(copy.grade("drive-drive-drive"), Access::Grade::Refused);
    EXPECT_EQ(copy.grade("look-look-look-look"), Access::Grade::Look);
}

TEST(Access, WrongTokensWaitTwiceAsLongEachTime) {
    Access access("drive-drive-drive", std::nullopt);
    EXPECT_EQ(access.wrong("a", 1s), 1s);
    EXPECT_EQ(access.wrong("a", 1s), 1s + 500ms);
    EXPECT_EQ(access.wrong("a", 1s), 1s + 500ms + 1s);
    EXPECT_EQ(access.wrong("b", 1s), 1s);    // another address
    EXPECT_EQ(access.wrong("a", 60s), 60s);  // so long after the last one, at once
    EXPECT_EQ(access.wrong("a", 60s), 60s + 4s);
    access.right("a");
    EXPECT_EQ(access.wrong("a", 61s), 61s);
}

TEST(Access, NoWaitGrowsAboveItsLimit) {
    Access access("drive-drive-drive", std::nullopt);
    for (int i = 0; i < 100; ++i) access.wrong("a", 1000s * i);
    EXPECT_EQ(access.wrong("a", 200000s), 200000s);
    EXPECT_EQ(access.wrong("a", 200000s), 200000s + 30s);
}

}  // namespace
}  // namespace vagus::serve
