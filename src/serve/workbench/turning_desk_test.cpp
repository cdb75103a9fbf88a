// When something was decided, as pages ask; the process that looks for it is played by the test.
#include "serve/workbench/turning_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "serve/edit/test_page.hpp"
#include "serve/workbench/test_runner.hpp"
#include "serve/workbench/turning_talk.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

class TurningDeskTest : public EditTest {
protected:
    TurningDeskTest() { enter({}); }

    void hear_host(Duration passed = 1s) {
        now += passed;
        turnings.tick(now);
    }
    // What the process was asked.
    TurningAsked begin(const Json& in) {
        ask("turning.ask", in);
        const auto packets = host->receive();
        if (packets.size() != 1)
            return ADD_FAILURE() << packets.size() << " packets", TurningAsked();
        return read_turning_asked(packets[0].bytes).value_or(TurningAsked());
    }
    void answer(const std::string& found) {
        host->send(kTurningAnswered, format_turning_found({"it turned there", found}));
        hear_host();
    }
    Json shown() { return document("turning"); }
    std::string point(double t, int came) const {
        return Json{{"t", t}, {"came", came}, {"of", 20}, {"low", 0}, {"high", 1}, {"end", false}}
            .dump();
    }

    std::optional<Pipe> host;
    std::optional<std::string> no_run;
    std::vector<std::function<void()>> flushing;
    bool holds = false;
    TurningDesk turnings{desk,
                         files,
                         [this] { return start_scripted(host); },
                         {.file = [this]() -> Result<std::string> {
                              if (no_run) return Error{Code::Unavailable, *no_run};
                              return std::string("/runs/run-3.mcap");
                          },
                          .flush =
                              [this](std::function<void()> done) {
                                  holds ? flushing.push_back(std::move(done)) : done();
                              }},
                         {.chain_of = [](const Json& chain) { return chain; },
                          .shorten = [](const std::string& text) { return text; },
                          .run = [] { return uint64_t{7}; }}};
};

TEST_F(TurningDeskTest, ItIsAskedTellsHowFarItIsAndWhatWasFound) {
    EXPECT_EQ(shown(), Json({{"state", "none"}}));
    const TurningAsked asked = begin({{"condition", "x > 1"}, {"tries", 40}});
    EXPECT_EQ(asked.file, "/runs/run-3.mcap");
    EXPECT_EQ(asked.condition, "x > 1");
    EXPECT_EQ(asked.tries, 40);
    EXPECT_EQ(asked.results, (root / ".vagus/turning-point").string());
    hear_host();
    EXPECT_EQ(shown()["state"], "running");
    EXPECT_EQ(shown()["run"], 7);
    EXPECT_EQ(shown()["progress"], Json({{"stage", "run"}, {"done", 0}, {"of", 0}}));
    host->send(kTurningProgress, format_progress({"curve", 40, 640}));
    hear_host();
    EXPECT_EQ(shown()["progress"], Json({{"stage", "curve"}, {"done", 40}, {"of", 640}}));
    answer(R"({"condition":"x > 1","came":2.5,"end":9,"tries":40,"continuations":700,"curve":[)" +
           point(0, 9) + R"(],"turn":{"before":)" + point(1, 9) + R"(,"after":)" + point(2, 20) +
           R"(,"narrowed":true,"with":{"file":")" + asked.results +
           R"(/run-3.with.mcap","from":1,"seed":5},"without":null,"there":[]}})");
    const Json done = shown();
    EXPECT_EQ(done["state"], "done");
    EXPECT_FALSE(done.contains("progress"));
    EXPECT_EQ(done["result"]["sentence"], "it turned there");
    EXPECT_EQ(done["result"]["came"], 2.5);
    EXPECT_EQ(done["result"]["continuations"], 700);
    const Json& turn = done["result"]["turn"];
    EXPECT_EQ(turn["after"]["t"], 2);
    EXPECT_EQ(turn["with"], ".vagus/turning-point/run-3.with.mcap");
    EXPECT_FALSE(turn.contains("without"));
    EXPECT_TRUE(turnings.has_recording(".vagus/turning-point/run-3.with.mcap"));
    EXPECT_FALSE(turnings.has_recording(""));
    EXPECT_FALSE(turnings.has_recording(".vagus/journal"));
    EXPECT_EQ(turnings.next_tick(), Time::max());
    turnings.forget();
    EXPECT_EQ(shown(), Json({{"state", "none"}}));
    EXPECT_FALSE(turnings.has_recording(".vagus/turning-point/run-3.with.mcap"));
}

TEST_F(TurningDeskTest, WhatChanceDidNotDecideHasNoTurn) {
    EXPECT_EQ(begin({{"condition", "x > 1"}}).tries, 20);
    answer(R"({"came":null,"end":9,"continuations":640,"curve":[],"turn":null})");
    EXPECT_EQ(shown()["state"], "done");
    EXPECT_FALSE(shown()["result"].contains("turn"));
    EXPECT_FALSE(shown()["result"].contains("came"));
}

TEST_F(TurningDeskTest, OneAtATimeAndItCanBeStopped) {
    begin({{"condition", "x > 1"}});
    EXPECT_THAT(refusal("turning.ask", {{"condition", "x > 2"}}), HasSubstr("wait for it"));
    ask("turning.stop", Json::object());
    EXPECT_EQ(shown()["state"], "stopped");
    EXPECT_EQ(turnings.next_tick(), Time::max());
    EXPECT_EQ(begin({{"condition", "x > 2"}}).condition, "x > 2");
}

// What is still being written when it is stopped begins nothing.
TEST_F(TurningDeskTest, ItBeginsWhenTheRunIsWrittenUnlessItWasStopped) {
    holds = true;
    ask("turning.ask", {{"condition", "x > 1"}});
    hear_host(2 * kTurningSilentMax);
    EXPECT_EQ(shown()["state"], "running");
    ask("turning.stop", Json::object());
    flushing.at(0)();
    EXPECT_FALSE(host);
    ask("turning.ask", {{"condition", "x > 2"}});
    flushing.at(1)();
    EXPECT_TRUE(host);
}

TEST_F(TurningDeskTest, WhatCannotBeFoundSaysWhy) {
    no_run = "nothing has run yet";
    EXPECT_THAT(refusal("turning.ask", {{"condition", "x > 1"}}), HasSubstr("nothing has run yet"));
    no_run.reset();
    begin({{"condition", "x >"}});
    host->send(kTurningAnswered, format_turning_refused("the condition \"x >\": expected a value"));
    hear_host();
    EXPECT_EQ(shown()["state"], "failed");
    EXPECT_EQ(shown()["why"], "the condition \"x >\": expected a value");
    begin({{"condition", "x > 1"}});
    host->send(kTurningAnswered, "{}");
    hear_host();
    EXPECT_THAT(shown()["why"].get<std::string>(), HasSubstr("cannot be read"));
    begin({{"condition", "x > 1"}});
    host.reset();
    hear_host();
    EXPECT_THAT(shown()["why"].get<std::string>(), HasSubstr("has gone; ask again"));
    begin({{"condition", "x > 1"}});
    hear_host();
    hear_host(kTurningSilentMax - 1ms);
    EXPECT_EQ(shown()["state"], "running");
    hear_host(1ms);
    EXPECT_THAT(shown()["why"].get<std::string>(), HasSubstr("has ended for 300 s"));
}

TEST(TurningTalk, WhatIsNoQuestionIsNone) {
    const TurningAsked asked{.file = "a", .condition = "b", .tries = 3, .results = "c"};
    const auto read = read_turning_asked(format_turning_asked(asked));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->condition, "b");
    EXPECT_EQ(read->tries, 3);
    for (const char* text : {"", "[]", "{}", R"({"file":"a","condition":"b","results":"c"})",
                             R"({"file":1,"condition":"b","results":"c","tries":3})"}) {
        EXPECT_FALSE(read_turning_asked(text)) << text;
    }
}

}  // namespace
}  // namespace vagus::serve
