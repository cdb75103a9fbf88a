// The process of a run, in this process: what it answers to what a server says.
#include "serve/runner/runner.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "serve/json.hpp"
#include "serve/runner/test_run_host.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

TEST_F(RunnerTest, AWorldIsOpenedStandsAndGoes) {
    say(talk::SetPace{true, 1});
    say(order(7, world()));
    EXPECT_EQ(wait<talk::Opening>().order, 7u);
    const auto opened = wait<talk::Opened>();
    EXPECT_EQ(opened.order, 7u);
    ASSERT_TRUE(opened.scene.has_value());
    EXPECT_EQ(opened.scene->robots.at(0).name, "alice");
    EXPECT_EQ(opened.scene->document.json["robots"][0]["name"], "alice");
    const auto paused = wait<talk::Clock>();
    EXPECT_EQ(paused.t, 0);
    EXPECT_TRUE(paused.paused);
    say(talk::SetPace{false, 0});
    (void)wait<talk::Clock>([](const talk::Clock& clock) { return clock.t > 1; });
    EXPECT_EQ(leave(), 0);
    EXPECT_EQ(ended.why, "");
}

TEST_F(RunnerTest, WhatCannotBeOpenedIsToldAndAnotherOrderIsServed) {
    say(order(1, (folder / "nowhere.world.json").string()));
    const auto failed = wait<talk::OpenFailed>();
    EXPECT_EQ(failed.order, 1u);
    EXPECT_THAT(failed.why, HasSubstr("nowhere.world.json"));
    say(order(2, world(), write("bad.plan.json", R"({"format": "vagus-plan/1"})")));
    EXPECT_EQ(wait<talk::OpenFailed>().order, 2u);
    say(order(3, world()));
    EXPECT_EQ(wait<talk::Opened>().order, 3u);
}

TEST_F(RunnerTest, APlanRunsToItsEndAndSaysHowItEnded) {
    const std::string plan = write("fail.plan.json", R"({
        "format": "vagus-plan/1", "name": "P", "start": {"actor": "a"}, "actors": {
        "a": {"template": "Fail", "in": {"message": "'it is broken'"}, "states": {}}}})");
    say(talk::SetPace{false, 0});
    say(order(1, world(), plan));
    (void)wait<talk::Opened>();
    const auto over = wait<talk::PlanNow>(
        [](const talk::PlanNow& told) { return told.state == talk::PlanState::Ended; });
    EXPECT_EQ(over.result, "Error");
    EXPECT_THAT(over.message, HasSubstr("it is broken"));
}

TEST_F(RunnerTest, EachRequestIsAnsweredWhateverRuns) {
    say(talk::SetPace{true, 1});
    say(order(1, world()));
    (void)wait<talk::Opened>();
    const talk::Order requests[] = {
        talk::SetVariable{1, 0, "n", plan::Value(int64_t{1})},
        talk::ChangePlan{2, {}},
        talk::HandleHeld{3, talk::HeldAct::Go, {}},
        talk::MoveRobot{4, "nobody", {1, 1}, {}},
        talk::TakeObject{5, 99},
        talk::CheckPlan{6, {}},
        talk::RaiseEvent{7, "s", "e", {}},
        talk::MoveObject{8, 99, {1, 1}, {}},
        talk::PutObject{.request = 9, .at = {5, 5}},
        talk::SwitchLight{10, 99, true},
        talk::PressButton{11, "nobody", "centre", true},
        talk::TapRobot{12, "nobody"},
    };
    uint64_t number = 0;
    for (const talk::Order& request : requests) {
        say(request);
        const auto answer = wait<talk::Answer>();
        EXPECT_EQ(answer.request, ++number);
        EXPECT_NE(answer.why, "") << number;
    }
}

TEST_F(RunnerTest, AHandPutsMovesAndTakesAnObject) {
    say(talk::SetPace{true, 1});
    say(order(1, world()));
    (void)wait<talk::Opened>();
    say(talk::PutObject{.request = 1, .kind = talk::ObjectKind::Cylinder, .at = {0.5, 0.5}});
    const auto put = wait<talk::Answer>();
    EXPECT_EQ(put.why, "");
    ASSERT_TRUE(put.number.has_value());
    const auto scene = wait<talk::SceneNow>(
        [](const talk::SceneNow& now) { return !now.scene.document.json["objects"].empty(); });
    EXPECT_EQ(scene.scene.document.json["objects"][0]["radius"], 0.05);
    say(talk::MoveObject{2, *put.number, {1, 0.5}, {}});
    EXPECT_EQ(wait<talk::Answer>().why, "");
    say(talk::TakeObject{3, *put.number});
    EXPECT_EQ(wait<talk::Answer>().why, "");
    say(talk::MoveRobot{4, "alice", {0.5, 0.5}, 1.5});
    EXPECT_EQ(wait<talk::Answer>().why, "");
}

// What a hand deleted can be put back as it was: Undo of a page.
TEST_F(RunnerTest, AHandPutsALampWithAllThatItHas) {
    say(talk::SetPace{true, 1});
    say(order(1, world()));
    (void)wait<talk::Opened>();
    say(talk::PutObject{.request = 1,
                        .kind = talk::ObjectKind::Light,
                        .at = {0.5, 0.5},
                        .id = "lamp",
                        .radius = 0.125,
                        .height = 0.25,
                        .colour = talk::Colour{1, 0.5, 0},
                        .on = false});
    EXPECT_EQ(wait<talk::Answer>().why, "");
    const auto scene = wait<talk::SceneNow>(
        [](const talk::SceneNow& now) { return !now.scene.document.json["objects"].empty(); });
    const Json lamp = scene.scene.document.json["objects"][0];
    EXPECT_EQ(lamp["id"], "lamp");
    EXPECT_EQ(lamp["kind"], "light");
    EXPECT_EQ(lamp["radius"], 0.125);
    EXPECT_EQ(lamp["height"], 0.25);
    EXPECT_EQ(lamp["colour"], Json({1, 0.5, 0}));
    EXPECT_EQ(lamp["on"], false);
}

// The text of its editor counts, not the file on the disk.
TEST_F(RunnerTest, AWorldIsOpenedFromATextThatIsNotSaved) {
    talk::Open open = order(1, world());
    open.world_text = R"({"format": "vagus-world/1", "size": [2, 1]})";
    say(open);
    EXPECT_EQ(wait<talk::Opened>().scene->document.json["size"], Json({2, 1}));
}

// ---- what is no order ----

TEST_F(RunnerTest, AServerThatSpeaksNonsenseIsLeft) {
    ASSERT_TRUE(server->send('J', "not JSON"));
    wait_end();
    EXPECT_EQ(leave(), kExitNonsense);
    EXPECT_EQ(ended.why,
              "the studio sent a message: expected one of the numbers 1 to 24, found 74; this run "
              "is ended");
}

TEST_F(RunnerTest, AMalformedOrderEndsAPlanThatRuns) {
    say(talk::SetPace{false, 1});
    say(order(1, world(), waiting_plan()));
    (void)wait<talk::Traced>();
    Packet pace = talk::encode(talk::Order(talk::SetPace{}));
    pace.bytes.pop_back();
    ASSERT_TRUE(server->send(pace));
    wait_end();
    EXPECT_EQ(leave(), kExitNonsense);
    EXPECT_EQ(ended.why,
              "the studio sent pace.speed: expected 8 bytes more, found its end; this run is "
              "ended");
}

// ---- two orders, one behind the other ----

TEST_F(RunnerTest, OfTwoOrdersOneBehindTheOtherTheSecondIsServed) {
    say(talk::SetPace{false, 0});
    say(order(1, world(), waiting_plan()));
    say(talk::SetVariable{1, 0, "n", plan::Value(true)});
    say(order(2, world()));
    EXPECT_EQ(wait<talk::Answer>().request, 1u);
    (void)wait<talk::Opened>([](const talk::Opened& opened) { return opened.order == 2; });
    (void)wait<talk::Clock>([](const talk::Clock& clock) { return clock.t > 0.5; });
    say(talk::SetVariable{2, 0, "n", plan::Value(true)});
    EXPECT_EQ(wait<talk::Answer>().why, "no plan runs");
    EXPECT_EQ(leave(), 0);
}

TEST_F(RunnerTest, AnOrderEndsThePlanThatRuns) {
    say(talk::SetPace{false, 0});
    say(order(1, world(), waiting_plan()));
    (void)wait<talk::Traced>();
    say(order(2, world(), waiting_plan()));
    const auto ends = [](const talk::Traced& one) {
        return one.line.find("plan-end") != std::string::npos;
    };
    EXPECT_THAT(wait<talk::Traced>(ends).line, HasSubstr(R"("result":"Interrupted")"));
    EXPECT_EQ(wait<talk::Opened>().order, 2u);
    EXPECT_EQ(wait<talk::PlanVersion>().number, 1u);
    EXPECT_EQ(
        wait<talk::Traced>([](const talk::Traced& one) { return one.actor.has_value(); }).actor,
        "a");
}

// ---- the plan changes ----

TEST_F(RunnerTest, AVersionThatTakesOverIsToldOnceAfterItsLineWithItsNumber) {
    say(talk::SetPace{false, 1});
    const std::string plan = waiting_plan();
    say(order(1, world(), plan));
    const auto first = wait<talk::PlanVersion>();
    EXPECT_EQ(first.number, 1u);
    ASSERT_EQ(first.plans.size(), 1u);
    EXPECT_EQ(first.plans[0].file, plan);
    EXPECT_EQ(first.plans[0].actors.at(0).template_name, "WaitForever");
    EXPECT_EQ(first.texts.at(plan), read_file(plan).value());
    (void)wait<talk::Traced>([](const talk::Traced& one) { return one.actor.has_value(); });
    write("wait.plan.json", R"({"format": "vagus-plan/1", "name": "P", "start": {"actor": "a"},
        "actors": {"a": {"template": "WaitForever", "states": {}},
                   "b": {"template": "WaitForever", "states": {}}}})");
    say(talk::ChangePlan{1, {plan}});
    // Its line, then what it is made of.
    (void)wait<talk::Traced>([](const talk::Traced& one) {
        return one.line.find(R"("kind":"change")") != std::string::npos;
    });
    const auto second = wait<talk::PlanVersion>();
    EXPECT_EQ(second.number, 2u);
    EXPECT_EQ(second.plans.at(0).actors.size(), 2u);
    EXPECT_EQ(second.texts.at(plan), read_file(plan).value());
}

// Two plans of the run change at one instant: two lines, one version.
TEST_F(RunnerTest, AVersionOfTwoFilesIsToldOnce) {
    const auto outer = [this](const std::string& help) {
        return write("outer.plan.json", R"({"format": "vagus-plan/1", "name": "Outer",
            "help": ")" + help + R"(", "start": {"actor": "a"}, "actors": {
            "a": {"plan": "wait.plan.json", "states": {"OK": "@terminate",
                  "Interrupted": "@terminate", "Error": "@terminate"}}}})");
    };
    say(talk::SetPace{false, 1});
    const std::string inner = waiting_plan();
    const std::string plan = outer("first");
    say(order(1, world(), plan));
    EXPECT_EQ(wait<talk::PlanVersion>().plans.size(), 2u);
    (void)wait<talk::Traced>([](const talk::Traced& one) {
        return one.line.find("WaitForever") == std::string::npos &&
               one.line.find(R"("plan":"Outer/a","kind":"actor-start")") != std::string::npos;
    });
    outer("second");
    waiting_plan("second");
    say(talk::ChangePlan{1, {plan, inner}});
    std::vector<uint64_t> versions;
    size_t lines = 0;
    (void)wait_all([&](const talk::News& news) {
        if (const auto* one = std::get_if<talk::PlanVersion>(&news))
            versions.push_back(one->number);
        const auto* traced = std::get_if<talk::Traced>(&news);
        if (traced && traced->line.find(R"("kind":"change")") != std::string::npos) ++lines;
        const auto* answer = std::get_if<talk::Answer>(&news);
        return answer && answer->request == 1;
    });
    EXPECT_EQ(lines, 2u);
    EXPECT_EQ(versions, std::vector<uint64_t>{2});
}

// The plan has ended and its world goes on: nothing of it is left that could be asked.
TEST_F(RunnerTest, AVersionForAPlanThatHasEndedIsRefused) {
    say(talk::SetPace{false, 1});
    const std::string plan = waiting_plan();
    say(order(1, world(), plan));
    (void)wait<talk::Traced>();
    say(talk::StopPlan{});
    (void)wait<talk::PlanNow>(
        [](const talk::PlanNow& now) { return now.state == talk::PlanState::Ended; });
    for (uint64_t number = 1; number < 20; number += 2) {
        say(talk::ChangePlan{number, {plan}});
        say(talk::CheckPlan{number + 1, {{plan, ""}}});
        EXPECT_NE(wait<talk::Answer>().why, "");
        EXPECT_NE(wait<talk::Answer>().why, "");
    }
    EXPECT_EQ(leave(), 0);
}

}  // namespace
}  // namespace vagus::serve
