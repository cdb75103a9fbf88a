#include "fleet/target.hpp"

#include <gtest/gtest.h>

namespace vagus::fleet {
namespace {

TEST(FleetTarget, IsReadAsPeopleWriteIt) {
    EXPECT_EQ(parse_fleet_target("mqtt://broker/lab").value(),
              (FleetTarget{"broker", 1883, false, "lab"}));
    EXPECT_EQ(parse_fleet_target("mqtts://10.0.0.1:9000/a%20b").value(),
              (FleetTarget{"10.0.0.1", 9000, true, "a b"}));
    EXPECT_EQ(parse_fleet_target("mqtts://[::1]:9000").value(),
              (FleetTarget{"::1", 9000, true, ""}));
    EXPECT_EQ(parse_fleet_target("mqtt://[::1]/").value(), (FleetTarget{"::1", 1883, false, ""}));
    EXPECT_EQ(to_string({"::1", 9000, true, "a b"}), "mqtts://[::1]:9000/a%20b");
}

TEST(FleetTarget, WhatIsNoneIsRefused) {
    for (const char* const text : {"", "tcp:a:1", "mqtt://", "mqtt:///lab", "mqtt://h:0/lab",
                                   "mqtt://h:65536/lab", "mqtt://h:x/lab", "mqtt://h/a/b"}) {
        EXPECT_FALSE(parse_fleet_target(text).ok()) << text;
    }
}

TEST(Login, HasTwoLines) {
    const Login login = read_login("r1\nsecret\n", "f").value();
    EXPECT_EQ(login.user, "r1");
    EXPECT_EQ(login.password, "secret");
    EXPECT_EQ(read_login("r1\n", "f").error().what,
              "f: expected two lines, a user and a password, found 1");
    EXPECT_FALSE(read_login("\nsecret\n", "f").ok());
    EXPECT_FALSE(read_login("r1\na\nb\n", "f").ok());
}

}  // namespace
}  // namespace vagus::fleet
