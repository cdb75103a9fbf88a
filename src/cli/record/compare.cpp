// vagus compare: tells where two recorded runs differ first, lane by lane.
#include <CLI/CLI.hpp>

#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "record/compare_runs.hpp"
#include "record/damage.hpp"

namespace vagus::cli {

namespace {

struct CompareOptions {
    std::string a;
    std::string b;
    std::vector<std::string> align = {"start"};
    bool json = false;
};

struct Opened {
    MappedFile file;
    mcap::Reader reader;
};

Result<Opened> open(const std::string& path) {
    MappedFile file = TRY(MappedFile::open(path));
    mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), path));
    return Opened{std::move(file), std::move(reader)};
}

int compare(const CompareOptions& options) {
    const auto align = record::read_align(options.align);
    if (!align.ok()) return complain(align.error(), kExitUsage);
    const auto a = open(options.a);
    if (!a.ok()) return complain(a.error(), kExitUsage);
    const auto b = open(options.b);
    if (!b.ok()) return complain(b.error(), kExitUsage);
    for (const auto* const one : {&a, &b}) {
        if (record::is_whole(one->value().reader)) continue;
        complain(one->value().reader.name() + ": " + std::string(record::kHasNoEnd));
    }
    const auto found = record::compare_runs(a.value().reader, b.value().reader, align.value());
    if (!found.ok()) return complain(found.error(), kExitUsage);
    print(options.json ? record::format_comparison_json(found.value())
                       : record::format_comparison(found.value(), options.a, options.b));
    return found.value().differs() ? kExitFailed : kExitDone;
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("compare", "tells where two recorded runs differ first");
    auto options = std::make_shared<CompareOptions>();  // owners: CLI11's options and the callback
    takes_file(*verb->add_option("A", options->a, "a recording")->required(), {".mcap"});
    takes_file(*verb->add_option("B", options->b, "another")->required(), {".mcap"});
    verb->add_option("--align", options->align,
                     "what is laid one over the other: start, actor NAME (where it begins first), "
                     "event NAME (of the bus or of a supervisor, where it comes first); of one of "
                     "several robots with projects of their own r4/NAME")
        ->type_name("start|actor NAME|event NAME")
        ->expected(1, 2);
    verb->add_flag("--json", options->json, "all lanes as JSON on stdout");
    verb->footer(
        "Tells, for each lane, the first difference, the earliest before the others: what came "
        "from outside, the trace of the plan, events of the bus, the variables of each node, the "
        "pose of each robot and loose object, the world, the end. Robots with projects of their "
        "own have lanes of their own. Before them, what the two were started with, where that is "
        "not the same. Beyond the end of the shorter one nothing is compared.\n"
        "Exit codes: 0 no difference, 1 differences, 2 not valid.\n\nExample:\n"
        "  vagus compare monday.mcap tuesday.mcap\n"
        "  vagus compare monday.mcap tuesday.mcap --align actor followWall");
    verb->callback([options, &exit_code] { exit_code = compare(*options); });
}

}  // namespace vagus::cli
