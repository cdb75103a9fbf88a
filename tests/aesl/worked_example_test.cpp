// The worked example of docs/spec/aesl-language.md, section 5.2: from the project file to the
// events.
#include <gtest/gtest.h>

#include "aesl/compile.hpp"
#include "aesl/project.hpp"
#include "base/file.hpp"
#include "base/test_places.hpp"
#include "our_run.hpp"
#include "reference/evaluate.hpp"

namespace vagus::aesl {
namespace {

// The node `rover`: 36 words of variables, so that the user's begin at 36.
NodeFile rover(const Project& project) {
    NodeFile node;
    node.target.name = "rover";
    node.target.bytecode_size = 1000;
    node.target.variables_size = 1060;
    node.target.stack_size = 32;
    node.target.variables = {
        {"id", 1}, {"source", 1}, {"args", 32}, {"_productId", 1}, {"timer.period", 1}};
    node.target.local_events = {{"timer", ""}};
    node.common = project.common;
    return node;
}

Project project() {
    const std::string path = test::testdata("projects/rover.aesl");
    return parse_project(read_file(path).value(), path).value();
}

TEST(WorkedExample, CompilesToTheWordsOfTheSpecification) {
    const Project rovers = project();
    const NodeFile node = rover(rovers);
    const Compilation compiled = compile(rovers.scripts[0].source, node.target, node.common, {});
    ASSERT_TRUE(compiled.ok());
    const std::vector<uint16_t> expected = {
        0x0007, 0x0000, 0x0007, 0xfffe, 0x000a, 0xffff, 0x0026, 0x3002, 0x4024,
        0x0000, 0x3025, 0x1001, 0x8002, 0x4025, 0x3024, 0x1064, 0x800e, 0x3025,
        0x1002, 0x800c, 0xa011, 0x0006, 0x3024, 0x100d, 0x8002, 0x4024, 0x3024,
        0x1032, 0xa10d, 0x0009, 0x3024, 0x4422, 0x3025, 0x4423, 0xb001, 0x0422,
        0x0002, 0x0000, 0x1000, 0x4024, 0x1000, 0x4025, 0x1028, 0x4023, 0x0000};
    EXPECT_EQ(compiled.program.bytecode, expected);
}

TEST(WorkedExample, TheWhenFiresOnceAtTheSixthTimer) {
    const Project rovers = project();
    Case program{rovers.scripts[0].source, std::vector<Stimulus>(8)};
    for (Stimulus& stimulus : program.stimuli) stimulus.event = "timer";
    const std::vector<Emission> expected = {{6, "status", {52, 6}}};
    EXPECT_EQ(run_ours(program, rover(rovers)).outcome.emitted, expected);
    EXPECT_EQ(evaluate(program, rover(rovers)).emitted, expected);
}

}  // namespace
}  // namespace vagus::aesl
