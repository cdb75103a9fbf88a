// One supervisor that raises without end, and the runs that look like it but are not.
#include "run/firing.hpp"

#include <gtest/gtest.h>

namespace vagus::run {
namespace {

using namespace std::chrono_literals;

class FiringPlan : public testing::Test {
protected:
    std::optional<std::string> see(decltype(plan::TraceEvent::what) what,
                                   const std::string& plan = "P") {
        return firing_.see({now_, plan, std::move(what)});
    }

    // An actor runs so long, then the event ends it.
    std::optional<std::string> interrupt_after(Duration time, std::string_view event = "Near",
                                               const std::string& plan = "P") {
        ++activation_;
        (void)see(plan::ActorStarted{"drive", activation_, {}}, plan);
        now_ += time;
        auto said = see(plan::EventRaised{"watch", event, "back", true, activation_}, plan);
        (void)see(plan::ActorInterrupted{"drive", activation_, true, 0us}, plan);
        return said;
    }

    Firing firing_;
    Time now_{};
    uint64_t activation_ = 0;
};

TEST_F(FiringPlan, IsNamedAtTheHundredthEventAndOnlyOnce) {
    for (int i = 1; i < kFiringsMax; ++i) ASSERT_EQ(interrupt_after(10ms), std::nullopt) << i;
    const auto said = interrupt_after(10ms);
    ASSERT_TRUE(said.has_value());
    for (const char* part :
         {"P: ", "\"watch\"", "Near", "100 times", "\"back\"", "period_ms", "@ignore"}) {
        EXPECT_NE(said->find(part), std::string::npos) << *said;
    }
    for (int i = 0; i < 3 * kFiringsMax; ++i) ASSERT_EQ(interrupt_after(10ms), std::nullopt);
}

TEST_F(FiringPlan, WorkOfMoreThanATenthOfASecondBeginsTheCountAnew) {
    for (int i = 1; i < kFiringsMax; ++i) ASSERT_EQ(interrupt_after(100ms), std::nullopt);
    // This event is the first of the new count.
    ASSERT_EQ(interrupt_after(100ms + 1us), std::nullopt);
    for (int i = 2; i < kFiringsMax; ++i) ASSERT_EQ(interrupt_after(100ms), std::nullopt);
    EXPECT_TRUE(interrupt_after(100ms).has_value());
}

TEST_F(FiringPlan, EachEventIsCountedForItself) {
    for (int i = 1; i < kFiringsMax; ++i) {
        ASSERT_EQ(interrupt_after(1ms, "Near"), std::nullopt);
        ASSERT_EQ(interrupt_after(1ms, "Far"), std::nullopt);
    }
    EXPECT_TRUE(interrupt_after(1ms, "Far").has_value());
}

// An ignored event interrupts nothing: the actor that runs on has run for long.
TEST_F(FiringPlan, IgnoredEventsBesideALongActorAreFine) {
    (void)see(plan::ActorStarted{"drive", 1, {}});
    for (int i = 0; i < 10; ++i) {
        now_ += 10ms;
        ASSERT_EQ(see(plan::EventRaised{"watch", "Near", "@ignore", true, 1}), std::nullopt);
    }
    for (int i = 0; i < 3 * kFiringsMax; ++i) {
        now_ += 10ms;
        ASSERT_EQ(see(plan::EventRaised{"watch", "Near", "@ignore", true, 1}), std::nullopt);
    }
}

TEST_F(FiringPlan, AnActorThatIsAPlanCountsByItsActors) {
    (void)see(plan::PlanStarted{});
    (void)see(plan::ActorStarted{"inner", 1000, {}});
    (void)see(plan::PlanStarted{}, "P/inner");
    for (int i = 1; i < kFiringsMax; ++i) {
        ASSERT_EQ(interrupt_after(10ms, "Near", "P/inner"), std::nullopt);
    }
    EXPECT_TRUE(interrupt_after(10ms, "Near", "P/inner").has_value());
}

}  // namespace
}  // namespace vagus::run
