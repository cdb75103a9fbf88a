#include "session/execute.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vagus::session {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Variables: id 0, event.source 1, event.args 2..5, speed 6..7, and the script's n 8 and list
// 9..10.
aesl::NodeFile node_file() {
    aesl::NodeFile file;
    file.target.name = "small";
    file.target.bytecode_size = 32;
    file.target.variables_size = 20;
    file.target.stack_size = 8;
    file.target.variables = {{"id", 1}, {"event.source", 1}, {"event.args", 4}, {"speed", 2}};
    file.target.local_events = {{"tick", ""}};
    file.common.events = {{"ping", uint16_t{0}}, {"report", uint16_t{2}}};
    return file;
}

// The code is on line 10, 11, 12 … one word a line, the table on line 0.
aesl::Program program_of(std::vector<uint16_t> bytecode) {
    aesl::Program program;
    program.lines.assign(bytecode.size(), 0);
    for (size_t i = bytecode[0]; i < bytecode.size(); ++i) {
        program.lines[i] = static_cast<uint16_t>(10 + i - bytecode[0]);
    }
    program.bytecode = std::move(bytecode);
    program.variables = {{"id", 0, 1},         {"event.source", 1, 1},
                         {"event.args", 2, 4}, {"speed", 6, 2},
                         {"n", 8, 1},          {"list", 9, 2}};
    return program;
}

aesl::Stimulus happens(const std::string& event, std::vector<int16_t> arguments = {},
                       std::optional<int16_t> source = {}) {
    return {.set = {}, .event = event, .arguments = std::move(arguments), .source = source};
}

aesl::Stimulus sets(std::vector<aesl::Assignment> assignments) {
    return {.set = std::move(assignments), .event = {}, .arguments = {}, .source = {}};
}

Execution run(const aesl::Program& program, const std::vector<aesl::Stimulus>& stimuli = {},
              uint32_t steps = kStepsPerEvent) {
    auto execution = execute(program, node_file(), stimuli, steps);
    EXPECT_TRUE(execution.ok()) << execution.error().what;
    return execution.value();
}

std::string refusal(const std::vector<aesl::Stimulus>& stimuli) {
    const auto execution = execute(program_of({0}), node_file(), stimuli, kStepsPerEvent);
    return execution.ok() ? "" : execution.error().what;
}

// ping @7: emit report [event.args[0..1]]. tick @11: n = n + 1. init @16: n = 5.
std::vector<uint16_t> three_handlers() {
    return {7, 0,      7,      0xfffe, 11,     0xffff, 16,     0xb001, 2, 2,
            0, 0x3008, 0x1001, 0x8002, 0x4008, 0,      0x1005, 0x4008, 0};
}

TEST(Execute, RunsInitThenEachStimulus) {
    const Execution done = run(program_of(three_handlers()), {happens("tick"), happens("tick")});
    EXPECT_FALSE(done.error);
    EXPECT_THAT(done.memory, ElementsAre(VariableWords{"n", {7}}, VariableWords{"list", {0, 0}}));
}

TEST(Execute, EventLeavesItsSourceAndArgumentsAndItsEmissionsAreRecorded) {
    const Execution done = run(program_of(three_handlers()), {happens("ping", {4, -5, 6}, 9)});
    EXPECT_THAT(done.emitted, ElementsAre(Emission{1, "report", {4, -5}}));
    EXPECT_THAT(done.memory, ElementsAre(VariableWords{"event.source", {9}},
                                         VariableWords{"event.args", {4, -5, 6, 0}},
                                         VariableWords{"n", {5}}, VariableWords{"list", {0, 0}}));
}

TEST(Execute, EventWithoutHandlerStillLeavesItsArguments) {
    const Execution done = run(program_of({3, 0xffff, 3, 0}), {happens("ping", {3})});
    EXPECT_EQ(done.memory.at(0), (VariableWords{"event.args", {3, 0, 0, 0}}));
}

TEST(Execute, SetWritesVariablesOfNodeAndScript) {
    const Execution done =
        run(program_of(three_handlers()), {sets({{"speed", {1}}, {"list", {8, 9}}})});
    EXPECT_THAT(done.memory, ElementsAre(VariableWords{"speed", {1, 0}}, VariableWords{"n", {5}},
                                         VariableWords{"list", {8, 9}}));
}

TEST(Execute, RuntimeErrorNamesItsLineAndStopsTheRun) {
    // tick: n = 1 / 0
    const auto program = program_of({3, 0xfffe, 3, 0x1001, 0x1000, 0x8005, 0x4008, 0});
    const Execution done = run(program, {happens("ping"), happens("tick"), sets({{"n", {5}}})});
    ASSERT_TRUE(done.error);
    EXPECT_EQ(done.error->kind, StopKind::DivisionByZero);
    EXPECT_EQ(done.error->during, 2);
    EXPECT_EQ(done.error->line, 12);
    EXPECT_EQ(done.memory.at(0), (VariableWords{"n", {0}}));
}

TEST(Execute, OutOfBoundsTellsSizeAndSignedIndex) {
    const Execution done = run(program_of({3, 0xffff, 3, 0x1fff, 0x5009, 2, 0}));
    ASSERT_TRUE(done.error);
    EXPECT_EQ(done.error->kind, StopKind::ArrayOutOfBounds);
    EXPECT_EQ(done.error->size, 2);
    EXPECT_EQ(done.error->index, -1);
    EXPECT_EQ(done.error->line, 11);
}

TEST(Execute, OtherFaultsBringTheirText) {
    const Execution done = run(program_of({3, 0xffff, 3, 0xc000, 0}));  // the node has no native
    ASSERT_TRUE(done.error);
    EXPECT_EQ(done.error->kind, StopKind::NodeSpecific);
    EXPECT_THAT(done.error->text, HasSubstr("Native function"));
}

// init: four instructions, the stop is the last.
TEST(Execute, EventOfExactlyTheStepLimitEnds) {
    const auto program = program_of({3, 0xffff, 3, 0x1001, 0x1001, 0x8002, 0});
    EXPECT_FALSE(run(program, {}, 4).error);
}

TEST(Execute, EventBeyondTheStepLimitIsStopped) {
    const auto program = program_of({3, 0xffff, 3, 0x1001, 0x1001, 0x8002, 0});
    const Execution done = run(program, {}, 3);
    ASSERT_TRUE(done.error);
    EXPECT_EQ(done.error->kind, StopKind::StepLimit);
    EXPECT_EQ(done.error->line, 13);
}

TEST(Execute, EndlessLoopIsStopped) {
    const Execution done = run(program_of({3, 0xffff, 3, 0x9000}));
    ASSERT_TRUE(done.error);
    EXPECT_EQ(done.error->kind, StopKind::StepLimit);
    EXPECT_EQ(done.error->line, 10);
}

TEST(Execute, StimuliThatNameWhatDoesNotExistAreRefused) {
    EXPECT_THAT(refusal({happens("tock")}), HasSubstr("no event tock: did you mean tick?"));
    EXPECT_THAT(refusal({sets({{"sped", {1}}})}),
                HasSubstr("no variable sped: did you mean speed?"));
}

TEST(Execute, MoreWordsThanAVariableHasAreRefused) {
    EXPECT_EQ(refusal({sets({{"speed", {1, 2}}})}), "");
    EXPECT_THAT(refusal({sets({{"speed", {1, 2, 3}}})}),
                HasSubstr("speed has 2 words, but 3 are given"));
    EXPECT_THAT(refusal({happens("tick", {1, 2, 3, 4, 5})}), HasSubstr("event.args has 4 words"));
}

// ---- Stimuli ----

std::string first_error(const std::string& text) {
    const auto stimuli = aesl::parse_stimuli(text, "case.json");
    return stimuli.ok() ? "" : stimuli.error().what;
}

TEST(Stimuli, AreReadInTheirOrder) {
    const auto stimuli = aesl::parse_stimuli(
        R"({"stimuli": [{"set": {"a": [1, -2]}}, {"event": "go", "args": [3], "source": 5}]})",
        "f");
    ASSERT_TRUE(stimuli.ok());
    ASSERT_EQ(stimuli.value().size(), 2u);
    EXPECT_EQ(stimuli.value()[0].set.at(0).variable, "a");
    EXPECT_THAT(stimuli.value()[0].set.at(0).words, ElementsAre(1, -2));
    EXPECT_EQ(stimuli.value()[1].event, "go");
    EXPECT_THAT(stimuli.value()[1].arguments, ElementsAre(3));
    EXPECT_EQ(stimuli.value()[1].source, 5);
}

TEST(Stimuli, MayComeFromAnExpectedFile) {
    EXPECT_EQ(first_error(R"({"about": "x", "bytecode": [], "lines": [], "memory": {},
                              "events_emitted": [], "runtime_error": {}, "quirk": "y"})"),
              "");
}

TEST(Stimuli, MistakesHaveAPlace) {
    EXPECT_THAT(first_error(R"({"stimuli": [{"event": "go", "arg": [3]}]})"),
                testing::StartsWith("case.json:1:30: "));
    EXPECT_THAT(first_error(R"({"stimuli": [{"event": "go", "args": [32768]}]})"),
                HasSubstr("-32768 to 32767"));
    EXPECT_THAT(first_error(R"({"stimuli": [{"set": {"a": 1}}]})"), HasSubstr("a list"));
    EXPECT_THAT(first_error(R"({"stimuli": [{"source": 1}]})"), HasSubstr("neither"));
    EXPECT_THAT(first_error("[]"), testing::StartsWith("case.json:1:1: "));
}

// ---- Output ----

TEST(FormatExecution, IsTheFormOfTheExpectedFiles) {
    Execution execution;
    execution.memory = {{"n", {1, -2}}};
    execution.emitted = {{0, "report", {4}}};
    execution.error = RuntimeError{StopKind::ArrayOutOfBounds, 1, 5, 2, -1, ""};
    EXPECT_EQ(format_execution(execution),
              "{\n"
              " \"memory\": {\n"
              "  \"n\": [1, -2]\n"
              " },\n"
              " \"events_emitted\": [\n"
              "  {\"during\": 0, \"event\": \"report\", \"args\": [4]}\n"
              " ],\n"
              " \"runtime_error\": {\"kind\": \"array_out_of_bounds\", \"during\": 1, \"line\": 5, "
              "\"size\": 2, \"index\": -1}\n"
              "}\n");
}

TEST(FormatExecution, NothingIsEmpty) {
    EXPECT_EQ(format_execution({}), "{\n \"memory\": {},\n \"events_emitted\": []\n}\n");
}

TEST(FormatExecution, CompileErrorHasItsPlace) {
    aesl::Diagnostic error;
    error.code = "ARRAY_SIZE_MISMATCH";
    error.number = 63;
    error.at = {2, 7};
    EXPECT_EQ(format_compile_error(error),
              "{\n \"error\": {\"code\": \"ARRAY_SIZE_MISMATCH\", \"number\": 63, \"line\": 2, "
              "\"column\": 7}\n}\n");
}

}  // namespace
}  // namespace vagus::session
