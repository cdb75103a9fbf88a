// vagus sim: a world with robots on a bus, in the terminal or as plain lines.
#include <CLI/CLI.hpp>
#include <cmath>

#include "cli/fleet/broker_options.hpp"
#include "cli/live_screen.hpp"
#include "cli/options.hpp"
#include "cli/sim/run.hpp"
#include "cli/verbs.hpp"
#include "sim/crew.hpp"

namespace vagus::cli {
namespace {

// "2.5", "max"; 0 is the fastest.
std::optional<double> speed_of(const std::string& text) {
    if (text == "max") return 0;
    char* end = nullptr;
    const double speed = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(speed >= kSpeedMin && speed <= kSpeedMax))
        return std::nullopt;
    return speed;
}

void add_time_options(CLI::App& verb, SimRunOptions& options) {
    verb.add_option_function<std::string>(
            "--speed",
            [&options](const std::string& text) {
                const auto speed = speed_of(text);
                if (!speed) {
                    throw CLI::ValidationError(
                        "--speed",
                        "expected a number from 0.01 to 1000, or max, found \"" + text + "\"");
                }
                options.speed = *speed;
            },
            "how fast time passes (default: 1, real time)")
        ->type_name("X|max");
    takes_seconds(
        *verb.add_option("--duration", options.duration, "ends after so many simulated seconds"),
        Seconds::Passing);
    add_seed_option(verb, options.seed, "of everything random (default: that of the world file)");
    verb.add_option("--pose", options.poses,
                    "a robot begins there, in m and degrees; for more robots again")
        ->allow_extra_args(false)
        ->type_name("ROBOT=X,Y,DEG");
}

void add_threads_option(CLI::App& verb, SimRunOptions& options) {
    CLI::Option* threads = verb.add_option(
        "--threads", options.threads,
        "how many threads sense and run scripts (default: 1 for less than 200 robots, else 1 or "
        "one "
        "for each processor, whichever proves faster); the result is the same to the byte. Robots "
        "that share something, a folder of cards or the energy of e-pucks, have one");
    threads->type_name("N");
    takes_whole_number(*threads, 1, sim::kThreadsMax);
}

}  // namespace

void add_sim(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("sim", "a world with robots on a bus");
    auto options = std::make_shared<SimRunOptions>();  // owners: CLI11's options and the callback
    takes_file(*verb->add_option("WORLD", options->world, "the world")->required(),
               {".world.json"});
    takes_file(*verb->add_option("--load", options->loads,
                                 "loads the scripts of a project, or one script for all robots")
                    ->allow_extra_args(false),
               {".aesl"});
    verb->add_flag("--watch", options->watch,
                   "reloads a script when its file is saved; mistakes are shown, and the script "
                   "before them runs on");
    verb->add_flag("--headless", options->headless, "plain lines also on a terminal");
    add_theme_option(*verb, options->theme);
    add_time_options(*verb, *options);
    add_threads_option(*verb, *options);
    verb->add_option("--listen", options->listen,
                     "lets hosts connect to the bus; prints `listening tcp:127.0.0.1:PORT` first")
        ->type_name("TARGET");
    takes_file(*verb->add_option("--trace", options->trace,
                                 "writes what happens, one JSON object a line; - is "
                                 "stdout, and other lines are on stderr then"),
               {});
    verb->add_option("--chaos", options->chaos,
                     "what breaks in the world: a JSON file, the JSON itself, or random:N[:SEED]")
        ->type_name("FAULTS");
    add_record_options(*verb, options->record, options->record_camera);
    verb->add_option("--fleet", options->fleet.target,
                     "robots with a project are members of this fleet, in real time: "
                     "mqtt[s]://HOST[:PORT][/FLEET]")
        ->type_name("TARGET");
    add_broker_options(*verb, options->fleet);
    verb->add_option("--logins", options->logins,
                     "with --fleet: a folder with NAME.login for each robot")
        ->type_name("FOLDER");
    add_dialect_options(*verb, options->compile);
    verb->footer(
        "On a terminal it shows the arena from above; keys are listed at the bottom. Without a "
        "terminal it\n"
        "prints plain lines and ends by itself after 20 simulated seconds (with --fleet: at "
        "Ctrl-C),\nunless --duration says otherwise.\n"
        "A plain script (no project) needs no declarations: `emit NAME` declares the event.\n"
        "\n"
        "Example:\n"
        "  vagus sim examples/thymio/arena.world.json --load examples/thymio/explore.aesl --watch\n"
        "  vagus sim arena.world.json --headless --speed max --duration 60 --trace run.jsonl\n"
        "  vagus sim arena.world.json --listen tcp:127.0.0.1:33333");
    verb->callback([options, &exit_code] { exit_code = run_sim(*options); });
}

}  // namespace vagus::cli
