// Events of the bus that wait for code: those between two waits, and those that code has asked for.
#include <gtest/gtest.h>

#include "run/heard_events.hpp"
#include "run/kept_events.hpp"

namespace vagus::run {
namespace {

BusEvent numbered(const std::string& name, size_t number) {
    return {name, {static_cast<int16_t>(number)}};
}

TEST(HeardEvents, ThoseBeforeTheOneThatIsWaitedForAreLetPass) {
    HeardEvents heard;
    for (const char* name : {"a", "b", "c"}) heard.push({name, {}});
    EXPECT_EQ(heard.take("b")->name, "b");
    EXPECT_FALSE(heard.take("a"));
    EXPECT_FALSE(heard.take(""));  // looking for `a` has let `c` pass
}

TEST(HeardEvents, OneThatWasHeardElsewhereTakesOnlyThoseBeforeItAlong) {
    HeardEvents heard;
    for (const char* name : {"a", "b", "c", "b"}) heard.push({name, {}});
    heard.pass("d");
    EXPECT_EQ(heard.all().size(), 4u);
    heard.pass("b");
    ASSERT_EQ(heard.all().size(), 2u);
    EXPECT_EQ(heard.all().front().name, "c");
}

TEST(HeardEvents, OfTooManyTheOldestAreLost) {
    HeardEvents heard;
    for (size_t i = 0; i <= kKeptEventsMax; ++i) heard.push(numbered("e", i));
    EXPECT_EQ(heard.take("")->arguments.front(), 1);
}

TEST(KeptEvents, OnlyThoseAskedForAreKeptInTheirOrder) {
    KeptEvents kept;
    kept.listen({"a", "b"});
    EXPECT_TRUE(kept.offer(numbered("b", 1)));
    EXPECT_FALSE(kept.offer(numbered("c", 2)));
    EXPECT_TRUE(kept.offer(numbered("a", 3)));
    EXPECT_EQ(kept.take()->name, "b");
    EXPECT_EQ(kept.take()->name, "a");
    EXPECT_FALSE(kept.take());
}

// Code could not know of an event that was lost.
TEST(KeptEvents, OneTooManyIsAnErrorUntilTheyAreAskedForAnew) {
    KeptEvents kept;
    kept.listen({"a"});
    for (size_t i = 0; i < kKeptEventsMax; ++i) kept.offer(numbered("a", i));
    EXPECT_FALSE(kept.empty());
    EXPECT_EQ(kept.take()->arguments.front(), 0);
    for (size_t i = 0; i < 2; ++i) kept.offer(numbered("a", i));
    EXPECT_THROW(kept.take(), CodeError);
    kept.listen({"a"});
    EXPECT_FALSE(kept.take());
}

}  // namespace
}  // namespace vagus::run
