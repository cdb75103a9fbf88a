#include "serve/fleet/fleet_desk.hpp"

#include <gtest/gtest.h>

#include "fleet/limits.hpp"
#include "serve/studio/test_desk.hpp"

namespace vagus::serve {
namespace {

using fleet::Kind;
using test::Fixture;

// What the desk said to a broker, and what that says to it.
struct Wire {
    std::vector<fleet::Post> posts;
    std::vector<fleet::LinkEvent> inbox;
    LinkOptions options;
};

class TestLink : public fleet::Link {
public:
    explicit TestLink(Wire& wire) : wire_(wire) {}
    void subscribe(const std::vector<fleet::Filter>&) override {}
    void publish(const fleet::Post& post) override { wire_.posts.push_back(post); }
    std::vector<fleet::LinkEvent> take() override { return std::exchange(wire_.inbox, {}); }

private:
    Wire& wire_;
};

class FleetDeskTest : public ::testing::Test, protected Fixture {
protected:
    FleetDeskTest() {
        hello(1, test::kDrive, "page");
        say(1, {{"id", 2}, {"do", "driver.ask"}, {"in", Json::object()}});
    }
    void tick(Duration later = 0s) {
        now += later;
        fleet.tick(now);
        desk.tick(now);
    }
    void hear(fleet::LinkEvent event) {
        wire.inbox.push_back(std::move(event));
        tick();
    }
    void hear(const fleet::Topic& topic, const fleet::Message& message) {
        hear(fleet::Received{{topic, message}, false});
    }
    void open_fleet(const std::string& host = "broker") {
        ASSERT_TRUE(fleet.open({.target = "mqtt://" + host + "/lab"}, now).ok());
        hear(fleet::Connected{});
        const std::string own = wire.options.client;
        hear({.kind = Kind::Command, .robot = own, .name = "stop"},
             fleet::Command{.verb = "stop", .id = "echo", .reply = own});
        wire.posts.clear();
    }
    void robot(const std::string& name, const std::string& connection = "online") {
        hear({.kind = Kind::Connection, .robot = name}, fleet::Connection{connection, "i", 7});
        hear({.kind = Kind::State, .robot = name},
             fleet::State{.number = 1, .epoch = 7, .clock = 100});
    }
    // The last command that was posted, answered by a robot.
    void answer(const std::string& name, bool done, std::vector<std::string> silent = {}) {
        const fleet::Post& post = wire.posts.back();
        const auto heard = fleet::read("lab", post.topic, post.payload);
        ASSERT_TRUE(heard.ok());
        const auto& command = std::get<fleet::Command>(heard.value().message);
        hear({.kind = Kind::Answer, .robot = name, .name = command.reply},
             fleet::Answer{.id = command.id, .done = done, .silent = std::move(silent)});
    }
    Json order(uint64_t id, const char* what, Json in) {
        return say(1, {{"id", id}, {"do", what}, {"in", std::move(in)}});
    }
    Json last() { return got[ClientId{1}].back(); }

    Wire wire;
    FleetDesk fleet{desk,
                    [this](LinkOptions options) {
                        wire.options = std::move(options);
                        return std::make_unique<TestLink>(wire);
                    },
                    {.version = [] {
                        const auto packed = []() -> Result<PackedVersion> {
                            return PackedVersion{"the version", "ab"};
                        };
                        return std::optional(OpenVersion{"Rover", {}, packed});
                    }}};
};

TEST_F(FleetDeskTest, WithoutAFleetNothingIsOrdered) {
    const Json said = order(3, "fleet.stop", Json::object());
    EXPECT_EQ(said["error"]["what"], "no fleet is open; open one with its address first");
}

TEST_F(FleetDeskTest, OpensWhatAnAddressNames) {
    EXPECT_EQ(order(3, "fleet.open", {{"target", "mqtt://broker"}})["error"]["what"],
              "mqtt://broker: which fleet? Write mqtt://HOST[:PORT]/FLEET");
    const Json missing =
        order(4, "fleet.open", {{"target", "mqtt://broker/lab"}, {"login", "/nowhere/x.login"}});
    EXPECT_NE(missing["error"]["what"].get<std::string>().find("/nowhere/x.login"),
              std::string::npos);
    EXPECT_TRUE(order(5, "fleet.open", {{"target", "mqtt://broker/lab"}}).contains("ok"));
    EXPECT_EQ(wire.options.target.host, "broker");
    EXPECT_EQ(wire.options.target.fleet, "lab");
}

TEST_F(FleetDeskTest, EachRobotIsToldByItself) {
    open_fleet();
    robot("r1"), robot("r2"), robot("r3");
    order(3, "fleet.order", {{"verb", "pause"}, {"robots", {"r1", "r3"}}});
    ASSERT_EQ(wire.posts.size(), 2u);
    EXPECT_EQ(wire.posts[0].topic, "vagus/1/lab/cmd/r1/pause");
    EXPECT_EQ(wire.posts[1].topic, "vagus/1/lab/cmd/r3/pause");
    answer("r1", true);
    EXPECT_NE(last()["id"], 3) << "r3 has not answered";
    answer("r3", false);
    EXPECT_EQ(last(), Json({{"id", 3},
                            {"ok",
                             {{"outcomes",
                               {{{"robot", "r1"}, {"result", "done"}, {"what", ""}},
                                {{"robot", "r3"}, {"result", "refused"}, {"what", ""}}}}}}}));
}

TEST_F(FleetDeskTest, StopAllNamesWhoDidNotAnswerAndWhichNodesDidNotStop) {
    open_fleet();
    robot("r1"), robot("r2"), robot("r3", "lost");
    order(3, "fleet.stop", Json::object());
    ASSERT_EQ(wire.posts.size(), 1u);
    EXPECT_EQ(wire.posts[0].topic, "vagus/1/lab/cmd/all/stop");
    answer("r1", false, {"thymio-II"});
    tick(kFleetAnswerWithin - 1us);
    EXPECT_NE(last()["id"], 3);
    EXPECT_GT(wire.posts.size(), 1u) << "repeated until it is answered";
    tick(1us);
    const Json outcomes = last()["ok"]["outcomes"];
    ASSERT_EQ(outcomes.size(), 3u);
    EXPECT_EQ(outcomes[0]["what"], "not known to have stopped: thymio-II");
    EXPECT_EQ(outcomes[1]["result"], "silent");
    EXPECT_EQ(outcomes[2]["result"], "away");
    const size_t posts = wire.posts.size();
    tick(1min);
    EXPECT_EQ(wire.posts.size(), posts) << "nobody waits for it any more";
}

TEST_F(FleetDeskTest, WhoIsAwayIsNotWaitedFor) {
    open_fleet();
    robot("r1"), robot("r2", "offline");
    order(3, "fleet.order", {{"verb", "start"}, {"robots", {"r1", "r2"}}});
    answer("r1", true);
    EXPECT_NE(last()["id"], 3);
    tick(kFleetAwayAfter);
    EXPECT_EQ(last()["ok"]["outcomes"][1]["result"], "away");
}

TEST_F(FleetDeskTest, AStopWithoutABrokerSaysWhatBecomesOfTheRobots) {
    open_fleet();
    robot("r1");
    hear(fleet::Lost{"no connection to mqtt://broker:1883/lab: Connection refused"});
    order(3, "fleet.stop", Json::object());
    tick(kFleetAnswerWithin);
    const std::string what = last()["error"]["what"];
    EXPECT_NE(what.find("Connection refused"), std::string::npos) << what;
    EXPECT_NE(what.find("stops after 5 s"), std::string::npos) << what;
}

TEST_F(FleetDeskTest, ALoginThatMayNotOrderIsTheReason) {
    open_fleet();
    robot("r1");
    order(3, "fleet.order", {{"verb", "start"}, {"robots", {"r1"}}});
    hear(fleet::Acknowledged{wire.posts.back().number, "Not authorized"});
    EXPECT_EQ(last()["error"]["code"], "not_allowed");
    EXPECT_EQ(last()["error"]["what"],
              "the broker does not pass it on (Not authorized); open the fleet with the login of "
              "an operator");
}

TEST_F(FleetDeskTest, WhatRobotsWouldNotUnderstandIsRefusedHere) {
    open_fleet();
    robot("r1");
    const Json said = order(3, "fleet.order", {{"verb", "emit"}, {"robots", {"r1"}}});
    EXPECT_EQ(said["error"]["code"], "bad_input");
    EXPECT_EQ(
        order(4, "fleet.order", {{"verb", "pause"}, {"robots", Json::array()}})["error"]["what"],
        "no robot is chosen; name at least one");
    EXPECT_TRUE(wire.posts.empty());
}

TEST_F(FleetDeskTest, SoManyOrdersAreUnderWayAtATimeAndStopIsNotRefused) {
    open_fleet();
    robot("r1");
    uint64_t id = 2;
    for (size_t i = 0; i < kFleetOrdersMax; ++i) {
        now += 10ms;  // not too many commands a second
        order(++id, "fleet.order", {{"verb", "pause"}, {"robots", {"r1"}}});
    }
    EXPECT_EQ(order(++id, "fleet.order", {{"verb", "pause"}, {"robots", {"r1"}}})["error"]["code"],
              "limit");
    order(++id, "fleet.stop", Json::object());
    EXPECT_EQ(wire.posts.back().topic, "vagus/1/lab/cmd/all/stop");
}

TEST_F(FleetDeskTest, WhoOnlyLooksMayStopAndNothingElse) {
    open_fleet();
    robot("r1");
    hello(2, test::kLook, "looker");
    const Json refused =
        say(2, {{"id", 2}, {"do", "fleet.order"}, {"in", {{"verb", "pause"}, {"robots", {"r1"}}}}});
    EXPECT_TRUE(refused.contains("error"));
    EXPECT_TRUE(wire.posts.empty());
    say(2, {{"id", 3}, {"do", "fleet.stop"}, {"in", {{"robots", {"r1"}}}}});
    ASSERT_EQ(wire.posts.size(), 1u);
    EXPECT_EQ(wire.posts[0].topic, "vagus/1/lab/cmd/r1/stop");
}

// A hundred robots that tell their state five times a second are one document five times a second.
TEST_F(FleetDeskTest, TilesChangeFiveTimesASecondAtMost) {
    open_fleet();
    say(1, {{"id", 3},
            {"do", "watch"},
            {"in", {{"watch", 1}, {"topic", "fleet"}, {"of", Json::object()}, {"rate", 20}}}});
    tick(1s);
    const size_t before = got[ClientId{1}].size();
    for (int i = 0; i < 100; ++i) {
        now += 10ms;
        const std::string name = "r" + std::to_string(i % 20);
        hear({.kind = Kind::State, .robot = name},
             fleet::State{.number = i + 1, .epoch = 7, .clock = i, .actor = std::to_string(i)});
    }
    EXPECT_LE(got[ClientId{1}].size() - before, 6u);
    EXPECT_GE(got[ClientId{1}].size() - before, 4u);
}

TEST_F(FleetDeskTest, AVersionIsForThoseThatAreThereFirst) {
    EXPECT_EQ(order(3, "fleet.deploy", Json::object())["error"]["what"],
              "no fleet is open; open one with its address first");
    open_fleet("127.0.0.1");
    robot("r1", "lost"), robot("r2");
    EXPECT_TRUE(order(4, "fleet.deploy", {{"steps", "1,100%"}}).contains("ok"));
    tick();
    ASSERT_EQ(wire.posts.size(), 1u);
    EXPECT_EQ(wire.posts[0].topic, "vagus/1/lab/robot/r2/want");
    EXPECT_EQ(order(5, "fleet.rollback", Json::object())["error"]["what"],
              "a roll-out is under way; stop it, or wait for its end");
    EXPECT_TRUE(order(6, "fleet.rollout_stop", Json::object()).contains("ok"));
    EXPECT_TRUE(order(7, "fleet.rollout_stop", Json::object()).contains("error"));
    hear(fleet::Lost{"cut"});
    EXPECT_EQ(order(8, "fleet.deploy", Json::object())["error"]["what"],
              "it could not be sent: cut");
}

TEST_F(FleetDeskTest, RobotsElsewhereNeedAnAddressThatTheyReach) {
    open_fleet();
    robot("r1");
    const std::string what = order(3, "fleet.deploy", Json::object())["error"]["what"];
    EXPECT_NE(what.find("--deploy-listen"), std::string::npos) << what;
}

TEST_F(FleetDeskTest, PagesSeeWhatWasOrdered) {
    open_fleet();
    robot("r1");
    order(3, "fleet.order", {{"verb", "pause"}, {"robots", {"r1"}}});
    answer("r1", true);
    say(1, {{"id", 4},
            {"do", "watch"},
            {"in", {{"watch", 2}, {"topic", "fleet_events"}, {"of", {{"last", 10}}}}}});
    tick(1s);
    const Json items = last()["items"];
    ASSERT_FALSE(items.empty());
    EXPECT_EQ(items.back()["kind"], "order");
    EXPECT_EQ(items.back()["name"], "pause");
    EXPECT_EQ(items.back()["text"], "1 of 1 robots");
}

}  // namespace
}  // namespace vagus::serve
