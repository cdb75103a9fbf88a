// Forms of docs/formats.md ("Targets") and of docs/spec/aseba-wire-and-vm.md, section 1.2.
#include "net/target.hpp"

#include <gtest/gtest.h>

namespace vagus::net {
namespace {

TEST(Target, ReadsTheShortForms) {
    EXPECT_EQ(parse_target("tcp:localhost:33333").value(),
              (Target{.place = TcpPlace{"localhost", 33333}}));
    EXPECT_EQ(parse_target("tcp:[::1]:0").value(), (Target{.place = TcpPlace{"::1", 0}}));
    EXPECT_EQ(
        parse_target("ser:/dev/ttyACM0").value(),
        (Target{.place = SerialPlace{.device = "/dev/ttyACM0", .name = ""}, .use = Use::Connect}));
    EXPECT_EQ(parse_target("ser:/dev/ttyUSB1:921600").value(),
              (Target{.place = SerialPlace{.device = "/dev/ttyUSB1", .name = "", .baud = 921600},
                      .use = Use::Connect}));
    EXPECT_EQ(parse_target("can:can1").value(),
              (Target{.place = CanPlace{"can1"}, .use = Use::Connect}));
}

TEST(Target, ReadsTheStringsOfAsebasTools) {
    EXPECT_EQ(parse_target("tcpin:33333").value(),
              (Target{.place = TcpPlace{"127.0.0.1", 33333}, .use = Use::Listen}));
    EXPECT_EQ(parse_target("tcpin:").value(),
              (Target{.place = TcpPlace{"127.0.0.1", 5000}, .use = Use::Listen}));
    EXPECT_EQ(parse_target("tcpin:port=0;address=0.0.0.0").value(),
              (Target{.place = TcpPlace{"0.0.0.0", 0}, .use = Use::Listen}));
    EXPECT_EQ(parse_target("tcp:192.168.1.5;33334").value(),
              (Target{.place = TcpPlace{"192.168.1.5", 33334}, .use = Use::Connect}));
    EXPECT_EQ(parse_target("tcp:port=33333").value(),  // as the dummy node prints it
              (Target{.place = TcpPlace{"localhost", 33333}, .use = Use::Connect}));
    EXPECT_EQ(parse_target("can:if=can2").value(),
              (Target{.place = CanPlace{"can2"}, .use = Use::Connect}));
}

TEST(Target, ReadsTheKeysOfASerialLine) {
    EXPECT_EQ(parse_target("ser:device=/dev/ttyS3;baud=57600;fc=hard;dtr=false").value(),
              (Target{.place = SerialPlace{.device = "/dev/ttyS3",
                                           .name = "",
                                           .baud = 57600,
                                           .flow_control = FlowControl::Hardware,
                                           .dtr = ModemLine::Leave},
                      .use = Use::Connect}));
    EXPECT_EQ(
        parse_target("ser:name=Thymio-II").value(),
        (Target{.place = SerialPlace{.device = "", .name = "Thymio-II"}, .use = Use::Connect}));
    EXPECT_EQ(parse_target("ser:/dev/ttyS3;9600").value(),
              (Target{.place = SerialPlace{.device = "/dev/ttyS3", .name = "", .baud = 9600},
                      .use = Use::Connect}));
    // Priority device, then name.
    EXPECT_EQ(parse_target("ser:name=x;device=/dev/a").value(),
              (Target{.place = SerialPlace{.device = "/dev/a", .name = ""}, .use = Use::Connect}));
}

TEST(Target, ReadsARemap) {
    const Target both = parse_target("tcp:host=h;port=33333;remapLocal=5;remapTarget=2").value();
    EXPECT_EQ(both.remap, (hub::Remap{5, 2}));
    EXPECT_EQ(parse_target("tcp:h;1;remapLocal=5").value().remap, (hub::Remap{5, 1}));
    EXPECT_EQ(parse_target("can:if=can0;remapLocal=7").value().remap, (hub::Remap{7, 1}));
    EXPECT_EQ(parse_target("tcp:h;1").value().remap, std::nullopt);
}

struct Refusal {
    const char* text;
    const char* says;  // a part of the sentence
};

TEST(Target, ErrorsQuoteTheTextAndNameTheKeyAndTheFix) {
    const Refusal refusals[] = {
        {"", "no ':'"},
        {"localhost", "no ':'"},
        {"udp:5000", "'udp' is not a protocol here; a target is tcp:HOST:PORT"},
        {"stdin:", "'stdin' is not a protocol"},
        {"tcp:", "the port is missing"},
        {"tcp:localhost", "the port is missing; write tcp:localhost:33333"},
        {"tcp::33333", "the host is missing"},
        {"tcp:::1:33333", "an IPv6 address is written in brackets"},
        {"tcp:[::1:33333", "']'"},
        {"tcp:[::1]", "the port is missing; write tcp:[::1]:33333"},
        {"tcp:[::1]33333", "the port is missing"},
        {"tcp:h:65536", "the port '65536' is not a number from 0 to 65535"},
        {"tcp:h:-1", "the port '-1'"},
        {"tcp:h:", "the port ''"},
        {"tcp:h;65536", "port=65536 is not a number from 0 to 65535"},
        {"tcp:host=h", "the port is missing"},
        {"tcp:host=;port=1", "the host is empty"},
        {"tcp:host=h;1", "'1' follows a key=value"},
        {"tcp:h;1;-1;-1;9", "'9' is one parameter too many"},
        {"tcp:h;1;port=2", "'port' is given twice"},
        {"tcp:h;1;colour=red", "the key 'colour' is unknown; known are host, port"},
        {"tcp:h;1;remapTarget=2", "remapTarget needs remapLocal"},
        {"tcp:h;1;remapLocal=70000", "remapLocal=70000 is not a number"},
        {"tcp:h;1;sock=4", "leave sock out"},
        {"tcpin:x", "port=x is not a number"},
        {"tcpin:1;address=", "the address is empty"},
        {"ser:", "the device is missing; write ser:/dev/ttyACM0"},
        {"ser:/dev/a:fast", "the baud rate 'fast' is not a number"},
        {"ser:baud=9600", "name the line: device=/dev/ttyACM0"},
        {"ser:1;9600", "port numbers change"},
        {"ser:device=/dev/a;parity=even", "parity=even: Aseba's serial lines are 8N1"},
        {"ser:device=/dev/a;fc=soft", "fc is 'none' or 'hard'"},
        {"ser:device=/dev/a;dtr=1", "dtr is 'true' or 'false'"},
        {"can:", "the interface is missing; write can:can0"},
        {"can:if=", "the interface is empty"},
    };
    for (const Refusal& each : refusals) {
        const auto result = parse_target(each.text);
        ASSERT_FALSE(result.ok()) << each.text;
        EXPECT_EQ(result.error().code, Code::BadInput);
        EXPECT_NE(result.error().what.find(each.says), std::string::npos) << result.error().what;
        EXPECT_NE(result.error().what.find("'" + std::string(each.text) + "'"), std::string::npos)
            << result.error().what;
    }
}

TEST(Target, RefusesATextOneCharacterTooLong) {
    const std::string longest = "can:" + std::string(kTargetCharsMax - 4, 'x');
    EXPECT_TRUE(parse_target(longest).ok());
    EXPECT_FALSE(parse_target(longest + "x").ok());
}

TEST(Target, IsWrittenInTheShortForm) {
    for (const char* text : {"tcp:localhost:1", "tcp:[::1]:2", "ser:/dev/a", "ser:/dev/a:9600",
                             "can:can0", "ser:name=Thymio-II;baud=9600"}) {
        EXPECT_EQ(to_string(parse_target(text).value()), text);
    }
    EXPECT_EQ(to_string(parse_target("tcpin:5").value()), "tcp:127.0.0.1:5");
}

}  // namespace
}  // namespace vagus::net
