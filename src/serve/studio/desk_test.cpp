#include "serve/studio/test_desk.hpp"

namespace vagus::serve {
namespace {

using namespace test;

TEST(Desk, NothingIsAnsweredBeforeHello) {
    Fixture f;
    f.open(1);
    EXPECT_EQ(f.run(1, 1)["error"]["code"], "not_allowed");
    EXPECT_EQ(f.ran, 0);
    EXPECT_EQ(f.closed[ClientId{1}], "expected the command hello");
}

TEST(Desk, AWrongTokenIsRefusedLoggedAndSlowedDown) {
    Fixture f;
    EXPECT_EQ(f.hello(1, "wrong", "a")["error"]["code"], "not_allowed");
    EXPECT_EQ(f.log.size(), 1u);
    // The second one hears so half a second later, and nothing that it says meanwhile counts.
    EXPECT_TRUE(f.hello(2, "wrong", "a").is_null());
    EXPECT_TRUE(f.say(2, {{"id", 2}, {"do", "hello"}, {"in", {{"token", kDrive}, {"client", "a"}}}})
                    .is_null());
    f.desk.tick(f.now);
    EXPECT_EQ(f.desk.next_tick(f.now), f.now + 500ms);
    f.now += 499ms;
    f.desk.tick(f.now);
    EXPECT_TRUE(f.got[ClientId{2}].empty());
    f.now += 1ms;
    f.desk.tick(f.now);
    EXPECT_EQ(f.got[ClientId{2}].back()["error"]["code"], "not_allowed");
    EXPECT_EQ(f.closed[ClientId{2}], "wrong token");
    EXPECT_EQ(f.log.size(), 1u);  // equal lines are one
}

TEST(Desk, ARightTokenDoesNotWaitForWrongOnes) {
    Fixture f;
    for (uint32_t i = 1; i <= 20; ++i) f.hello(i, "wrong", "a");
    EXPECT_TRUE(f.hello(21, kDrive, "b").contains("ok"));
}

// As long as one that says nothing: a guesser cannot fill all the places for longer.
TEST(Desk, NoWrongTokenStaysLongerThanAPageWithoutAHello) {
    Fixture f;
    for (uint32_t i = 1; i <= 20; ++i) f.hello(i, "wrong", "a");
    f.now += 5s;
    f.desk.tick(f.now);
    EXPECT_EQ(f.closed.size(), 20u);
    EXPECT_EQ(f.closed[ClientId{20}], "wrong token");
}

TEST(Desk, WhoSaysNothingIsSentAway) {
    Fixture f;
    f.open(1);
    f.desk.tick(f.now + 5s);
    EXPECT_TRUE(f.closed.empty());
    f.desk.tick(f.now + 5001ms);
    EXPECT_EQ(f.closed[ClientId{1}], "expected the command hello");
}

TEST(Desk, TheFirstWhoMayDriveDrivesOthersLookAndMayStop) {
    Fixture f;
    EXPECT_EQ(f.hello(1, kDrive, "a")["ok"]["driver"], true);
    EXPECT_EQ(f.hello(2, kDrive, "b")["ok"]["driver"], false);
    EXPECT_EQ(f.hello(3, kLook, "c")["ok"]["role"], "look");
    EXPECT_TRUE(f.run(1, 2).contains("ok"));
    EXPECT_EQ(f.run(2, 2)["error"]["code"], "not_driver");
    EXPECT_EQ(f.run(3, 2)["error"]["code"], "not_allowed");
    EXPECT_EQ(f.ran, 1);
    for (const uint32_t page : {2u, 3u}) {
        EXPECT_TRUE(f.say(page, {{"id", 3}, {"do", "stop"}}).contains("ok"));
    }
}

TEST(Desk, ACommandThatComesTwiceIsDoneOnce) {
    Fixture f;
    f.hello(1, kDrive, "a");
    const Json first = f.run(1, 2);
    f.desk.hear(ClientClosed{{1}}, f.now);
    EXPECT_EQ(f.hello(2, kDrive, "a")["ok"]["driver"], true);  // its wheel waited for it
    EXPECT_EQ(f.run(2, 2), first);
    EXPECT_EQ(f.ran, 1);
}

TEST(Desk, AnAnswerThatCameWhileThePageWasAwayIsGivenToItLater) {
    Fixture f;
    f.hello(1, kDrive, "a");
    const Json load = {{"id", 2}, {"do", "node.load"}, {"in", {{"node", 0}}}};
    f.say(1, load);
    f.desk.hear(ClientClosed{{1}}, f.now);
    f.waiting.at(0).done({{"loaded", {1}}, {"failed", Json::array()}});
    f.hello(2, kDrive, "a");
    EXPECT_EQ(f.say(2, load)["ok"]["loaded"], Json({1}));
    EXPECT_EQ(f.waiting.size(), 1u);
}

TEST(Desk, TheWheelIsGivenRefusedOrTakenFromOneWhoIsGone) {
    Fixture f;
    f.hello(1, kDrive, "a");
    f.hello(2, kDrive, "b");
    const Json ask = {{"id", 2}, {"do", "driver.ask"}};
    EXPECT_EQ(f.say(2, ask)["ok"]["driver"], false);
    f.now += 10s;
    f.desk.tick(f.now);  // the driver is there and says nothing: refused
    EXPECT_EQ(f.run(2, 3)["error"]["code"], "not_driver");
    f.say(2, {{"id", 4}, {"do", "driver.ask"}});
    f.say(1, {{"id", 2}, {"do", "driver.answer"}, {"in", {{"give", true}}}});
    EXPECT_TRUE(f.run(2, 5).contains("ok"));
    f.desk.hear(ClientClosed{{2}}, f.now);
    EXPECT_EQ(f.say(1, {{"id", 3}, {"do", "driver.ask"}})["ok"]["driver"], true);  // gone: at once
    EXPECT_TRUE(f.run(1, 4).contains("ok"));
}

TEST(Desk, APageThatClosesGivesTheWheelToWhoAskedForIt) {
    Fixture f;
    f.hello(1, kDrive, "a");
    f.hello(2, kDrive, "b");
    EXPECT_EQ(f.say(2, {{"id", 2}, {"do", "driver.ask"}})["ok"]["driver"], false);
    f.desk.hear(ClientClosed{{1}}, f.now);
    EXPECT_TRUE(f.run(2, 3).contains("ok"));
    EXPECT_EQ(f.hello(3, kDrive, "a")["ok"]["driver"],
              false);  // and does not get it back by itself
}

TEST(Desk, WhoReadsNothingIsSentAwayAndOthersAreServed) {
    Fixture f;
    f.desk.topics().document("clock", [&](const Json&) {
        return Json{{"t", static_cast<double>(f.now.count())}, {"why", std::string(100'000, 'x')}};
    });
    f.hello(1, kDrive, "a");
    f.say(1, {{"id", 2}, {"do", "watch"}, {"in", {{"watch", 1}, {"topic", "clock"}}}});
    size_t largest = 0;
    for (int i = 0; i < 100; ++i) {
        f.now += 101ms;
        f.desk.topics().touch("clock");
        f.desk.tick(f.now);
        size_t bytes = 0;
        for (const Json& message : f.got[ClientId{1}]) bytes += message.dump().size();
        largest = std::max(largest, bytes);
    }
    EXPECT_LT(largest, kRoomBytes + 200'000);
    EXPECT_NE(f.closed[ClientId{1}].find("read too slowly"), std::string::npos);
}

// Ten seconds in which our own loop did nothing are not ten seconds of silence.
TEST(Desk, WhoIsSlowWhileWeAreLateIsKept) {
    Fixture f;
    f.hello(1, kDrive, "a");
    f.desk.tick(f.now);
    for (int i = 0; i < 20; ++i) f.desk.tick(f.now += 3s);
    EXPECT_TRUE(f.closed.empty());
    for (int i = 0; i < 11; ++i) f.desk.tick(f.now += 1s);
    EXPECT_NE(f.closed[ClientId{1}].find("read too slowly"), std::string::npos);
}

TEST(Desk, AnActHasADeadlineInTheServersTime) {
    Fixture f;
    f.hello(1, kDrive, "a");
    f.now = 100s;
    const auto run = [&](uint64_t id, const Json& until) {
        Json message = {{"id", id}, {"do", "node.run"}, {"in", {{"node", 1}}}};
        if (!until.is_null()) message["until"] = until;
        const Json answer = f.say_as_it_is(1, message);
        return answer.contains("error") ? answer["error"]["code"].get<std::string>() : "ok";
    };
    EXPECT_EQ(run(2, nullptr), "late");
    EXPECT_EQ(run(3, 99'999.9), "late");
    EXPECT_EQ(run(4, 100'000), "ok");
    EXPECT_EQ(run(5, 103'000), "ok");
    EXPECT_EQ(run(6, 104'000), "ok");  // a page whose clock is a little ahead
    EXPECT_EQ(run(7, 104'001), "late");
    EXPECT_EQ(run(8, "soon"), "bad_message");
    EXPECT_EQ(f.ran, 3);
    EXPECT_EQ(f.log.size(), 4u);
    EXPECT_NE(f.log[0].find("no deadline"), std::string::npos);
}

TEST(Desk, AnActThatAReconnectionBringsLateIsNotDone) {
    Fixture f;
    f.hello(1, kDrive, "a");
    const Json run = {
        {"id", 2}, {"do", "node.run"}, {"in", {{"node", 1}}}, {"until", 1000.0 + 3000}};
    f.desk.hear(ClientClosed{{1}}, f.now);
    f.now += 60s;
    f.hello(2, kDrive, "a");
    EXPECT_EQ(f.say_as_it_is(2, run)["error"]["code"], "late");
    EXPECT_EQ(f.ran, 0);
    // One that was done before is answered as it was, however late it is asked again.
    f.run(2, 3);
    f.desk.hear(ClientClosed{{2}}, f.now);
    f.now += 60s;
    f.hello(3, kDrive, "a");
    EXPECT_TRUE(
        f.say_as_it_is(3, {{"id", 3}, {"do", "node.run"}, {"in", {{"node", 1}}}}).contains("ok"));
    EXPECT_EQ(f.ran, 1);
}

TEST(Desk, StopNeedsNoDeadlineAndComesFirst) {
    Fixture f;
    std::vector<std::string> order;
    f.desk.command("stop", [&](const Call& call) {
        order.push_back("stop of " + std::to_string(call.member));
        call.done({{"stood", Json::array()}});
    });
    f.desk.command("doc.save", [&](const Call& call) {
        order.push_back("save");
        call.done();
    });
    f.hello(1, kDrive, "a");
    f.hello(2, kLook, "b");
    const Json save = {{"id", 2}, {"do", "doc.save"}, {"in", {{"doc", "a"}}}};
    const Json stop = {{"id", 3}, {"do", "stop"}};
    f.desk.hear(std::vector<WebEvent>{ClientText{{1}, save.dump()}, ClientText{{1}, stop.dump()},
                                      ClientText{{2}, stop.dump()}, StopAsked{"10.0.0.9"}},
                f.now);
    EXPECT_EQ(order, (std::vector<std::string>{"stop of 1", "stop of 2", "stop of 0", "save"}));
    EXPECT_EQ(f.log.back(), "10.0.0.9: POST /stop");
}

// Whoever reads the log may be slow.
TEST(Desk, AStopThatWasPostedIsObeyedBeforeItIsLogged) {
    Fixture f;
    size_t lines = 1;
    f.desk.command("stop", [&](const Call& call) {
        lines = f.log.size();
        call.done({{"stood", Json::array()}});
    });
    f.desk.hear(StopAsked{"10.0.0.9"}, f.now);
    EXPECT_EQ(lines, 0u);
    EXPECT_EQ(f.log, std::vector<std::string>{"10.0.0.9: POST /stop"});
}

// What was pressed before Stop and came in the same turn must not run behind it; what was pressed
// after it may. Where a POST came among the others nobody knows: it counts as the last.
TEST(Desk, WhatAStopHasOvertakenDoesNotRun) {
    Fixture f;
    f.hello(1, kDrive, "a");
    const auto run = [&](int id) {
        const Json in = {{"node", 1}};
        const double until = static_cast<double>(f.now.count()) / 1000 + 3000;
        const Json message = {{"id", id}, {"do", "node.run"}, {"in", in}, {"until", until}};
        return ClientText{{1}, message.dump()};
    };
    const auto error_of = [&](int id) -> Json {
        for (const Json& answer : f.got[ClientId{1}]) {
            if (answer.value("id", 0) == id && answer.contains("error")) return answer["error"];
        }
        return nullptr;
    };
    f.desk.hear(std::vector<WebEvent>{run(2), ClientText{{1}, R"({"id":3,"do":"stop"})"}, run(4)},
                f.now);
    EXPECT_EQ(f.ran, 1);
    EXPECT_EQ(error_of(2)["code"], "failed");
    EXPECT_EQ(error_of(2)["what"], "it was stopped before it ran");
    EXPECT_EQ(error_of(4), nullptr);
    f.desk.hear(std::vector<WebEvent>{StopAsked{"10.0.0.9"}, run(5)}, f.now);
    EXPECT_EQ(f.ran, 1);
    EXPECT_EQ(error_of(5)["code"], "failed");
    f.desk.hear(std::vector<WebEvent>{run(6)}, f.now);
    EXPECT_EQ(f.ran, 2);
}

// The hello of a batch is heard before the Stop behind it.
TEST(Desk, AStopBehindItsHelloIsDone) {
    Fixture f;
    int stops = 0;
    f.desk.command("stop", [&](const Call& call) {
        ++stops;
        call.done({{"stood", Json::array()}});
    });
    f.open(1);
    const Json hello = {{"id", 1}, {"do", "hello"}, {"in", {{"token", kLook}, {"client", "a"}}}};
    f.desk.hear(std::vector<WebEvent>{ClientText{{1}, hello.dump()},
                                      ClientText{{1}, R"({"id":2,"do":"stop"})"}},
                f.now);
    EXPECT_EQ(stops, 1);
}

TEST(Desk, WhatThrowsIsAnsweredOnceAndLogged) {
    Fixture f;
    f.desk.command("node.run", [&](const Call& call) {
        ++f.ran;
        if (f.ran == 2) call.done({{"failed", Json::array()}});
        throw std::runtime_error("out of cheese");
    });
    f.hello(1, kDrive, "a");
    EXPECT_EQ(f.run(1, 2)["error"]["code"], "failed");
    ASSERT_EQ(f.log.size(), 1u);
    EXPECT_EQ(f.log[0], "node.run: out of cheese");
    const size_t answers = f.got[ClientId{1}].size();
    EXPECT_TRUE(f.run(1, 3).contains("ok"));
    EXPECT_EQ(f.got[ClientId{1}].size(), answers + 1);
}

TEST(Desk, ARobotObeysOnlyWhatTheProtocolMarks) {
    Fixture f;
    f.desk.command("project.close", [&](const Call& call) { call.done(); });
    f.desk.allow_only_on_robot("not on a robot");
    f.hello(1, kDrive, "a");
    EXPECT_EQ(f.say(1, {{"id", 2}, {"do", "project.close"}})["error"]["what"], "not on a robot");
    EXPECT_TRUE(f.run(1, 3).contains("ok"));
}

TEST(Desk, PagesArePingedEachSecondWithTheTimeOfTheServer) {
    Fixture f;
    f.open(2);  // said nothing: hears nothing
    EXPECT_EQ(f.hello(1, kDrive, "a")["ok"]["now"], 1000);
    f.desk.tick(f.now);
    f.desk.tick(f.now += 999ms);
    EXPECT_EQ(f.pings[ClientId{1}].size(), 1u);
    EXPECT_EQ(f.desk.next_tick(f.now), 2s);
    f.desk.tick(f.now += 1ms);
    ASSERT_EQ(f.pings[ClientId{1}].size(), 2u);
    EXPECT_EQ(f.pings[ClientId{1}][1]["now"], 2000);
    EXPECT_TRUE(f.pings[ClientId{2}].empty());
    // An answer is not answered.
    const size_t answers = f.got[ClientId{1}].size();
    f.say_as_it_is(1, {{"pong", f.pings[ClientId{1}][1]["ping"]}});
    EXPECT_EQ(f.got[ClientId{1}].size(), answers);
}

// ---- two pages of one name ----

Json hello_of(const char* key, const char* nonce) {
    return {
        {"id", 1}, {"do", "hello"}, {"in", {{"token", kDrive}, {"client", key}, {"nonce", nonce}}}};
}

TEST(Desk, TwoTabsOfOneNameBothStayAndTheNewerGetsAnother) {
    Fixture f;
    f.open(1);
    EXPECT_EQ(f.say(1, hello_of("a", "one"))["ok"]["client"], "a");
    f.open(2);
    EXPECT_TRUE(f.say(2, hello_of("a", "two")).is_null());  // not yet
    ASSERT_EQ(f.pings[ClientId{1}].size(), 1u);
    f.say_as_it_is(1, {{"pong", f.pings[ClientId{1}][0]["ping"]}});
    const Json welcome = f.got[ClientId{2}].back();
    EXPECT_EQ(welcome["ok"]["client"], "2000000000000000");
    EXPECT_EQ(welcome["ok"]["driver"], false);
    EXPECT_TRUE(f.closed.empty());
    EXPECT_TRUE(f.run(1, 2).contains("ok"));
    // With its new name it comes back at once.
    f.desk.hear(ClientClosed{{2}}, f.now);
    f.open(3);
    EXPECT_EQ(f.say(3, hello_of("2000000000000000", "two"))["ok"]["number"],
              welcome["ok"]["number"]);
}

TEST(Desk, AnOldPongDoesNotSpeakForATab) {
    Fixture f;
    f.open(1);
    f.say(1, hello_of("a", "one"));
    f.desk.tick(f.now);
    f.open(2);
    f.say(2, hello_of("a", "two"));
    f.say_as_it_is(1, {{"pong", f.pings[ClientId{1}][0]["ping"]}});  // of before
    EXPECT_TRUE(f.got[ClientId{2}].empty());
}

TEST(Desk, APageThatWasLoadedAgainTakesThePlaceOfTheOneThatDoesNotAnswer) {
    Fixture f;
    f.open(1);
    f.say(1, hello_of("a", "one"));
    f.open(2);
    f.say(2, hello_of("a", "two"));
    f.desk.tick(f.now += kTwinWithin - 1ms);
    EXPECT_TRUE(f.got[ClientId{2}].empty());
    f.desk.tick(f.now += 1ms);
    EXPECT_EQ(f.got[ClientId{2}].back()["ok"]["client"], "a");
    EXPECT_EQ(f.got[ClientId{2}].back()["ok"]["driver"], true);
    EXPECT_EQ(f.closed[ClientId{1}], "the same page has connected again");
}

TEST(Desk, APageWhoseOldConnectionClosesMeanwhileKeepsItsName) {
    Fixture f;
    f.open(1);
    f.say(1, hello_of("a", "one"));
    f.open(2);
    f.say(2, hello_of("a", "two"));
    f.desk.hear(ClientClosed{{1}}, f.now);
    EXPECT_EQ(f.got[ClientId{2}].back()["ok"]["client"], "a");
}

TEST(Desk, TheSamePageReplacesItsOldConnectionAtOnce) {
    Fixture f;
    f.open(1);
    const Json first = f.say(1, hello_of("a", "one"));
    EXPECT_FALSE(first["ok"]["epoch"].get<std::string>().empty());
    f.open(2);
    const Json second = f.say(2, hello_of("a", "one"));
    EXPECT_EQ(second["ok"]["number"], first["ok"]["number"]);
    EXPECT_EQ(second["ok"]["epoch"], first["ok"]["epoch"]);
    EXPECT_EQ(f.closed[ClientId{1}], "the same page has connected again");
}

// ---- places ----

TEST(Desk, StrangersTakePlacesFromEachOtherOnly) {
    Fixture f;
    f.hello(1, kDrive, "a");
    const auto places = static_cast<uint32_t>(Protocol::get().limit("strangers"));
    for (uint32_t i = 2; i < 2 + places; ++i) f.open(i);
    EXPECT_TRUE(f.closed.empty());
    f.open(2 + places);
    EXPECT_EQ(f.closed.size(), 1u);
    EXPECT_TRUE(f.closed.contains(ClientId{2}));
    // The next one has a token, and finds a place.
    EXPECT_TRUE(f.hello(3 + places, kDrive, "b").contains("ok"));
    EXPECT_EQ(f.known, (std::vector<ClientId>{{1}, {3 + places}}));
}

TEST(Desk, OnePageMoreThanTheLimitHearsWhy) {
    Fixture f;
    const auto places = static_cast<uint32_t>(Protocol::get().limit("clients"));
    for (uint32_t i = 1; i <= places; ++i) {
        EXPECT_TRUE(f.hello(i, kDrive, std::to_string(i).c_str()).contains("ok"));
    }
    EXPECT_EQ(f.hello(places + 1, kDrive, "x")["error"]["code"], "limit");
    // One of them comes back.
    EXPECT_TRUE(f.hello(places + 2, kDrive, "7").contains("ok"));
}

TEST(Desk, ANewTokenSendsAwayWhoDrivesWithTheOldOne) {
    Fixture f;
    f.new_token = "new-new-new-new-new";
    f.hello(1, kDrive, "a");
    f.hello(2, kDrive, "b");
    f.hello(3, kLook, "c");
    EXPECT_EQ(f.say(2, {{"id", 2}, {"do", "access.renew"}})["error"]["code"], "not_driver");
    EXPECT_EQ(f.say(1, {{"id", 2}, {"do", "access.renew"}})["ok"]["token"], f.new_token);
    EXPECT_EQ(f.closed.size(), 1u);
    EXPECT_TRUE(f.closed.contains(ClientId{2}));
}

// What was seen: a duplicated tab that had shown the old token and waited for the other's answer
// drove with it ever after.
TEST(Desk, ANewTokenSendsAwayATabThatWaitsForItsTwin) {
    Fixture f;
    f.new_token = "new-new-new-new-new";
    f.hello(1, kDrive, "a");
    f.open(2);
    f.say(2, hello_of("b", "load 1"));
    f.open(3);
    f.say(3, hello_of("b", "load 2"));
    f.say(1, {{"id", 2}, {"do", "access.renew"}});
    EXPECT_TRUE(f.closed.contains(ClientId{2}));
    EXPECT_TRUE(f.closed.contains(ClientId{3}));
    f.desk.hear(ClientClosed{{2}}, f.now);
    f.desk.tick(f.now + 2 * kTwinWithin);
    EXPECT_EQ(f.desk.clients().connected(), 1u);
}

TEST(Desk, AFloodOfCommandsIsRefused) {
    Fixture f;
    f.hello(1, kDrive, "a");
    f.now += 3s;
    f.run(1, 2);
    int refused = 0;
    for (uint64_t id = 3; id < 1503; ++id) {
        if (f.run(1, id).contains("error")) ++refused;
    }
    EXPECT_EQ(refused, 1500 - 999);  // two seconds' worth, one of which went before
}

TEST(Desk, OneConnectionIsOneClient) {
    Fixture f;
    f.hello(1, kDrive, "a");
    const Json again = {{"id", 2}, {"do", "hello"}, {"in", {{"token", kDrive}, {"client", "b"}}}};
    EXPECT_EQ(f.say(1, again)["error"]["code"], "conflict");
    EXPECT_EQ(f.desk.clients().connected(), 1u);
}

TEST(Desk, WhoWasSentAwayIsNotHeardAnyMore) {
    Fixture f;
    f.open(1);
    f.run(1, 1);
    const size_t answers = f.got[ClientId{1}].size();
    f.say(1, {{"id", 2}, {"do", "hello"}, {"in", {{"token", kDrive}, {"client", "a"}}}});
    EXPECT_EQ(f.got[ClientId{1}].size(), answers);
    EXPECT_EQ(f.desk.clients().connected(), 0u);
}

TEST(Desk, PagesHearThatAQuestionForTheWheelIsOver) {
    Fixture f;
    int told = 0;
    f.hello(1, kDrive, "a");
    f.hello(2, kDrive, "b");
    f.say(2, {{"id", 2}, {"do", "driver.ask"}});
    EXPECT_TRUE(f.desk.people().contains("asked"));
    f.desk.on_people([&] { ++told; });
    f.desk.tick(f.now + 10s);
    EXPECT_EQ(told, 1);
    EXPECT_FALSE(f.desk.people().contains("asked"));
}

// 3 answers of 2 MB are more than kAnswerBytesKept: the oldest is forgotten, not done again.
TEST(Desk, LongAnswersAreNotKeptForEver) {
    Fixture f;
    f.desk.command("node.run", [&](const Call& call) {
        ++f.ran;
        call.done({{"long", std::string(2u << 20, 'x')}});
    });
    f.hello(1, kDrive, "a");
    for (uint64_t id = 2; id <= 4; ++id) {
        EXPECT_TRUE(f.run(1, id).contains("ok"));
        f.desk.hear(ClientTook{{1}, 4u << 20}, f.now);
    }
    EXPECT_EQ(f.run(1, 2)["error"]["code"], "conflict");
    EXPECT_TRUE(f.run(1, 4).contains("ok"));
    EXPECT_EQ(f.ran, 3);
}

TEST(Desk, WhoAsksForMoreThanItTakesIsSentAway) {
    Fixture f;
    f.desk.command("node.run", [&](const Call& call) {
        call.done({{"long", std::string(2u << 20, 'x')}});
    });
    f.hello(1, kDrive, "a");
    const uint64_t fits = Protocol::get().limit("unsent_bytes") / (2u << 20);
    for (uint64_t id = 2; id < 2 + fits; ++id) f.run(1, id);
    EXPECT_NE(f.closed[ClientId{1}].find("read too slowly"), std::string::npos);
}

// ---- a slow line: its buffers hold what a page has not read ----

// A clock of 20 kB that is another one each tenth of a second, all of which the network has taken.
struct SlowLine : Fixture {
    std::string text;
    SlowLine() {
        desk.topics().document("clock", [this](const Json&) { return Json{{"why", text}}; });
        hello(1, kDrive, "a");
        say(1, {{"id", 2}, {"do", "watch"}, {"in", {{"watch", 1}, {"topic", "clock"}}}});
    }
    // How many of so many changes are sent.
    size_t change(int times) {
        const size_t before = got[ClientId{1}].size();
        for (int i = 0; i < times; ++i) {
            text = std::string(20'000, static_cast<char>('a' + i % 26));
            desk.topics().touch("clock");
            desk.hear(ClientTook{{1}, 1u << 20}, now);
            desk.tick(now += 100ms);
        }
        return got[ClientId{1}].size() - before;
    }
    void answer_ping() { say_as_it_is(1, {{"pong", pings[ClientId{1}].back()["ping"]}}); }
};

TEST(Desk, APageGetsNothingNewWhileMuchIsOnTheWay) {
    SlowLine line;
    line.change(1);
    line.answer_ping();
    // 20, 40 and 60 kB are less than 64.
    EXPECT_EQ(line.change(20), 4u);
    EXPECT_EQ(line.change(20), 0u);
    line.answer_ping();
    EXPECT_GT(line.change(20), 0u);
    EXPECT_TRUE(line.closed.empty());
    EXPECT_TRUE(line.run(1, 3).contains("ok"));  // answers do not wait
}

TEST(Desk, WhoNeverAnswersAPingIsNoPageAndGetsAll) {
    SlowLine line;
    EXPECT_EQ(line.change(20), 20u);
}

}  // namespace
}  // namespace vagus::serve
