// `vagus plan explore`: what could happen, without running it (docs/explore.md).
#include "cli/plan/explore.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/plan/run.hpp"
#include "embed/loaded_plan.hpp"
#include "plan/explore.hpp"
#include "run/played_path.hpp"
#include "run/virtual_time.hpp"
#include "session/toolboxes.hpp"

namespace vagus::cli {

namespace {

struct ExploreWords {
    std::string file;
    std::vector<std::string> toolboxes;
    int depth = plan::kExploreDepth;
    size_t play = 0;  // number of the finding; 0: none
    bool json = false;
};

std::string numbered(const plan::Exploration& found) {
    std::string text;
    for (size_t i = 0; i < found.findings.size(); ++i) {
        std::string one = plan::format_text(found.findings[i]);
        // Behind the place, which an editor reads.
        one.insert(one.find(": ") + 1, fmt::format(" {}:", i + 1));
        text += one;
    }
    return text + plan::format_summary(found);
}

bool has_skip(const plan::ExploreFinding& finding) {
    for (const plan::ExploreStep& step : finding.path) {
        if (step.kind == plan::ExploreStep::Kind::Skip) return true;
    }
    return false;
}

// The trace of a run that takes the way of the finding, on stdout.
int play(const plan::ExploreFinding& finding, const embed::LoadedPlan& plan) {
    if (has_skip(finding)) {
        return complain("its path goes through a sub-plan beyond the depth; --depth looks deeper");
    }
    run::PlayedPath path(finding.path);
    const plan::Graph graph =
        run::with_checks_in_time(plan.graph(), [](const plan::GraphSupervisor&) { return true; });
    const run::RunOptions options = {
        .on_trace = [](const plan::TraceEvent& event) { print(plan::format_trace(event) + "\n"); },
        .code_source = &path};
    run::VirtualTime run(graph, plan.library(), options);
    path.at_its_end([&run] { run.abort(); });
    run.run();
    if (path.left() == 0) return kExitFailed;
    return complain(
        fmt::format("the run left the path {} before its end: values did not allow "
                    "it; the trace says which",
                    path.left() == 1 ? "a step" : fmt::format("{} steps", path.left())));
}

int explore(const ExploreWords& words) {
    const toolbox::Parts parts;
    run::CodeLibrary library;
    const Status added = session::add_toolboxes(library, parts, words.toolboxes);
    if (!added.ok()) return complain(added.error(), kExitUsage);
    const auto plan = embed::LoadedPlan::from_file(words.file, library);
    if (!plan.ok()) {
        show_findings(plan.findings());
        return kExitUsage;
    }
    const plan::Exploration found =
        plan::explore(plan.plans(), plan.graph(), {.depth = words.depth});
    if (words.play > 0) {
        if (words.play > found.findings.size()) {
            return complain(
                fmt::format("--play {}: {} found", words.play,
                            found.findings.empty()
                                ? "nothing was"
                                : fmt::format("only 1 to {} were", found.findings.size())),
                kExitUsage);
        }
        return play(found.findings[words.play - 1], plan);
    }
    print(words.json ? plan::format_json(found) : numbered(found));
    return found.findings.empty() ? kExitDone : kExitFailed;
}

}  // namespace

void add_plan_explore(CLI::App& plan, int& exit_code) {
    CLI::App* verb =
        plan.add_subcommand("explore", "finds what could happen, without running the plan");
    verb->footer(
        "Walks through all that can follow from the drawing: each actor may end in each of its "
        "states at any\ntime, each watching supervisor may raise each event. Exit codes: 0 nothing "
        "was found, 1 something\nwas, 2 the plan is not valid.\n\nExample:\n"
        "  vagus plan explore examples/follow-wall/WallFollow.plan.json");
    auto words = std::make_shared<ExploreWords>();  // owners: CLI11's options and the callback
    add_plan_file(*verb, words->file);
    add_toolbox_option(*verb, words->toolboxes);
    CLI::Option* const depth = verb->add_option(
        "--depth", words->depth,
        fmt::format("how many plans inside one another are looked into, the outermost is 1 ({})",
                    plan::kExploreDepth));
    takes_whole_number(*depth, 1, plan::kExploreDepthMax);
    CLI::Option* const play = verb->add_option(
        "--play", words->play, "runs the path of finding N in virtual time and prints its trace");
    takes_whole_number(*play, 1, plan::kSituationsMax);
    verb->add_flag("--json", words->json, "as a JSON object on stdout")->excludes(play);
    verb->callback([words, &exit_code] { exit_code = explore(*words); });
}

}  // namespace vagus::cli
