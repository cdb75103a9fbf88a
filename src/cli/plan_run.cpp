#include "cli/plan_run.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "embed/loaded_plan.hpp"
#include "run/real_time.hpp"
#include "run/virtual_time.hpp"
#include "session/toolboxes.hpp"
#include "toolbox/needs_bus.hpp"

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
    const Status taken = made->take_options(options);
    if (taken.ok()) return made;
    complain(taken.error());
    return nullptr;
}

Status PlanRun::take_options(const PlanRunOptions& options) {
    const Status alone = toolbox::check_without_bus(graph_);
    if (!alone.ok()) {
        return Error{
            alone.error().code,
            alone.error().what + "; give it a world (--world FILE) or a bus (--bus TARGET)"};
    }
    virtual_time_ = options.clock == "virtual";
    how_.seed = options.seed;
    for (const std::string& text : options.set) {
        how_.set.push_back(TRY(embed::parse_set(graph_.plans.front(), text)));
    }
    if (!options.max_time.empty()) how_.max_time = TRY(embed::parse_max_time(options.max_time));
    sink_ = TRY(embed::TraceSink::open(options.trace));
    how_.on_trace = [this](const plan::TraceEvent& event) {
        sink_->write(event);
        if (listener_) listener_(event);
    };
    return Status::done();
}

void PlanRun::listen(std::function<void(const plan::TraceEvent&)> listener) {
    listener_ = std::move(listener);
}

run::Ended PlanRun::run(run::Debugger* debugger) {
    how_.debugger = debugger;
    return virtual_time_ ? run::VirtualTime(graph_, library_, how_).run()
                         : run::RealTime(graph_, library_, how_).run();
}

void add_plan_file(CLI::App& verb, std::string& file) {
    CLI::Option* option = verb.add_option("FILE", file, "the plan, NAME.plan.json")->required();
    takes_file(*option, {".plan.json"});
}

void add_run_options(CLI::App& verb, PlanRunOptions& options) {
    add_plan_file(verb, options.file);
    add_toolbox_option(verb, options.toolboxes);
    verb.add_option("--set", options.set, "NAME=VALUE: a variable's value at the start");
    takes_one_of(*verb.add_option("--clock", options.clock, "real or virtual time (real)"),
                 {"real", "virtual"});
    verb.add_option("--seed", options.seed, "of all that is random (1)")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    verb.add_option("--max-time", options.max_time, "seconds after which the run is aborted");
    takes_file(*verb.add_option("--trace", options.trace, "where its trace goes; - is stdout"),
               {".jsonl"});
}

}  // namespace vagus::cli
