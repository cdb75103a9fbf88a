#include "record/keyframe_instants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

namespace vagus::record {
namespace {

using namespace std::chrono_literals;

TEST(KeyframeInstants, AreFurtherApartTheLongerAgoTheyAre) {
    // 7.5 s apart up to an age of 60 s, 15 s up to 120 s, 30 s up to 240 s.
    const std::vector<Time> expected = {30s,      60s,  75s,      90s,  105s,     112500ms, 120s,
                                        127500ms, 135s, 142500ms, 150s, 157500ms, 165s};
    EXPECT_EQ(keyframe_instants(165s), expected);
    EXPECT_TRUE(keyframe_instants(0s).empty());
    EXPECT_TRUE(keyframe_instants(7499ms).empty());
    EXPECT_EQ(keyframe_instants(7500ms), std::vector<Time>{7500ms});
}

TEST(KeyframeInstants, AnHourHasDozensNeverFurtherApartThanTheMost) {
    for (const Time newest : {Time(600s), Time(3333333ms), Time(3600s)}) {
        const std::vector<Time> all = keyframe_instants(newest);
        EXPECT_LT(all.size(), 50u);
        Time before{};
        for (const Time at : all) {
            EXPECT_LE(at - before, kKeyframesApartMax);
            before = at;
        }
        EXPECT_LE(newest - before, kKeyframesApartMin);
    }
}

TEST(KeyframeInstants, ThereAreNeverMoreThanTheMost) {
    size_t most = 0;
    for (Time newest = 0s; newest <= 200h; newest += 97s) {
        most = std::max(most, keyframe_instants(newest).size());
    }
    EXPECT_EQ(most, kKeyframesMax);  // the rule alone has some more
}

TEST(KeyframeInstants, OneThatIsLeftOutIsNeverWantedAgain) {
    std::vector<Time> before;
    for (Time newest = 0s; newest <= 5h; newest += 2500ms) {
        const std::vector<Time> now = keyframe_instants(newest);
        for (const Time at : now) {
            const bool is_new = at > newest - 2500ms;
            EXPECT_TRUE(is_new || std::ranges::binary_search(before, at))
                << at.count() << " at " << newest.count();
        }
        before = now;
    }
}

}  // namespace
}  // namespace vagus::record
