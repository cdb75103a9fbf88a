#include "run/held_events.hpp"

#include <gtest/gtest.h>

namespace vagus::run {
namespace {

HeldEvent numbered(uint64_t number) {
    return {.number = number, .after = {}, .event = {"e", {static_cast<int16_t>(number)}}};
}

TEST(HeldEvents, TheyWaitInTheirOrderUntilTheyAreTaken) {
    HeldEvents held;
    for (const uint64_t number : {3, 5, 8}) held.add(numbered(number));
    EXPECT_EQ(held.take(5)->event.arguments.front(), 5);
    EXPECT_FALSE(held.take(5));
    ASSERT_EQ(held.now().events.size(), 2u);
    EXPECT_EQ(held.now().events[0].number, 3u);
    EXPECT_EQ(held.now().events[1].number, 8u);
    EXPECT_EQ(held.take_all().size(), 2u);
    EXPECT_TRUE(held.now().events.empty());
}

TEST(HeldEvents, OfTooManyTheNewestAreDroppedAndCounted) {
    HeldEvents held;
    for (uint64_t number = 1; number <= kHeldEventsMax + 2; ++number) held.add(numbered(number));
    EXPECT_EQ(held.now().events.size(), kHeldEventsMax);
    EXPECT_EQ(held.now().events.back().number, kHeldEventsMax);
    EXPECT_EQ(held.now().dropped, 2u);
    (void)held.take_all();
    EXPECT_EQ(held.now().dropped, 0u);
}

}  // namespace
}  // namespace vagus::run
