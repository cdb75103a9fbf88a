#include "serve/web/live_client.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

TEST(ServerAddress, IsReadAsPeopleWriteIt) {
    const auto read = [](const std::string& text) { return parse_address(text).value(); };
    EXPECT_EQ(read("robot.local").host, "robot.local");
    EXPECT_EQ(read("robot.local").port, 8910);
    EXPECT_FALSE(read("robot.local").secure);
    EXPECT_EQ(read("192.168.1.7:8000").port, 8000);
    EXPECT_EQ(read("[::1]:8000").host, "::1");
    EXPECT_EQ(read("[::1]:8000").port, 8000);
    EXPECT_EQ(read("[fe80::2]").port, 8910);
    const ServerAddress printed = read("https://robot.local:443/#token=abc123");
    EXPECT_TRUE(printed.secure);
    EXPECT_EQ(printed.host, "robot.local");
    EXPECT_EQ(printed.port, 443);
    EXPECT_EQ(printed.token, "abc123");
}

TEST(ServerAddress, WhatIsNoneIsRefused) {
    for (const char* text :
         {"", "http://", ":8910", "robot:0", "robot:65536", "robot:port", "robot:1x", "::1",
          "fe80::2:8910", "a b", "user@robot", "http://robot/page", "tcp:robot:33333"}) {
        EXPECT_FALSE(parse_address(text).ok()) << text;
    }
}

}  // namespace
}  // namespace vagus::serve
