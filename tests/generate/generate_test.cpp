// The generated code of each plan gives the same trace as the plan, byte for byte (docs/plans.md,
// section 9). That the traces of the golden plans are right is for tests/plans to say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/test_places.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/prepared_run.hpp"
#include "plan/check.hpp"
#include "plan/generate.hpp"
#include "run/virtual_time.hpp"
#include "tests/generate/case.hpp"
#include "tests/plans/random_plan.hpp"
#include "toolbox/core.hpp"

namespace vagus {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const fs::path kFolder = test::testdata("golden/plans");

std::vector<GeneratedCase> all_cases() {
    std::vector<GeneratedCase> cases;
    for (const auto batch :
         {generated_batch0(), generated_batch1(), generated_batch2(), generated_batch3()}) {
        cases.insert(cases.end(), batch.begin(), batch.end());
    }
    return cases;
}

// As the golden case's further arguments say.
run::RunOptions options_of(const std::string& name, const plan::Graph& graph) {
    run::RunOptions options;
    std::ifstream file(kFolder / (name + ".args"));
    for (std::string word, value; std::getline(file, word) && std::getline(file, value);) {
        if (word == "--seed") options.seed = std::stoull(value);
        if (word == "--max-time") options.max_time = embed::parse_max_time(value).value();
        if (word == "--set") {
            options.set.push_back(embed::parse_set(graph.plans.front(), value).value());
        }
    }
    return options;
}

std::string trace_of(const plan::Graph& graph, const run::CodeLibrary& library,
                     run::RunOptions options, uint64_t events_max) {
    std::string lines;
    uint64_t events = 0;
    run::VirtualTime* running = nullptr;
    options.on_trace = [&](const plan::TraceEvent& event) {
        lines += plan::format_trace(event) + "\n";
        if (++events == events_max) running->abort();
    };
    run::VirtualTime run(graph, library, options);
    running = &run;
    const run::Ended ended = run.run();
    return lines + "exit status " + std::to_string(run::exit_status(ended));
}

class Generated : public testing::TestWithParam<GeneratedCase> {
protected:
    Generated() { toolbox::add_core(library_); }
    run::CodeLibrary library_;
};

TEST_P(Generated, GivesTheTraceOfItsPlan) {
    const std::string name(GetParam().name);
    const embed::LoadedPlan code = embed::LoadedPlan::from_code(GetParam().make, library_);
    ASSERT_TRUE(code.ok()) << code.report();
    const bool random = name.starts_with("random-");
    if (random) {
        const RandomPlans files(std::stoull(name.substr(7)));
        const plan::Checked checked = plan::check("main.plan.json", files, library_.templates());
        const plan::Graph graph = plan::make_graph(checked);
        run::RunOptions options;
        options.max_time = 2s;
        EXPECT_EQ(trace_of(code.graph(), library_, options, 3000),
                  trace_of(graph, library_, options, 3000));
        return;
    }
    const std::string path = (kFolder / (name + ".plan.json")).string();
    const embed::LoadedPlan plan = embed::LoadedPlan::from_file(path, library_);
    ASSERT_TRUE(plan.ok()) << plan.report();
    const run::RunOptions options = options_of(name, plan.graph());
    // Two golden plans have a trace of a million lines.
    const uint64_t most = std::getenv("VAGUS_LONG") ? UINT64_MAX : 50'000;
    EXPECT_EQ(trace_of(code.graph(), library_, options, most),
              trace_of(plan.graph(), library_, options, most));
}

std::string test_name(const testing::TestParamInfo<GeneratedCase>& info) {
    std::string name(info.param.name);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, Generated, testing::ValuesIn(all_cases()), test_name);

// Of the golden plans those without errors run.
TEST(GeneratedPlans, AreAllThere) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    size_t runnable = 0;
    for (const auto& entry : fs::directory_iterator(kFolder)) {
        const std::string path = entry.path().string();
        if (!path.ends_with(".plan.json")) continue;
        runnable += embed::LoadedPlan::from_file(path, library).ok() ? 1 : 0;
    }
    EXPECT_GT(runnable, 40u);
    EXPECT_EQ(all_cases().size(), runnable + VAGUS_GENERATED_RANDOM);
}

}  // namespace
}  // namespace vagus
