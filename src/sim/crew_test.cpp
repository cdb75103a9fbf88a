#include "sim/crew.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <set>
#include <vector>

using namespace vagus::sim;

namespace {

TEST(Crew, DoesEachPartOnceWhateverItsSize) {
    for (const unsigned threads : {1u, 2u, 3u, 7u}) {
        Crew crew(threads);
        EXPECT_EQ(crew.size(), threads);
        for (const size_t count : {size_t{0}, size_t{1}, kPartsForTwo - 1, kPartsForTwo,
                                   kPartsForTwo + 1, size_t{1000}}) {
            std::vector<int> done(count);
            crew.each(count, [&done](size_t i) { ++done[i]; });
            EXPECT_EQ(done, std::vector<int>(count, 1)) << threads << " threads";
        }
    }
}

// Each begins with a share of its own: the first parts of both wait for each other, and would wait
// for ever on one thread.
TEST(Crew, SharesALargePieceOfWorkAndKeepsASmallOne) {
    Crew crew(2);
    std::vector<std::thread::id> who(kPartsForTwo);
    std::latch both(2);
    crew.each(who.size(), [&](size_t i) {
        who[i] = std::this_thread::get_id();
        if (i % (kPartsForTwo / 2) == 0) both.arrive_and_wait();
    });
    EXPECT_EQ(std::set<std::thread::id>(who.begin(), who.end()).size(), 2u);
    EXPECT_EQ(who.front(), std::this_thread::get_id());
    who.resize(kPartsForTwo - 1);
    crew.each(who.size(), [&who](size_t i) { who[i] = std::this_thread::get_id(); });
    EXPECT_EQ(std::set<std::thread::id>(who.begin(), who.end()).size(), 1u);
}

// The first part lasts until three quarters of all are done: the other thread has to take from the
// share of this one.
TEST(Crew, WhoIsReadyHelpsTheOthers) {
    Crew crew(2);
    std::atomic<size_t> done = 0;
    crew.each(kPartsForTwo, [&done](size_t i) {
        while (i == 0 && done < kPartsForTwo * 3 / 4) std::this_thread::yield();
        ++done;
    });
    EXPECT_EQ(done, kPartsForTwo);
}

// It does not end before the other thread has done some parts.
TEST(Crew, OthersWorkBesideWhatTheCallingThreadDoesFirst) {
    Crew crew(2);
    std::atomic<size_t> done = 0;
    std::thread::id who;
    const auto own = [&] {
        while (done < kPartsForTwo / 2) std::this_thread::yield();
        who = std::this_thread::get_id();
    };
    crew.beside(own, kPartsForTwo, [&done](size_t) { ++done; });
    EXPECT_EQ(who, std::this_thread::get_id());
    EXPECT_EQ(done, kPartsForTwo);
}

TEST(Crew, WithFewPartsOrAloneTheCallingThreadDoesItsOwnAndThenThem) {
    const std::vector<size_t> expected = {100, 0, 1, 2};
    for (const unsigned threads : {1u, 3u}) {
        Crew crew(threads);
        std::vector<size_t> order;
        crew.beside([&order] { order.push_back(100); }, 3,
                    [&order](size_t i) { order.push_back(i); });
        EXPECT_EQ(order, expected);
    }
}

TEST(Crew, WorksRoundAfterRound) {
    Crew crew(3);
    std::vector<uint64_t> sums(200);
    for (uint64_t round = 0; round < 5000; ++round)
        crew.each(sums.size(), [&sums, round](size_t i) { sums[i] += round; });
    EXPECT_EQ(sums, std::vector<uint64_t>(200, 4999u * 5000 / 2));
}

}  // namespace
