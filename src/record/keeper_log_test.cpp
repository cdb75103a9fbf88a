#include "record/keeper_log.hpp"

#include <gtest/gtest.h>

namespace vagus::record {
namespace {

using namespace std::chrono_literals;

keeper::Reply done(keeper::Record record) {
    return {.outcome = keeper::Outcome::Done, .record = std::move(record)};
}

const keeper::Claim kDock{.name = "dock", .lease = {}};
keeper::Task task() {
    keeper::Task made;
    made.queue = "fetch";
    made.id = "t3";
    return made;
}

TEST(KeeperLog, WhoGaveANameBackThatAnotherGot) {
    KeeperLog log;
    log.add({1, 7, 14s}, keeper::ClaimName{"dock", {}}, done(kDock));
    log.add({1, 8, 17s}, keeper::Release{}, done(kDock));
    log.add({2, 3, 18s}, keeper::ClaimName{"dock", {}}, done(kDock));
    EXPECT_FALSE(log.giver_of(1, 7));
    const auto giver = log.giver_of(2, 3);
    ASSERT_TRUE(giver);
    EXPECT_TRUE(giver->is(1, 8));
    EXPECT_EQ(giver->at, 17s);
    EXPECT_EQ(giver->thing, "the name dock");
    // The question was asked again, and is answered again.
    log.add({2, 3, 19s}, keeper::ClaimName{"dock", {}}, done(kDock));
    EXPECT_TRUE(log.giver_of(2, 3)->is(1, 8));
}

// Nobody gave it back before the second one had it.
TEST(KeeperLog, ALeaseThatEndedByItselfWasGivenByNobody) {
    KeeperLog log;
    log.add({3, 1, 13s}, keeper::Release{}, done(kDock));
    log.add({1, 7, 14s}, keeper::ClaimName{"dock", {}}, done(kDock));
    log.add({2, 3, 30s}, keeper::ClaimName{"dock", {}}, done(kDock));
    EXPECT_FALSE(log.giver_of(2, 3));
    EXPECT_FALSE(log.giver_of(2, 99));
}

TEST(KeeperLog, ATaskIsOfWhoGaveIt) {
    KeeperLog log;
    log.add({1, 2, 14s}, keeper::Give{"fetch", "t3", ""}, done(task()));
    log.add({2, 5, 15s}, keeper::Take{"fetch", {}}, {.outcome = keeper::Outcome::Nothing});
    log.add({3, 4, 16s}, keeper::Take{"fetch", {}}, done(task()));
    EXPECT_FALSE(log.giver_of(2, 5));
    ASSERT_TRUE(log.giver_of(3, 4));
    EXPECT_TRUE(log.giver_of(3, 4)->is(1, 2));
    EXPECT_EQ(log.giver_of(3, 4)->thing, "the task t3 of fetch");
    // What is renewed changes no hands.
    log.add({3, 5, 17s}, keeper::Renew{}, done(task()));
    EXPECT_FALSE(log.giver_of(3, 5));
}

TEST(KeeperLog, WhoWroteAVersion) {
    KeeperLog log;
    const auto value = [](uint64_t number) {
        return keeper::Shared{.key = "meeting", .version = {1, number}, .value = "\"2\""};
    };
    log.add({1, 2, 14s}, keeper::Write{"meeting", {}, ""}, done(value(5)));
    log.add({2, 3, 15s}, keeper::Write{"meeting", {}, ""}, done(value(6)));
    ASSERT_TRUE(log.writer_of(value(6)));
    EXPECT_TRUE(log.writer_of(value(6))->is(2, 3));
    EXPECT_EQ(log.writer_of(value(5))->thing, "the shared value meeting");
    EXPECT_FALSE(log.writer_of(value(7)));
}

}  // namespace
}  // namespace vagus::record
