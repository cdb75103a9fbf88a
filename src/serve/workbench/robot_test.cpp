// The studio with a robot at the other end of a real connection.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/test_folder.hpp"
#include "net/links.hpp"
#include "serve/json.hpp"
#include "serve/talk/codec.hpp"
#include "serve/workbench/test_runner.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;

constexpr const char* kToken = "0123456789abcdef";
using namespace std::string_literals;
const std::string kPresent = "\x02\x00\x01\x00\x0c\x90\x05\x00"s;  // node 1, version 5
const std::string kStopNode = "\x02\x00\x00\x00\x06\xa0\x01\x00"s;
constexpr const char* kLongPlan =
    "{ \"format\": \"vagus-plan/1\", \"name\": \"Go\", \"start\": { \"actor\": \"wait\" }, "
    "\"actors\": { \"wait\": { \"template\": \"WaitForever\" } } }\n";
// "a" has room for 100 words of program, 32 of stack and 100 of variables, and lists nothing.
const std::string kDescription =
    "\x10\x00\x01\x00\x00\x90\x01"s + "a\x05\x00\x64\x00\x20\x00\x64\x00\x00\x00\x00\x00\x00\x00"s;
const std::string kRuns = "\x04\x00\x01\x00\x0a\x90\x00\x00\x00\x00"s;
const std::string kStands = "\x04\x00\x01\x00\x0a\x90\x00\x00\x02\x00"s;
constexpr int kReset = 0xa002, kRun = 0xa003, kStop = 0xa006, kAskState = 0xa007;
const std::string kDescribe = "\x10\xa0"s;  // the type of GetNodeDescription

struct RobotBench : testing::Test {
    RobotBench()
        : desk(Access(kToken, "fedcba9876543210"),
               {.send =
                    [this](ClientId, bool binary, const std::string& bytes) {
                        if (!binary) heard.push_back(Json::parse(bytes));
                    },
                .close = [](ClientId, const std::string&) {},
                .log = [](const std::string&) {},
                .wall_ms = [] { return 1e12; }}),
          bench(network, desk,
                {.library = {root / "data", root / "examples"},
                 .settings = (root / "settings.json").string(),
                 .program = "/bin/false",
                 .home = root.string(),
                 .runner = [this] { return start_scripted(runner); },
                 .slept = [this] { return slept; }}) {
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
            << R"({"format":"vagus-project/1","name":"p","scripts":[],"plan":"Go.plan.json",)"
            << R"("target":")" << target << "\"}";
        std::ofstream(root / "project" / "Go.plan.json") << kLongPlan;
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
        const double until = static_cast<double>(network.now().count()) / 1000 + 3000;
        return {{1}, Json({{"id", ++id}, {"do", command}, {"in", in}, {"until", until}}).dump()};
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

    void answer(const std::string& bytes) {
        ASSERT_EQ(::send(robot, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
    }
    // A turn, and what the robot answers to commands that change its state, or ask for it.
    void live() {
        turn();
        told();
        const auto word = [this](size_t at) {
            return static_cast<uint8_t>(text[at]) | (static_cast<uint8_t>(text[at + 1]) << 8);
        };
        for (size_t end = 0; text.size() >= read + 6; read = end) {
            end = read + 6 + static_cast<size_t>(word(read));
            if (text.size() < end) return;
            const int type = word(read + 4);
            stands = type == kStop || type == kReset || (stands && type != kRun);
            if (type == kStop || type == kReset || type == kRun || type == kAskState) {
                answer(stands ? kStands : kRuns);
            }
        }
    }
    // The robot has told what it is: "a", without variables.
    void describe() {
        answer(kPresent);
        while (told().find(kDescribe) == std::string::npos) turn();
        answer(kDescription);
        while (bench.figures().target.nodes == 0) live();
    }
    // The plan of the project runs, as far as its process tells.
    void run_plan() {
        desk.hear(say("run.start", Json::object()), network.now());
        const uint64_t asked = id;
        while (!runner) live();
        tell(talk::Opened{.order = order(), .scene = talk::Scene{}});
        const std::string plan = (root / "project" / "Go.plan.json").string();
        tell(talk::PlanNow{.state = talk::PlanState::Running, .file = plan});
        const auto answers = [this, asked](const Json& message) {
            return message.value("id", uint64_t{0}) == asked && message.contains("ok");
        };
        while (!std::any_of(heard.begin(), heard.end(), answers)) live();
        text.erase(0, std::exchange(read, 0));
    }
    // The number of the order to open.
    uint64_t order() {
        for (;;) {
            for (const Packet& packet : runner->receive()) {
                const auto said = talk::decode_order(packet);
                const auto* open = said.ok() ? std::get_if<talk::Open>(&said.value()) : nullptr;
                if (open) return open->order;
            }
            live();
        }
    }
    void tell(const talk::News& news) { ASSERT_TRUE(runner->send(talk::encode(news))); }
    Json end_document() {
        heard.clear();
        desk.hear(say("watch", {{"watch", 1}, {"topic", "end"}}), network.now());
        desk.tick(network.now());
        for (const Json& message : heard) {
            if (message.contains("whole")) return message["whole"];
        }
        return {};
    }

    const test::Folder root;
    std::optional<Pipe> runner;
    size_t read = 0;  // of what it was told
    bool stands = false;
    Duration slept = 5s;  // before the server began: that is no matter
    std::vector<Json> heard;
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
    answer(kPresent);
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

// Nobody watched the robot meanwhile (safe stop, S5).
TEST_F(RobotBench, AComputerThatSleptStopsTheRobotOfItsPlan) {
    describe();
    run_plan();
    EXPECT_EQ(end_document(), Json({{"open", false}}));
    slept += 4s;
    turn();
    EXPECT_NE(told().find(kStopNode), std::string::npos);
    // Its process has noticed, too.
    tell(talk::PlanNow{.state = talk::PlanState::Ended, .result = "Interrupted"});
    while (!end_document().contains("end")) live();
    const Json end = end_document()["end"];
    EXPECT_EQ(end["why"], "slept");
    EXPECT_EQ(end["nodes"], Json({{{"node", 1}, {"name", "a"}, {"state", "stopped"}}}));
    EXPECT_EQ(bench.end_in_words(),
              "stopped, since this computer slept; the plan's result: Interrupted; at rest: a (1)");
    EXPECT_EQ(bench.figures().ends["slept"], 1u);
}

TEST_F(RobotBench, OneThatSleptWithoutAPlanIsLeftAsItIs) {
    describe();
    slept += 4s;
    for (int i = 0; i < 5; ++i) live();
    EXPECT_EQ(text.find(kStopNode), std::string::npos);
}

// By whom: there is no page that could be named.
TEST_F(RobotBench, AStopByPostSaysFromWhere) {
    describe();
    run_plan();
    desk.hear(StopAsked{"192.0.2.7"}, network.now());
    tell(talk::PlanNow{.state = talk::PlanState::Ended, .result = "Interrupted"});
    while (!end_document().contains("end")) live();
    EXPECT_EQ(end_document()["end"]["by"], "POST /stop from 192.0.2.7");
}

// A page has a name: "a page" is one that did not tell it.
TEST_F(RobotBench, WhoOpensAnotherProjectEndsTheRunOfTheOneBefore) {
    describe();
    run_plan();
    desk.hear(say("project.open", {{"path", (root / "project").string()}}), network.now());
    tell(talk::PlanNow{.state = talk::PlanState::Ended, .result = "Interrupted"});
    while (!end_document().contains("end")) live();
    EXPECT_EQ(end_document()["end"]["by"], "a page");
}

}  // namespace
}  // namespace vagus::serve
