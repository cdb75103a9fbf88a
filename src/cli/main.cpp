// The map of the program: one verb for each thing that Vagus does. What a verb takes and how it
// runs is in the file of its name; the list is verbs.def.
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
        vagus::cli::print(text.str());
        return code;
    } catch (const CLI::ParseError& error) {
        vagus::cli::say(vagus::cli::usage_error(app, error));
        return vagus::cli::kExitUsage;
    }
    if (!app.get_subcommands().empty()) return exit_code;
    vagus::cli::say(vagus::cli::no_verb_error());
    return vagus::cli::kExitUsage;
}

}  // namespace

int main(int argc, char** argv) {
    vagus::prepare_standard_files();
    CLI::App app("Vagus programs robots that are made of many microcontrollers.");
    describe(app);
    int exit_code = vagus::cli::kExitDone;
#define VERB(name) vagus::cli::add_##name(app, exit_code);
#include "cli/verbs.def"
#undef VERB
    vagus::cli::add_page(app, exit_code);
    vagus::cli::add_runner(app, exit_code);
    vagus::cli::add_why_host(app, exit_code);
    vagus::cli::add_log_host(app, exit_code);
    vagus::cli::add_compare_host(app, exit_code);
    vagus::cli::add_try_host(app, exit_code);
    vagus::cli::add_test_host(app, exit_code);
    vagus::cli::add_turning_host(app, exit_code);
    vagus::cli::shape_help(app);
    vagus::cli::refuse_options_as_values(app);
    return vagus::cli::end_output(parse_and_run(app, argc, argv, exit_code));
}
