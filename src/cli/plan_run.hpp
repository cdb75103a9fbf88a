// A plan made ready to run as the command line says: what `vagus plan run` and `debug` share.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "embed/prepared_run.hpp"
#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "run/code.hpp"
#include "run/options.hpp"
#include "toolbox/parts.hpp"

namespace CLI {
class App;
}

namespace vagus::cli {

class PlanDisk final : public plan::Files {
public:
    Result<std::string> read(const std::string& path) const override;
};

// On stderr, one a line.
void show_findings(const plan::Findings& findings);

struct PlanRunOptions {
    std::string file;
    std::vector<std::string> toolboxes;
    embed::RunWords words;
    bool headless = false;  // plain lines also on a terminal
};

void add_plan_file(CLI::App& verb, std::string& file);
void add_run_options(CLI::App& verb, PlanRunOptions& options);

class PlanRun {
public:
    // Nothing if it cannot run; it has complained then.
    static std::unique_ptr<PlanRun> prepare(const PlanRunOptions& options);
    ~PlanRun();

    const plan::Graph& graph() const { return graph_; }
    const plan::Plan& plan() const { return checked_.plans.front(); }  // the outermost
    embed::PreparedRun& prepared() { return *prepared_; }
    // Can be called again: each is a run of its own. One that cannot begin has complained, and is
    // over with an error.
    run::Ended run(run::Debugger* debugger = nullptr);

private:
    PlanRun();

    toolbox::Parts parts_;  // before the library, whose code looks at them
    run::CodeLibrary library_;
    plan::Checked checked_;
    plan::Graph graph_;
    std::unique_ptr<embed::PreparedRun> prepared_;
};

}  // namespace vagus::cli
