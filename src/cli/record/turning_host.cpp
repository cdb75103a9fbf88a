#include "cli/record/turning_host.hpp"

#include <unistd.h>

#include "base/file.hpp"
#include "cli/host_verb.hpp"
#include "cli/output.hpp"
#include "cli/record/turning_search.hpp"
#include "cli/test/test_host.hpp"
#include "serve/runner/one_answer.hpp"
#include "serve/workbench/turning_talk.hpp"

namespace vagus::cli {

namespace {

Result<trial::TurningTold> find(const serve::TurningAsked& asked, const TellSearch& told) {
    const MappedFile file = TRY(MappedFile::open(asked.file));
    const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), asked.file));
    const auto continued = TRY(trial::Continued::open(reader, asked.condition, std::nullopt));
    const TurningSearch search{.file = asked.file, .tries = asked.tries, .results = asked.results};
    return find_turning_point(*continued, reader, search, told);
}

int run_turning(serve::Pipe pipe) {
    (void)!nice(kTestNice);
    const auto packet = serve::wait_for_packet(pipe);
    if (!packet || packet->kind != serve::kTurningAsked) return kExitUsage;
    const auto asked = serve::read_turning_asked(packet->bytes);
    if (!asked) return kExitUsage;
    const auto found = find(*asked, [&pipe](const SearchProgress& progress) {
        return serve::send_whole(
            pipe, serve::kTurningProgress,
            serve::format_progress(
                {.stage = serve::kTurningStages[static_cast<size_t>(progress.stage)],
                 .done = progress.done,
                 .of = progress.of}));
    });
    const std::string answer =
        found.ok() ? serve::format_turning_found({trial::turning_sentence(found.value().turning),
                                                  trial::format_turning_json(found.value())})
                   : serve::format_turning_refused(found.error().what);
    (void)serve::send_whole(pipe, serve::kTurningAnswered, answer);
    return kExitDone;
}

}  // namespace

void add_turning_host(CLI::App& app, int& exit_code) {
    add_host_verb(app, {"turning-host", "when something was decided, for the studio"}, run_turning,
                  exit_code);
}

}  // namespace vagus::cli
