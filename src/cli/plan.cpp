// `vagus plan`: checks, runs, debugs and formats plans (docs/plans.md, sections 5 and 6).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/plan_debug.hpp"
#include "cli/plan_generate.hpp"
#include "cli/plan_run.hpp"
#include "cli/plan_show.hpp"
#include "cli/verbs.hpp"
#include "plan/check.hpp"
#include "plan/file.hpp"
#include "session/toolboxes.hpp"

namespace vagus::cli {

namespace {

// ---- check ----

struct CheckOptions {
    std::string file;
    std::vector<std::string> toolboxes;
    bool json = false;
};

int check(const CheckOptions& options) {
    const toolbox::Parts parts;
    run::CodeLibrary library;
    const Status added = session::add_toolboxes(library, parts, options.toolboxes);
    if (!added.ok()) return complain(added.error(), kExitUsage);
    const plan::Checked checked = plan::check(options.file, PlanDisk(), library.templates());
    if (options.json) {
        print(plan::format_findings_json(checked.findings));
    } else {
        show_findings(checked.findings);
    }
    return checked.ok() ? kExitDone : kExitUsage;
}

// ---- run ----

int run_plan(const PlanRunOptions& options) {
    const std::unique_ptr<PlanRun> run = PlanRun::prepare(options);
    if (!run) return kExitUsage;
    switch (how_to_show(options)) {
        case PlanShown::Screen:
            return run_on_screen(*run);
        case PlanShown::Lines:
            return run_in_lines(*run);
        case PlanShown::Nowhere:
            break;
    }
    const run::Ended ended = run->run();
    if (!ended.message.empty()) complain(ended.message);
    return run::exit_status(ended);
}

// ---- format ----

struct FormatOptions {
    std::string file;
    std::vector<std::string> toolboxes;  // taken by all verbs alike; the form does not need them
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

void add_check(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("check", "finds what is wrong with a plan");
    verb->footer("Example:\n  vagus plan check examples/follow-wall/WallFollow.plan.json");
    auto options = std::make_shared<CheckOptions>();  // owners: CLI11's option and the callback
    add_plan_file(*verb, options->file);
    add_toolbox_option(*verb, options->toolboxes);
    verb->add_flag("--json", options->json, "the findings as a JSON array on stdout");
    verb->callback([options, &exit_code] { exit_code = check(*options); });
}

void add_run(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("run", "runs a plan");
    verb->footer(
        "Exit codes: 0 the plan ended well, 3 it was interrupted, 4 it failed, 5 --max-time came, "
        "2 it is not valid.\n\nBeside a world, on a terminal, it shows the plan and the world; the "
        "keys stand at the bottom. The\nend stays on the screen until q, 30 s at most. Without a "
        "terminal, or with --clock virtual, it prints\nplain lines of what happens.\n\nExample:\n  "
        "vagus plan run Count.plan.json --clock virtual --trace - "
        "--set last=40\n  vagus plan run Square.plan.json --world thymio.world.json");
    auto options = std::make_shared<PlanRunOptions>();  // owners: CLI11's options, the callback
    add_run_options(*verb, *options);
    verb->add_flag("--headless", options->headless,
                   "beside a world: plain lines also on a terminal");
    verb->callback([options, &exit_code] { exit_code = run_plan(*options); });
}

void add_debug(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("debug", "runs a plan with a prompt: breakpoints, steps");
    verb->footer(
        "The run waits before its start; `help` lists the commands. Without a terminal they are "
        "lines of stdin. Exit codes as for `vagus plan run`.\n\nExample:\n"
        "  vagus plan debug Square.plan.json --world carbot.world.json --clock virtual");
    auto options = std::make_shared<PlanRunOptions>();  // owners: CLI11's options, the callback
    add_run_options(*verb, *options);
    verb->callback([options, &exit_code] { exit_code = debug_plan(*options); });
}

void add_format(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("format", "prints a plan in its saved form");
    verb->footer("Example:\n  vagus plan format -w Square.plan.json");
    auto options = std::make_shared<FormatOptions>();  // owners: CLI11's options and the callback
    add_plan_file(*verb, options->file);
    add_toolbox_option(*verb, options->toolboxes);
    verb->add_flag("-w,--write", options->write, "writes the file instead of printing");
    verb->add_flag("--check", options->check,
                   "exit code 1 if the file differs from its saved form");
    verb->callback([options, &exit_code] { exit_code = format(*options); });
}

}  // namespace

void add_plan(CLI::App& app, int& exit_code) {
    CLI::App* plan =
        app.add_subcommand("plan", "checks, runs, debugs and formats plans; programs of them");
    plan->require_subcommand(1);
    plan->footer(
        "Example:\n  vagus plan run Square.plan.json --world carbot.world.json --clock virtual "
        "--trace -");
    add_check(*plan, exit_code);
    add_run(*plan, exit_code);
    add_debug(*plan, exit_code);
    add_plan_generate(*plan, exit_code);
    add_format(*plan, exit_code);
}

}  // namespace vagus::cli
