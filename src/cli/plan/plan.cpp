// `vagus plan`: checks, runs, debugs and formats plans (docs/plans.md, sections 5 and 6).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/shell_word.hpp"
#include "cli/live_screen.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/plan/debug.hpp"
#include "cli/plan/diff.hpp"
#include "cli/plan/explore.hpp"
#include "cli/plan/generate.hpp"
#include "cli/plan/hot_change.hpp"
#include "cli/plan/run.hpp"
#include "cli/plan/save_watcher.hpp"
#include "cli/plan/show.hpp"
#include "cli/verbs.hpp"
#include "net/end_signal.hpp"
#include "plan/check.hpp"
#include "plan/file.hpp"
#include "plan/formula_words.hpp"
#include "session/toolboxes.hpp"

namespace vagus::cli {

namespace {

// ---- check ----

struct CheckOptions {
    std::string file;
    embed::RunWords words;  // toolboxes, a world with one of its robots, or a project
    bool json = false;
};

int check(const CheckOptions& options) {
    const toolbox::Parts parts;
    run::CodeLibrary library;
    const embed::RunWords& words = options.words;
    const Status added = session::add_toolboxes(library, parts, words.toolboxes);
    if (!added.ok()) return complain(added.error(), kExitUsage);
    const auto plan = embed::LoadedPlan::from_file(options.file, library);
    plan::Findings findings = plan.findings();
    if (plan.ok()) {
        const Result<plan::Findings> missing = embed::check_bus(plan, words);
        if (!missing.ok()) return complain(missing.error(), kExitUsage);
        findings.insert(findings.end(), missing.value().begin(), missing.value().end());
    }
    if (options.json) {
        print(plan::format_findings_json(findings));
    } else {
        show_findings(findings);
    }
    return plan::has_error(findings) ? kExitUsage : kExitDone;
}

// ---- run ----

// To the end of the plan, or of the watching; gives the exit code.
int show_run(TerminalRun& run, const PlanRunOptions& options) {
    run.prepared().end_when_stopped();
    run.prepared().brake_as_a_whole();
    const PlanShown shown = how_to_show(options);
    // In real time a robot relies on what the plan says next.
    std::optional<OutputNeverWaits> never;
    if (shown != PlanShown::Screen && options.words.clock != "virtual") never.emplace();
    switch (shown) {
        case PlanShown::Screen:
            return run_on_screen(run, options.theme);
        case PlanShown::Lines:
        case PlanShown::LinesOnStderr:
            return run_in_lines(run, shown);
        case PlanShown::Nowhere:
            break;
    }
    const run::Ended ended = run.run();
    if (!ended.message.empty()) complain(ended.message);
    return run.exit_status(ended);
}

int run_once(const PlanRunOptions& options) {
    net::watch_for_end();
    const std::unique_ptr<TerminalRun> run = TerminalRun::prepare(options);
    if (!run) return kExitUsage;
    const net::EndWatcher end_watcher([&run] { run->prepared().abort(net::end_asked_by()); });
    return show_run(*run, options);
}

// What the watcher of one run does when files are saved: a plan takes over, all else ends the run.
// False: it has ended it.
bool take_save(const std::vector<std::string>& saved, FileWatch& watch, TerminalRun& run,
               HotChange& change) {
    if (change.is_for(saved) && change.hand_in(saved, watch)) return true;
    run.prepared().abort();
    return false;
}

// Again each time that a file is saved which cannot take over in a run that goes on, until a signal
// ends it. Such a run is aborted first.
int run_watched(const PlanRunOptions& options) {
    net::watch_for_end();
    std::vector<std::string> files = options.words.toolboxes;
    files.insert(files.end(), {options.file, options.words.world, options.words.project});
    int exit_code = kExitUsage;
    while (!net::end_asked()) {
        // Made before they are read: what is saved meanwhile is not missed.
        FileWatch watch(files);
        const std::unique_ptr<TerminalRun> run = TerminalRun::prepare(options);
        if (run && run->files() != files) {
            files = run->files();
            watch = FileWatch(files);
        }
        std::optional<HotChange> change;
        if (run) {
            change.emplace(*run, options.file, [](const std::string& line) { say(line + "\n"); });
            run->set_debugger(change->debugger());
        }
        SaveWatcher saves(std::move(watch), [&run, &change](const auto& saved, FileWatch& here) {
            return run && take_save(saved, here, *run, *change);
        });
        const net::EndWatcher end_watcher([&run] {
            if (run) run->prepared().abort(net::end_asked_by());
        });
        if (run) exit_code = show_run(*run, options);
        const std::optional<std::string> saved = saves.wait();
        if (saved) say(*saved + " was saved: the plan starts again\n");
    }
    return exit_code;
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
            fmt::format("{} is not in the saved form; `vagus plan format -w {}` fixes that",
                        options.file, shell_word(options.file)));
    }
    if (!options.write) {
        print_file(formatted.value());
        return kExitDone;
    }
    if (same) return kExitDone;
    const Status written = write_file(options.file, formatted.value());
    return written.ok() ? kExitDone : complain(written.error());
}

// ---- formulas ----

void print_formula_words() {
    const auto row = [](std::string_view form, std::string_view help) {
        print(fmt::format("  {:<20}  {}\n", form, help));
    };
    print("operators, the weakest first\n");
    for (const plan::FormulaOperator& one : plan::formula_operators()) row(one.form, one.help);
    print("functions\n");
    for (const plan::FormulaFunction& one : plan::formula_functions()) row(one.form, one.help);
}

// ---- the command line ----

void add_check(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("check", "finds what is wrong with a plan");
    verb->footer("Example:\n  vagus plan check examples/follow-wall/WallFollow.plan.json");
    auto options = std::make_shared<CheckOptions>();  // owners: CLI11's option and the callback
    add_plan_file(*verb, options->file);
    add_toolbox_option(*verb, options->words.toolboxes);
    embed::RunWords& words = options->words;
    CLI::Option* world = verb->add_option("--world", words.world,
                                          "a world whose scripts must know the plan's events");
    takes_file(*world, {".world.json"});
    verb->add_option("--robot", words.robot, "which robot of the world")
        ->type_name("NAME")
        ->needs(world);
    takes_file(*verb->add_option("--project", words.project,
                                 "a project whose events the plan must keep to")
                    ->excludes(world),
               {".aesl"});
    verb->add_flag("--json", options->json, "the findings as a JSON array on stdout");
    verb->callback([options, &exit_code] { exit_code = check(*options); });
}

void add_run(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("run", "runs a plan");
    verb->footer(
        "Exit codes: 0 the plan ended well, 3 it was interrupted, 4 it failed, 5 --max-time came, "
        "2 it is not valid,\n1 it ended well, but its trace or its recording could not be "
        "written.\n\nBeside a world, on a terminal, it shows the plan and the world; "
        "keys are listed at the bottom. At the\nend the view stays until a key. Otherwise it "
        "prints a "
        "line "
        "for each thing that happens: on stdout, or on\nstderr where stdout carries a trace. "
        "--quiet "
        "leaves the lines out.\n\nExample:\n  "
        "vagus plan run Count.plan.json --clock virtual --trace - "
        "--set last=40\n  vagus plan run Square.plan.json --world thymio.world.json");
    auto options = std::make_shared<PlanRunOptions>();  // owners: CLI11's options, the callback
    add_run_options(*verb, *options);
    verb->add_flag("--headless", options->headless,
                   "beside a world: plain lines also on a terminal");
    verb->add_flag("--quiet", options->quiet, "no lines of what happens, and no view");
    add_theme_option(*verb, options->theme);
    add_record_options(*verb, options->record, options->record_camera);
    verb->add_flag("--watch", options->watch,
                   "a plan that is saved takes over while it runs; any other file that it read "
                   "starts it again");
    verb->callback([options, &exit_code] {
        if (options->watch && !options->record.empty()) {
            exit_code = complain("--record " + options->record +
                                     ": not together with --watch; leave one of them out",
                                 kExitUsage);
            return;
        }
        exit_code = options->watch ? run_watched(*options) : run_once(*options);
    });
}

void add_debug(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("debug", "runs a plan with a prompt: breakpoints, steps");
    verb->footer(
        "The run waits before its start; `help` lists the commands. Without a terminal they are "
        "lines of stdin. Exit codes as for `vagus plan run`.\n\nExample:\n"
        "  vagus plan debug Square.plan.json --world carbot.world.json --clock virtual");
    auto options = std::make_shared<PlanRunOptions>();  // owners: CLI11's options, the callback
    options->verb = record::kDebugVerb;
    add_run_options(*verb, *options);
    add_record_options(*verb, options->record, options->record_camera);
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
                   "only checks: exit code 1 if the file differs from its saved form");
    verb->callback([options, &exit_code] { exit_code = format(*options); });
}

void add_formulas(CLI::App& plan) {
    CLI::App* verb =
        plan.add_subcommand("formulas", "lists the operators and functions of formulas");
    verb->footer("Example:\n  vagus plan formulas --json");
    auto json = std::make_shared<bool>(false);  // owners: CLI11's option and the callback
    verb->add_flag("--json", *json, "as a JSON object on stdout, for editors");
    verb->callback([json] {
        if (*json) {
            print(plan::format_formula_words_json());
        } else {
            print_formula_words();
        }
    });
}

}  // namespace

void add_plan(CLI::App& app, int& exit_code) {
    CLI::App* plan = app.add_subcommand(
        "plan", "checks, runs, debugs and formats plans, and makes programs of them");
    plan->require_subcommand(1);
    plan->footer(
        "Example:\n  vagus plan run Square.plan.json --world carbot.world.json --clock virtual "
        "--trace -");
    add_check(*plan, exit_code);
    add_run(*plan, exit_code);
    add_debug(*plan, exit_code);
    add_plan_explore(*plan, exit_code);
    add_plan_diff(*plan, exit_code);
    add_plan_generate(*plan, exit_code);
    add_format(*plan, exit_code);
    add_formulas(*plan);
}

}  // namespace vagus::cli
