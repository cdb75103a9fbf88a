#include "embed/command_line.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "embed/loaded_plan.hpp"
#include "embed/prepared_run.hpp"
#include "session/toolboxes.hpp"

namespace vagus::embed {

namespace {

constexpr int kExitUsage = 2;

constexpr std::string_view kHelp =
    "Runs the plan {0}.\n\n"
    "  {1} [--set NAME=VALUE]... [--clock real|virtual] [--seed N] [--max-time SECONDS]\n"
    "      [--trace FILE|-] [--world FILE [--trace-all FILE|-]] [--bus TARGET --project FILE]\n"
    "      [--toolbox FILE]...\n\n"
    "  --set NAME=VALUE    a variable's value at the start\n"
    "  --clock             real or virtual time (real)\n"
    "  --seed N            of all that is random (1; that of a world's file for the world)\n"
    "  --max-time SECONDS  after which the run is aborted (beside a world: 3600)\n"
    "  --trace FILE        where its trace goes; - is stdout\n"
    "  --world FILE        a world whose robots the plan drives\n"
    "  --trace-all FILE    the trace with what happens in the world\n"
    "  --bus TARGET        a bus with nodes that the plan drives\n"
    "  --project FILE      the .aesl that they were loaded with: names of events\n"
    "  --toolbox FILE      more templates: a toolbox file or a shared library\n\n"
    "Exit codes: 0 the plan ended well, 3 it was interrupted, 4 it failed, 5 --max-time came, 2 "
    "it is not valid.\n\n"
    "Example:\n  {1} --clock virtual --trace -\n";

struct Words {
    RunWords run;
    std::vector<std::string> toolboxes;
    bool help = false;
};

Error wrong(std::string sentence) {
    return {Code::BadInput, std::move(sentence)};
}

Result<uint64_t> parse_seed(const std::string& text) {
    uint64_t seed = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, seed);
    if (read.ec == std::errc() && read.ptr == end) return seed;
    return wrong(
        fmt::format("--seed {}: expected a whole number from 0 to 18446744073709551615", text));
}

// Where the value of the option goes; nullptr if there is no such option.
std::string* place_of(const std::string& name, Words& given, std::string& seed) {
    RunWords& words = given.run;
    const std::pair<std::string_view, std::string*> options[] = {
        {"--clock", &words.clock}, {"--seed", &seed},
        {"--trace", &words.trace}, {"--max-time", &words.max_time},
        {"--world", &words.world}, {"--trace-all", &words.trace_all},
        {"--bus", &words.bus},     {"--project", &words.project}};
    for (const auto& [known, place] : options) {
        if (known == name) return place;
    }
    if (name == "--toolbox") return &given.toolboxes.emplace_back();
    return name == "--set" ? &words.set.emplace_back() : nullptr;
}

// `--name VALUE` and `--name=VALUE`; the last one holds, but for --set and --toolbox.
Result<Words> read_words(int argc, char** argv) {
    Words words;
    std::string seed;
    for (int i = 1; i < argc; ++i) {
        std::string name = argv[i];
        if (name == "--help" || name == "-h") {
            words.help = true;
            continue;
        }
        const size_t equals = name.find('=');
        std::optional<std::string> value;
        if (equals != std::string::npos) {
            value = name.substr(equals + 1);
            name.resize(equals);
        }
        std::string* place = place_of(name, words, seed);
        if (!place) {
            return wrong(
                fmt::format("{}: there is no such option; --help lists those that there "
                            "are",
                            argv[i]));
        }
        if (!value && i + 1 < argc) value = argv[++i];
        if (!value) return wrong(fmt::format("{} needs a value", name));
        *place = *value;
    }
    if (!seed.empty()) words.run.seed = TRY(parse_seed(seed));
    return words;
}

int complain(std::string_view program, std::string_view sentence) {
    const std::string line = fmt::format("{}: {}\n", program, sentence);
    std::fputs(line.c_str(), stderr);
    return kExitUsage;
}

int run_with(MakePlan make, const run::CodeLibrary& library, toolbox::Parts& parts,
             const std::string& program, const Words& words) {
    const LoadedPlan plan = LoadedPlan::from_code(make, library);
    std::fputs(plan.report().c_str(), stderr);
    if (!plan.ok()) return kExitUsage;
    if (words.help) {
        const std::string& name = plan.graph().plans.front().name;
        std::fputs(fmt::format(kHelp, name, program).c_str(), stdout);
        return 0;
    }
    const auto prepared =
        PreparedRun::prepare({plan.graph(), plan.plans(), library}, words.run, parts);
    if (!prepared.ok()) return complain(program, prepared.error().what);
    const Result<run::Ended> ended = prepared.value()->run();
    if (!ended.ok()) return complain(program, ended.error().what);
    if (!ended.value().message.empty()) complain(program, ended.value().message);
    return run::exit_status(ended.value());
}

}  // namespace

int run_main(MakePlan make, int argc, char** argv) {
    const std::string program = argc > 0 ? argv[0] : "plan";
    const Result<Words> words = read_words(argc, argv);
    if (!words.ok()) return complain(program, words.error().what);
    toolbox::Parts parts;
    run::CodeLibrary library;
    const Status added = session::add_toolboxes(library, parts, words.value().toolboxes);
    if (!added.ok()) return complain(program, added.error().what);
    return run_with(make, library, parts, program, words.value());
}

int run_main(MakePlan make, const run::CodeLibrary& library, toolbox::Parts& parts, int argc,
             char** argv) {
    const std::string program = argc > 0 ? argv[0] : "plan";
    const Result<Words> words = read_words(argc, argv);
    if (!words.ok()) return complain(program, words.error().what);
    if (!words.value().toolboxes.empty()) {
        return complain(program, "--toolbox: this program has its toolboxes built in");
    }
    return run_with(make, library, parts, program, words.value());
}

}  // namespace vagus::embed
