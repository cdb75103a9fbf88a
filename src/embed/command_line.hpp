// `vagus plan run`'s options for a program that holds its plan (docs/plans.md, section 6).
//
//     int main(int argc, char** argv) { return vagus::embed::run_main(&make_Square, argc, argv); }
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "base/result.hpp"
#include "base/time.hpp"
#include "embed/plan_code.hpp"
#include "embed/plan_run.hpp"
#include "plan/graph.hpp"
#include "run/code.hpp"

namespace vagus::embed {

// Runs the plan with the options of the command line and the built-in toolboxes; gives the exit
// status of section 6.
int run_main(MakePlan make, int argc, char** argv);
// The same with toolboxes of the program's own.
int run_main(MakePlan make, const run::CodeLibrary& library, int argc, char** argv);

// ---- what `vagus plan run` takes from here ----

// NAME=VALUE of `--set`: a slot of the plan, and the value converted as a string.
Result<std::pair<int, plan::Value>> parse_set(const plan::GraphPlan& plan, const std::string& text);

// The seconds of `--max-time`.
Result<Duration> parse_max_time(const std::string& text);

// Where the lines of `--trace` go: a file, `-` for stdout, nowhere for an empty path.
class TraceSink {
public:
    static Result<std::unique_ptr<TraceSink>> open(const std::string& path);
    TraceSink() = default;
    ~TraceSink();
    TraceSink(const TraceSink&) = delete;
    TraceSink& operator=(const TraceSink&) = delete;
    void write(const plan::TraceEvent& event);

private:
    std::FILE* file_ = nullptr;
    bool owned_ = false;
};

}  // namespace vagus::embed
