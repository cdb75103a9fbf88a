#include "cli/net/switch.hpp"

#include <gtest/gtest.h>

namespace vagus::cli {
namespace {

wire::Frame frame(uint16_t source, uint16_t type, std::vector<uint8_t> payload) {
    wire::Frame frame{};
    frame.source = source;
    frame.type = type;
    frame.size = static_cast<uint16_t>(payload.size());
    std::copy(payload.begin(), payload.end(), frame.payload);
    return frame;
}

TEST(Switch, ShowsEventsInDecimalAndTheRestInHex) {
    EXPECT_EQ(frame_line(Time(1204), frame(42, 4, {5, 0, 0xf8, 0xff})),
              "0.001204 42 event 4: 5 -8\n");
    EXPECT_EQ(frame_line(Time(0), frame(1, 0x900c, {5, 0})), "0.000000 1 NodePresent: 05 00\n");
    EXPECT_EQ(frame_line(Time(2500000), frame(1, 0x900f, {})), "2.500000 1 message 0x900f\n");
    EXPECT_EQ(frame_line(Time(0), frame(1, 4, {7})), "0.000000 1 event 4: 07\n");
}

TEST(Switch, SaysWhoLostHowMuch) {
    EXPECT_EQ(loss_sentence("tcp:127.0.0.1:5", {2048, 1}),
              "tcp:127.0.0.1:5: too slow: 2048 user events and 1 other messages lost so far");
}

TEST(Switch, KnowsItselfUnderItsNames) {
    const auto same = [](const char* target, const char* listening) {
        return is_ourselves(net::parse_target(target).value(),
                            net::parse_target(listening).value());
    };
    EXPECT_TRUE(same("tcp:localhost:33333", "tcp:127.0.0.1:33333"));
    EXPECT_TRUE(same("tcp:127.0.0.1;33333", "tcpin:port=33333;address=0.0.0.0"));
    EXPECT_TRUE(same("tcp:10.0.0.7:33333", "tcp:10.0.0.7:33333"));
    EXPECT_FALSE(same("tcp:localhost:33334", "tcp:127.0.0.1:33333"));
    EXPECT_FALSE(same("tcp:10.0.0.7:33333", "tcp:127.0.0.1:33333"));
    EXPECT_FALSE(same("tcp:localhost:33333", "tcp:10.0.0.7:33333"));
    EXPECT_FALSE(same("can:can0", "tcp:127.0.0.1:33333"));
}

}  // namespace
}  // namespace vagus::cli
