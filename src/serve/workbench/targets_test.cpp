// Finding targets, from what the system shows of them.
#include "serve/workbench/targets.hpp"
#include "base/test_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

using namespace vagus::serve;
namespace fs = std::filesystem;

namespace {

struct TargetsTest : testing::Test {
    TargetsTest() {
        fs::create_directories(folder / "dev");
        fs::create_directories(folder / "by-id");
    }
    void write(const char* name, std::string_view text) const {
        std::ofstream(folder / name) << text;
    }
    const vagus::test::Folder folder;
};

TEST_F(TargetsTest, SerialDevicesHaveTheNamesOfTheirMakers) {
    write("dev/ttyACM0", "");
    write("dev/ttyUSB3", "");
    write("dev/tty1", "");
    fs::create_symlink(folder / "dev/ttyACM0", folder / "by-id/usb-Mobsya_Thymio-II-if00");
    const auto found = serial_targets((folder / "by-id").string(), (folder / "dev").string());
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].target, "ser:" + (folder / "dev/ttyACM0").string());
    EXPECT_EQ(found[0].name, "Mobsya Thymio-II");
    EXPECT_EQ(found[1].name, "ttyUSB3");
    EXPECT_EQ(found[1].kind, "serial");
}

// 33333 is 8235, 33342 is 823E, 33343 is 823F in hexadecimal; state 0A listens, 01 is connected
// (proc(5), /proc/net/tcp).
TEST_F(TargetsTest, PortsOfAsebasProgramsOnWhichSomethingListensAreOffered) {
    write("tcp",
          "  sl  local_address rem_address   st tx_queue rx_queue\n"
          "   0: 0100007F:8235 00000000:0000 0A 00000000:00000000\n"
          "   1: 0100007F:8236 0100007F:9C40 01 00000000:00000000\n"
          "   2: 00000000:0016 00000000:0000 0A 00000000:00000000\n"
          "   3: 00000000:823F 00000000:0000 0A 00000000:00000000\n");
    write("tcp6",
          "  sl  local_address rem_address st\n"
          "   0: 00000000000000000000000000000000:823E 00000000000000000000000000000000:0000 0A\n"
          "garbage\n");
    const auto found = local_targets((folder / "tcp").string(), (folder / "tcp6").string());
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].target, "tcp:127.0.0.1:33333");
    EXPECT_EQ(found[1].target, "tcp:127.0.0.1:33342");
}

TEST(Targets, WhatAnnouncesItselfIsOfferedOnceByItsName) {
    const auto found = announced_targets(
        "+;eth0;IPv4;Thymio\\032of\\032Anna;_aseba._tcp;local\n"
        "=;eth0;IPv6;Thymio\\032of\\032Anna;_aseba._tcp;local;anna.local;fe80::1;33333;\"id=1\"\n"
        "=;eth0;IPv4;Thymio\\032of\\032Anna;_aseba._tcp;local;anna.local;192.168.1.7;33333;\n"
        "=;eth0;IPv4;Bert;_aseba._tcp;local;bert.local;192.168.1.8;33334;\n"
        "=;too;short\n");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].name, "Thymio of Anna");
    EXPECT_EQ(found[0].target, "tcp:[fe80::1]:33333");
    EXPECT_EQ(found[0].help, "anna.local");
    EXPECT_EQ(found[1].target, "tcp:192.168.1.8:33334");
    EXPECT_EQ(found[1].kind, "network");
}

}  // namespace
