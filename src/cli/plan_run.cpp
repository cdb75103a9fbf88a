#include "cli/plan_run.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "embed/loaded_plan.hpp"
#include "session/toolboxes.hpp"

namespace vagus::cli {

Result<std::string> PlanDisk::read(const std::string& path) const {
    return read_file(path);
}

void show_findings(const plan::Findings& findings) {
    std::fputs(embed::format_findings(findings).c_str(), stderr);
}

PlanRun::PlanRun() = default;
PlanRun::~PlanRun() = default;

std::unique_ptr<PlanRun> PlanRun::prepare(const PlanRunOptions& options) {
    std::unique_ptr<PlanRun> made(new PlanRun());  // make_unique cannot reach the constructor
    const Status added = session::add_toolboxes(made->library_, made->parts_, options.toolboxes);
    if (!added.ok()) {
        complain(added.error());
        return nullptr;
    }
    made->checked_ = plan::check(options.file, PlanDisk(), made->library_.templates());
    show_findings(made->checked_.findings);
    if (!made->checked_.ok()) return nullptr;
    made->graph_ = plan::make_graph(made->checked_);
    auto prepared = embed::PreparedRun::prepare(
        {made->graph_, made->checked_.plans, made->library_}, options.words, made->parts_);
    if (prepared.ok()) {
        made->prepared_ = std::move(prepared.value());
        return made;
    }
    complain(prepared.error());
    return nullptr;
}

run::Ended PlanRun::run(run::Debugger* debugger) {
    Result<run::Ended> ended = prepared_->run(debugger);
    if (ended.ok()) return ended.value();
    complain(ended.error());
    return {.result = plan::PlanResult::Error, .message = {}};
}

void add_plan_file(CLI::App& verb, std::string& file) {
    CLI::Option* option = verb.add_option("FILE", file, "the plan, NAME.plan.json")->required();
    takes_file(*option, {".plan.json"});
}

void add_run_options(CLI::App& verb, PlanRunOptions& options) {
    add_plan_file(verb, options.file);
    add_toolbox_option(verb, options.toolboxes);
    embed::RunWords& words = options.words;
    verb.add_option("--set", words.set, "NAME=VALUE: a variable's value at the start")
        ->allow_extra_args(false);
    takes_one_of(*verb.add_option("--clock", words.clock, "real or virtual time (real)"),
                 {"real", "virtual"});
    verb.add_option("--seed", words.seed,
                    "of all that is random (1; for the world that of its file)")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    verb.add_option("--max-time", words.max_time,
                    "seconds after which the run is aborted (with --world: 3600)");
    takes_file(*verb.add_option("--trace", words.trace, "where its trace goes; - is stdout"),
               {".jsonl"});
    takes_file(*verb.add_option("--world", words.world, "a world whose robots the plan drives"),
               {".world.json"});
    takes_file(*verb.add_option("--trace-all", words.trace_all,
                                "the trace with what happens in the world; - is stdout"),
               {".jsonl"});
    verb.add_option("--bus", words.bus, "a bus with nodes that the plan drives, in real time")
        ->type_name("TARGET");
    takes_file(*verb.add_option("--project", words.project,
                                "what the nodes of --bus were loaded with: names of events"),
               {".aesl"});
}

}  // namespace vagus::cli
