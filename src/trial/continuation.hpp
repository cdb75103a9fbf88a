// A recorded run that is continued: from an instant on with another seed, until a condition
// becomes true (turning.hpp). It is opened once; each run of it is for a process of its own, that
// begins as a copy of this one and ends with the run.
//
//     const auto continued = TRY(Continued::open(reader, "contact >= 2", until));
//     const RunEnd end = TRY(continued->as_it_was());                  // in a child
//     const auto other = TRY(continued->from_each(at, seeds, split));  // in another one
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "mcap/reader.hpp"
#include "plan/graph.hpp"
#include "record/replay.hpp"
#include "trial/awaited.hpp"
#include "trial/turning.hpp"

namespace vagus::trial {

// Whether it became true, and until when the run was looked at.
struct RunEnd {
    std::optional<Time> came = {};
    Time end{};
    friend bool operator==(const RunEnd&, const RunEnd&) = default;
};

class Continued {
public:
    // The reader is borrowed. Runs end at `until` at the latest; empty: when the recording does.
    // `robot`: whose condition it is, where robots have projects of their own. The Error says what
    // is wrong with the condition, or why the run cannot be continued: it needs a world, and nobody
    // may have stepped it or stopped it at a breakpoint.
    static Result<std::unique_ptr<Continued>> open(const mcap::Reader& reader,
                                                   std::string_view condition,
                                                   std::optional<Time> until,
                                                   const std::string& robot = "");
    Continued(const Continued&) = delete;
    Continued& operator=(const Continued&) = delete;

    const Condition& condition() const { return condition_; }
    Time until() const { return until_; }

    // ---- one of these, once: in a process of its own ----
    Result<RunEnd> as_it_was();
    // Continued from one instant with each of these seeds; the run up to there is done once.
    // `split` makes a copy of this process: true in the copy, which continues and gets what became
    // of it; false here, when the copy has ended. In the end there is nothing here.
    Result<std::optional<RunEnd>> from_each(Time at, std::span<const uint64_t> seeds,
                                            const std::function<bool()>& split);
    // Recorded, to its end.
    Status record(const Continuation& start, const std::string& file);

private:
    Continued(const mcap::Reader& reader, Condition condition, std::unique_ptr<record::Rerun> rerun)
        : reader_(reader), condition_(std::move(condition)), rerun_(std::move(rerun)) {}
    Status choose_bus(const std::string& robot);
    Status bind();
    enum class Ends : uint8_t { WhenItCame, AtItsEnd };
    Result<RunEnd> run(record::Tape& tape, Ends ends);

    const mcap::Reader& reader_;
    Condition condition_;
    std::unique_ptr<record::Rerun> rerun_;
    record::RunBus bus_;    // that the condition is about
    size_t bus_index_ = 0;  // in rerun_->buses()
    plan::Graph no_plan_;   // of a world without one
    Time until_{};
};

// One line, for a pipe between our own processes, and back.
std::string format_run_end(const RunEnd& end);
RunEnd read_run_end(std::string_view text);

}  // namespace vagus::trial
