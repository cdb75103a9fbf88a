// `vagus plan`: checks, runs and formats plans (docs/plans.md, sections 5 and 6).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "plan/check.hpp"
#include "plan/file.hpp"
#include "plan/graph.hpp"
#include "run/real_time.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/core.hpp"
#include "toolbox/core_values.hpp"

namespace vagus::cli {

namespace {

class Disk final : public plan::Files {
public:
    Result<std::string> read(const std::string& path) const override { return read_file(path); }
};

void show_findings(const plan::Findings& findings) {
    std::string lines;
    for (const plan::Finding& finding : findings) {
        const bool error = finding.severity == plan::Severity::Error;
        lines += fmt::format("{}:{}: {}: {} [{}]\n", finding.file, finding.line,
                             error ? "error" : "warning", finding.message, finding.rule);
    }
    std::fputs(lines.c_str(), stderr);
}

// ---- check ----

struct CheckOptions {
    std::string file;
    bool json = false;
};

int check(const CheckOptions& options) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    const plan::Checked checked = plan::check(options.file, Disk(), library.templates());
    if (options.json) {
        print(plan::format_findings_json(checked.findings));
    } else {
        show_findings(checked.findings);
    }
    return checked.ok() ? kExitDone : kExitUsage;
}

// ---- run ----

struct RunOptions {
    std::string file;
    std::vector<std::string> set;
    std::string clock = "real";
    uint64_t seed = 1;
    std::string max_time;
    std::string trace;
};

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

// Where trace lines go; closes what it opened.
class TraceSink {
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

int run_checked(const RunOptions& options, const plan::Checked& checked,
                const run::CodeLibrary& library) {
    const plan::Graph graph = plan::make_graph(checked);
    run::RunOptions how;
    how.seed = options.seed;
    for (const std::string& text : options.set) {
        auto set = parse_set(graph.plans.front(), text);
        if (!set.ok()) return complain(set.error(), kExitUsage);
        how.set.push_back(std::move(set.value()));
    }
    if (!options.max_time.empty()) {
        const Result<Duration> most = parse_max_time(options.max_time);
        if (!most.ok()) return complain(most.error(), kExitUsage);
        how.max_time = most.value();
    }
    auto sink = TraceSink::open(options.trace);
    if (!sink.ok()) return complain(sink.error(), kExitUsage);
    how.on_trace = [&sink](const plan::TraceEvent& event) { sink.value()->write(event); };
    const run::Ended ended = options.clock == "virtual"
                                 ? run::VirtualTime(graph, library, how).run()
                                 : run::RealTime(graph, library, how).run();
    if (!ended.message.empty()) complain(ended.message);
    return run::exit_status(ended);
}

int run_plan(const RunOptions& options) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    const plan::Checked checked = plan::check(options.file, Disk(), library.templates());
    show_findings(checked.findings);
    return checked.ok() ? run_checked(options, checked, library) : kExitUsage;
}

// ---- format ----

struct FormatOptions {
    std::string file;
    bool write = false;
    bool check = false;
};

int format(const FormatOptions& options) {
    const Result<std::string> text = read_file(options.file);
    if (!text.ok()) return complain(text.error(), kExitUsage);
    const Result<std::string> formatted = plan::format_plan(text.value(), options.file);
    if (!formatted.ok()) return complain(formatted.error(), kExitUsage);
    const bool same = formatted.value() == text.value();
    if (options.check) {
        if (same) return kExitDone;
        return complain(
            fmt::format("{} is not in the saved form; `vagus plan format -w {}` mends "
                        "that",
                        options.file, options.file));
    }
    if (!options.write) {
        print(formatted.value());
        return kExitDone;
    }
    if (same) return kExitDone;
    const Status written = write_file(options.file, formatted.value());
    return written.ok() ? kExitDone : complain(written.error());
}

// ---- the command line ----

CLI::Option* add_file(CLI::App& verb, std::string& file) {
    CLI::Option* option = verb.add_option("FILE", file, "the plan, NAME.plan.json")->required();
    takes_file(*option, {".plan.json"});
    return option;
}

void add_check(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("check", "finds what is wrong with a plan");
    verb->footer("Example:\n  vagus plan check examples/wall/WallFollow.plan.json");
    auto options = std::make_shared<CheckOptions>();  // owners: CLI11's option and the callback
    add_file(*verb, options->file);
    verb->add_flag("--json", options->json, "the findings as a JSON array on stdout");
    verb->callback([options, &exit_code] { exit_code = check(*options); });
}

void add_run(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("run", "runs a plan");
    verb->footer(
        "Exit codes: 0 the plan ended well, 3 it was interrupted, 4 it failed, 5 --max-time came, "
        "2 it is not valid.\n\nExample:\n  vagus plan run Square.plan.json --clock virtual "
        "--trace - --set side=40");
    auto options = std::make_shared<RunOptions>();  // owners: CLI11's options and the callback
    add_file(*verb, options->file);
    verb->add_option("--set", options->set, "NAME=VALUE: a variable's value at the start");
    takes_one_of(*verb->add_option("--clock", options->clock, "real or virtual time (real)"),
                 {"real", "virtual"});
    verb->add_option("--seed", options->seed, "of all that is random (1)")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    verb->add_option("--max-time", options->max_time, "seconds after which the run is aborted");
    takes_file(*verb->add_option("--trace", options->trace, "where its trace goes; - is stdout"),
               {".jsonl"});
    verb->callback([options, &exit_code] { exit_code = run_plan(*options); });
}

void add_format(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("format", "prints a plan in its saved form");
    verb->footer("Example:\n  vagus plan format -w Square.plan.json");
    auto options = std::make_shared<FormatOptions>();  // owners: CLI11's options and the callback
    add_file(*verb, options->file);
    verb->add_flag("-w,--write", options->write, "writes the file instead of printing");
    verb->add_flag("--check", options->check,
                   "exit code 1 if the file differs from its saved form");
    verb->callback([options, &exit_code] { exit_code = format(*options); });
}

}  // namespace

void add_plan(CLI::App& app, int& exit_code) {
    CLI::App* plan = app.add_subcommand("plan", "checks, runs and formats plans");
    plan->require_subcommand(1);
    plan->footer("Example:\n  vagus plan run Square.plan.json --clock virtual --trace -");
    add_check(*plan, exit_code);
    add_run(*plan, exit_code);
    add_format(*plan, exit_code);
}

}  // namespace vagus::cli
