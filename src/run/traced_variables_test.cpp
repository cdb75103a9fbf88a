#include "run/traced_variables.hpp"

#include <gtest/gtest.h>

#include "run/test_plans.hpp"

namespace vagus::run {
namespace {

class TwoFiles final : public plan::Files {
public:
    Result<std::string> read(const std::string& path) const override {
        if (path == "main.plan.json") {
            return std::string(R"({ "format": "vagus-plan/1", "name": "Main",
              "configuration": { "m": { "type": "int", "initial": 1 },
                                 "n": { "type": "int", "initial": 2 } },
              "start": { "actor": "inner" },
              "actors": { "inner": { "plan": "sub.plan.json", "states": { "OK": "@terminate",
                "Interrupted": "@terminate", "Error": "@terminate" } } } })");
        }
        return std::string(R"({ "format": "vagus-plan/1", "name": "Sub",
          "configuration": { "n": { "type": "int", "access": "shared" },
                             "own": { "type": "int", "initial": 7 } },
          "start": { "actor": "a" },
          "actors": { "a": { "template": "Once", "states": { "Done": "@terminate" } } } })");
    }
};

class Traced : public testing::Test {
protected:
    Traced() {
        library_.add("core", "", {test_actor("Once", [](ActorContext& code) { code.end(0); })});
        const plan::Checked checked =
            plan::check("main.plan.json", TwoFiles(), library_.templates());
        EXPECT_TRUE(checked.ok()) << plan::format_findings_json(checked.findings);
        graph_ = plan::make_graph(checked);
        variables_.emplace(graph_);
        see("Main", plan::PlanStarted{});
        see("Main", plan::ActorStarted{"inner", 1, {}});
        see("Main/inner", plan::PlanStarted{});
    }

    template <typename What>
    void see(const char* plan, What what) {
        variables_->see({Time{0}, plan, std::move(what)});
    }
    void write(const char* plan, const char* variable, int64_t value) {
        see(plan, plan::VariableWritten{variable, plan::Value(value), "a"});
    }

    CodeLibrary library_;
    plan::Graph graph_;
    std::optional<TracedVariables> variables_;
};

// `n` of Sub is slot 0 there and slot 1 of Main.
TEST_F(Traced, AWriteToASharedVariableGoesToTheCaller) {
    write("Main/inner", "n", 5);
    EXPECT_EQ(variables_->last_write().level, 0);
    EXPECT_EQ(variables_->last_write().slot, 1);
    EXPECT_EQ(variables_->value(0, 1).integer(), 5);
    EXPECT_EQ(variables_->value(1, 0).integer(), 5);
}

TEST_F(Traced, AWriteToALocalVariableStaysInItsPlan) {
    write("Main/inner", "own", 8);
    EXPECT_EQ(variables_->last_write().level, 1);
    EXPECT_EQ(variables_->value(1, 1).integer(), 8);
    EXPECT_EQ(variables_->value(0, 0).integer(), 1);
}

TEST_F(Traced, AtTheEndOfAPlanItsVariablesGo) {
    EXPECT_EQ(variables_->depth(), 2);
    see("Main/inner", plan::PlanEnded{plan::PlanResult::Ok, ""});
    EXPECT_EQ(variables_->depth(), 1);
    see("Main/inner", plan::PlanStarted{});
    EXPECT_EQ(variables_->value(1, 1).integer(), 7);  // the initial value again
}

}  // namespace
}  // namespace vagus::run
