#include "embed/command_line.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/line_sink.hpp"
#include "base/text.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/prepared_run.hpp"
#include "net/end_signal.hpp"
#include "session/toolboxes.hpp"

namespace vagus::embed {

namespace {

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

constexpr std::string_view kHelp =
    "Runs the plan {0}.\n\n"
    "  {1} [OPTION]...\n\n{2}\n"
    "Ctrl-C, SIGTERM and SIGHUP abort the run in order; a second one ends it at once.\n\n"
    "Exit codes: 0 the plan ended well, 3 it was interrupted, 4 it failed, 5 --max-time came, 2 "
    "it is not valid.\n\n"
    "Example:\n  {1} --clock virtual --trace -\n";

struct Words {
    RunWords run;
    bool help = false;
};

Error wrong(std::string sentence) {
    return {Code::BadInput, std::move(sentence)};
}

// Where the value of the option goes; nullptr if there is no such option.
std::string* place_of(const std::string& name, RunWords& words) {
    for (const RunOption& option : run_options()) {
        if (option.name != name) continue;
        return option.one ? &(words.*option.one) : &(words.*option.many).emplace_back();
    }
    return nullptr;
}

// `--name VALUE` and `--name=VALUE`.
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
        std::string* place = place_of(name, words.run);
        if (!place) {
            return wrong(
                fmt::format("{}: there is no such option; --help lists those that there "
                            "are",
                            argv[i]));
        }
        const bool value_follows = i + 1 < argc && !std::string_view(argv[i + 1]).starts_with("--");
        if (!value && value_follows) value = argv[++i];
        if (!value || value->empty()) return wrong(fmt::format("{} needs a value", name));
        *place = *value;
    }
    return words;
}

int complain(std::string_view program, std::string_view sentence) {
    const std::string line = fmt::format("{}: {}\n", program, sentence);
    write_to_stderr(line);
    return kExitUsage;
}

int print_help(std::string_view program, std::string_view help) {
    LineSink output = std::move(LineSink::open("-", LineSink::When::AtOnce).value());
    output.write(help);
    const Status written = output.flush();
    if (written.ok()) return 0;
    complain(program, written.error().what);
    return kExitFailed;
}

void say_listening(const std::string& target, const RunWords& words) {
    const std::string line = fmt::format("listening {}\n", target);
    if (words.traces_on_stdout()) return write_to_stderr(line);
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
}

int run_with(MakePlan make, const run::CodeLibrary& library, toolbox::Parts& parts,
             const std::string& program, const Words& words) {
    const LoadedPlan plan = LoadedPlan::from_code(make, library);
    write_to_stderr(plan.report());
    if (!plan.ok()) return kExitUsage;
    if (words.help) {
        const std::string& name = plan.graph().plans.front().name;
        return print_help(program, fmt::format(kHelp, name, program, describe_run_options()));
    }
    net::watch_for_end();
    const auto prepared = PreparedRun::prepare(plan, words.run, parts);
    if (!prepared.ok()) return complain(program, prepared.error().what);
    const std::string listening = prepared.value()->listening();
    if (!listening.empty()) say_listening(listening, words.run);
    prepared.value()->end_when_stopped();
    prepared.value()->brake_as_a_whole();
    const net::EndWatcher end_watcher(
        [&prepared] { prepared.value()->abort(net::end_asked_by()); });
    const Result<run::Ended> ended = prepared.value()->run();
    if (!ended.ok()) return complain(program, ended.error().what);
    if (!ended.value().message.empty()) complain(program, ended.value().message);
    return prepared.value()->exit_status(ended.value());
}

}  // namespace

int run_main(MakePlan make, int argc, char** argv) {
    prepare_standard_files();
    const std::string program = argc > 0 ? argv[0] : "plan";
    const Result<Words> words = read_words(argc, argv);
    if (!words.ok()) return complain(program, words.error().what);
    toolbox::Parts parts;
    run::CodeLibrary library;
    const Status added = session::add_toolboxes(library, parts, words.value().run.toolboxes);
    if (!added.ok()) return complain(program, added.error().what);
    return run_with(make, library, parts, program, words.value());
}

int run_main(MakePlan make, const run::CodeLibrary& library, toolbox::Parts& parts, int argc,
             char** argv) {
    prepare_standard_files();
    const std::string program = argc > 0 ? argv[0] : "plan";
    const Result<Words> words = read_words(argc, argv);
    if (!words.ok()) return complain(program, words.error().what);
    if (!words.value().run.toolboxes.empty()) {
        return complain(program, "--toolbox: this program has its toolboxes built in");
    }
    return run_with(make, library, parts, program, words.value());
}

}  // namespace vagus::embed
