#include "cli/plan_run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "run/real_time.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/core.hpp"
#include "toolbox/core_values.hpp"

namespace vagus::cli {

namespace {

// NAME=VALUE: the value is converted as a string (section 6).
Result<std::pair<int, plan::Value>> parse_set(const plan::GraphPlan& plan,
                                              const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos) {
        return Error{Code::BadInput,
                     fmt::format("--set {}: expected NAME=VALUE, as --set speed=12", text)};
    }
    const std::string name = text.substr(0, equals);
    for (size_t slot = 0; slot < plan.variables.size(); ++slot) {
        if (plan.variables[slot].name != name) continue;
        Result<plan::Value> value =
            plan::convert(plan::Value(text.substr(equals + 1)), plan.variables[slot].type);
        if (value.ok()) return std::pair(static_cast<int>(slot), std::move(value.value()));
        return Error{Code::BadInput, fmt::format("--set {}: {}", text, value.error().what)};
    }
    return Error{Code::NotFound, fmt::format("--set {}: the plan {} has no variable \"{}\"", text,
                                             plan.name, name)};
}

Result<Duration> parse_max_time(const std::string& text) {
    const Result<double> seconds = plan::float_from_text(text);
    if (seconds.ok() && toolbox::duration_of(seconds.value()).count() > 0) {
        return toolbox::duration_of(seconds.value());
    }
    return Error{Code::BadInput,
                 fmt::format("--max-time {}: expected seconds above 0, as --max-time 2.5", text)};
}

}  // namespace

Result<std::string> PlanDisk::read(const std::string& path) const {
    return read_file(path);
}

void show_findings(const plan::Findings& findings) {
    std::string lines;
    for (const plan::Finding& finding : findings) {
        const bool error = finding.severity == plan::Severity::Error;
        lines += fmt::format("{}:{}: {}: {} [{}]\n", finding.file, finding.line,
                             error ? "error" : "warning", finding.message, finding.rule);
    }
    std::fputs(lines.c_str(), stderr);
}

// Where trace lines go; closes what it opened.
class PlanRun::TraceSink {
public:
    static Result<std::unique_ptr<TraceSink>> open(const std::string& path) {
        auto sink = std::make_unique<TraceSink>();
        if (path == "-") sink->file_ = stdout;
        if (path.empty() || path == "-") return sink;
        sink->file_ = std::fopen(path.c_str(), "wb");
        sink->owned_ = true;
        if (sink->file_) return sink;
        return Error{Code::Unavailable, fmt::format("the trace {} cannot be written", path)};
    }
    ~TraceSink() {
        if (owned_ && file_) std::fclose(file_);
    }
    void write(const plan::TraceEvent& event) {
        if (!file_) return;
        const std::string line = plan::format_trace(event) + "\n";
        std::fwrite(line.data(), 1, line.size(), file_);
    }

private:
    std::FILE* file_ = nullptr;
    bool owned_ = false;
};

PlanRun::PlanRun() = default;
PlanRun::~PlanRun() = default;

std::unique_ptr<PlanRun> PlanRun::prepare(const PlanRunOptions& options) {
    std::unique_ptr<PlanRun> made(new PlanRun());  // make_unique cannot reach the constructor
    toolbox::add_core(made->library_);
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
    virtual_time_ = options.clock == "virtual";
    how_.seed = options.seed;
    for (const std::string& text : options.set) {
        how_.set.push_back(TRY(parse_set(graph_.plans.front(), text)));
    }
    if (!options.max_time.empty()) how_.max_time = TRY(parse_max_time(options.max_time));
    sink_ = TRY(TraceSink::open(options.trace));
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
