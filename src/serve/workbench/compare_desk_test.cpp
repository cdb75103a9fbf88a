#include "serve/workbench/compare_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>

#include "plan/differences.hpp"
#include "serve/edit/test_page.hpp"
#include "serve/workbench/git.hpp"

namespace vagus::serve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string plan_of(const std::string& first, double seconds) {
    return R"({"format": "vagus-plan/1", "name": "P", "start": {"actor": ")" + first +
           R"("}, "actors": {")" + first + R"(": {"template": "Wait", "in": {"seconds": )" +
           std::to_string(seconds) + R"(}, "states": {"Done": "@terminate"}}}})";
}

class CompareTest : public EditTest {
protected:
    CompareTest() {
        write("P.plan.json", plan_of("wait", 1));
        enter({.plan = "P.plan.json"});
    }
    Json ask_for(const std::string& against, const Json& more = Json::object()) {
        Json in = {{"doc", "P.plan.json"}, {"against", against}};
        in.update(more);
        return in;
    }
    // Kinds and paths of an answer.
    static std::vector<std::string> told(const Json& answer) {
        std::vector<std::string> lines;
        for (const Json& one : answer["differences"]) {
            std::string line = one["kind"];
            for (const Json& key : one["path"]) line += " " + key.get<std::string>();
            lines.push_back(line);
        }
        return lines;
    }
    // Of a command that a child answers.
    Json answer_of(const std::string& command, const Json& in) {
        got.clear();
        desk.hear(ClientText{{1}, Json{{"id", ++id}, {"do", command}, {"in", in}}.dump()}, now);
        while (true) {
            compares.tick(now);
            if (const Json* answer = answered()) return *answer;
            // What git says wakes nobody here: it is looked at again, and again.
            (void)::poll(nullptr, 0, 1);
        }
    }
    bool git(std::vector<std::string> words) {
        std::vector<std::string> all = {"git",
                                        "-C",
                                        root.string(),
                                        "-c",
                                        "user.name=Ada",
                                        "-c",
                                        "user.email=ada@example.org",
                                        "-c",
                                        "commit.gpgsign=false"};
        all.insert(all.end(), words.begin(), words.end());
        auto printing = Printing::start(all);
        if (!printing.ok()) return false;
        while (!printing.value().read()) (void)::poll(nullptr, 0, 1);
        return printing.value().good();
    }

    std::optional<std::string> running;
    CompareDesk compares{
        desk, files, [this](const std::string&) { return running; },
        [this](double t, const std::string&) { return t < 2 ? running : std::nullopt; }};
};

TEST_F(CompareTest, AnUnsavedPlanIsComparedWithItsFile) {
    edit("P.plan.json", 0, 0, "\n");
    EXPECT_THAT(told(ask("plan.differences", ask_for("disk"))), IsEmpty());
    const std::string text = plan_of("stay", 2);
    ask("doc.revert", {{"doc", "P.plan.json"}});
    edit("P.plan.json", 0, plan_of("wait", 1).size(), text);
    const Json answer = ask("plan.differences", ask_for("disk"));
    EXPECT_THAT(told(answer),
                ElementsAre("changed start actor", "removed actors wait", "added actors stay"));
    // What is removed can be drawn.
    EXPECT_EQ(Json::parse(answer["before"].get<std::string>())["actors"]["wait"]["template"],
              "Wait");
    EXPECT_EQ(answer["version"], ask("doc.open", {{"doc", "P.plan.json"}})["version"]);
}

TEST_F(CompareTest, WhatIsOnDiskInAConflictIsCompared) {
    edit("P.plan.json", 0, plan_of("wait", 1).size(), plan_of("wait", 2));
    write("P.plan.json", plan_of("wait", 33));
    (void)say("doc.save", {{"doc", "P.plan.json"}});
    const Json answer = ask("plan.differences", ask_for("disk"));
    EXPECT_THAT(told(answer), ElementsAre("changed actors wait in seconds"));
    EXPECT_EQ(answer["differences"][0]["before"], 33);
    EXPECT_EQ(answer["differences"][0]["after"], 2);
}

TEST_F(CompareTest, TheAnswerIsThatOfTheCommandLine) {
    write("Other.plan.json", plan_of("go", 3));
    const Json answer = ask("plan.differences", ask_for("file", {{"file", "Other.plan.json"}}));
    const auto before = plan::read_plan_tree(plan_of("go", 3), "a").value();
    const auto after = plan::read_plan_tree(plan_of("wait", 1), "b").value();
    EXPECT_EQ(answer["differences"],
              Json::parse(plan::format_json(plan::differences(before, after))));
}

TEST_F(CompareTest, TheVersionThatRunsIsCompared) {
    EXPECT_THAT(refusal("plan.differences", ask_for("running")),
                StartsWith("unavailable: no plan runs that is made of P.plan.json"));
    running = plan_of("wait", 7);
    EXPECT_THAT(told(ask("plan.differences", ask_for("running"))),
                ElementsAre("changed actors wait in seconds"));
}

TEST_F(CompareTest, TheVersionThatRanAtAnInstantIsCompared) {
    running = plan_of("wait", 7);
    EXPECT_THAT(told(ask("plan.differences", ask_for("then", {{"t", 1.5}}))),
                ElementsAre("changed actors wait in seconds"));
    EXPECT_THAT(refusal("plan.differences", ask_for("then", {{"t", 2.5}})),
                StartsWith("unavailable: the plan that ran at 2.5 s was not made of P.plan.json"));
}

TEST_F(CompareTest, WhatCannotBeComparedSaysWhy) {
    EXPECT_THAT(refusal("plan.differences", ask_for("file", {{"file", "vagus.json"}})),
                HasSubstr("expected the path of a .plan.json file, found \"vagus.json\""));
    EXPECT_THAT(refusal("plan.differences", ask_for("file", {{"file", "No.plan.json"}})),
                StartsWith("not_found: "));
    write("Bad.plan.json", "{\n  \"format\": 7 }");
    EXPECT_THAT(refusal("plan.differences", ask_for("file", {{"file", "Bad.plan.json"}})),
                HasSubstr("Bad.plan.json:2:"));
    EXPECT_THAT(refusal("plan.differences", ask_for("revision", {{"revision", "--output=x"}})),
                HasSubstr("expected a revision of git, as 1a2b3c4 or HEAD~2"));
    EXPECT_THAT(refusal("plan.differences", {{"doc", "notes.txt"}, {"against", "disk"}}),
                StartsWith("bad_input: notes.txt is no plan"));
    EXPECT_THAT(refusal("plan.versions", {{"doc", "../P.plan.json"}}), HasSubstr("../P.plan.json"));
}

TEST_F(CompareTest, AFolderThatGitDoesNotKnowHasNoVersions) {
    // Nor any folder around it.
    write(".git", "gitdir: /nowhere\n");
    EXPECT_EQ(answer_of("plan.versions", {{"doc", "P.plan.json"}})["ok"]["versions"],
              Json::array());
    const Json answer = answer_of("plan.differences", ask_for("revision", {{"revision", "HEAD"}}));
    EXPECT_EQ(answer["error"]["what"],
              "git does not have P.plan.json at HEAD; choose a commit from its list");
}

TEST_F(CompareTest, CommitsOfThePlanAreListedAndCompared) {
    ASSERT_TRUE(git({"init", "--quiet"}));
    ASSERT_TRUE(git({"add", "P.plan.json"}));
    ASSERT_TRUE(git({"commit", "--quiet", "--no-verify", "-m", "Wait for a second"}));
    write("P.plan.json", plan_of("wait", 5));
    ASSERT_TRUE(git({"commit", "--quiet", "--no-verify", "-a", "-m", "Wait longer"}));
    // Would be started by a git that obeys it.
    ASSERT_TRUE(git({"config", "core.fsmonitor", "touch " + (root / "started").string()}));
    ASSERT_TRUE(git({"config", "log.showSignature", "true"}));
    const Json versions = answer_of("plan.versions", {{"doc", "P.plan.json"}})["ok"]["versions"];
    ASSERT_EQ(versions.size(), 2u);
    EXPECT_EQ(versions[0]["subject"], "Wait longer");
    EXPECT_EQ(versions[1]["by"], "Ada");
    EXPECT_GT(versions[1]["when_wall"], 1e12);
    for (const Json& revision : {versions[1]["revision"], Json("HEAD~1")}) {
        const Json answer =
            answer_of("plan.differences", ask_for("revision", {{"revision", revision}}));
        EXPECT_THAT(told(answer["ok"]), ElementsAre("changed actors wait in seconds"));
    }
    EXPECT_FALSE(std::filesystem::exists(root / "started"));
}

TEST(GitVersions, WhatGitPrintsIsReadToItsLimit) {
    std::string printed;
    for (size_t i = 0; i <= kGitVersionsMax; ++i) {
        printed +=
            "abc\x1f"
            "12\x1f"
            "Ada\x1f"
            "Sub\x1fject" +
            std::string(1, '\0');
    }
    const auto versions = git_versions(printed);
    ASSERT_EQ(versions.size(), kGitVersionsMax);
    EXPECT_EQ(versions[0].when_wall, 12'000);
    EXPECT_EQ(versions[0].subject, "Sub\x1fject");
    EXPECT_THAT(git_versions("-x\x1f"
                             "1\x1f"
                             "a\x1f"
                             "b"),
                IsEmpty());
}

}  // namespace
}  // namespace vagus::serve
