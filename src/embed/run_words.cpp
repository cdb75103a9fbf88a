#include "embed/run_words.hpp"

#include <fmt/format.h>

namespace vagus::embed {

namespace {

// How the plan runs.
std::vector<RunOption> options_of_the_plan() {
    return {
        {.name = "--toolbox",
         .value = "FILE",
         .help = "more templates: a toolbox file or a shared library; again for more",
         .many = &RunWords::toolboxes,
         .endings = {".toolbox.json", ".so"}},
        {.name = "--set",
         .value = "NAME=VALUE",
         .help = "a variable's value at the start; again for more",
         .many = &RunWords::set},
        {.name = "--from",
         .value = "ACTOR",
         .help = "begins with this actor instead of the plan's start",
         .one = &RunWords::from},
        {.name = "--clock",
         .value = "real|virtual",
         .help = "real or virtual time (real)",
         .one = &RunWords::clock,
         .choices = {"real", "virtual"}},
        {.name = "--seed",
         .value = "N",
         .help = "of all that is random (1; for the world that of its file)",
         .one = &RunWords::seed},
        {.name = "--max-time",
         .value = "SECONDS",
         .help = "seconds after which the run is aborted (with --world: 3600)",
         .one = &RunWords::max_time},
        {.name = "--answers",
         .value = "FILE",
         .help =
             "a JSON file whose key \"answers\" says how actors end and supervisors raise instead "
             "of working",
         .one = &RunWords::answers,
         .endings = {".json"}},
        {.name = "--trace",
         .value = "FILE",
         .help = "where its trace goes; - is stdout",
         .one = &RunWords::trace,
         .endings = {".jsonl"}},
    };
}

// What it drives.
std::vector<RunOption> options_of_its_robot() {
    return {
        {.name = "--world",
         .value = "FILE",
         .help = "a world of which the plan drives a robot",
         .one = &RunWords::world,
         .endings = {".world.json"}},
        {.name = "--robot",
         .value = "NAME",
         .help = "which robot of the world, if the plan could drive several",
         .one = &RunWords::robot},
        {.name = "--pose",
         .value = "ROBOT=X,Y,DEG",
         .help = "where a robot of the world begins, m and degrees; again for more",
         .many = &RunWords::poses},
        {.name = "--chaos",
         .value = "FAULTS",
         .help = "what breaks in the world: a JSON file, the JSON itself, or random:N[:SEED]",
         .one = &RunWords::chaos},
        {.name = "--threads",
         .value = "N",
         .help = "threads for the world (one below 200 robots, else what proves faster)",
         .one = &RunWords::threads},
        {.name = "--trace-all",
         .value = "FILE",
         .help = "the trace with what happens in the world; - is stdout",
         .one = &RunWords::trace_all,
         .endings = {".jsonl"}},
        {.name = "--listen",
         .value = "TARGET",
         .help = "opens the bus of the world to others, as tcp:127.0.0.1:33333",
         .one = &RunWords::listen},
        {.name = "--bus",
         .value = "TARGET",
         .help = "a bus with nodes that the plan drives, in real time",
         .one = &RunWords::bus},
        {.name = "--project",
         .value = "FILE",
         .help = "what the nodes of --bus were loaded with: names of events",
         .one = &RunWords::project,
         .endings = {".aesl"}},
    };
}

std::vector<RunOption> all_options() {
    std::vector<RunOption> all = options_of_the_plan();
    const std::vector<RunOption> more = options_of_its_robot();
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

const std::vector<RunOption>& run_options() {
    static const std::vector<RunOption> kOptions = all_options();
    return kOptions;
}

std::string describe_run_options() {
    std::string lines;
    for (const RunOption& option : run_options()) {
        lines += fmt::format("  {:<21}  {}\n", fmt::format("{} {}", option.name, option.value),
                             option.help);
    }
    return lines;
}

}  // namespace vagus::embed
