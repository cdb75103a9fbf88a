// The supervisors of a RealTime run: those that watch, and those that are over while a check of
// theirs still runs (P18b). Only real_time.cpp includes this.
#pragma once

#include <deque>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "run/real_time_parts.hpp"
#include "run/workers.hpp"

namespace vagus::run {

// Used on the deciding thread only.
class WatchContext final : public SupervisorContext {
public:
    // All are borrowed for the run.
    WatchContext(const RunOptions& options, Inbox& inbox, uint64_t number, std::string_view name)
        : options_(&options), inbox_(&inbox), number_(number), name_(name) {}

    void emit(BusEvent event) override {
        if (!over_) throw_if_refused(*options_, event);
        event.by = name_;
        inbox_->post(Heard{std::move(event), true});
    }
    uint64_t number() const override { return number_; }
    // The watching is over: from now on there is nobody to throw to.
    void end() { over_ = true; }

private:
    const RunOptions* options_;
    Inbox* inbox_;
    uint64_t number_;
    std::string_view name_;
    bool over_ = false;
};

struct Watching {
    plan::WatchId id;
    int level;
    std::string path;  // of its plan
    const plan::GraphSupervisor* of;
    std::shared_ptr<Supervisor> code;  // owners: this, and the check that runs
    WatchContext context;
    Time started;
    Time next;
    Time checked_at;                // when the check that runs, or ran last, was due
    bool waits_for_events = false;  // period 0, its inputs are read
    bool begun = false;             // its code knows that it watches
    bool busy = false;              // a check runs
    bool first_done = false;
    std::vector<plan::Value> in;
    std::deque<BusEvent> events;
    std::string looks_at;  // name of the event that the check looks at
    Workers::Job job;      // the check

    Duration period() const { return Duration{of->period_us}; }
};

// Those that are over, each with a check that runs. It is waited for up to a time; then it is left
// to itself.
class EndingChecks {
public:
    void add(Watching watching, Time until) { all_.push_back({std::move(watching), until, false}); }

    // Whether one of them is waited for, and up to when for the first that is left.
    bool waits() const { return until().has_value(); }
    std::optional<Time> until() const {
        std::optional<Time> first;
        for (const Ending& one : all_) {
            if (!one.left && (!first || one.until < *first)) first = one.until;
        }
        return first;
    }

    // Those whose time is over now; they are no longer waited for. Valid until the next call.
    std::vector<const Watching*> leave(Time now) {
        std::vector<const Watching*> late;
        for (Ending& one : all_) {
            if (one.left || one.until > now) continue;
            one.left = true;
            late.push_back(&one.watching);
        }
        return late;
    }

    // Its check has returned; nothing if there is no such one.
    std::optional<Watching> take(plan::WatchId id) {
        for (auto one = all_.begin(); one != all_.end(); ++one) {
            if (one->watching.id != id) continue;
            std::optional<Watching> over = std::move(one->watching);
            all_.erase(one);
            return over;
        }
        return std::nullopt;
    }

    // Whether a check of this supervisor of the plan at that level still runs. By its name, which
    // no other there has: after a change (P31) another version may have started it.
    bool runs(int level, const plan::GraphSupervisor& of) const {
        for (const Ending& one : all_) {
            const plan::GraphSupervisor& other = *one.watching.of;
            const bool same = one.watching.level == level && other.name == of.name;
            if (same && other.of == of.of) return true;
        }
        return false;
    }

private:
    struct Ending {
        Watching watching;
        Time until;
        bool left;
    };
    std::list<Ending> all_;
};

}  // namespace vagus::run
