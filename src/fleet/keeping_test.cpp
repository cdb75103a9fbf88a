#include "fleet/keeping.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <climits>
#include <map>

#include "fleet/keeper_client.hpp"

namespace vagus::fleet {
namespace {

using KeeperState = keeper::Keeper::State;
using testing::HasSubstr;

// A keeper and one robot at a broker that delivers at once, in order, and keeps what is retained.
class Desk {
public:
    explicit Desk(const std::string& instance = "k1") { start(instance); }

    void start(const std::string& instance) {
        keeping = std::make_unique<Keeping>(
            KeepingOptions{"lab", {.instance = instance, .longest = 10s, .first_epoch = 100}});
    }

    void connect() { hear(Connected{}); }
    void pass(Duration time) {
        for (const Time end = now + time; now < end; now += kKeeperTickEvery) {
            keeping->tick(now);
            carry();
        }
    }
    void serve() {
        connect();
        pass(keeper::kListen + 10s + 1s);
        ASSERT_EQ(keeping->state(), KeeperState::Serving);
    }
    void hear(const LinkEvent& event) {
        keeping->hear(event, now);
        carry();
    }
    void hear(const std::string& topic, const std::string& payload, bool kept = false) {
        auto heard = read("lab", topic, payload);
        ASSERT_TRUE(heard.ok()) << heard.error().what;
        hear(Received{std::move(heard.value()), kept});
    }
    std::optional<keeper::Reply> ask(keeper::Request request) {
        const uint64_t number = robot.ask(std::move(request), now);
        robot.tick(now);
        for (const Post& post : robot.take()) hear(post.topic, post.payload);
        for (const keeper::Over& over : robot.leases().take_over())
            if (over.number == number) return over.reply;
        return std::nullopt;
    }

    Time now{};
    std::unique_ptr<Keeping> keeping;
    KeeperClient robot{{"lab", "r1", 7}};
    std::map<std::string, std::string> retained;
    std::vector<Post> records;  // that wait for their acknowledgement, if `acknowledges` is not set
    bool acknowledges = true;
    int drops = 0;  // beats that the broker has no room for
    std::string said;

private:
    void carry() {
        for (const KeepingAction& action : keeping->take()) {
            if (const auto* post = std::get_if<Post>(&action)) carry(*post);
            if (const auto* words = std::get_if<Say>(&action)) said += words->text + "\n";
            if (std::get_if<Subscribe>(&action))
                for (const auto& [topic, payload] : retained) hear(topic, payload, true);
        }
    }
    void carry(const Post& post) {
        if (post.retained) retained[post.topic] = post.payload;
        if (post.payload.empty()) retained.erase(post.topic);
        if (post.number != 0 && post.retained) {
            records.push_back(post);
            if (acknowledges) keeping->hear(Acknowledged{post.number, ""}, now);
        }
        if (post.topic == "vagus/1/lab/keeper/beat") {
            if (drops == 0) return hear(post.topic, post.payload);
            --drops;
        }
        if (post.topic == "vagus/1/lab/keeper/answer/r1") {
            auto heard = read("lab", post.topic, post.payload);
            ASSERT_TRUE(heard.ok()) << heard.error().what;
            robot.hear(Received{std::move(heard.value()), false}, now);
        }
        carry();
    }
};

// A broker drops what does not fit into its queue for a client, behind all that it has retained.
TEST(Keeping, AsksAgainWhetherAllIsKnown) {
    Desk desk;
    desk.drops = 1;
    desk.connect();
    EXPECT_EQ(desk.keeping->state(), KeeperState::Away);
    desk.pass(kAskAgainEvery + 2 * kKeeperTickEvery);
    EXPECT_EQ(desk.keeping->state(), KeeperState::Listening);
}

TEST(Keeping, WhatItDecidesIsRetainedUnderTopicsOfItsOwn) {
    Desk desk;
    desk.serve();
    EXPECT_EQ(desk.ask(keeper::Give{"pick", "t/1", "[4]"})->outcome, keeper::Outcome::Done);
    EXPECT_EQ(desk.retained["vagus/1/lab/task/pick/t%2F1"],
              R"({ "work": "waiting", "given": "100.1", "data": [4] })");
    const auto taken = desk.ask(keeper::Take{"pick", 2s});
    ASSERT_EQ(taken->outcome, keeper::Outcome::Done);
    const keeper::Term term = std::get<keeper::Task>(*taken->record).lease.term;
    EXPECT_EQ(term, (keeper::Term{100, 2}));
    EXPECT_TRUE(desk.robot.leases().holds(term, desk.now));
    EXPECT_EQ(desk.ask(keeper::Take{"pick", 2s})->outcome, keeper::Outcome::Nothing);
    EXPECT_EQ(desk.ask(keeper::Finish{term, "true"})->outcome, keeper::Outcome::Done);
    EXPECT_EQ(desk.retained["vagus/1/lab/task/pick/t%2F1"],
              R"({ "work": "done", "given": "100.1", "data": [4], "term": "100.2", )"
              R"("length": 2000, "result": true })");
    desk.pass(keeper::kDoneKept + 1s);
    EXPECT_FALSE(desk.retained.contains("vagus/1/lab/task/pick/t%2F1"));
}

TEST(Keeping, AnotherOneFindsWhatTheFirstHasLeft) {
    Desk desk;
    desk.serve();
    ASSERT_TRUE(desk.ask(keeper::Give{"pick", "t1", ""}));
    ASSERT_TRUE(desk.ask(keeper::Write{"map", {}, "{ \"a\": 1 }"}));
    desk.start("k2");  // the first is killed
    desk.serve();
    EXPECT_THAT(desk.said, HasSubstr("serves, epoch 101"));
    const auto taken = desk.ask(keeper::Take{"pick", 2s});
    ASSERT_EQ(taken->outcome, keeper::Outcome::Done);
    EXPECT_EQ(std::get<keeper::Task>(*taken->record).id, "t1");
    const auto written = desk.ask(keeper::Write{"map", {99, 1}, "2"});
    EXPECT_THAT(written->why, HasSubstr("map is of version 100.2, not 99.1"));
}

TEST(Keeping, ASecondOneStaysOut) {
    Desk desk("k2");
    desk.connect();
    desk.hear("vagus/1/lab/keeper/beat", R"({ "epoch": 100, "instance": "k1", "number": 4 })");
    EXPECT_TRUE(desk.keeping->is_out());
    EXPECT_THAT(desk.said, HasSubstr("stays out: there is another keeper, k1"));
}

// The broker has not told all that it keeps before our own message comes back: a task that is on
// lease would be given away again.
TEST(Keeping, ItDoesNothingBeforeAllThatWasRetainedHasCome) {
    Desk desk;
    desk.drops = INT_MAX;  // its echoes are under way for long
    desk.connect();
    desk.pass(60s);
    EXPECT_EQ(desk.keeping->state(), KeeperState::Away);
}

TEST(Keeping, OneMoreRecordThanMayBeUnderWayWaits) {
    Desk desk;
    desk.serve();
    desk.acknowledges = false;
    for (size_t i = 0; i <= kRecordsInFlight; ++i)
        desk.hear(text_of("lab", topic_of("b", keeper::Give{})),
                  payload_of(Question{1, i + 1, keeper::Give{"q", "t" + std::to_string(i), ""}}));
    EXPECT_EQ(desk.records.size(), kRecordsInFlight);
    desk.hear(Acknowledged{desk.records.front().number, ""});
    EXPECT_EQ(desk.records.size(), kRecordsInFlight + 1);
}

TEST(Keeping, ABrokerThatRefusesIsNamedOnce) {
    Desk desk;
    desk.serve();
    desk.hear(Acknowledged{1, "Not authorized"});
    desk.hear(Acknowledged{2, "Not authorized"});
    const size_t first = desk.said.find("its access list must let this user write keeper/");
    EXPECT_NE(first, std::string::npos);
    EXPECT_EQ(desk.said.find("refuses", first), std::string::npos);
}

}  // namespace
}  // namespace vagus::fleet
