#include "serve/web/origin.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

Asked asked(std::string host, std::optional<std::string> origin = {}) {
    return {std::move(host), std::move(origin), "127.0.0.1", 8080, false};
}

TEST(Origin, TheAddressThatWasPrintedIsLetIn) {
    EXPECT_FALSE(refusal_of(asked("127.0.0.1:8080"), {}));
    EXPECT_FALSE(refusal_of(asked("localhost:8080"), {}));
    EXPECT_FALSE(refusal_of(asked("LOCALHOST:8080", "http://localhost:8080"), {}));
    EXPECT_FALSE(refusal_of(asked("127.0.0.1:8080", "http://127.0.0.1:8080"), {}));
}

TEST(Origin, NamesThatOnlyPointHereAreNot) {
    for (const char* host : {"", "evil.example:8080", "127.0.0.1", "127.0.0.1:8081",
                             "localhost.evil.example:8080", "127.0.0.2:8080", "[::1]:8080"}) {
        EXPECT_TRUE(refusal_of(asked(host), {})) << host;
    }
    EXPECT_FALSE(refusal_of(asked("robot.local:8080"), {"Robot.local"}));
}

TEST(Origin, OtherPagesInTheSameBrowserAreNot) {
    for (const char* origin :
         {"null", "", "http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1:8081",
          "http://localhost:8080", "http://127.0.0.1:8080.evil.example"}) {
        EXPECT_TRUE(refusal_of(asked("127.0.0.1:8080", origin), {})) << origin;
    }
}

TEST(Origin, UsualPortsMayBeMissing) {
    EXPECT_FALSE(refusal_of({"10.0.0.5", "https://10.0.0.5", "10.0.0.5", 443, true}, {}));
    EXPECT_FALSE(refusal_of({"10.0.0.5", {}, "10.0.0.5", 80, false}, {}));
    EXPECT_TRUE(refusal_of({"10.0.0.5", {}, "10.0.0.5", 443, false}, {}));
    EXPECT_FALSE(refusal_of({"[::1]:9", "http://[::1]:9", "::1", 9, false}, {}));
}

TEST(Origin, LoopbackIsThisComputerOnly) {
    EXPECT_TRUE(is_loopback("127.0.0.1"));
    EXPECT_TRUE(is_loopback("127.1.2.3"));
    EXPECT_TRUE(is_loopback("::1"));
    EXPECT_FALSE(is_loopback("0.0.0.0"));
    EXPECT_FALSE(is_loopback("::"));
    EXPECT_FALSE(is_loopback("192.168.0.12"));
}

}  // namespace
}  // namespace vagus::serve
