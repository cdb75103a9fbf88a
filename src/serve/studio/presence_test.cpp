// Who is there, of those that are connected.
#include "serve/studio/test_desk.hpp"

namespace vagus::serve {
namespace {

using namespace test;

// A client that was stopped, or whose Wi-Fi is gone: its connection stays.
TEST(Desk, AClientThatLeavesThreePingsUnansweredIsNotThere) {
    Fixture f;
    f.hello(1, kDrive, "a");
    int changes = 0;
    f.desk.on_people([&] { ++changes; });
    const auto pass = [&f](int seconds) {
        for (int i = 0; i < seconds; ++i) f.desk.tick(f.now += 1s);
    };
    f.desk.tick(f.now);
    pass(3);
    EXPECT_EQ(f.desk.present(), 1u);
    EXPECT_EQ(changes, 0);
    pass(1);  // three are unanswered, and the fourth was sent
    EXPECT_EQ(f.desk.present(), 0u);
    EXPECT_FALSE(f.desk.is_there(1));
    EXPECT_EQ(changes, 1);
    pass(5);
    EXPECT_EQ(changes, 1);
    f.say_as_it_is(1, {{"pong", 1}});
    EXPECT_EQ(f.desk.present(), 1u);
    EXPECT_TRUE(f.desk.is_there(1));
    EXPECT_EQ(changes, 2);
}

TEST(Desk, WhatACommandShowsIsThereToo) {
    Fixture f;
    f.hello(1, kDrive, "a");
    f.desk.tick(f.now);
    for (int i = 0; i < 6; ++i) {  // who takes nothing for longer is sent away
        f.desk.tick(f.now += 1s);
        f.run(1, 2 + static_cast<uint64_t>(i));
    }
    EXPECT_EQ(f.desk.present(), 1u);
}

// Our own loop was late, or it is just taking what was before the ping.
TEST(Desk, SlowIsNotGone) {
    Fixture f;
    f.hello(1, kDrive, "a");
    f.desk.tick(f.now);
    for (int i = 0; i < 5; ++i) f.desk.tick(f.now += 1s + kPingLateMax + 1ms);
    EXPECT_EQ(f.desk.present(), 1u);
    // Its document is on its way, and comes through piece by piece.
    f.desk.command("doc.open", [](const Call& call) {
        call.done({{"text", std::string(3 * kSlowBytes, 'x')}});
    });
    f.say(1, {{"id", 99}, {"do", "doc.open"}, {"in", {{"doc", "a"}}}});
    for (int i = 0; i < 10; ++i) {
        f.desk.hear(ClientTook{{1}, 1000}, f.now);
        f.desk.tick(f.now += 1s);
    }
    EXPECT_EQ(f.desk.present(), 1u);
}

// A page that only looked may come back first: who typed goes on typing.
TEST(Desk, AfterARestartThePageThatHadControlHasItAgain) {
    Fixture f;
    EXPECT_EQ(f.hello(1, kDrive, "looked")["ok"]["driver"], true);
    f.now += 5s;
    EXPECT_EQ(f.hello(2, kLook, "may only look", true)["ok"]["driver"], false);
    EXPECT_EQ(f.hello(3, kDrive, "typed", true)["ok"]["driver"], true);
    EXPECT_EQ(f.run(1, 2)["error"]["code"], "not_driver");
    EXPECT_EQ(f.hello(4, kDrive, "another", true)["ok"]["driver"], false);
}

TEST(Desk, ControlThatWasGivenOrIsOldIsNotTakenBack) {
    Fixture given;
    given.hello(1, kDrive, "a");
    given.say(1, {{"id", 2}, {"do", "driver.leave"}});
    given.say(1, {{"id", 3}, {"do", "driver.ask"}});
    EXPECT_EQ(given.hello(2, kDrive, "b", true)["ok"]["driver"], false);

    Fixture old;
    old.hello(1, kDrive, "a");
    old.now += kControlBackWithin;
    EXPECT_EQ(old.hello(2, kDrive, "b", true)["ok"]["driver"], false);
}

TEST(Desk, WhatWasAskedForBeforeAnotherPressedStopIsNotDoneAfterIt) {
    Fixture f;
    f.desk.command("stop", [&f](const Call& call) {
        f.desk.count_stop(call.member);
        call.done({{"stood", Json::array()}});
    });
    EXPECT_EQ(f.hello(1, kDrive, "a")["ok"]["stops"], 0);
    f.hello(2, kLook, "b");
    const auto run = [&](int id, int stops) {
        const Json in = {{"node", 1}};
        return f.say(1, {{"id", id}, {"do", "node.run"}, {"in", in}, {"stops", stops}});
    };
    f.say(2, {{"id", 2}, {"do", "stop"}});
    const Json refused = run(2, 0);  // it was on its way
    EXPECT_EQ(f.ran, 0);
    EXPECT_EQ(refused["error"]["what"],
              "node.run was asked for before somebody else pressed Stop; it was not done. Give it "
              "again");
    f.desk.tick(f.now);
    EXPECT_EQ(f.pings[ClientId{1}].back()["stops"], 1);  // heard of at once
    run(3, 1);
    EXPECT_EQ(f.ran, 1);
    // Its own, on each of its ways: what it sends behind them is meant.
    f.say(1, {{"id", 4}, {"do", "stop"}});
    f.desk.hear(StopAsked{"127.0.0.1", 1}, f.now);
    run(5, 1);
    EXPECT_EQ(f.ran, 2);
    f.desk.hear(StopAsked{"127.0.0.1"}, f.now);  // of someone without a page
    run(6, 1);
    EXPECT_EQ(f.ran, 2);
    f.run(1, 7);  // a client that does not say what it has heard of
    EXPECT_EQ(f.ran, 3);
}

}  // namespace
}  // namespace vagus::serve
