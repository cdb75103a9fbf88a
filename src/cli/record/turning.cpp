#include "cli/record/turning.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/test/pool.hpp"
#include "net/end_signal.hpp"

namespace vagus::cli {

CLI::Option* add_turning_options(CLI::App& verb, TurningOptions& options) {
    CLI::Option* const turning =
        verb.add_option("--turning-point", options.condition,
                        "instead of a question: when it was decided that this condition comes "
                        "about, or does not");
    turning->type_name("CONDITION");
    CLI::Option* const tries =
        verb.add_option("--tries", options.search.tries,
                        fmt::format("with --turning-point: continuations from each instant ({})",
                                    trial::kTriesUsual));
    takes_whole_number(*tries, 1, trial::kTriesMax);
    CLI::Option* const until =
        verb.add_option("--until", options.until,
                        "with --turning-point: until when the condition is waited for (the end of "
                        "the recording)");
    takes_seconds(*until, Seconds::Passing);
    CLI::Option* const at_once = verb.add_option(
        "-j", options.search.at_once,
        "with --turning-point: continuations that run at once (one for each processor)");
    takes_whole_number(*at_once, 1, kJobsAtOnceMax);
    CLI::Option* const results =
        verb.add_option("--results", options.search.results,
                        "with --turning-point: where the two continuations go (turning-point)");
    results->type_name("FOLDER");
    for (CLI::Option* const one : {tries, until, at_once, results}) one->needs(turning);
    return turning;
}

namespace {

// All that it holds, a folder of files among it, is gone when this returns.
int tell(const TurningOptions& options) {
    const TurningSearch& search = options.search;
    const auto file = MappedFile::open(search.file);
    if (!file.ok()) return complain(file.error(), kExitUsage);
    const auto reader = mcap::Reader::open(file.value().bytes(), search.file);
    if (!reader.ok()) return complain(reader.error(), kExitUsage);
    std::optional<Time> until;
    if (options.until) until = from_seconds(*options.until);
    const auto continued =
        trial::Continued::open(reader.value(), options.condition, until, search.robot);
    if (!continued.ok()) return complain(continued.error(), kExitUsage);
    const auto told = find_turning_point(*continued.value(), reader.value(), search,
                                         [](const SearchProgress&) { return true; });
    if (net::end_asked()) return kExitFailed;
    if (!told.ok()) {
        return complain(told.error(),
                        told.error().code == Code::BadInput ? kExitUsage : kExitFailed);
    }
    print(options.json ? trial::format_turning_json(told.value())
                       : trial::format_turning(told.value()));
    return kExitDone;
}

}  // namespace

int tell_turning(const TurningOptions& options) {
    net::watch_for_end();
    const int exit_code = tell(options);
    return net::end_asked() ? net::end_as_asked(exit_code) : exit_code;
}

}  // namespace vagus::cli
