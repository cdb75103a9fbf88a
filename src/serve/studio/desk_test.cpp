#include "serve/studio/desk.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

constexpr const char* kDrive = "0123456789abcdef";
constexpr const char* kLook = "fedcba9876543210";

// A desk with pages that speak to it.
struct Fixture {
    std::map<ClientId, std::vector<Json>> got;
    std::map<ClientId, std::string> closed;
    std::vector<std::string> log;
    int ran = 0;
    std::vector<Call> waiting;
    Time now = 1s;
    Desk desk{Access(kDrive, kLook),
              {.send = [this](ClientId client, bool,
                              std::string bytes) { got[client].push_back(Json::parse(bytes)); },
               .close = [this](ClientId client, std::string why) { closed[client] = why; },
               .log = [this](const std::string& line) { log.push_back(line); },
               .wall_ms = [] { return 1e12; }}};

    Fixture() {
        desk.command("node.run", [this](const Call& call) {
            ++ran;
            call.done({{"failed", Json::array()}});
        });
        desk.command("stop", [](const Call& call) { call.done({{"stood", Json::array()}}); });
        desk.command("node.load", [this](const Call& call) { waiting.push_back(call); });
    }
    void open(uint32_t number) { desk.hear(ClientOpened{{number}, "127.0.0.1"}, now); }
    Json say(uint32_t number, const Json& message) {
        desk.hear(ClientText{{number}, message.dump()}, now);
        const auto& all = got[ClientId{number}];
        return all.empty() ? Json() : all.back();
    }
    Json hello(uint32_t number, const char* token, const char* key) {
        open(number);
        return say(number,
                   {{"id", 1}, {"do", "hello"}, {"in", {{"token", token}, {"client", key}}}});
    }
    Json run(uint32_t number, uint64_t id) {
        return say(number, {{"id", id}, {"do", "node.run"}, {"in", {{"node", 1}}}});
    }
};

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
    EXPECT_EQ(f.desk.next_tick(f.now), f.now + 500ms);
    f.now += 499ms;
    f.desk.tick(f.now);
    EXPECT_TRUE(f.got[ClientId{2}].empty());
    f.now += 1ms;
    f.desk.tick(f.now);
    EXPECT_EQ(f.got[ClientId{2}].back()["error"]["code"], "not_allowed");
    EXPECT_EQ(f.closed[ClientId{2}], "wrong token");
    EXPECT_EQ(f.log.size(), 2u);
}

TEST(Desk, ARightTokenDoesNotWaitForWrongOnes) {
    Fixture f;
    for (uint32_t i = 1; i <= 20; ++i) f.hello(i, "wrong", "a");
    EXPECT_TRUE(f.hello(21, kDrive, "b").contains("ok"));
}

// As long as one that says nothing: who guesses cannot fill all the places for longer.
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
    f.desk.board().document("clock", [&](const Json&) {
        return Json{{"t", static_cast<double>(f.now.count())}, {"why", std::string(100'000, 'x')}};
    });
    f.hello(1, kDrive, "a");
    f.say(1, {{"id", 2}, {"do", "watch"}, {"in", {{"watch", 1}, {"topic", "clock"}}}});
    size_t largest = 0;
    for (int i = 0; i < 100; ++i) {
        f.now += 101ms;
        f.desk.board().touch("clock");
        f.desk.tick(f.now);
        size_t bytes = 0;
        for (const Json& message : f.got[ClientId{1}]) bytes += message.dump().size();
        largest = std::max(largest, bytes);
    }
    EXPECT_LT(largest, kRoomBytes + 200'000);
    EXPECT_NE(f.closed[ClientId{1}].find("took nothing"), std::string::npos);
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
    EXPECT_NE(f.closed[ClientId{1}].find("more than it takes"), std::string::npos);
}

}  // namespace
}  // namespace vagus::serve
