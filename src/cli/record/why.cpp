// vagus why: tells from a recording why something is as it is.
#include "record/why.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record/chain_text.hpp"
#include "cli/record/turning.hpp"
#include "cli/verbs.hpp"

namespace vagus::cli {

namespace {

struct WhyOptions {
    TurningOptions turning;  // if its condition is given
    std::string file;
    std::vector<std::string> question;
    std::string robot;
    std::optional<double> at;
    bool json = false;
    bool all = false;
};

int tell_why(const WhyOptions& options) {
    if (!options.turning.condition.empty()) {
        TurningOptions turning = options.turning;
        turning.search.file = options.file;
        turning.search.robot = options.robot;
        turning.json = options.json;
        return tell_turning(turning);
    }
    auto question = record::read_question(options.question);
    if (!question.ok()) return complain(question.error(), kExitUsage);
    question.value().robot = options.robot;
    const auto file = MappedFile::open(options.file);
    if (!file.ok()) return complain(file.error(), kExitUsage);
    const auto reader = mcap::Reader::open(file.value().bytes(), options.file);
    if (!reader.ok()) return complain(reader.error(), kExitUsage);
    std::optional<Time> at;
    if (options.at) at = from_seconds(*options.at);
    const auto chain = record::why(reader.value(), question.value(), at);
    if (!chain.ok()) {
        const bool invalid = chain.error().code == Code::BadInput;  // damaged, or of no run
        return complain(chain.error(), invalid ? kExitUsage : kExitFailed);
    }
    if (options.json) {
        print(record::format_chain_json(chain.value()));
        return kExitDone;
    }
    print(chain_text(chain.value(), options.all ? "" : "--all shows them"));
    return kExitDone;
}

}  // namespace

void add_why(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("why", "tells from a recording why something happened");
    auto options = std::make_shared<WhyOptions>();  // owners: CLI11's options and the callback
    takes_file(*verb->add_option("FILE", options->file, "the recording")->required(), {".mcap"});
    CLI::Option* const question = verb->add_option(
        "QUESTION", options->question,
        "actor NAME, variable NODE.NAME, variable NAME, motor ROBOT, event NAME, end");
    question->expected(1, 2);
    verb->add_option("--robot", options->robot,
                     "of robots with projects of their own, the one that is asked about")
        ->type_name("NAME");
    CLI::Option* const at =
        verb->add_option("--at", options->at, "the instant that the question is about (the end)");
    takes_seconds(*at, Seconds::Instant);
    CLI::Option* const all = verb->add_flag("--all", options->all, "all of a long chain");
    verb->add_flag("--json", options->json, "the answer as JSON on stdout");
    CLI::Option* const turning = add_turning_options(*verb, options->turning);
    for (CLI::Option* const one : {question, at, all}) turning->excludes(one);
    verb->footer(
        "Prints what happened before it, the newest first, one line each: when, what, its value, "
        "and where it is written. The last line is where it began: something in the world, a "
        "person, a timer, the beginning. Plans, scripts and worlds are those in the recording. "
        "Where robots have projects of their own each line says whose it is, and what the fleet "
        "brought leads on to the robot that sent it.\n"
        "--turning-point asks when a condition of a test (vagus test --signals) was decided: from "
        "instants over the run it is continued again and again with other seeds, and counted "
        "in how many continuations the condition becomes true. Told are that curve, the instant at "
        "which it turned, what there was, and one continuation with it and one without it, which "
        "are kept as recordings.\n"
        "Exit codes: 0 answered, 1 there is no such thing by then, 2 not valid.\n\nExample:\n"
        "  vagus why run.mcap motor carbot --at 83\n"
        "  vagus why run.mcap actor backupCollision\n"
        "  vagus why run.mcap variable drive.token --at 20\n"
        "  vagus why fleet.mcap event alarm --robot t11\n"
        "  vagus why run.mcap --turning-point \"contact >= 2\" --tries 40");
    verb->callback([options, &exit_code] { exit_code = tell_why(*options); });
}

}  // namespace vagus::cli
