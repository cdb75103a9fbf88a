#include "session/trace.hpp"

#include <gtest/gtest.h>

namespace vagus::session {
namespace {

TEST(TraceLine, IsOneObjectWithItsKeysInOrder) {
    const int16_t args[] = {3, -4};
    EXPECT_EQ(
        TraceLine(Time(1234567), "event")
            .number("node", 1)
            .text("name", "a\"b")
            .words("args", args)
            .done(),
        "{\"t\":1.234567,\"kind\":\"event\",\"node\":1,\"name\":\"a\\\"b\",\"args\":[3,-4]}\n");
}

TEST(TraceLine, SecondsHaveSixDecimals) {
    EXPECT_EQ(TraceLine(Time(0), "x").done(), "{\"t\":0.000000,\"kind\":\"x\"}\n");
    EXPECT_EQ(TraceLine(Time(20000010), "x").done(), "{\"t\":20.000010,\"kind\":\"x\"}\n");
}

// The fewest digits that say the same to a millionth, never with an exponent.
TEST(TraceLine, NumbersAreShort) {
    const auto real = [](double value) {
        return TraceLine(Time(0), "x").real("v", value).done().substr(29);
    };
    EXPECT_EQ(real(0.1), "0.1}\n");
    EXPECT_EQ(real(30), "30}\n");
    EXPECT_EQ(real(-0.0000001), "0}\n");
    EXPECT_EQ(real(0.00001), "0.00001}\n");
    EXPECT_EQ(real(-1.23456789), "-1.234568}\n");
}

}  // namespace
}  // namespace vagus::session
