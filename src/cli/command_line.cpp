#include "cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

#include "base/line_sink.hpp"
#include "cli/output.hpp"
#include "cli/page.hpp"
#include "cli/record/turning_host.hpp"
#include "cli/studio/runner.hpp"
#include "cli/test/test_host.hpp"
#include "cli/usage.hpp"
#include "cli/verbs.hpp"

namespace vagus::cli {

namespace {

void describe(CLI::App& app) {
    app.name("vagus");
    app.set_version_flag("--version", "vagus " VAGUS_VERSION, "the version, and nothing else");
    app.set_help_flag("-h,--help", "this text; `vagus VERB --help` says more about a verb");
    app.require_subcommand(0, 1);
    app.footer(
        "Example:\n"
        "  vagus sim examples/thymio/arena.world.json --watch\n"
        "\n"
        "Exit codes: 0 done, 1 the work failed, 2 the command line or a file it names is wrong.");
}

// CLI11 answers --help and wrong command lines by exceptions; they end here.
int parse_and_run(CLI::App& app, int argc, const char* const* argv, const int& exit_code) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answer) {
        std::ostringstream text;
        const int code = app.exit(answer, text, text);
        print(text.str());
        return code;
    } catch (const CLI::ParseError& error) {
        say(usage_error(app, error));
        return kExitUsage;
    }
    if (!app.get_subcommands().empty()) return exit_code;
    say(no_verb_error());
    return kExitUsage;
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
    prepare_standard_files();
    CLI::App app("Vagus programs robots that are made of many microcontrollers.");
    describe(app);
    int exit_code = kExitDone;
#define VERB(name) add_##name(app, exit_code);
#include "cli/verbs.def"
#undef VERB
    add_page(app, exit_code);
    add_runner(app, exit_code);
    add_why_host(app, exit_code);
    add_log_host(app, exit_code);
    add_compare_host(app, exit_code);
    add_keep_host(app, exit_code);
    add_try_host(app, exit_code);
    add_test_host(app, exit_code);
    add_turning_host(app, exit_code);
    shape_help(app);
    refuse_options_as_values(app);
    return end_output(parse_and_run(app, argc, argv, exit_code));
}

}  // namespace vagus::cli
