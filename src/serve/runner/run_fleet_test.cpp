#include "serve/runner/run_fleet.hpp"

#include <gtest/gtest.h>

#include "fleet/topic.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;

// What it was told to send and to hear.
class WrittenLink final : public fleet::Link {
public:
    struct Written {
        std::vector<fleet::LinkEvent> comes = {};
        std::vector<std::string> sent = {};
        size_t filters = 0;
    };
    explicit WrittenLink(Written& written) : written_(written) {}
    void subscribe(const std::vector<fleet::Filter>& filters) override {
        written_.filters += filters.size();
    }
    void publish(const fleet::Post& post) override { written_.sent.push_back(post.topic); }
    std::vector<fleet::LinkEvent> take() override { return std::exchange(written_.comes, {}); }

private:
    Written& written_;
};

fleet::LinkEvent connection_of(const std::string& robot, const std::string& instance,
                               const std::string& state = "online") {
    return fleet::Received{
        {{.kind = fleet::Kind::Connection, .robot = robot}, fleet::Connection{state, instance, 1}},
        true};
}

class RunFleetTest : public testing::Test {
protected:
    void comes(fleet::LinkEvent event) {
        written_.comes.push_back(std::move(event));
        fleet_.turn();
    }
    void pass(Duration span) {
        now_ += span;
        fleet_.turn();
    }

    WrittenLink::Written written_;
    Time now_ = 1s;
    RunFleet fleet_{{.fleet = "lab", .robot = "r1", .instance = "ours", .epoch = 7},
                    std::make_unique<WrittenLink>(written_),
                    [this] { return now_; }};
};

using Texts = std::vector<std::string>;
const char* const kTake = "vagus/1/lab/robot/r1/ask/take";

// The keeper's replies and its sign of life, shared values, connections: four filters.
TEST_F(RunFleetTest, HearsTheKeeperAtEachConnection) {
    comes(fleet::Connected{});
    EXPECT_EQ(written_.filters, 4u);
    comes(fleet::Lost{"cut"});
    comes(fleet::Connected{});
    EXPECT_EQ(written_.filters, 8u);
}

TEST_F(RunFleetTest, AsksOnlyWhileTheNameIsThatOfItsMember) {
    comes(fleet::Connected{});
    ASSERT_NE(fleet_.ask(keeper::Take{"pick", 10s}), 0u);
    pass(2s);
    EXPECT_EQ(written_.sent, Texts{});
    comes(connection_of("r2", "ours"));
    comes(connection_of("r1", "theirs"));
    pass(2s);
    EXPECT_EQ(written_.sent, Texts{});
    comes(connection_of("r1", "ours"));
    pass(2s);
    EXPECT_EQ(written_.sent, Texts{kTake});
    // Somebody else has the name: nothing is asked as that robot any more.
    comes(connection_of("r1", "theirs"));
    pass(2s);
    EXPECT_EQ(written_.sent, Texts{kTake});
}

TEST_F(RunFleetTest, ALeaseEndsByTheClockOfNowNotOfTheLastTurn) {
    comes(fleet::Connected{});
    comes(connection_of("r1", "ours"));
    const uint64_t number = fleet_.ask(keeper::Take{"pick", 10s});
    const keeper::Task task{"pick", "a", {1, 1}, "1", keeper::Work::Leased, {"r1", {1, 2}, 10s},
                            ""};
    comes(fleet::Received{{{.kind = fleet::Kind::Reply, .robot = "r1"},
                           fleet::Reply{7, number, {keeper::Outcome::Done, "", 1, task}}},
                          false});
    EXPECT_TRUE(fleet_.answer(number));
    EXPECT_TRUE(fleet_.holds({1, 2}));
    now_ += 10s;
    EXPECT_FALSE(fleet_.holds({1, 2}));
}

TEST_F(RunFleetTest, WhatItsPlanTellsIsTakenOnce) {
    fleet_.tell("battery", {42});
    const auto told = fleet_.take_told();
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told.front().name, "battery");
    EXPECT_EQ(told.front().values, std::vector<int16_t>{42});
    EXPECT_TRUE(fleet_.take_told().empty());
}

}  // namespace
}  // namespace vagus::serve
