#include "record/log_run.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "base/seconds.hpp"
#include "embed/loaded_plan.hpp"
#include "record/compare_tape.hpp"
#include "record/damage.hpp"
#include "record/past_run.hpp"

namespace vagus::record {

namespace {

Error not_the_same(const Difference& found) {
    return {Code::Refused,
            fmt::format("the run does not come out as it was recorded: it differs at {} s in {}; "
                        "another version of Vagus has recorded it, or a file is damaged "
                        "(`vagus replay` says more)",
                        seconds_text(found.at), found.topic)};
}

}  // namespace

std::vector<LogPoints::Bus> buses_of(Rerun& rerun) {
    std::vector<LogPoints::Bus> all;
    for (const RunBus& one : rerun.buses()) {
        const plan::Graph* const graph = one.plan != nullptr ? &one.plan->graph() : nullptr;
        all.push_back({one.session, graph, one.robot, one.number});
    }
    return all;
}

void follow(Rerun& rerun, LogPoints& points) {
    rerun.listen([&points](const plan::TraceEvent& event) { points.see(0, event); });
    rerun.watch_robots(&points);
    rerun.each_instant([&points](Time) { points.instant(); });
}

Result<Time> log_run(const mcap::Reader& reader, const LogRun& wanted) {
    RerunOptions how;
    if (!is_whole(reader)) how.until = end_of(reader);
    const Time until = how.until.value_or(Time::max());
    const std::unique_ptr<Rerun> rerun = TRY(Rerun::open(reader, how));
    const auto wishes = TRY(wanted.wishes(*rerun));
    const auto points = TRY(LogPoints::set(wishes, buses_of(*rerun), wanted.told));
    CompareTape tape(reader, {}, until);
    LogPlaces places(*points, [&] { return wanted.settled(*rerun); });
    follow(*rerun, *points);
    rerun->each_instant([&](Time at) {
        places.look();
        if (places.are_missing() || tape.difference()) rerun->stop();
        if (at >= until) points->close();
    });
    const Rerun::Ended ended = TRY(rerun->run(tape));
    TRY(places.ask());
    points->close();
    TRY(tape.end());
    if (tape.difference()) return not_the_same(*tape.difference());
    return std::min(ended.at, until);
}

}  // namespace vagus::record
