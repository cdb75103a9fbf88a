#include "fleet/operator.hpp"

#include <gtest/gtest.h>

namespace vagus::fleet {
namespace {

struct OperatorCase {
    void hear(const LinkEvent& event) {
        desk.hear(event, now);
        take();
    }
    void hear(const Topic& topic, const Message& message, bool retained = false) {
        hear(Received{{topic, message}, retained});
    }
    void robot(const std::string& name, const std::string& state = "online",
               const std::string& group = "") {
        hear({.kind = Kind::Connection, .robot = name}, Connection{state, "i", 7}, true);
        Description description;
        if (!group.empty()) description.groups = {group};
        hear({.kind = Kind::Description, .robot = name}, description, true);
        hear({.kind = Kind::State, .robot = name}, State{.number = 1, .epoch = 7, .clock = 100},
             true);
    }
    void fresh(const std::string& name, int64_t clock) {
        hear({.kind = Kind::State, .robot = name}, State{.number = 2, .epoch = 7, .clock = clock});
    }
    void all_is_known() {
        hear({.kind = Kind::Command, .robot = "desk", .name = "stop"},
             Command{.verb = "stop", .id = "echo", .reply = "desk"});
    }
    void answer(const std::string& name, const std::string& id, bool done = true) {
        hear({.kind = Kind::Answer, .robot = name, .name = "desk"}, Answer{.id = id, .done = done});
    }
    void tick(Time time) {
        now = time;
        desk.tick(now);
        take();
    }
    void take() {
        for (OperatorAction& action : desk.take()) {
            if (const auto* post = std::get_if<Post>(&action)) posts.push_back(*post);
        }
    }
    std::vector<std::string> topics() const {
        std::vector<std::string> list;
        for (const Post& post : posts) list.push_back(post.topic);
        return list;
    }

    Time now{};
    Operator desk{{.fleet = "lab", .name = "desk"}};
    std::vector<Post> posts;
};

using Texts = std::vector<std::string>;

TEST(Operator, KnowsAllOnceItsOwnMessageIsBack) {
    OperatorCase c;
    c.hear(Connected{});
    EXPECT_EQ(c.topics(), Texts{"vagus/1/lab/cmd/desk/stop"});
    c.robot("r1");
    EXPECT_FALSE(c.desk.knows_all());
    c.all_is_known();
    EXPECT_TRUE(c.desk.knows_all());
    EXPECT_FALSE(c.desk.all_are_fresh());
    c.fresh("r1", 200);
    EXPECT_TRUE(c.desk.all_are_fresh());
}

// A broker drops what does not fit into the queue of a client: of a large fleet, our own message.
TEST(Operator, ItsOwnMessageIsRepeatedUntilItIsBack) {
    OperatorCase c;
    c.hear(Connected{});
    EXPECT_EQ(c.desk.next_tick(), kAskAgainEvery);
    c.tick(kAskAgainEvery - 1us);
    EXPECT_EQ(c.posts.size(), 1u);
    c.tick(kAskAgainEvery);
    ASSERT_EQ(c.posts.size(), 2u);
    EXPECT_EQ(c.posts[1].topic, "vagus/1/lab/cmd/desk/stop");
    c.all_is_known();
    c.tick(1min);
    EXPECT_EQ(c.posts.size(), 2u);
}

TEST(Operator, ThoseThatAreOnlineComeFirst) {
    OperatorCase c;
    c.robot("r1", "lost");
    c.robot("r2");
    c.robot("r3", "offline");
    c.robot("r4");
    c.robot("r10");
    EXPECT_EQ(c.desk.chosen_online_first({.all = true}), (Texts{"r2", "r4", "r10", "r1"}));
    EXPECT_EQ(c.desk.chosen_online_first({.robots = {"r9", "r4", "r1"}}),
              (Texts{"r4", "r9", "r1"}));
    EXPECT_FALSE(c.desk.is_online("r9"));
}

TEST(Operator, StopIsRepeatedUntilEverybodyHasAnswered) {
    OperatorCase c;
    const auto order =
        c.desk.begin({.command = {.verb = "stop", .id = "s"}, .to = {.all = true}}, 0s);
    c.robot("r1");
    c.robot("r2", "lost");
    c.robot("r3", "offline");
    c.all_is_known();
    EXPECT_EQ(c.topics(), Texts{"vagus/1/lab/cmd/all/stop"});
    c.answer("r1", "s");
    c.answer("r2", "another order");
    EXPECT_FALSE(c.desk.is_over(order));
    EXPECT_EQ(c.desk.next_tick(), kAskAgainEvery);
    c.tick(kAskAgainEvery - 1us);
    EXPECT_EQ(c.posts.size(), 1u);
    c.tick(kAskAgainEvery);
    EXPECT_EQ(c.posts.size(), 2u);
    const auto outcomes = c.desk.outcomes(order);
    ASSERT_EQ(outcomes.size(), 2u) << "who said good-bye is not missed";
    EXPECT_TRUE(outcomes[0].answered);
    EXPECT_FALSE(outcomes[1].answered);
    c.answer("r2", "s");
    EXPECT_TRUE(c.desk.is_over(order));
    c.tick(1s);
    EXPECT_EQ(c.posts.size(), 2u);
}

TEST(Operator, StopForAGroupAndForOne) {
    OperatorCase c;
    const auto order =
        c.desk.begin({.command = {.verb = "stop", .id = "s"}, .to = {.group = "red"}}, 0s);
    c.robot("r1", "online", "red");
    c.robot("r2", "online", "blue");
    c.all_is_known();
    EXPECT_EQ(c.topics(), Texts{"vagus/1/lab/cmd/group/red/stop"});
    EXPECT_EQ(c.desk.outcomes(order).size(), 1u);
    const auto other =
        c.desk.begin({.command = {.verb = "stop", .id = "t"}, .to = {.robots = {"nobody"}}}, 0s);
    c.tick(0s);
    EXPECT_EQ(c.topics().back(), "vagus/1/lab/cmd/nobody/stop");
    EXPECT_FALSE(c.desk.outcomes(other)[0].answered);
}

TEST(Operator, OtherCommandsGoToEachWithItsOwnDeadlineAndOnce) {
    OperatorCase c;
    const auto order =
        c.desk.begin({.command = {.verb = "start", .id = "c"}, .to = {.all = true}}, 0s);
    c.robot("r1");
    c.robot("r2");
    c.all_is_known();
    EXPECT_TRUE(c.posts.empty()) << "a retained state says nothing of the clock now";
    c.now = 1s;
    c.fresh("r1", 5000);
    c.now = 2s;
    c.fresh("r1", 6000);
    ASSERT_EQ(c.topics(), Texts{"vagus/1/lab/cmd/r1/start"});
    const auto heard = read("lab", c.posts[0].topic, c.posts[0].payload);
    const Command& command = std::get<Command>(heard.value().message);
    EXPECT_EQ(command.deadline, 5000 + 3000);
    EXPECT_EQ(command.epoch, 7);
    EXPECT_EQ(command.reply, "desk");
    c.answer("r1", "c");
    EXPECT_FALSE(c.desk.is_over(order)) << "r2 has not told a clock";
}

TEST(Operator, SeveralOrdersAreUnderWayTogether) {
    OperatorCase c;
    c.robot("r1");
    c.robot("r2");
    c.all_is_known();
    c.fresh("r1", 100), c.fresh("r2", 100);
    const auto stop =
        c.desk.begin({.command = {.verb = "stop", .id = "s"}, .to = {.robots = {"r1", "r2"}}}, 0s);
    const auto pause =
        c.desk.begin({.command = {.verb = "pause", .id = "p"}, .to = {.robots = {"r1"}}}, 0s);
    EXPECT_NE(stop, pause);
    c.tick(0s);
    EXPECT_EQ(c.topics(), (Texts{"vagus/1/lab/cmd/r1/stop", "vagus/1/lab/cmd/r2/stop",
                                 "vagus/1/lab/cmd/r1/pause"}));
    c.answer("r1", "s"), c.answer("r1", "p", false);
    EXPECT_TRUE(c.desk.is_over(pause));
    EXPECT_FALSE(c.desk.is_over(stop));
    c.tick(kAskAgainEvery);
    EXPECT_EQ(c.topics().size(), 4u);
    EXPECT_EQ(c.topics().back(), "vagus/1/lab/cmd/r2/stop") << "r1 has answered";
    c.desk.end(stop);
    c.tick(10s);
    EXPECT_EQ(c.topics().size(), 4u) << "nobody waits for it any more";
}

TEST(Operator, ABrokerThatDoesNotPassAnOrderOnIsTheReason) {
    OperatorCase c;
    c.robot("r1");
    c.all_is_known();
    c.fresh("r1", 100);
    const auto order = c.desk.begin({.command = {.verb = "start"}, .to = {.robots = {"r1"}}}, 0s);
    c.tick(0s);
    ASSERT_EQ(c.posts.size(), 1u);
    c.hear(Acknowledged{c.posts[0].number, ""});
    EXPECT_FALSE(c.desk.is_over(order));
    c.hear(Acknowledged{c.posts[0].number, "Not authorized"});
    EXPECT_TRUE(c.desk.is_over(order));
    EXPECT_EQ(c.desk.refusal(order), "Not authorized");
    EXPECT_FALSE(c.desk.outcomes(order)[0].answered);
}

TEST(Operator, KnowsWhyItsOwnMessageDoesNotComeBack) {
    OperatorCase c;
    c.hear(Connected{});
    ASSERT_EQ(c.posts.size(), 1u);
    c.hear(Acknowledged{c.posts[0].number, "Not authorized"});
    EXPECT_FALSE(c.desk.knows_all());
    EXPECT_EQ(c.desk.refused(), "Not authorized");
}

TEST(Operator, WhatWasHeardBeforeALossIsNotFresh) {
    OperatorCase c;
    c.robot("r1");
    c.fresh("r1", 100);
    ASSERT_TRUE(c.desk.all_are_fresh());
    c.hear(Lost{"gone"});
    EXPECT_FALSE(c.desk.all_are_fresh());
    EXPECT_FALSE(c.desk.knows_all());
}

TEST(Operator, ARobotThatIsForgottenIsNotKnown) {
    OperatorCase c;
    c.robot("r1");
    c.hear(TakenBack{{.kind = Kind::State, .robot = "r1"}});
    EXPECT_EQ(c.desk.robots().size(), 1u) << "its connection goes last";
    c.hear(TakenBack{{.kind = Kind::Connection, .robot = "r1"}});
    EXPECT_TRUE(c.desk.robots().empty());
}

TEST(Operator, KnowsOnlySoManyRobots) {
    OperatorCase c;
    for (size_t i = 0; i <= kRobotsMax; ++i) {
        c.hear({.kind = Kind::Connection, .robot = std::to_string(i)}, Connection{"online", "i", 7},
               true);
    }
    EXPECT_EQ(c.desk.robots().size(), kRobotsMax);
}

}  // namespace
}  // namespace vagus::fleet
