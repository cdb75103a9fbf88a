#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>

#include "base/json.hpp"
#include "cli/verbs.hpp"

namespace vagus::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view kNode = R"({
  "name": "small", "bytecodeSize": 100, "variablesSize": 60, "stackSize": 8,
  "variables": [{ "name": "id", "size": 1 }, { "name": "event.source", "size": 1 },
                { "name": "event.args", "size": 4 }],
  "localEvents": [{ "name": "tick" }],
  "events": [{ "name": "report", "size": 1 }],
  "natives": []
})";

struct Outcome {
    int exit_code = -1;
    std::string out;
    std::string err;
};

class Exec : public testing::Test {
protected:
    Exec() {
        folder_ = std::filesystem::temp_directory_path() /
                  ("vagus-exec-" + std::to_string(getpid()) + "-" +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
        write("node.json", kNode);
    }
    ~Exec() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, std::string_view text) {
        const std::string path = (folder_ / name).string();
        std::ofstream(path) << text;
        return path;
    }
    Outcome run(std::string_view script, std::vector<std::string> more = {}) {
        std::vector<std::string> words = {"exec", write("script.aesl", script), "--node",
                                          (folder_ / "node.json").string()};
        words.insert(words.end(), more.begin(), more.end());
        std::ranges::reverse(words);  // as CLI11 takes them
        CLI::App app;
        Outcome outcome;
        add_exec(app, outcome.exit_code);
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        app.parse(words);
        outcome.out = testing::internal::GetCapturedStdout();
        outcome.err = testing::internal::GetCapturedStderr();
        return outcome;
    }

    std::filesystem::path folder_;
};

TEST_F(Exec, PrintsTheMemoryOfAProgramThatRan) {
    const Outcome done = run("var n = 6 * 7");
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_EQ(done.out, "{\n \"memory\": {\n  \"n\": [42]\n },\n \"events_emitted\": []\n}\n");
}

TEST_F(Exec, RuntimeErrorIsNoFailureOfTheVerb) {
    const Outcome done = run("var n = 1\nvar z = 0\nn = n / z");
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_THAT(done.out, HasSubstr(R"({"kind": "division_by_zero", "during": 0, "line": 3})"));
}

TEST_F(Exec, CompileErrorsAreAllOnStderrAndTheFirstOneInTheOutput) {
    const Outcome done = run("var n = 1\nm = 2\nn = 3\nk = 4\n");
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_THAT(done.out, StartsWith("{\n \"error\": {\"code\": \""));
    EXPECT_THAT(done.out, HasSubstr("\"line\": 2, \"column\": 1}"));
    EXPECT_THAT(done.err, StartsWith((folder_ / "script.aesl").string() + ":2:1: error: "));
    EXPECT_THAT(done.err, HasSubstr("script.aesl:4:1: error: "));
}

TEST_F(Exec, AppliesStimuliInOrder) {
    const std::string stimuli = write(
        "case.json", R"({"stimuli": [{"event": "tick"}, {"set": {"n": [7]}}, {"event": "tick"}]})");
    const Outcome done = run("var n = 1\nonevent tick\nemit report n", {"--stimuli", stimuli});
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_THAT(done.out, HasSubstr("{\"during\": 1, \"event\": \"report\", \"args\": [1]},\n"
                                    "  {\"during\": 3, \"event\": \"report\", \"args\": [7]}"));
}

TEST_F(Exec, EndlessProgramIsStoppedByTheStepLimit) {
    const Outcome done = run("var n = 1\nwhile n == 1 do\nn = 1\nend", {"--max-steps", "1000"});
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_THAT(done.out, HasSubstr(R"("kind": "step_limit", "during": 0, "line": )"));
}

TEST_F(Exec, RunsTheScriptThatAProjectHasForTheNode) {
    const std::string project =
        "<!DOCTYPE aseba-source>\n<network>\n<event size=\"1\" name=\"told\"/>\n"
        "<node nodeId=\"1\" name=\"other\">var a = 1</node>\n"
        "<node nodeId=\"2\" name=\"small\">emit told 5</node>\n</network>\n";
    const Outcome done = run(project);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr(R"({"during": 0, "event": "told", "args": [5]})"));
}

TEST_F(Exec, ErrorsInAProjectHaveTheLineOfTheFile) {
    const Outcome done =
        run("<!DOCTYPE aseba-source>\n<network>\n<node nodeId=\"2\" name=\"small\">m = 1</node>\n"
            "</network>\n");
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_THAT(done.err, HasSubstr("script.aesl:3:1: error: "));
    EXPECT_THAT(done.out, HasSubstr("\"line\": 3, \"column\": 1}"));
}

TEST_F(Exec, WrongFilesAreWrongCommandLines) {
    const std::string script = write("ok.aesl", "var n = 1");
    EXPECT_EQ(run("var n", {"--stimuli", write("bad.json", "[]")}).exit_code, 2);
    EXPECT_EQ(run("var n", {"--stimuli", (folder_ / "none.json").string()}).exit_code, 2);
    const std::string unknown = write("unknown.json", R"({"stimuli": [{"event": "tock"}]})");
    EXPECT_THAT(run("var n", {"--stimuli", unknown}).err, HasSubstr("did you mean tick?"));
    EXPECT_EQ(run("var n", {"--stimuli", unknown}).exit_code, 2);
}

TEST_F(Exec, NodeWithANativeThatHasNoCodeIsRefused) {
    std::string node(kNode);
    node.replace(node.find("\"natives\": []"), 13,
                 R"("natives": [{ "name": "sound.play", "params": [] }])");
    write("node.json", node);
    const Outcome done = run("var n = 1");
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_THAT(done.err, HasSubstr("native sound.play has no code"));
}

}  // namespace
}  // namespace vagus::cli
