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

TEST(Access, WrongTokensWaitTwiceAsLongEachTime) {
    Access access("drive-drive-drive", std::nullopt);
    EXPECT_EQ(access.wait_until("a"), Time{});
    EXPECT_EQ(access.wrong("a", 1s), 1s + 500ms);
    EXPECT_EQ(access.wrong("a", 2s), 2s + 1000ms);
    for (int i = 0; i < 10; ++i) access.wrong("a", 3s);
    EXPECT_EQ(access.wait_until("a"), 3s + 30s);
    EXPECT_EQ(access.wait_until("b"), Time{});
    access.right("a");
    EXPECT_EQ(access.wait_until("a"), Time{});
}

}  // namespace
}  // namespace vagus::serve
