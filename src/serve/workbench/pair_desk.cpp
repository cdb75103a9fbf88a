#include "serve/workbench/pair_desk.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "serve/runner/compare_host.hpp"

namespace vagus::serve {

namespace {

// Two files can be compared where nothing has run.
ShownRun or_none(ShownRun run) {
    return {.file = [file = run.file]() -> Result<std::string> {
                const auto found = file();
                return found.ok() ? found.value() : std::string();
            },
            .flush = std::move(run.flush),
            .kept = std::move(run.kept)};
}

}  // namespace

PairDesk::PairDesk(Desk& desk, std::string program, ShownRun run, Project project)
    : shown_(run.file),
      project_(std::move(project)),
      questions_({.program = std::move(program),
                  .verb = "compare-host",
                  .kind = kCompareAsked,
                  .memory_max = kPairMemoryMax,
                  .within = kPairWithin,
                  .look_every = kPairLookEvery,
                  .refused = "bad_input",
                  .died = "the two runs could not be compared",
                  .late = fmt::format("to compare these two runs takes longer than {} s; use "
                                      "`vagus compare` in a terminal",
                                      seconds_of(kPairWithin))},
                 kPairsAtOnce, or_none(std::move(run))) {
    desk.command("runs.compare", [this](const Call& call) { ask(call); });
}

void PairDesk::ask(const Call& call) {
    const auto a = file_of(call, "a");
    if (!a.ok()) return call.fail(a.error());
    const auto b = file_of(call, "b");
    if (!b.ok()) return call.fail(b.error());
    const std::string align = call.in["align"];
    Json words = Json::array({align});
    if (align != "start") words.push_back(call.in.value("name", ""));
    questions_.ask(call, {{"a", a.value()}, {"b", b.value()}, {"align", std::move(words)}},
                   [this, call, a = a.value(), b = b.value()](Json answer) {
                       answer["a"]["path"] = project_.doc_of(a);
                       answer["b"]["path"] = project_.doc_of(b);
                       call.done(std::move(answer));
                   });
}

Result<std::string> PairDesk::file_of(const Call& call, const char* side) const {
    return call.in.contains(side) ? project_.recording_at(call.in[side]) : shown_();
}

}  // namespace vagus::serve
