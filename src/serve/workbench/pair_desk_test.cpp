#include "serve/workbench/pair_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "base/test_folder.hpp"
#include "serve/protocol/protocol.hpp"
#include "serve/runner/compare_host.hpp"
#include "serve/runner/test_recording.hpp"
#include "serve/workbench/test_other_end.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

class PairDeskTest : public OtherEndTest {
protected:
    void desk_with(const std::string& script, bool has_run = true) {
        const PairDesk::Project project = {
            .recording_at = [](const std::string& path) -> Result<std::string> {
                if (path == "kept.mcap") return "/there/" + path;
                return Error{Code::NotFound, path + ": there is no such file"};
            },
            .doc_of = [](const std::string& file) { return file; }};
        pairs.emplace(desk, other_end(script), shown_run(has_run), project);
    }
    std::string refused() {
        return OtherEndTest::refused([this](Time at) { pairs->tick(at); });
    }

    std::optional<PairDesk> pairs;
};

TEST_F(PairDeskTest, AProcessThatDiesIsTold) {
    desk_with("exit 7");
    tell("runs.compare", {{"b", "kept.mcap"}, {"align", "start"}});
    EXPECT_THAT(refused(), HasSubstr("the two runs could not be compared: its process"));
}

TEST_F(PairDeskTest, WhatIsNotThereIsRefused) {
    desk_with("exit 0", false);
    tell("runs.compare", {{"b", "kept.mcap"}, {"align", "start"}});
    EXPECT_EQ(refused(), "nothing has run yet");
    got.clear();
    tell("runs.compare", {{"a", "kept.mcap"}, {"b", "gone.mcap"}, {"align", "start"}});
    EXPECT_EQ(refused(), "gone.mcap: there is no such file");
}

// Without a run that is shown, too.
TEST_F(PairDeskTest, TwoFilesThatTakeTooLongAreNotWaitedFor) {
    desk_with("exec sleep 1000", false);
    tell("runs.compare", {{"a", "kept.mcap"}, {"b", "kept.mcap"}, {"align", "start"}});
    pairs->tick(now);
    EXPECT_EQ(answered(), nullptr);
    now += kPairWithin;
    EXPECT_THAT(refused(), HasSubstr("takes longer than 60 s"));
    EXPECT_EQ(pairs->next_tick(), Time::max());
}

// ---- what the process answers ----

TEST(CompareHost, ItTellsWhereTwoRunsDifferAndWhatTheyAreDrawnFrom) {
    const test::Folder folder;
    const std::string a = record_wall((folder / "a.mcap").string(), "30");
    const std::string b = record_wall((folder / "b.mcap").string(), "45");
    const auto ask = [&](const Json& align, const std::string& other) {
        return Json::parse(answer_compare(Json{{"a", a}, {"b", other}, {"align", align}}.dump()));
    };
    Json found = ask({"start"}, b);
    ASSERT_FALSE(found.contains("error")) << found;
    for (const char* const side : {"a", "b"}) found[side]["path"] = side;  // by the desk
    EXPECT_EQ(Protocol::get().fault_of_answer("runs.compare", found), std::nullopt);
    ASSERT_FALSE(found["lanes"].empty());
    EXPECT_EQ(found["lanes"][0]["name"], "/plan/trace");
    EXPECT_EQ(found["lanes"][0]["t"], 0.0);
    EXPECT_EQ(found["started"][0]["what"], "set");
    EXPECT_EQ(found["a"]["actors"][0]["name"], "searchFirstWall");
    EXPECT_EQ(found["a"]["ways"][0]["robot"], "carbot");
    EXPECT_FALSE(found["scene"].empty());
    const Json aligned = ask({"actor", "findWallAngle"}, b);
    EXPECT_EQ(aligned["a"]["start"], aligned["a"]["actors"][1]["from"]);
    EXPECT_THAT(ask({"actor", "findwallangle"}, b)["error"].get<std::string>(),
                HasSubstr(a + " began no actor \"findwallangle\"; did you mean findWallAngle?"));
    const Json same = ask({"start"}, a);
    for (const Json& lane : same["lanes"]) EXPECT_FALSE(lane.contains("t")) << lane;
    EXPECT_THAT(ask({"start"}, "/no/x.mcap")["error"].get<std::string>(), HasSubstr("/no/x.mcap"));
    EXPECT_EQ(answer_compare("{}"), "");
}

}  // namespace
}  // namespace vagus::serve
