#include "serve/workbench/try_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "serve/workbench/test_other_end.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

const std::string kTriedPlan =
    R"({"format": "vagus-plan/1", "name": "P", "start": {"actor": "wait"},
    "actors": {"wait": {"template": "Wait", "in": {"seconds": 1},
                        "states": {"Done": "@terminate"}}}})";

// The other end is a script: what vagus does is tested in try_host_test.cpp.
class TryDeskTest : public OtherEndTest {
protected:
    TryDeskTest() {
        write("P.plan.json", kTriedPlan);
        enter({.plan = "P.plan.json"});
    }
    TryDesk& desk_with(const std::string& script) {
        const TryDesk::Project project = {
            .toolboxes = [] { return std::vector<std::string>{}; },
            .real = [this](const std::string& doc) { return (root / doc).string(); },
            .doc_of = [](const std::string& file) { return file; },
            .new_test =
                [](const std::string&, const std::string&) {
                    return Result<std::string>(std::string("P.test.json"));
                }};
        tries.emplace(desk, files, other_end(script), project);
        return *tries;
    }
    void hear(const std::string& doc = "P.plan.json") {
        tell("plan.try", {{"doc", doc}, {"way", Json::array()}});
    }
    std::string refused() {
        return OtherEndTest::refused([this](Time at) { tries->tick(at); });
    }

    std::optional<TryDesk> tries;
};

TEST_F(TryDeskTest, AProcessThatDiesIsTold) {
    desk_with("exit 7");
    hear();
    EXPECT_THAT(refused(), HasSubstr("the plan cannot be tried: its process"));
}

TEST_F(TryDeskTest, APlanThatNeverWaitsIsGivenUpAndTheNextIsAnswered) {
    TryDesk& one = desk_with("exec sleep 1000");
    hear();
    one.tick(now);
    EXPECT_EQ(answered(), nullptr);
    EXPECT_EQ(one.next_tick(), now + kTryLookEvery);
    now += kTryWithin;
    EXPECT_THAT(refused(), HasSubstr("for more than 10 s and does not come to an actor"));
    EXPECT_EQ(one.next_tick(), Time::max());
}

TEST_F(TryDeskTest, AtMostFourAreTriedAtOnce) {
    desk_with("exec sleep 1000");
    for (size_t i = 0; i < kTriesAtOnce; ++i) hear();
    EXPECT_EQ(answered(), nullptr);
    hear();
    EXPECT_THAT(refused(), HasSubstr("4 plans are being tried; wait for them"));
}

TEST_F(TryDeskTest, WhatIsNoPlanIsRefused) {
    desk_with("exit 0");
    hear("vagus.json");
    EXPECT_THAT(refused(), HasSubstr("vagus.json is no plan"));
    got.clear();
    hear("Gone.plan.json");
    EXPECT_THAT(refused(), HasSubstr("Gone.plan.json"));
}

}  // namespace
}  // namespace vagus::serve
