#include "embed/command_line.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "run/real_time.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/builtin.hpp"
#include "toolbox/core_values.hpp"
#include "toolbox/load.hpp"
#include "toolbox/needs_bus.hpp"

namespace vagus::embed {

namespace {

constexpr int kExitUsage = 2;

constexpr std::string_view kHelp =
    "Runs the plan {0}.\n\n"
    "  {1} [--set NAME=VALUE]... [--clock real|virtual] [--seed N] [--max-time SECONDS]\n"
    "      [--trace FILE|-] [--toolbox FILE]...\n\n"
    "  --set NAME=VALUE    a variable's value at the start\n"
    "  --clock             real or virtual time (real)\n"
    "  --seed N            of all that is random (1)\n"
    "  --max-time SECONDS  after which the run is aborted\n"
    "  --trace FILE        where its trace goes; - is stdout\n"
    "  --toolbox FILE      more templates: a toolbox file or a shared library\n\n"
    "Exit codes: 0 the plan ended well, 3 it was interrupted, 4 it failed, 5 --max-time came, 2 "
    "it is not valid.\n\n"
    "Example:\n  {1} --clock virtual --trace -\n";

struct Words {
    std::vector<std::string> set;
    std::vector<std::string> toolboxes;
    std::string clock = "real";
    std::string seed = "1";
    std::string max_time;
    std::string trace;
    bool help = false;
};

// `--name VALUE` and `--name=VALUE`; the last one holds, but for --set and --toolbox.
Result<Words> read_words(int argc, char** argv) {
    Words words;
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
        std::string* place = name == "--clock"      ? &words.clock
                             : name == "--seed"     ? &words.seed
                             : name == "--max-time" ? &words.max_time
                             : name == "--trace"    ? &words.trace
                             : name == "--set"      ? &words.set.emplace_back()
                             : name == "--toolbox"  ? &words.toolboxes.emplace_back()
                                                    : nullptr;
        if (!place) {
            return Error{Code::BadInput, fmt::format("{}: there is no such option; --help lists "
                                                     "those that there are",
                                                     argv[i])};
        }
        if (!value && i + 1 < argc) value = argv[++i];
        if (!value) return Error{Code::BadInput, fmt::format("{} needs a value", name)};
        *place = *value;
    }
    return words;
}

struct Prepared {
    run::RunOptions options;
    Clock clock = Clock::Real;
    std::unique_ptr<TraceSink> sink;
};

Result<Prepared> prepare(const Words& words, const plan::GraphPlan& plan) {
    Prepared prepared;
    if (words.clock != "real" && words.clock != "virtual") {
        return Error{Code::BadInput,
                     fmt::format("--clock {}: expected real or virtual", words.clock)};
    }
    if (words.clock == "virtual") prepared.clock = Clock::Virtual;
    const char* end = words.seed.data() + words.seed.size();
    const auto seed = std::from_chars(words.seed.data(), end, prepared.options.seed);
    if (seed.ec != std::errc() || seed.ptr != end) {
        return Error{Code::BadInput, fmt::format("--seed {}: expected a whole number from 0 to "
                                                 "18446744073709551615",
                                                 words.seed)};
    }
    for (const std::string& text : words.set) {
        prepared.options.set.push_back(TRY(parse_set(plan, text)));
    }
    if (!words.max_time.empty()) prepared.options.max_time = TRY(parse_max_time(words.max_time));
    prepared.sink = TRY(TraceSink::open(words.trace));
    return prepared;
}

int complain(std::string_view program, std::string_view sentence) {
    const std::string line = fmt::format("{}: {}\n", program, sentence);
    std::fputs(line.c_str(), stderr);
    return kExitUsage;
}

int run_with(MakePlan make, const run::CodeLibrary& library, const std::string& program,
             const Words& words) {
    const LoadedPlan plan = LoadedPlan::from_code(make, library);
    std::fputs(plan.report().c_str(), stderr);
    if (!plan.ok()) return kExitUsage;
    const plan::GraphPlan& outermost = plan.graph().plans.front();
    if (words.help) {
        std::fputs(fmt::format(kHelp, outermost.name, program).c_str(), stdout);
        return 0;
    }
    const Status alone = toolbox::check_without_bus(plan.graph());
    if (!alone.ok()) return complain(program, alone.error().what);
    Result<Prepared> prepared = prepare(words, outermost);
    if (!prepared.ok()) return complain(program, prepared.error().what);
    run::RunOptions& options = prepared.value().options;
    options.on_trace = [&prepared](const plan::TraceEvent& event) {
        prepared.value().sink->write(event);
    };
    const run::Ended ended = prepared.value().clock == Clock::Virtual
                                 ? run::VirtualTime(plan.graph(), library, options).run()
                                 : run::RealTime(plan.graph(), library, options).run();
    if (!ended.message.empty()) complain(program, ended.message);
    return run::exit_status(ended);
}

}  // namespace

int run_main(MakePlan make, int argc, char** argv) {
    const std::string program = argc > 0 ? argv[0] : "plan";
    const Result<Words> words = read_words(argc, argv);
    if (!words.ok()) return complain(program, words.error().what);
    const toolbox::Parts parts;
    run::CodeLibrary library;
    toolbox::add_builtin(library, parts);
    for (const std::string& path : words.value().toolboxes) {
        const Status loaded = toolbox::load_toolbox(library, path, parts, {});
        if (!loaded.ok()) return complain(program, loaded.error().what);
    }
    return run_with(make, library, program, words.value());
}

int run_main(MakePlan make, const run::CodeLibrary& library, int argc, char** argv) {
    const std::string program = argc > 0 ? argv[0] : "plan";
    const Result<Words> words = read_words(argc, argv);
    if (!words.ok()) return complain(program, words.error().what);
    if (!words.value().toolboxes.empty()) {
        return complain(program, "--toolbox: this program has its toolboxes built in");
    }
    return run_with(make, library, program, words.value());
}

// ---- options ----

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

Result<std::unique_ptr<TraceSink>> TraceSink::open(const std::string& path) {
    auto sink = std::make_unique<TraceSink>();
    if (path == "-") sink->file_ = stdout;
    if (path.empty() || path == "-") return sink;
    sink->file_ = std::fopen(path.c_str(), "wb");
    sink->owned_ = true;
    if (sink->file_) return sink;
    return Error{Code::Unavailable, fmt::format("the trace {} cannot be written", path)};
}

TraceSink::~TraceSink() {
    if (owned_ && file_) std::fclose(file_);
}

void TraceSink::write(const plan::TraceEvent& event) {
    if (!file_) return;
    const std::string line = plan::format_trace(event) + "\n";
    std::fwrite(line.data(), 1, line.size(), file_);
}

}  // namespace vagus::embed
