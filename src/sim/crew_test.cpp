#include "sim/crew.hpp"

#include <gtest/gtest.h>

#include <atomic>
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

TEST(Crew, SharesALargePieceOfWorkAndKeepsASmallOne) {
    Crew crew(2);
    std::vector<std::thread::id> who(kPartsForTwo);
    crew.each(who.size(), [&who](size_t i) { who[i] = std::this_thread::get_id(); });
    EXPECT_EQ(std::set<std::thread::id>(who.begin(), who.end()).size(), 2u);
    EXPECT_EQ(who.front(), std::this_thread::get_id());
    who.resize(kPartsForTwo - 1);
    crew.each(who.size(), [&who](size_t i) { who[i] = std::this_thread::get_id(); });
    EXPECT_EQ(std::set<std::thread::id>(who.begin(), who.end()).size(), 1u);
}

TEST(Crew, WorksRoundAfterRound) {
    Crew crew(3);
    std::vector<uint64_t> sums(200);
    for (uint64_t round = 0; round < 5000; ++round)
        crew.each(sums.size(), [&sums, round](size_t i) { sums[i] += round; });
    EXPECT_EQ(sums, std::vector<uint64_t>(200, 4999u * 5000 / 2));
}

}  // namespace
