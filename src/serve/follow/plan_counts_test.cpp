#include "serve/follow/plan_counts.hpp"

#include "serve/json.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;

// go for 2 s, touched after 1 s more in its second turn.
PlanCounts counted() {
    PlanCounts counts;
    const auto see = [&](Time at, auto what) { counts.see({at, "P", what}); };
    see(0s, plan::PlanStarted{});
    see(0s, plan::ActorStarted{"go", 1, {}});
    see(2s, plan::ActorEnded{"go", 1, "Done", "go"});
    see(2s, plan::ActorStarted{"go", 2, {}});
    see(3s, plan::EventRaised{"touch", "Pressed", "back", false, 2});
    return counts;
}

TEST(PlanCounts, CountTurnsAndAddUpTheTimeOfThoseThatAreOver) {
    PlanCounts counts = counted();
    EXPECT_EQ(counts.counts("P"), Json::parse(R"([
        {"is": "actor", "name": "go", "times": 2, "seconds": 2.0, "last": 2.0},
        {"is": "supervisor", "name": "touch", "times": 1, "seconds": 0.0, "last": 0.0}])"));

    counts.see({3500ms, "P", plan::ActorInterrupted{"go", 2, true, 500ms}});
    EXPECT_EQ(counts.counts("P")[0]["seconds"], 3.5);
    EXPECT_EQ(counts.counts("P")[0]["last"], 1.5);
}

TEST(PlanCounts, NameTheArrowThatWasTakenAndCountIt) {
    EXPECT_EQ(counted().taken("P"), Json::parse(R"({
        "number": 3, "is": "event", "element": "touch", "outcome": "Pressed",
        "target": "back"})"));
    PlanCounts first;
    first.see({0s, "P", plan::ActorStarted{"go", 1, {}}});
    EXPECT_EQ(first.taken("P")["is"], "start");
    EXPECT_EQ(first.taken("P")["target"], "go");
}

TEST(PlanCounts, KeepWhatASubPlanDidInItsEarlierTurns) {
    PlanCounts counts;
    for (const Time begun : {0s, 10s}) {
        counts.see({begun, "P/in", plan::PlanStarted{}});
        counts.see({begun, "P/in", plan::ActorStarted{"nap", 1, {}}});
        counts.see({begun + 1s, "P/in", plan::PlanEnded{plan::PlanResult::Error, "no"}});
    }
    EXPECT_EQ(counts.counts("P/in")[0]["times"], 2);
    EXPECT_EQ(counts.counts("P/in")[0]["seconds"], 2.0);
    EXPECT_TRUE(counts.counts("P").empty());
    EXPECT_TRUE(counts.taken("P").is_null());
}

}  // namespace
}  // namespace vagus::serve
