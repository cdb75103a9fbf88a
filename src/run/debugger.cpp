#include "run/debugger.hpp"

#include <fmt/format.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>

#include "base/nearest.hpp"
#include "run/debug_view.hpp"

namespace vagus::run {

namespace {

struct PostedRequest {
    uint64_t number;
    Request request;
};

// Both directions between the deciding thread and all others.
class Mailbox {
public:
    Result<uint64_t> post(Request request) {
        const std::lock_guard lock(mutex_);
        if (requests_.size() >= kDebugQueueMax) {
            return Error{Code::Limit, fmt::format("{} requests wait already: the run does not "
                                                  "come to answer them",
                                                  kDebugQueueMax)};
        }
        requests_.push_back({++last_, std::move(request)});
        waiting_ = true;
        came_.notify_one();
        // Under the lock, so that the executor lives as long as the call.
        if (wake_) wake_();
        return last_;
    }

    void report(Report report) {
        {
            const std::lock_guard lock(mutex_);
            if (reports_.size() >= kDebugQueueMax) reports_.pop_front();
            reports_.push_back(std::move(report));
        }
        reported_.notify_one();
    }

    std::optional<Report> wait_report(Duration at_most) {
        std::unique_lock lock(mutex_);
        // To wait for no time takes some, and some ask at each instant.
        if (at_most > Duration::zero()) {
            reported_.wait_for(lock, at_most, [this] { return !reports_.empty(); });
        }
        if (reports_.empty()) return std::nullopt;
        Report report = std::move(reports_.front());
        reports_.pop_front();
        return report;
    }

    void set_wake(std::function<void()> wake) {
        const std::lock_guard lock(mutex_);
        wake_ = std::move(wake);
    }

    std::optional<PostedRequest> take() {
        if (!waiting_) return std::nullopt;
        const std::lock_guard lock(mutex_);
        return take_locked();
    }

    PostedRequest wait() {
        std::unique_lock lock(mutex_);
        came_.wait(lock, [this] { return !requests_.empty(); });
        return *take_locked();
    }

private:
    std::optional<PostedRequest> take_locked() {
        if (requests_.empty()) return std::nullopt;
        PostedRequest posted = std::move(requests_.front());
        requests_.pop_front();
        waiting_ = !requests_.empty();
        return posted;
    }

    std::mutex mutex_;
    std::condition_variable came_;
    std::condition_variable reported_;
    std::deque<PostedRequest> requests_;
    std::deque<Report> reports_;
    std::function<void()> wake_;
    uint64_t last_ = 0;
    std::atomic<bool> waiting_ = false;  // so that a decision costs no lock
};

const Error kNothingHeld{Code::NotFound, "no event of the bus waits for the plan"};
const Error kNotHeld{Code::NotFound, "that event does not wait any more: it was let go or dropped"};
const Error kNotPaused{Code::Refused, "the plan runs; pause it first"};
// A line of the trace that tells of something that the plan itself has done.
bool is_doing(const plan::TraceEvent& event) {
    return !std::holds_alternative<plan::CheckLate>(event.what) &&
           !std::holds_alternative<plan::PlanChanged>(event.what);
}

const Error kNotStarted{Code::Refused,
                        "the run has not started; step to its first actor, or give values at the "
                        "start with --set NAME=VALUE"};

}  // namespace

class Debugger::Core {
public:
    Core(const plan::Graph& graph, At first) : first_(first), breakpoints_(graph) {}

    Result<Reply> answer(AddBreakpoint& asked) {
        const int id = TRY(breakpoints_.add(std::move(asked.breakpoint)));
        return Reply(id);
    }
    Result<Reply> answer(RemoveBreakpoint& asked) { return reply(breakpoints_.remove(asked.id)); }
    Result<Reply> answer(EnableBreakpoint& asked) {
        return reply(breakpoints_.enable(asked.id, asked.enabled));
    }
    Result<Reply> answer(ListBreakpoints&) { return Reply(breakpoints_.list()); }
    Result<Reply> answer(Pause& asked) {
        if (asked.at && *asked.at > now_) {
            instant_ = asked.at;
        } else if (!paused_) {
            stop(Stopped::Why::Asked);
        }
        return Reply(Done{});
    }
    Result<Reply> answer(Continue& asked) {
        const bool met = why_ == Stopped::Why::Breakpoint || why_ == Stopped::Why::Step;
        if (paused_ && met && !asked.from_met) return Reply(Done{});
        return go_on(false);
    }
    Result<Reply> answer(Step&) { return go_on(true); }
    Result<Reply> answer(Abort&) {
        abort_asked_ = true;
        paused_ = false;
        gate_->open_gate();  // code that is told to stop may wait for an answer of its node
        machine_->abort(now_);
        return Reply(Done{});
    }
    Result<Reply> answer(AskWhere&) { return Reply(where()); }
    Result<Reply> answer(Evaluate& asked) {
        return as_reply(evaluate(*machine_, asked.level, asked.expression));
    }
    Result<Reply> answer(SetVariable& asked) {
        if (!paused_) return kNotPaused;
        if (machine_->depth() == 0) return kNotStarted;
        const int slot = TRY(find_variable(*machine_, asked.level, asked.name));
        const Status written = machine_->write_outside(asked.level, slot, asked.value, now_);
        if (written.ok()) return Reply(Done{});
        return Error{Code::BadInput,
                     fmt::format("the variable {}: {}", asked.name, written.error().what)};
    }
    Result<Reply> answer(RaiseEvent& asked) {
        if (!paused_) return kNotPaused;
        if (machine_->depth() == 0) return kNotStarted;
        const Raised raised =
            TRY(find_raised(*machine_, asked.supervisor, asked.event, asked.outputs));
        machine_->raise(raised.watch, raised.given, now_);
        return Reply(Done{});
    }

    Result<Reply> answer(TakeVersion& asked) {
        return Reply(Change{asked.only_ask ? machine_->reasons_against(asked.next)
                                           : machine_->change(asked.next, now_)});
    }

    Result<Reply> answer(ListHeld&) { return Reply(gate_->held()); }
    Result<Reply> answer(LetGo& asked) {
        return for_held(asked.number, [this](uint64_t number) { return gate_->let_go(number); });
    }
    Result<Reply> answer(DropHeld& asked) {
        return for_held(asked.number, [this](uint64_t number) { return gate_->drop(number); });
    }
    Result<Reply> answer(StepEvent& asked) {
        if (!paused_) return kNotPaused;
        const HeldNow now = gate_->held();
        if (!asked.number) {
            if (now.events.empty()) return kNothingHeld;
            asked.number = now.events.front().number;
        }
        if (!gate_->let_go(*asked.number)) return kNotHeld;
        paused_ = false;
        event_step_ends_ = now_ + kEventStep;
        return Reply(Done{});
    }

    Where where() const {
        Where seen = look(*machine_);
        seen.at = now_;
        seen.paused = paused_;
        return seen;
    }

    void stop(Stopped::Why why, std::vector<int> breakpoints = {}) {
        paused_ = true;
        step_ = false;
        event_step_ends_.reset();
        event_step_heard_ = false;
        if (why != Stopped::Why::Start) gate_->close_gate();
        why_ = why;
        mailbox_.report(Stopped{why, std::move(breakpoints), where()});
    }

    // Pauses for what was met since the last decision.
    void stop_if_met() {
        add(breakpoints_.settle());
        const bool pauses = stepped_ || !met_.empty();
        if (pauses && !paused_ && !machine_->over()) {
            stop(met_.empty() ? Stopped::Why::Step : Stopped::Why::Breakpoint, met_);
        }
        met_.clear();
        stepped_ = false;
    }

    // A run that has not begun has no plan yet that could change.
    bool must_wait(const PostedRequest& posted) const {
        return std::holds_alternative<TakeVersion>(posted.request) && machine_->depth() == 0;
    }

    std::optional<PostedRequest> next_request() {
        if (!waiting_.empty() && machine_->depth() > 0) {
            std::optional<PostedRequest> first = std::move(waiting_.front());
            waiting_.pop_front();
            return first;
        }
        return paused_ ? std::optional(wait()) : mailbox_.take();
    }

    // Done for that one, or for all that wait: what has arrived and was not listed yet is among
    // them.
    template <typename Act>
    Result<Reply> for_held(std::optional<uint64_t> number, const Act& act) {
        if (!paused_) return kNotPaused;
        const HeldNow now = gate_->held();
        if (number) return act(*number) ? Result<Reply>(Done{}) : kNotHeld;
        for (const HeldEvent& one : now.events) (void)act(one.number);
        return Reply(Done{});
    }

    void add(std::vector<int> hits) { met_.insert(met_.end(), hits.begin(), hits.end()); }

    static Result<Reply> reply(const Status& status) {
        if (!status.ok()) return status.error();
        return Reply(Done{});
    }
    static Result<Reply> as_reply(Result<plan::Value> value) {
        if (!value.ok()) return value.error();
        return Reply(std::move(value.value()));
    }

    const At first_;
    // The next request; while there is none, what else the thread has to do.
    PostedRequest wait() {
        if (!meanwhile_) return mailbox_.wait();
        for (;;) {
            if (auto posted = mailbox_.take()) return std::move(*posted);
            meanwhile_();
        }
    }

    Mailbox mailbox_;
    // From here on: the deciding thread's.
    std::function<void()> meanwhile_;
    Follower follower_;
    uint64_t place_ = 0;  // of the run, for the follower
    Breakpoints breakpoints_;
    plan::Machine* machine_ = nullptr;
    EventGate* gate_ = nullptr;
    Time now_{0};
    bool paused_ = false;
    Stopped::Why why_ = Stopped::Why::Start;
    bool step_ = false;     // stop before the next begin
    bool stepped_ = false;  // that is now
    bool abort_asked_ = false;
    std::deque<PostedRequest> waiting_;  // for the run to begin
    std::vector<int> met_;               // breakpoints, in this decision
    std::optional<Time> instant_;        // at which to pause
    // While it runs with one event alone: it stops at the next thing it does, or then.
    std::optional<Time> event_step_ends_;
    bool event_step_heard_ = false;  // the plan has it: what it does from here on is the next thing
    plan::ActivationId announced_ = 0;  // whose begin has been stopped at, or let pass

private:
    Result<Reply> go_on(bool step) {
        if (!paused_) return Error{Code::Refused, "the plan runs already"};
        paused_ = false;
        step_ = step;
        gate_->open_gate();
        return Reply(Done{});
    }
};

Debugger::Debugger(const plan::Graph& graph, At first)
    : core_(std::make_unique<Core>(graph, first)) {}
Debugger::~Debugger() = default;

Result<uint64_t> Debugger::post(Request request) {
    return core_->mailbox_.post(std::move(request));
}

std::optional<Report> Debugger::wait_report(Duration at_most) {
    return core_->mailbox_.wait_report(at_most);
}

void Debugger::while_paused(std::function<void()> meanwhile) {
    core_->meanwhile_ = std::move(meanwhile);
}

void Debugger::follow(Follower follower) {
    core_->follower_ = std::move(follower);
}

void Debugger::attach(plan::Machine& machine, EventGate& gate, std::function<void()> wake) {
    Core& core = *core_;
    core.machine_ = &machine;
    core.gate_ = &gate;
    core.now_ = Time{0};
    core.place_ = 0;
    core.breakpoints_.start_again();
    core.met_.clear();
    core.waiting_.clear();
    core.step_ = core.stepped_ = core.abort_asked_ = false;
    core.instant_.reset();
    core.event_step_ends_.reset();
    core.event_step_heard_ = false;
    core.announced_ = 0;
    core.paused_ = false;
    core.mailbox_.set_wake(std::move(wake));
    if (core.first_ == At::Start) core.stop(Stopped::Why::Start);
}

bool Debugger::serve(Time now) {
    Core& core = *core_;
    core.now_ = now;
    const bool was_paused = core.paused_;
    core.stop_if_met();
    if (core.paused_ && !was_paused) return true;  // the executor first pauses everything
    if (core.abort_asked_ || core.machine_->over()) return false;
    if (core.follower_.comes) core.follower_.comes(core.place_, now);
    std::optional<PostedRequest> posted = core.next_request();
    if (!posted) {
        ++core.place_;
        return false;
    }
    if (core.follower_.asked) core.follower_.asked(posted->request, now);
    if (core.must_wait(*posted)) {
        core.waiting_.push_back(std::move(*posted));
        return true;
    }
    Result<Reply> reply =
        std::visit([&core](auto& asked) { return core.answer(asked); }, posted->request);
    core.mailbox_.report(Answer{posted->number, std::move(reply)});
    return true;
}

bool Debugger::paused() const {
    return core_->paused_;
}

bool Debugger::aborted() const {
    return core_->abort_asked_;
}

void Debugger::see(const plan::TraceEvent& event) {
    core_->add(core_->breakpoints_.see(event));
    if (core_->event_step_heard_ && is_doing(event)) core_->stepped_ = true;
}

void Debugger::heard() {
    core_->event_step_heard_ = core_->event_step_ends_.has_value();
}

std::vector<std::string> Debugger::reasons_against(const plan::NewVersion& next) const {
    if (!core_->machine_) return {"the run has ended or not begun: there is nothing to change"};
    return core_->machine_->reasons_against(next);
}

bool Debugger::stops_before_begin() {
    Core& core = *core_;
    const int level = core.machine_->depth() - 1;
    const plan::ActivationId activation = core.machine_->activation_at(level);
    if (core.announced_ == activation) return false;
    core.announced_ = activation;
    core.add(core.breakpoints_.settle());
    core.add(core.breakpoints_.before_begin(level, *core.machine_->actor_at(level)));
    core.stepped_ = core.step_ || core.event_step_heard_;
    return core.stepped_ || !core.met_.empty();
}

std::optional<Time> Debugger::instant() const {
    const auto& [asked, step] = std::pair(core_->instant_, core_->event_step_ends_);
    return asked && step ? std::min(asked, step) : asked ? asked : step;
}

void Debugger::reach_instant(Time now) {
    Core& core = *core_;
    core.now_ = now;
    const bool asked = core.instant_ && *core.instant_ <= now;
    if (asked) core.instant_.reset();
    if (!core.paused_) core.stop(asked ? Stopped::Why::Instant : Stopped::Why::Step);
}

void Debugger::detach(const RunOver& over) {
    core_->mailbox_.set_wake({});
    core_->paused_ = false;
    core_->machine_ = nullptr;
    core_->gate_ = nullptr;
    core_->mailbox_.report(over);
}

}  // namespace vagus::run
