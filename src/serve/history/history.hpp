// All that is kept of a run, or of a trace that was opened: what the plan did, what happened on the
// bus, what variables were, where things were, what sensors and cameras saw. It is told the time
// with everything it is told, and answers for any instant and for any window of time.
//
//     History history;
//     history.begin({.kind = "simulated", .name = "WallFollow"});
//     history.plan(1, plans);                    // of the runner
//     history.trace(line);
//     reply(history.at({.t = 86.8, .events = 100}));
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "serve/history/event_past.hpp"
#include "serve/history/picture_past.hpp"
#include "serve/history/plan_past.hpp"
#include "serve/history/tape.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

constexpr size_t kTimelineWidthMax = 4000;  // pixels
constexpr size_t kTimelineWords = 16;       // curves of a timeline
constexpr size_t kInstantRanges = 256;
constexpr size_t kInstantWords = 20'000;  // words of one instant
constexpr size_t kInstantEvents = 2000;
constexpr size_t kWaysMax = 1024;  // robots whose ways are told

class History {
public:
    struct Beginning {
        uint64_t run = 0;                // tells runs apart
        std::string kind = "simulated";  // or "bus", "trace"
        std::string name = {};           // of the plan, the world, or the file
        PlanPast::Plans plans = {};      // empty: no plan, or one that is told later
        PlanPast::DocOf doc_of = [](const std::string& file) { return file; };
        double plan_seconds = kTraceSeconds;
    };
    // Forgets everything before.
    void begin(Beginning beginning);
    void end();
    // Another run, which has all of this one until an instant, that one included, and goes on from
    // there.
    void continue_from(double t, uint64_t run);

    // ---- what is told ----
    bool record(std::string_view bytes);
    bool trace(const std::string& line);
    // What the next lines of the trace are of: the first version of a plan, or the one that took
    // over. One that was told already changes nothing.
    void plan(uint64_t version, PlanPast::Plans plans, PlanPast::Texts texts = {});
    void picture(KeptPicture picture) { pictures_.add(std::move(picture)); }
    void happen(Happened event) { events_.add(std::move(event)); }
    void words(double t, uint16_t node, uint16_t address, std::span<const int16_t> values);
    void forget(double t, uint16_t node, uint16_t address, uint16_t count);
    // Time has passed, and nothing happened.
    void passed(double t) { passed_ = std::max(passed_, t); }

    // ---- what is asked ----
    struct Range {
        uint16_t node = 0, first = 0, count = 0;
    };
    struct Instant {
        double t = 0;
        std::vector<Range> ranges = {};
        size_t events = 0;
        bool rays = false;         // where sensors looked, and lamps
        std::string picture = {};  // of the camera of that robot; empty: none is asked for
    };
    struct Word {
        uint16_t node = 0, address = 0;
    };
    struct Window {
        double from = 0, to = 0;
        size_t width = 0;
        std::vector<Word> words = {};
    };
    bool empty() const { return kind_ == "none"; }
    uint64_t run() const { return run_; }
    double from() const;
    double to() const;
    // The topic history.
    Json document() const;
    // The answers of history.at and history.lanes.
    Json at(const Instant& instant) const;
    Json lanes(const Window& window) const;
    // The answer of history.ways.
    Json ways(double from, double to) const;
    // Of the outermost plan; empty without one.
    std::string plan_name() const { return plan_ ? plan_->name() : ""; }
    std::string trace_text() const { return plan_ ? plan_->text() : ""; }
    const PlanPast* plan() const { return plan_.get(); }
    const Tape& tape() const { return tape_; }
    const EventPast& events() const { return events_; }

private:
    void add_sights(Json& found, const TapeState& state, const Instant& instant) const;
    Json values_at(const TapeState& state, const std::vector<Range>& ranges) const;
    Json curve(const Word& word, const Window& window) const;
    Json loads(const Window& window) const;

    uint64_t run_ = 0;
    std::string kind_ = "none", name_;
    PlanPast::DocOf doc_of_;
    double plan_seconds_ = kTraceSeconds;
    std::unique_ptr<PlanPast> plan_;
    Tape tape_;
    EventPast events_;
    PicturePast pictures_;
    double passed_ = 0;
};

}  // namespace vagus::serve
