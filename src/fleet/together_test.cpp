// Members together, over a broker in memory.
#include <gtest/gtest.h>

#include <algorithm>

#include "fleet/limits.hpp"
#include "fleet/test_broker.hpp"

namespace vagus::fleet {
namespace {

using Client = TestBroker::Client;
using Standing = Member::Standing;

MemberOptions robot(const std::string& name, const std::string& instance, int64_t epoch = 1) {
    return {.fleet = "lab",
            .robot = name,
            .instance = instance,
            .epoch = epoch,
            .project = {.send = {"alarm"}, .hear = {{"alarm", ""}}},
            .description = {"Alarm", "0.1.0", "", "", {}, {}, {}, {}}};
}

std::vector<std::string> heard_by(const Client& client) {
    std::vector<std::string> list;
    for (const MemberAction& action : client.done) {
        const auto* event = std::get_if<EmitOnBus>(&action);
        if (event != nullptr) list.push_back(event->from + std::to_string(event->args.at(0)));
    }
    return list;
}

using Texts = std::vector<std::string>;

TEST(Together, AnEventOfOneIsHeardByAllOthersOnce) {
    TestBroker broker;
    Client& one = broker.add(robot("r1", "a"));
    Client& two = broker.add(robot("r2", "b"));
    Client& three = broker.add(robot("r3", "c"));
    for (Client* client : {&one, &two, &three}) broker.connect(*client);
    broker.run();
    one.member.emitted("alarm", {5}, broker.now);
    broker.run();
    EXPECT_EQ(heard_by(one), Texts{});
    EXPECT_EQ(heard_by(two), Texts{"r15"});
    EXPECT_EQ(heard_by(three), Texts{"r15"});
}

TEST(Together, OfTwoOfOneNameTheSecondStaysOutUntilTheFirstGoes) {
    TestBroker broker;
    Client& first = broker.add(robot("r1", "a"));
    broker.connect(first);
    broker.run();
    Client& second = broker.add(robot("r1", "b", 2));
    broker.connect(second);
    broker.run();
    EXPECT_EQ(first.member.standing(), Standing::Holding);
    EXPECT_EQ(second.member.standing(), Standing::Out);
    broker.cut(first);
    broker.run();
    EXPECT_EQ(second.member.standing(), Standing::Holding);
    broker.connect(first);
    broker.run();
    EXPECT_EQ(first.member.standing(), Standing::Out);
    EXPECT_EQ(second.member.standing(), Standing::Holding);
}

TEST(Together, OfTwoThatComeAtOnceOneHasTheName) {
    TestBroker broker;
    Client& first = broker.add(robot("r1", "a"));
    Client& second = broker.add(robot("r1", "b", 2));
    broker.connect(first);
    broker.connect(second);
    broker.run();
    const int holding = (first.member.standing() == Standing::Holding ? 1 : 0) +
                        (second.member.standing() == Standing::Holding ? 1 : 0);
    EXPECT_EQ(holding, 1);
}

// Each but the last one believes for a moment that the name is its own.
TEST(Together, OfAHundredOfOneNameOneIsInTheFleetAndIsTheOneThatIsDescribed) {
    TestBroker broker;
    std::vector<Client*> all;
    for (int i = 0; i < 100; ++i) {
        MemberOptions options = robot("r1", std::to_string(i), i);
        options.description.studio = "http://" + std::to_string(i);
        all.push_back(&broker.add(std::move(options)));
        broker.connect(*all.back());
    }
    const auto holders = [&] {
        broker.now += kNameAnswerWithin;
        broker.run();
        std::vector<Client*> list;
        for (Client* one : all) {
            if (one->member.standing() == Standing::Holding) list.push_back(one);
        }
        return list;
    };
    for (int gone = 0; gone < 3; ++gone) {
        const auto now = holders();
        ASSERT_EQ(now.size(), 1u) << gone;
        const auto which = std::find(all.begin(), all.end(), now[0]) - all.begin();
        EXPECT_NE(broker.retained("vagus/1/lab/robot/r1/description")
                      .find("\"http://" + std::to_string(which) + "\""),
                  std::string::npos);
        broker.cut(*now[0]);
    }
}

TEST(Together, WhatHappenedWhileTheLinkWasCutComesOnce) {
    TestBroker broker;
    Client& one = broker.add(robot("r1", "a"));
    Client& two = broker.add(robot("r2", "b"));
    broker.connect(one);
    broker.connect(two);
    broker.run();
    broker.cut(one);
    one.member.emitted("alarm", {1}, broker.now);
    broker.now = 4s;
    one.member.emitted("alarm", {2}, broker.now);
    broker.run();
    EXPECT_EQ(heard_by(two), Texts{});
    broker.connect(one);
    broker.run();
    EXPECT_EQ(heard_by(two), (Texts{"r11", "r12"}));
    EXPECT_EQ(one.member.standing(), Standing::Holding);
}

}  // namespace
}  // namespace vagus::fleet
