#include "serve/workbench/try_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "serve/edit/test_page.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

const std::string kPlan = R"({"format": "vagus-plan/1", "name": "P", "start": {"actor": "wait"},
    "actors": {"wait": {"template": "Wait", "in": {"seconds": 1},
                        "states": {"Done": "@terminate"}}}})";

// The other end is a script: what vagus does is tested in try_host_test.cpp.
class TryDeskTest : public EditTest {
protected:
    TryDeskTest() {
        write("P.plan.json", kPlan);
        enter({.plan = "P.plan.json"});
    }
    TryDesk& desk_with(const std::string& script) {
        write("other-end", "#!/bin/sh\n" + script);
        const auto path = root / "other-end";
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        const TryDesk::Project project = {
            .toolboxes = [] { return std::vector<std::string>{}; },
            .real = [this](const std::string& doc) { return (root / doc).string(); },
            .doc_of = [](const std::string& file) { return file; },
            .new_test = [](const std::string&, const std::string&) {
                return Result<std::string>(std::string("P.test.json"));
            }};
        tries.emplace(desk, files, path.string(), project);
        return *tries;
    }
    void hear(const std::string& doc = "P.plan.json") {
        const Json in = {{"doc", doc}, {"way", Json::array()}};
        desk.hear(ClientText{{1}, Json{{"id", ++id}, {"do", "plan.try"}, {"in", in}}.dump()}, now);
    }
    // The sentence of a refusal.
    std::string refused() {
        const Json* answer = nullptr;
        while (!(answer = answered())) tries->tick(now);
        return answer->contains("error") ? answer->at("error").at("what").get<std::string>()
                                         : answer->dump();
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
