// The studio with a robot at the other end of a real connection.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/test_folder.hpp"
#include "net/links.hpp"
#include "serve/json.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;

constexpr const char* kToken = "0123456789abcdef";
using namespace std::string_literals;
const std::string kPresent = "\x02\x00\x01\x00\x0c\x90\x05\x00"s;  // node 1, version 5
const std::string kStopNode = "\x02\x00\x00\x00\x06\xa0\x01\x00"s;
const std::string kDescribe = "\x10\xa0"s;  // the type of GetNodeDescription

struct RobotBench : testing::Test {
    RobotBench()
        : desk(Access(kToken, "fedcba9876543210"),
               {.send = [](ClientId, bool, const std::string&) {},
                .close = [](ClientId, const std::string&) {},
                .log = [](const std::string&) {},
                .wall_ms = [] { return 1e12; }}),
          bench(network, desk,
                {.library = {root / "data", root / "examples"},
                 .settings = (root / "settings.json").string(),
                 .program = "/bin/false",
                 .home = root.string()}) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        EXPECT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
        EXPECT_EQ(::listen(listener, 1), 0);
        EXPECT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
        const std::string target = "tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port));
        fs::create_directories(root / "project");
        std::ofstream(root / "project" / "vagus.json")
            << R"({"format":"vagus-project/1","name":"p","scripts":[],"target":")" << target
            << "\"}";
        desk.hear(ClientOpened{{1}, "127.0.0.1"}, network.now());
        desk.hear(say("hello", {{"token", kToken}, {"client", "a"}}), network.now());
        EXPECT_TRUE(bench.open((root / "project").string(), network.now()).ok());
        // The kernel has taken the connection as soon as it is asked for.
        turn();
        robot = ::accept(listener, nullptr, nullptr);
    }
    ~RobotBench() override {
        ::close(robot);
        ::close(listener);
    }

    ClientText say(const char* command, const Json& in) {
        return {{1}, Json({{"id", ++id}, {"do", command}, {"in", in}}).dump()};
    }
    void turn() {
        for (const net::Event& event : network.poll(network.now() + 10ms)) bench.hear(event);
        bench.tick(network.now());
    }
    // What the robot has been told by now.
    std::string told() {
        char bytes[4096];
        for (ssize_t count = 1; count > 0;) {
            count = ::recv(robot, bytes, sizeof bytes, MSG_DONTWAIT);
            if (count > 0) text.append(bytes, static_cast<size_t>(count));
        }
        return text;
    }

    const test::Folder root;
    const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
    int robot = -1;
    uint64_t id = 0;
    std::string text;
    net::Links network;
    Desk desk;
    Workbench bench;
};

// Other pages' commands of the same turn may take long.
TEST_F(RobotBench, StopIsOnTheWireBeforeTheNextCommandOfItsTurnIsObeyed) {
    ASSERT_EQ(::send(robot, kPresent.data(), kPresent.size(), 0), 8);
    while (told().find(kDescribe) == std::string::npos) turn();
    std::string by_then;
    desk.command("project.forget", [&](const Call& call) {
        by_then = told();
        call.done();
    });
    desk.hear({say("stop", Json::object()), say("project.forget", {{"path", "/x"}})},
              network.now());
    EXPECT_NE(by_then.find(kStopNode), std::string::npos);
}

}  // namespace
}  // namespace vagus::serve
