#include "embed/plan_code.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "embed/loaded_plan.hpp"
#include "run/virtual_time.hpp"
#include "templates/core.hpp"
#include "toolbox/core.hpp"

namespace vagus::embed {
namespace {

using testing::HasSubstr;
namespace core = templates::core;

Plan make_countdown() {
    core::Assign set("set", {.value = "n - 1"}, {.result = "n"});
    core::Compare ask("ask", {.left = "n", .op = "'>'", .right = "0"});

    Plan plan("Countdown");
    plan.variable("n", Type::Int, {.initial = 2, .access = Access::InOut});
    plan.start_with(set);

    plan.after(set, core::Assign::Done, ask);

    plan.after(ask, core::Compare::True, set);
    plan.after(ask, core::Compare::False, Plan::kTerminate);
    return plan;
}

class CountdownActor final : public SubPlanObject {
public:
    static constexpr State<CountdownActor> OK{"OK"};
    static constexpr State<CountdownActor> Interrupted{"Interrupted"};
    static constexpr State<CountdownActor> Error{"Error"};
    explicit CountdownActor(std::string name)
        : SubPlanObject(std::move(name), &make_countdown, std::source_location::current()) {
        feed("n", "3");
        write("n", "left");
    }
};

Plan make_caller() {
    CountdownActor first("first");
    CountdownActor second("second");
    Plan plan("Caller");
    plan.variable("left", Type::Int, {.initial = 9});
    plan.start_with(first);
    for (const CountdownActor* actor : {&first, &second}) {
        const Target next = actor == &first ? Target(second) : Plan::kTerminate;
        plan.after(*actor, CountdownActor::OK, next);
        plan.after(*actor, CountdownActor::Interrupted, Plan::kTerminate);
        plan.after(*actor, CountdownActor::Error, Plan::kTerminate);
    }
    return plan;
}

struct Library {
    Library() { toolbox::add_core(all); }
    run::CodeLibrary all;
};

std::vector<std::string> writes(MakePlan make) {
    const Library library;
    const LoadedPlan plan = LoadedPlan::from_code(make, library.all);
    EXPECT_TRUE(plan.ok()) << plan.report();
    std::vector<std::string> lines;
    run::RunOptions options;
    options.on_trace = [&lines](const plan::TraceEvent& event) {
        const auto* written = std::get_if<plan::VariableWritten>(&event.what);
        if (!written) return;
        lines.push_back(event.plan + " " + std::string(written->variable) + "=" +
                        plan::text_of(written->value).value());
    };
    run::VirtualTime(plan.graph(), library.all, options).run();
    return lines;
}

TEST(PlanCode, RunsAsWritten) {
    EXPECT_THAT(writes(&make_countdown),
                testing::ElementsAre("Countdown n=2", "Countdown n=1", "Countdown n=0"));
}

TEST(PlanCode, ASubPlanUsedTwiceIsOnePlan) {
    const Assembly assembly = assemble(&make_caller);
    ASSERT_EQ(assembly.plans.size(), 2u);
    EXPECT_EQ(*assembly.plans[0].actors[0].plan, assembly.plans[1].file);
    EXPECT_EQ(*assembly.plans[0].actors[1].plan, assembly.plans[1].file);
    EXPECT_EQ(writes(&make_caller).back(), "Caller left=0");
}

Plan make_wrong() {
    core::Wait wait("wait", {.seconds = "speeed"});
    core::Wait twin("wait", {.seconds = "1"});
    core::Timeout late("late", {.seconds = "1"});
    Plan plan("Wrong");
    plan.variable("speed", Type::Int, {.initial = "fast"});
    plan.variable("speed", Type::Float);
    plan.start_with(wait);
    plan.after(wait, core::Wait::Done, twin);
    plan.after(wait, core::Wait::Done, Plan::kIgnore);
    plan.during(wait, late, core::Timeout::Timeout_, Plan::kTerminate);
    plan.during(twin, late, core::Timeout::Timeout_, Plan::kTerminate);
    return plan;
}

// Each finding names this file and its line, as those of plan files do theirs.
TEST(PlanCode, MistakesAreFoundAsInPlanFiles) {
    const Library library;
    const LoadedPlan plan = LoadedPlan::from_code(&make_wrong, library.all);
    ASSERT_FALSE(plan.ok());
    const std::string report = plan.report();
    EXPECT_THAT(report, HasSubstr("plan_code_test.cpp:"));
    EXPECT_THAT(report, HasSubstr("uses the variable \"speeed\", which does not exist"));
    EXPECT_THAT(report, HasSubstr("there is an actor named \"wait\" already"));
    EXPECT_THAT(report, HasSubstr("there is a variable named \"speed\" already"));
    EXPECT_THAT(report, HasSubstr("there is a supervisor named \"late\" already"));
    EXPECT_THAT(report, HasSubstr("\"Done\" of wait leads to wait already"));
    EXPECT_THAT(report, HasSubstr("the initial value must be a constant of the type int"));
}

}  // namespace
}  // namespace vagus::embed
