// A recorded run that is run again, all of it, for what its log points tell (log_points.hpp).
//
//     const auto wishes = [](Rerun&) -> Wishes {
//         return std::vector<LogWish>{{"drive:42", "token, patience"}};
//     };
//     const Time until = TRY(log_run(reader, {.wishes = wishes, .told = show}));
//
// Of a run that goes on there is what was written by now.
#pragma once

#include <functional>
#include <vector>

#include "base/result.hpp"
#include "mcap/reader.hpp"
#include "record/log_points.hpp"
#include "record/replay.hpp"

namespace vagus::record {

using Wishes = Result<std::vector<LogWish>>;

struct LogRun {
    std::function<Wishes(Rerun& rerun)> wishes;  // before it runs
    LogPoints::Told told;
    // Their places are there; before anything is told that comes later.
    std::function<Status(Rerun& rerun)> settled = [](Rerun&) { return Status::done(); };
};

// What log points are of in a run that is run again.
std::vector<LogPoints::Bus> buses_of(Rerun& rerun);
// Before its run: they are told what they need of it. Borrowed for the run.
void follow(Rerun& rerun, LogPoints& points);

// Up to when it was asked. The Error says what is not there, as soon as that is known, or that the
// run has not come out as it was recorded, so that what was told counts for nothing.
Result<Time> log_run(const mcap::Reader& reader, const LogRun& wanted);

}  // namespace vagus::record
