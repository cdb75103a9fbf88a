#include "run/real_time.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <vector>

#include "run/debugger.hpp"
#include "run/real_time_parts.hpp"
#include "run/real_time_watch.hpp"
#include "run/traced_variables.hpp"
#include "run/workers.hpp"

namespace vagus::run {

class RealTime::Engine final : private EventGate {
public:
    Engine(const plan::Graph& graph, const CodeLibrary& library, const RunOptions& options)
        : library_(library),
          options_(options),
          machine_(graph),
          random_(options.seed),
          numbers_(options.first_token),
          sleep_(options) {}

    Ended run();
    Lateness lateness() const { return lateness_.told(); }
    Inbox& inbox() { return inbox_; }

private:
    struct Code {
        plan::ActivationId activation = 0;
        std::unique_ptr<Actor> actor;
        std::unique_ptr<LiveContext> context;
        bool told = false;
        Duration grace{};
        std::optional<Time> grace_ends;
    };

    Time now() const { return clock_.now(); }

    void obey();
    void obey(plan::StartWatch& command);
    void obey(plan::StopWatch& command);
    void obey(plan::Activate& command);
    void obey(plan::StartCode& command);
    void obey(plan::StopCode& command);
    void obey(plan::RankAgain&) {}  // ties are as they arrive (P21)
    void obey(plan::SubPlanOver& command) { machine_.end_sub_plan(command.activation, now()); }

    void take(CodeOver& message);
    void take(Checked& message);
    void take(Logged& message) { machine_.log(message.activation, std::move(message.text), now()); }
    void take(Heard& message);
    void take(Written& message);
    void take(Aborted&) { machine_.abort(now()); }
    void take(RunFailed& message) { machine_.fail_run(message.why, now()); }
    void take(TokensMoved& message) { numbers_.move_to(message.token); }

    void start_due_checks();
    void start_check(Watching& watching);
    bool begin_watching(Watching& watching, const std::vector<plan::Value>& in);
    void end_watching(Watching& watching);
    void run_check(Watching& watching, Check check, std::optional<BusEvent> event, Time deadline);
    void begin_if_checked();
    void check_deadlines();
    void leave_checks();
    bool has_to_wait(const plan::Command& command) const;
    bool may_start(const Watching& watching) const;
    bool may_check(const Watching& watching) const;
    std::optional<Time> next_deadline() const;
    // ---- EventGate ----
    void close_gate() override {
        inbox_.give_back(std::exchange(taken_, {}));
        inbox_.close_gate();
    }
    void open_gate() override { inbox_.open_gate(); }
    HeldNow held() override { return inbox_.held(); }
    bool let_go(uint64_t number) override { return inbox_.let_go(number); }
    bool drop(uint64_t number) override { return inbox_.drop(number); }

    void let_debug();
    void stand_still();
    void go_on();
    Ended decide();
    void finish();
    void hand_out_trace();
    void hand_out(const plan::TraceEvent& event);

    const CodeLibrary& library_;
    const RunOptions& options_;
    plan::Machine machine_;
    SplitMix64 random_;
    Numbers numbers_;
    SleepWatch sleep_;
    const std::shared_ptr<Doors> doors_ = std::make_shared<Doors>();
    Inbox& inbox_ = doors_->inbox;
    RunClock& clock_ = doors_->clock;
    bool timed_out_ = false;
    std::deque<plan::Command> commands_;  // not yet obeyed
    std::deque<Posted> taken_;            // of the inbox, not yet looked at
    HeardEvents between_;                 // arrived while no code ran; for the next code
    std::map<plan::WatchId, Watching> watching_;
    EndingChecks ending_;
    plan::ActivationId begin_due_ = 0;
    bool begin_waits_ = false;  // for first checks
    std::optional<plan::TraceEvent> last_line_;
    std::map<plan::ActivationId, std::shared_ptr<Code>> code_;  // owners: this, and its thread
    LatenessSamples lateness_;
    Workers workers_;  // last: its threads end before what they use
};

Ended RealTime::Engine::run() {
    Debugger* const debugger = options_.debugger;
    if (debugger) debugger->attach(machine_, *this, [&inbox = inbox_] { inbox.nudge(); });
    clock_.start();
    let_debug();
    Ended ended{.result = plan::PlanResult::Interrupted, .message = {}};
    if (!debugger || !debugger->aborted()) ended = decide();
    if (debugger) debugger->detach({now(), ended.result, ended.message});
    return ended;
}

Ended RealTime::Engine::decide() {
    machine_.start(options_.set, Time{0});
    obey();
    while (!machine_.over()) {
        let_debug();
        begin_if_checked();
        let_debug();
        begin_if_checked();  // paused before that; events that came meanwhile come after it
        start_due_checks();
        obey();
        taken_ = inbox_.take();
        if (taken_.empty() && (begin_due_ == 0 || begin_waits_) && !machine_.over()) {
            if (begin_due_ == 0) machine_.time_passed();
            const std::optional<Time> next = next_deadline();
            inbox_.wait_until(next ? std::optional(clock_.point_of(*next)) : std::nullopt);
            taken_ = inbox_.take();
        }
        if (!machine_.over() && sleep_.has_slept()) machine_.abort(now());
        while (!taken_.empty()) {
            Posted first = std::move(taken_.front());
            taken_.pop_front();
            std::visit([this](auto& one) { take(one); }, first.message);
            obey();
            let_debug();
        }
        check_deadlines();
        obey();
    }
    finish();
    const bool failed = !machine_.message().empty();
    return {machine_.result(), failed ? machine_.message() : sleep_.sentence(), timed_out_};
}

// Nothing of the run may outlive it: what still runs is told to stop and waited for; a check only
// as P18b says. The line of the plan's end is the last one.
void RealTime::Engine::finish() {
    for (const auto& [activation, code] : code_) code->context->tell_to_stop();
    while (!watching_.empty()) {
        plan::StopWatch stop{watching_.begin()->first};
        obey(stop);
    }
    const auto take_all = [this] {
        for (Posted& posted : inbox_.take()) {
            std::visit([this](auto& one) { take(one); }, posted.message);
        }
    };
    inbox_.open_gate();  // code may wait for an answer of its node
    for (take_all(); ending_.waits(); leave_checks()) {
        inbox_.wait_until(clock_.point_of(*ending_.until()));
        take_all();
    }
    hand_out_trace();
    if (last_line_) hand_out(*last_line_);
    while (!code_.empty()) {
        inbox_.wait_until(std::nullopt);
        take_all();
    }
    take_all();  // what was emitted last, as supervisors stopped, belongs to the bus too
}

// ---- debugging ----

// Between two decisions: what a debugger asks is answered; while it pauses the run, here. Then no
// message is taken, no check starts, code is held at its waits, and the run's clock is stopped.
void RealTime::Engine::let_debug() {
    if (!options_.debugger) return;
    bool paused = false;
    for (bool more = true; more;) {
        if (options_.debugger->paused() && !paused) {
            paused = true;
            stand_still();
        }
        more = options_.debugger->serve(now());
        if (more) obey();
    }
    if (paused) go_on();
}

void RealTime::Engine::stand_still() {
    clock_.halt();
    for (const auto& [activation, code] : code_) code->context->hold();
}

void RealTime::Engine::go_on() {
    clock_.release();
    for (const auto& [activation, code] : code_) code->context->release();
}

// ---- what the machine wants ----

void RealTime::Engine::obey() {
    hand_out_trace();
    for (;;) {
        for (plan::Command& command : machine_.take_commands()) {
            commands_.push_back(std::move(command));
        }
        if (commands_.empty() || has_to_wait(commands_.front())) return;
        plan::Command command = std::move(commands_.front());
        commands_.pop_front();
        std::visit([this](auto& one) { obey(one); }, command);
        hand_out_trace();
    }
}

// What begins after supervisors have stopped: not while a check of theirs is waited for (P18b).
bool RealTime::Engine::has_to_wait(const plan::Command& command) const {
    const bool ends = std::holds_alternative<plan::StopWatch>(command) ||
                      std::holds_alternative<plan::StopCode>(command);
    return !ends && ending_.waits() && !machine_.over();
}

void RealTime::Engine::obey(plan::StartWatch& command) {
    if (!machine_.watching(command.watch)) return;  // stopped again while the command waited
    const bool by_events = command.supervisor->period_us == 0;
    watching_.emplace(command.watch,
                      Watching{.id = command.watch,
                               .level = command.level,
                               .path = machine_.path_at(command.level),
                               .of = command.supervisor,
                               .code = library_.make_supervisor(*command.supervisor->of),
                               .context = WatchContext(options_, inbox_, numbers_.next(),
                                                       command.supervisor->name),
                               .started = now(),
                               .next = now(),
                               .checked_at = now(),
                               .in = {},
                               .events = by_events ? between_.all() : std::deque<BusEvent>{},
                               .looks_at = {},
                               .job = {}});
}

void RealTime::Engine::obey(plan::Activate& command) {
    begin_due_ = command.activation;
    begin_waits_ = false;
}

void RealTime::Engine::obey(plan::StopWatch& command) {
    const auto found = watching_.find(command.watch);
    if (found == watching_.end()) return;
    Watching over = std::move(found->second);
    watching_.erase(found);
    if (over.busy) {
        ending_.add(std::move(over), now() + options_.check_ends_within);
    } else {
        end_watching(over);
    }
}

void RealTime::Engine::end_watching(Watching& watching) {
    watching.context.end();
    if (watching.begun) watching.code->stopped(watching.context);
}

void RealTime::Engine::obey(plan::StartCode& command) {
    auto code = std::make_shared<Code>();
    code->activation = command.activation;
    code->actor = library_.make_actor(*command.actor->of);
    const LiveContext::Of of{command.activation, numbers_.next(),
                             *code->actor,       command.actor->of->outputs.size(),
                             options_,           command.actor->name};
    code->context =
        std::make_unique<LiveContext>(std::move(command.in), of, inbox_, random_, clock_);
    code->grace = Duration{command.actor->of->grace_ms * 1000};
    for (const BusEvent& event : between_.take_all()) code->context->hear(event);
    code_[command.activation] = code;
    const auto body = [code, &inbox = inbox_] {
        CodeOver over{code->activation, {}, false, {}};
        try {
            code->actor->run(*code->context);
        } catch (const Stop&) {
        } catch (const std::exception& error) {
            over.failed = true;
            over.failure = error.what();
        }
        over.given = code->context->given();
        inbox.post(std::move(over));
    };
    if (command.actor->of->kind == plan::Kind::Computation) {
        body();  // it never waits
    } else {
        workers_.start(body);
    }
}

void RealTime::Engine::obey(plan::StopCode& command) {
    const auto found = code_.find(command.activation);
    if (found == code_.end()) {
        machine_.stopped(command.activation, now());
        return;
    }
    Code& code = *found->second;
    code.told = true;
    code.grace_ends = now() + code.grace;
    code.context->tell_to_stop();
}

// ---- what other threads tell ----

void RealTime::Engine::take(CodeOver& message) {
    const auto found = code_.find(message.activation);
    if (found == code_.end()) return;
    const bool told = found->second->told;
    // Code takes no time between its waits: events since the last one arrive after its end.
    for (BusEvent& event : found->second->context->take_unheard()) {
        if (!told) between_.push(event);
    }
    code_.erase(found);
    if (told) {
        const int level = machine_.stopping_level();
        for (auto& [id, watching] : watching_) {
            if (level >= 0 && watching.level >= level) watching.events.clear();
        }
        machine_.stopped(message.activation, now());
    } else if (message.failed) {
        machine_.fail(message.activation, message.failure, now());
    } else {
        machine_.end(message.activation, message.given, now());
    }
}

void RealTime::Engine::take(Checked& message) {
    lateness_.note(message.late);
    const auto found = watching_.find(message.watch);
    if (found == watching_.end()) {  // it has been stopped meanwhile: dropped (P18)
        if (auto over = ending_.take(message.watch)) end_watching(*over);
        return;
    }
    Watching& watching = found->second;
    watching.busy = false;
    watching.first_done = true;
    if (message.late > kLateness) machine_.late(message.watch, message.late, now());
    if (watching.period().count() > 0) {
        // The next whole multiple that lies ahead; one that an overrun has passed is left out.
        const Duration since = now() - watching.started;
        const Duration planned = watching.next - watching.started;
        if (since >= planned) {
            machine_.late(message.watch, since - planned + watching.period(), now());
            watching.next = watching.started + (since / watching.period() + 1) * watching.period();
        }
    }
    if (!may_check(watching)) return;  // its plan is being stopped: left out (P18a)
    if (message.failed) {
        machine_.fail_watch(message.watch, message.failure, now());
    } else if (message.given) {
        // The code that starts next does not hear it again.
        between_.pass(watching.looks_at);
        machine_.raise(message.watch, *message.given, now());
    }
}

void RealTime::Engine::take(Heard& message) {
    if (message.own && options_.on_emit) options_.on_emit(message.event);
    for (auto& [id, watching] : watching_) {
        if (watching.period().count() == 0 && may_check(watching)) {
            watching.events.push_back(message.event);
        }
    }
    if (message.own) return;  // code does not hear what it has said itself
    if (options_.debugger) options_.debugger->heard();
    if (options_.on_hear) options_.on_hear(message.event, now());
    if (code_.empty()) between_.push(message.event);
    for (const auto& [activation, code] : code_) code->context->hear(message.event);
}

void RealTime::Engine::take(Written& message) {
    if (machine_.over()) return;
    // A value that does not fit is the writer's to know: set() has checked it before.
    (void)machine_.write_outside(message.slot, message.value, now()).ok();
}

// ---- checks ----

// Never beside an earlier check of the same supervisor.
bool RealTime::Engine::may_start(const Watching& watching) const {
    return !watching.busy && may_check(watching) && !ending_.runs(watching.level, *watching.of);
}

bool RealTime::Engine::may_check(const Watching& watching) const {
    const int stopping = machine_.stopping_level();
    return stopping < 0 || watching.level < stopping;
}

void RealTime::Engine::start_due_checks() {
    std::vector<plan::WatchId> due;
    const Time at = now();
    for (const auto& [id, watching] : watching_) {
        if (!may_start(watching)) continue;
        const bool timed = !watching.waits_for_events && watching.next <= at;
        if (timed || !watching.events.empty()) due.push_back(id);
    }
    for (const plan::WatchId id : due) {
        const auto found = watching_.find(id);
        if (found != watching_.end()) start_check(found->second);
    }
}

void RealTime::Engine::start_check(Watching& watching) {
    const Time deadline = watching.next;
    Check check;
    check.since_start = deadline - watching.started;
    if (!watching.waits_for_events) {
        Result<std::vector<plan::Value>> in = machine_.read_inputs(watching.id);
        if (!in.ok()) {
            machine_.fail_watch(watching.id, in.error().what, now());
            return;
        }
        if (!begin_watching(watching, in.value())) return;
        if (watching.period().count() == 0) {
            watching.in = std::move(in.value());
            watching.waits_for_events = true;
            watching.first_done = true;
            return;
        }
        check.in = std::move(in.value());
        watching.next = deadline + watching.period();
        run_check(watching, std::move(check), std::nullopt, deadline);
        return;
    }
    BusEvent event = std::move(watching.events.front());
    watching.events.pop_front();
    check.in = watching.in;
    run_check(watching, std::move(check), std::move(event), now());
}

// Tells its code once that it watches. False: that has failed.
bool RealTime::Engine::begin_watching(Watching& watching, const std::vector<plan::Value>& in) {
    if (std::exchange(watching.begun, true)) return true;
    try {
        watching.code->started(in, watching.context);
        return true;
    } catch (const std::exception& error) {
        machine_.fail_watch(watching.id, error.what(), now());
        return false;
    }
}

void RealTime::Engine::run_check(Watching& watching, Check check, std::optional<BusEvent> event,
                                 Time deadline) {
    watching.busy = true;
    watching.checked_at = deadline;
    watching.looks_at = event ? event->name : "";
    watching.job =
        workers_.start([watch = watching.id, code = watching.code, check = std::move(check),
                        event = std::move(event), deadline, doors = doors_]() mutable {
            Checked checked{watch, std::nullopt, false, {}, {}};
            checked.late = doors->clock.now() - deadline;
            if (event) check.event = &*event;
            try {
                checked.given = code->check(check);
            } catch (const std::exception& error) {
                checked.failed = true;
                checked.failure = error.what();
            }
            code.reset();
            doors->inbox.post(std::move(checked));
        });
}

// The actor's code starts only after the first check of each of its supervisors (P16).
void RealTime::Engine::begin_if_checked() {
    if (begin_due_ == 0 || ending_.waits() || machine_.over()) return;
    start_due_checks();
    for (const auto& [id, watching] : watching_) {
        begin_waits_ = !watching.first_done;
        if (begin_waits_) return;
    }
    if (options_.debugger && options_.debugger->stops_before_begin()) return;
    machine_.begin(std::exchange(begin_due_, 0), now());
    obey();
}

// ---- time ----

void RealTime::Engine::check_deadlines() {
    const Time at = now();
    leave_checks();
    for (const auto& [activation, code] : code_) {
        if (code->grace_ends && *code->grace_ends < at) {
            code->grace_ends.reset();
            machine_.overstayed(activation, now());
            break;
        }
    }
    Debugger* const debugger = options_.debugger;
    if (debugger && debugger->instant() && *debugger->instant() <= at) debugger->reach_instant(at);
    if (options_.max_time && !timed_out_ && now() >= *options_.max_time && !machine_.over()) {
        timed_out_ = true;
        machine_.abort(now());
    }
}

// Those that have been waited for long enough.
void RealTime::Engine::leave_checks() {
    const Time at = now();
    for (const Watching* const left : ending_.leave(at)) {
        workers_.leave(left->job);
        hand_out_trace();
        hand_out({at, left->path, plan::CheckLate{left->of->name, at - left->checked_at}});
        if (last_line_) last_line_->at = at;
    }
}

std::optional<Time> RealTime::Engine::next_deadline() const {
    std::optional<Time> next;
    const auto consider = [&next](Time at) {
        if (!next || at < *next) next = at;
    };
    for (const auto& [id, watching] : watching_) {
        if (!watching.waits_for_events && may_start(watching)) consider(watching.next);
    }
    if (ending_.waits()) consider(*ending_.until());
    for (const auto& [activation, code] : code_) {
        if (code->grace_ends) consider(*code->grace_ends);
    }
    if (options_.max_time && !timed_out_) consider(*options_.max_time);
    if (options_.debugger && options_.debugger->instant()) consider(*options_.debugger->instant());
    return next;
}

void RealTime::Engine::hand_out_trace() {
    for (plan::TraceEvent& event : machine_.take_trace()) {
        const bool last =
            std::holds_alternative<plan::PlanEnded>(event.what) && level_of(event) == 0;
        if (last) {
            last_line_ = std::move(event);
        } else {
            hand_out(event);
        }
    }
}

void RealTime::Engine::hand_out(const plan::TraceEvent& event) {
    if (options_.debugger) options_.debugger->see(event);
    if (options_.on_trace) options_.on_trace(event);
}

RealTime::RealTime(const plan::Graph& graph, const CodeLibrary& library, const RunOptions& options)
    : engine_(std::make_unique<Engine>(graph, library, options)) {}

RealTime::~RealTime() = default;

Ended RealTime::run() {
    return engine_->run();
}

Lateness RealTime::lateness() const {
    return engine_->lateness();
}

void RealTime::abort() {
    engine_->inbox().post(Aborted{});
}

void RealTime::fail(std::string why) {
    engine_->inbox().post(RunFailed{std::move(why)});
}

void RealTime::set(int slot, plan::Value value) {
    engine_->inbox().post(Written{slot, std::move(value)});
}

void RealTime::hear(BusEvent event) {
    engine_->inbox().post_bounded(Heard{std::move(event), false});
}

void RealTime::move_tokens(uint16_t token) {
    engine_->inbox().post(TokensMoved{token});
}

}  // namespace vagus::run
