#include "session/sent_to_fleet.hpp"

#include <gtest/gtest.h>

namespace vagus::session {
namespace {

TEST(SentToFleet, AnEventIsFoundByItsNumber) {
    SentToFleet sent;
    sent.add(3, 70);
    sent.add(8, 90);
    EXPECT_EQ(sent.frame_of(3), 70u);
    EXPECT_EQ(sent.frame_of(8), 90u);
    EXPECT_EQ(sent.frame_of(5), 0u);
    EXPECT_EQ(sent.frame_of(9), 0u);
}

TEST(SentToFleet, TheOldestIsForgottenForOneMore) {
    SentToFleet sent;
    for (size_t i = 1; i <= fleet::kNumbersRemembered; ++i) sent.add(static_cast<int64_t>(i), 7);
    EXPECT_EQ(sent.frame_of(1), 7u);
    sent.add(static_cast<int64_t>(fleet::kNumbersRemembered + 1), 7);
    EXPECT_EQ(sent.frame_of(1), 0u);
    EXPECT_EQ(sent.frame_of(2), 7u);
}

}  // namespace
}  // namespace vagus::session
