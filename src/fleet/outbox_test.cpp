#include "fleet/outbox.hpp"

#include <gtest/gtest.h>

#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

std::vector<std::string> topics(const std::vector<Post>& posts) {
    std::vector<std::string> list;
    for (const Post& post : posts) list.push_back(post.topic);
    return list;
}

Post post(const std::string& topic) {
    return {.topic = topic, .payload = ""};
}

TEST(Outbox, SendsOnceAndInOrder) {
    Outbox outbox;
    outbox.add(post("a"), 0s);
    outbox.add(post("b"), 0s);
    EXPECT_EQ(topics(outbox.take_due(0s)), (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(outbox.take_due(0s).empty());
}

TEST(Outbox, SendsAgainWhatWasNotAcknowledgedWhenTheLinkBroke) {
    Outbox outbox;
    outbox.add(post("a"), 0s);
    outbox.add(post("b"), 0s);
    const auto sent = outbox.take_due(0s);
    outbox.acknowledged(sent[0].number);
    outbox.add(post("c"), 1s);
    outbox.link_lost();
    EXPECT_EQ(topics(outbox.take_due(2s)), (std::vector<std::string>{"b", "c"}));
}

TEST(Outbox, OnlySoManyAreUnderWay) {
    Outbox outbox;
    for (size_t i = 0; i <= kInFlightMax; ++i) outbox.add(post(std::to_string(i)), 0s);
    const auto sent = outbox.take_due(0s);
    EXPECT_EQ(sent.size(), kInFlightMax);
    EXPECT_TRUE(outbox.has_waiting());
    outbox.acknowledged(sent[3].number);
    EXPECT_EQ(outbox.take_due(0s).size(), 1u);
    EXPECT_FALSE(outbox.has_waiting());
}

TEST(Outbox, DropsTheOldestAndCounts) {
    Outbox outbox;
    for (size_t i = 0; i <= kOutboxMax; ++i) outbox.add(post(std::to_string(i)), 0s);
    EXPECT_EQ(outbox.size(), kOutboxMax);
    EXPECT_EQ(outbox.dropped(), 1u);
    EXPECT_EQ(outbox.take_due(0s).front().topic, "1");
}

TEST(Outbox, DropsWhatIsTooOld) {
    Outbox outbox;
    outbox.add(post("a"), 0s);
    outbox.add(post("b"), 1us);
    EXPECT_EQ(topics(outbox.take_due(kEventAgeMax + 1us)), (std::vector<std::string>{"b"}));
    EXPECT_EQ(outbox.dropped(), 1u);
}

}  // namespace
}  // namespace vagus::fleet
