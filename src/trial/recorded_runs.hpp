// Coverage of recorded runs, also of real robots: of plans, everything in their traces; of scripts
// on the nodes of a real bus, the lines that frames prove, because no other line sends that event.
//
//     RecordedRuns recorded;
//     recorded.know("WallFollow.plan.json", text);    // a file of other runs that are counted
//     const CountedRun one = TRY(recorded.add(reader));
//     all.add(recorded.coverage());
//
// A file of a recording with the same content as a known file counts as that file. Other versions
// are counted separately: a plan that was changed has not been run yet.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "mcap/reader.hpp"
#include "plan/model.hpp"
#include "trial/coverage.hpp"

namespace vagus::trial {

struct CountedRun {
    std::string plan;      // how coverage() calls its file
    bool of_bus = false;   // of a real robot
    Time end{};            // up to when it was counted
    bool changed = false;  // there another version of the plan took over
};

class RecordedRuns {
public:
    void know(const std::string& path, std::string content);
    // The Error names the recording, and why there is nothing to count.
    Result<CountedRun> add(const mcap::Reader& reader);

    const Coverage& coverage() const { return coverage_; }
    // Of those plans, each file once and named as there: to be drawn.
    const std::vector<plan::Plan>& plans() const { return plans_; }

private:
    std::string name_of(const mcap::Reader& reader, const std::string& file);

    Coverage coverage_;
    std::vector<plan::Plan> plans_;
    std::map<std::string, std::string> files_;  // what is in them, by how they are called
};

}  // namespace vagus::trial
