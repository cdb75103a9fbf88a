// Chains whose root is a person, who acts while the run goes on. Those of the samples are in
// tests/recordings/why_questions.py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/test_folder.hpp"
#include "base/test_places.hpp"
#include "embed/robots_run.hpp"
#include "record/past_run.hpp"
#include "record/sim_recording.hpp"
#include "record/why.hpp"

namespace vagus::record {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

// A Thymio that explores; what a person does comes after four seconds, and it goes on for one.
std::string explored(const std::function<Status(sim::World&)>& act) {
    const test::Folder folder;
    const std::string file = (folder / "run.mcap").string();
    const std::string script = test::examples("thymio/explore.aesl");
    RunFile about;
    about.verb = "sim";
    about.world = test::examples("thymio/arena.world.json");
    about.loads = {script};
    FilesRead files;
    auto robots = embed::RobotsRun::open({.world = about.world});
    EXPECT_TRUE(robots.ok());
    session::SimSession& session = robots.value()->buses().common();
    session.load(script, read_file(script).value());
    auto recording = SimRecording::begin(file, about, files, *robots.value(), Pace::Waits);
    EXPECT_TRUE(recording.ok());
    while (session.now() < 4s) session.step(sim::kNodeStep);
    EXPECT_TRUE(act(session.world()).ok());
    while (session.now() < 5s) session.step(sim::kNodeStep);
    EXPECT_TRUE(recording.value()->end().ok());
    return read_file(file).value();
}

std::vector<std::string> sentences(const std::string& recording, const Question& question) {
    const auto reader = mcap::Reader::open(recording, "run.mcap");
    if (!reader.ok()) return {reader.error().what};
    const auto chain = why(reader.value(), question, std::nullopt);
    if (!chain.ok()) return {chain.error().what};
    std::vector<std::string> said;
    for (const Link& link : chain.value()) said.push_back(link.what);
    EXPECT_TRUE(chain.value().back().root);
    return said;
}

TEST(Why, AButtonThatAPersonPressed) {
    const std::string recording =
        explored([](sim::World& world) { return world.press(sim::RobotId{1}, "center"); });
    EXPECT_THAT(sentences(recording, {Question::About::Variable, "thymio-II.running"}),
                ElementsAre("the script of thymio-II wrote running", "thymio-II felt button.center",
                            "a person pressed the button \"center\""));
    // And nobody touched what was written before.
    EXPECT_THAT(
        sentences(recording, {Question::About::Variable, "thymio-II.curve"}),
        ElementsAre("the script of thymio-II wrote curve", "a timer of thymio-II ran out: timer0"));
}

TEST(Why, WhatLostIsOneSentence) {
    const Loser bell{"bell", "Timeout"};
    const Loser end{"first", "Done", true};
    EXPECT_EQ(won_against({bell}), "won against bell, which raised Timeout at the same instant");
    EXPECT_EQ(won_against({end}),
              "won against the actor first, which ended with Done at the same instant");
    EXPECT_EQ(won_against({bell, bell, end}),
              "won against bell, which raised Timeout, bell, which raised Timeout, and the actor "
              "first, which ended with Done, all at the same instant");
}

// ---- a fleet ----

TEST(Why, ALinkSaysWhoseItIs) {
    EXPECT_EQ(format_link({.at = 6s + 420ms,
                           .what = "the fleet brought alarm from t15",
                           .place = "",
                           .value = "7",
                           .robot = "t11"}),
              "      6.420 s  t11: the fleet brought alarm from t15 (7)");
    EXPECT_EQ(format_chain_json({{.at = 1s, .what = "w", .place = "", .value = "", .robot = "r"}}),
              "[\n{\"t\":1.000000,\"what\":\"w\",\"place\":\"\",\"value\":\"\",\"root\":false,"
              "\"element\":\"\",\"robot\":\"r\"}\n]\n");
}

// The studio runs one bus and one plan.
TEST(PastRun, OfAFleetIsRefusedWithWhatCanBeDone) {
    const test::Folder folder;
    const std::string file = (folder / "run.mcap").string();
    RunFile about;
    about.verb = "sim";
    about.world = test::examples("alarm/class.world.json");
    FilesRead files;
    auto robots = embed::RobotsRun::open({.world = about.world});
    ASSERT_TRUE(robots.ok());
    auto recording = SimRecording::begin(file, about, files, *robots.value(), Pace::Waits);
    ASSERT_TRUE(recording.ok());
    ASSERT_TRUE(robots.value()->start().ok());
    robots.value()->step(10ms);
    ASSERT_TRUE(recording.value()->end().ok());
    const auto past = read_past(file, std::nullopt);
    ASSERT_FALSE(past.ok());
    EXPECT_THAT(past.error().what, HasSubstr("is of a world in which 30 robots have projects of "
                                             "their own, which the studio does not run"));
}

}  // namespace
}  // namespace vagus::record
