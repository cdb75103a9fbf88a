// The trace of a plan's run, and what it says of any instant: the document of the topic plan as it
// was then, and the lanes of a timeline. The lines are kept in blocks, each of which begins with
// what a follower knew; the oldest blocks are dropped.
//
//     PlanPast past(plans, doc_of, 3600);
//     past.add(line);
//     show(past.at(86.8));
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plan/check.hpp"
#include "serve/follow/plan_follower.hpp"
#include "serve/history/lane.hpp"
#include "serve/history/trace_line.hpp"

namespace vagus::serve {

constexpr size_t kTraceBlockLines = 500;
constexpr size_t kTraceLines = 200'000;
constexpr size_t kTraceBytes = 32u << 20;
constexpr size_t kPlanLanesMax = 500;
constexpr size_t kPlanVersions = 1000;  // of one run; after that the past shows the last of them
constexpr double kTraceSeconds = 3600;  // of a run; a trace that is opened is kept whole

class PlanPast {
public:
    using Plans = PlanOutlines;
    using Texts = std::map<std::string, std::string>;  // by document; empty: nobody told them
    using DocOf = std::function<std::string(const std::string& file)>;

    PlanPast() = default;
    // The plans that run, the outermost first; `seconds` is how long lines are kept.
    PlanPast(Plans plans, DocOf doc_of, double seconds, Texts texts = {});

    // False: this is no line of a trace, and it is not kept.
    bool add(const std::string& line);
    // From the last line on this version of the plan runs (P31), counted from 1; what was before
    // keeps its own. False: it is none that follows, and nothing changes.
    bool change(uint64_t version, Plans plans, Texts texts = {});
    // As if nothing had been told after that instant.
    void cut(double t);
    bool empty() const { return blocks_.empty(); }
    std::string name() const { return plans_->front().name; }
    double from() const { return blocks_.empty() ? 0 : blocks_.front().from; }
    double to() const { return to_; }
    size_t bytes() const { return bytes_; }
    // Lines that are not kept any more.
    uint64_t dropped() const { return dropped_; }
    size_t line_count() const { return lines_; }

    // The document of the topic plan; of no plan before the first line that is kept.
    nlohmann::json at(double t) const;
    // What a document of the version that ran then said; nothing: it was not of it.
    std::optional<std::string> text_at(double t, const std::string& doc) const;
    // Actors by plan, then supervisors: HistoryLane of the protocol.
    std::vector<nlohmann::json> lanes(const LaneWindow& window) const;
    // The trace as a file.
    std::string text() const;
    // The next instant after t, or the last one before it, at which an actor ended or an event was
    // raised.
    std::optional<double> next_step(double t) const;
    std::optional<double> step_before(double t) const;

private:
    struct Block {
        PlanFollower before;
        PlanFollower::Plans plans;  // that it was told with, their texts and their number
        std::shared_ptr<const Texts> texts;
        uint64_t version = 1;
        double from = 0, to = 0;
        std::vector<std::string> lines = {};
        size_t bytes = 0;
    };
    void begin_block(double t);
    const Block* block_at(double t) const;
    void again(const std::string& text, double until);
    void keep(const std::string& text, double t);
    void bound();
    void see(const plan::TraceEvent& event, double t);
    void step_at(double t);
    void watch(double t, std::string_view without_path = {});
    Lane* lane(const char* kind, const std::string& path, const std::string& name);

    PlanFollower::Plans plans_;  // the version that runs
    std::shared_ptr<const Texts> texts_ = std::make_shared<const Texts>();
    uint64_t version_ = 1;  // its number
    DocOf doc_of_;
    double seconds_ = kTraceSeconds;
    std::optional<PlanFollower> now_;
    std::deque<Block> blocks_;
    std::deque<Lane> actors_, supervisors_;
    std::deque<double> steps_;
    double to_ = 0;
    size_t bytes_ = 0, lines_ = 0;
    uint64_t dropped_ = 0;
};

// The plan of a file with all its sub-plans, as far as they can be read: from the disk, or there.
PlanPast::Plans read_plans(const std::string& file);
PlanPast::Plans read_plans(const std::string& file, const plan::Files& files);

}  // namespace vagus::serve
