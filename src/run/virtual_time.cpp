#include "run/virtual_time.hpp"

#include <algorithm>
#include <cassert>
#include <deque>
#include <exception>
#include <tuple>
#include <utility>

#include "run/code_source.hpp"
#include "run/debugger.hpp"
#include "run/heard_events.hpp"
#include "run/kept_events.hpp"
#include "run/surroundings.hpp"

namespace vagus::run {

using plan::Machine;

namespace {

constexpr std::string_view kNoEvent("\0", 1);  // no event of a bus is called this

// A wait of `length` that begins at `now` ends then; kNever stays never.
Time after(Time now, Duration length) {
    if (length == kNever || length > kNever - now) return kNever;
    return now + std::max(length, Duration{0});
}

}  // namespace

class VirtualTime::WatchContext final : public SupervisorContext {
public:
    WatchContext(VirtualTime& run, std::string_view name)
        : run_(run), name_(name), number_(run.numbers_.next()) {}

    void emit(BusEvent event) override {
        if (!over_) throw_if_refused(run_.options_, event);
        event.by = name_;
        event.cause = run_.trigger_;
        run_.emit(event);
    }
    uint64_t number() const override { return number_; }
    // The watching is over: from now on there is nobody to throw to.
    void end() { over_ = true; }

private:
    VirtualTime& run_;
    std::string_view name_;
    uint64_t number_;
    bool over_ = false;
};

// A supervisor that watches.
struct VirtualTime::Watching {
    plan::WatchId id;
    int level;
    bool global;
    int index;
    const plan::GraphSupervisor* of;
    std::unique_ptr<Supervisor> code;
    WatchContext context;
    Time started;
    Time next;                      // of the next check; kNever: waits for events
    bool begun = false;             // its code knows that it watches
    std::vector<plan::Value> in{};  // with period 0: read at the start
    std::deque<BusEvent> events{};  // with period 0: heard, not yet checked

    std::tuple<int, bool, int> rank() const { return {level, !global, index}; }  // P21
    Duration period() const { return Duration{of->period_us}; }
    bool due(Time now) const { return next <= now || !events.empty(); }
    // The first whole multiple of the period after `now`.
    void move_beyond(Time now) {
        next =
            period().count() == 0 ? kNever : started + ((now - started) / period() + 1) * period();
    }
};

// The code of the innermost actor: it runs, or has run to its end.
struct VirtualTime::Code final : FiberCode {
    void run() override;

    plan::ActivationId activation = 0;
    std::string_view name;
    std::unique_ptr<Actor> actor;
    std::unique_ptr<Context> context;
    std::string failure;  // what it threw, if that was no Stop
    bool failed = false;
    bool ended = false;  // run() has returned or thrown; `wake` is when that counts
    bool told = false;
    Time told_at{};
    Time wake{};  // when its wait ends
    Time grace_ends = kNever;
    std::string event;        // that ends its wait; empty: any
    bool waits_kept = false;  // a kept event ends its wait
    uint32_t heard = 0;       // number of the frame that it heard last
};

class VirtualTime::Context final : public ActorContext {
public:
    Context(VirtualTime& run, Code& code, std::vector<plan::Value> in, size_t outputs)
        : ActorContext(std::move(in), outputs, run.numbers_.next()), run_(run), code_(code) {}

    Time now() const override { return run_.now_; }

    void linger(Duration time) override {
        code_.wake = after(run_.now_, time);
        code_.event = std::string(kNoEvent);
        run_.fiber_->give_back();
    }

    void log(std::string text) override {
        run_.machine_.log(code_.activation, std::move(text), run_.now_);
    }

    // The executor waits while code runs, so its state is the code's to use.
    void emit(BusEvent event) override {
        throw_if_refused(run_.options_, event);
        event.by = code_.name;
        event.cause = code_.heard;
        run_.emit(event);
    }

    SplitMix64& random() override { return run_.random_; }

    void listen(std::vector<std::string> names) override { kept_.listen(std::move(names)); }

    void wake_with(Woken woken) { woken_ = std::move(woken); }
    bool keep(const BusEvent& event) { return kept_.offer(event); }
    void overhear(const BusEvent& event) { heard_.push(event); }
    std::deque<BusEvent> take_unheard() { return heard_.take_all(); }

protected:
    Woken wait(Duration at_most, std::string_view event) override {
        woken_ = {.stop = false, .event = heard_.take(event)};
        code_.wake = woken_.event ? run_.now_ : after(run_.now_, at_most);
        code_.event = std::string(event);
        run_.fiber_->give_back();
        if (woken_.event) code_.heard = woken_.event->frame;
        return std::move(woken_);
    }

    Woken wait_kept(Duration at_most) override {
        if (kept_.empty()) {
            code_.waits_kept = true;
            const Woken woken = wait(at_most, kNoEvent);
            code_.waits_kept = false;
            if (woken.stop) return woken;
        }
        Woken woken{.stop = false, .event = kept_.take()};
        if (woken.event) code_.heard = woken.event->frame;
        return woken;
    }

private:
    VirtualTime& run_;
    Code& code_;
    Woken woken_;
    HeardEvents heard_;  // at this instant, when its wait was over already
    KeptEvents kept_;
};

void VirtualTime::Code::run() {
    try {
        actor->run(*context);
    } catch (const Stop&) {
    } catch (const std::exception& error) {
        failed = true;
        failure = error.what();
    }
    ended = true;
}

VirtualTime::VirtualTime(const plan::Graph& graph, const CodeLibrary& library,
                         const RunOptions& options)
    : library_(library),
      options_(options),
      machine_(graph),
      random_(options.seed),
      numbers_(options.first_token) {}

VirtualTime::~VirtualTime() = default;

Ended VirtualTime::run() {
    Debugger* const debugger = options_.debugger;
    if (debugger) debugger->attach(machine_, *this, {});
    let_debug();
    Ended ended{.result = plan::PlanResult::Interrupted, .message = {}};
    if (!debugger || !debugger->aborted()) ended = decide();
    if (debugger) debugger->detach({now_, ended.result, ended.message});
    return ended;
}

Ended VirtualTime::decide() {
    start();
    for (let_debug(); !over(); let_debug()) step();
    return finish();
}

void VirtualTime::start() {
    machine_.start(options_.set, now_);
    obey();
}

void VirtualTime::step() {
    write_from_outside();
    meet_surroundings();
    if (abort_asked_.exchange(false)) {
        machine_.abort(now_);
    } else if (!waits_for_surroundings() && !take_first_due() && !advance()) {
        timed_out_ = true;
        machine_.abort(now_);
    }
    obey();
    trigger_ = 0;
}

Ended VirtualTime::finish() {
    leave_surroundings();
    // An actor that overstayed its grace time is still in the middle of its code: it is told until
    // that ends.
    while (code_ && !code_->ended) {
        fiber_->go_on();
        after_turn();
    }
    code_.reset();
    hand_out_trace();
    return {machine_.result(), machine_.message(), timed_out_};
}

// Between two decisions: what a debugger asks is answered; while it pauses the run, here.
void VirtualTime::let_debug() {
    if (!options_.debugger) return;
    while (options_.debugger->serve(now_)) obey();
}

// ---- what the machine wants ----

void VirtualTime::obey() {
    hand_out_trace();
    for (auto commands = machine_.take_commands(); !commands.empty();
         commands = machine_.take_commands()) {
        for (plan::Command& command : commands) {
            std::visit([this](auto& one) { obey(one); }, command);
        }
        hand_out_trace();
    }
}

void VirtualTime::obey(plan::StartWatch& command) {
    const bool is_there = command.level < machine_.depth();  // its plan may have ended again
    const CodePlace here{is_there ? machine_.path_at(command.level) : "", now_};
    auto watching = std::make_unique<Watching>(
        Watching{command.watch, command.level, command.global, command.index, command.supervisor,
                 make_supervisor(options_, library_, *command.supervisor, here),
                 WatchContext(*this, command.supervisor->name), now_, now_});
    const auto place = std::find_if(watching_.begin(), watching_.end(), [&](const auto& other) {
        return watching->rank() < other->rank();
    });
    watching_.insert(place, std::move(watching));
}

void VirtualTime::obey(plan::StopWatch& command) {
    const auto found = std::find_if(watching_.begin(), watching_.end(),
                                    [&command](const auto& w) { return w->id == command.watch; });
    if (found == watching_.end()) return;
    const std::unique_ptr<Watching> over = std::move(*found);
    watching_.erase(found);
    over->context.end();
    if (over->begun) over->code->stopped(over->context);
}

void VirtualTime::obey(plan::Activate& command) {
    begin_due_ = command;
    over_due_.reset();
}

void VirtualTime::obey(plan::SubPlanOver& command) {
    over_due_ = command;
    begin_due_.reset();
}

void VirtualTime::obey(plan::RankAgain&) {
    for (const auto& watching : watching_) {
        if (watching->global) watching->index = machine_.place_of(watching->id).index;
    }
    std::sort(watching_.begin(), watching_.end(),
              [](const auto& a, const auto& b) { return a->rank() < b->rank(); });
}

void VirtualTime::obey(plan::StartCode& command) {
    code_ = std::make_unique<Code>();
    Code& code = *code_;
    code.activation = command.activation;
    code.name = command.actor->name;
    code.actor =
        make_actor(options_, library_, *command.actor, {machine_.path_at(command.level), now_});
    code.context = std::make_unique<Context>(*this, code, std::move(command.in),
                                             command.actor->of->outputs.size());
    code.grace_ends = Duration{command.actor->of->grace_ms * 1000};
    for (const BusEvent& event : between_.take_all()) code.context->overhear(event);
    if (command.actor->of->kind == plan::Kind::Computation) {
        code.run();  // it never waits: it needs no stack of its own
    } else {
        if (!fiber_) fiber_ = std::make_unique<Fiber>();
        fiber_->start(code);
    }
    after_turn();
}

void VirtualTime::obey(plan::StopCode& command) {
    assert(code_ && code_->activation == command.activation);
    Code& code = *code_;
    code.told = true;
    code.told_at = now_;
    code.grace_ends = after(now_, code.grace_ends);
    if (!code.ended) {
        code.context->wake_with({.stop = true, .event = {}});
        fiber_->go_on();
        after_turn();
    } else {
        code.wake = now_;  // it had ended at this instant, but something else was first
    }
    if (code.ended && code.wake <= now_) {
        machine_.stopped(code.activation, now_);
        code_.reset();
    }
}

// ---- what is due ----

// Takes the first thing due at this instant, in the order of P21. False if there is none.
bool VirtualTime::take_first_due() {
    for (const auto& watching : watching_) {
        if (!may_check(*watching) || !watching->due(now_)) continue;
        take_check(*watching);
        return true;
    }
    if (begin_due_) {
        if (options_.debugger && options_.debugger->stops_before_begin()) return true;
        const plan::ActivationId activation = begin_due_->activation;
        begin_due_.reset();
        machine_.begin(activation, now_);
        return true;
    }
    if (over_due_) {
        const plan::ActivationId activation = over_due_->activation;
        over_due_.reset();
        machine_.end_sub_plan(activation, now_);
        return true;
    }
    if (!code_ || std::min(code_->wake, code_->told ? code_->grace_ends : kNever) > now_) {
        return false;
    }
    take_code();
    return true;
}

bool VirtualTime::may_check(const Watching& watching) const {
    const int stopping = machine_.stopping_level();
    return stopping < 0 || watching.level < stopping;
}

void VirtualTime::take_check(Watching& watching) {
    const plan::WatchId id = watching.id;
    Check check;
    check.since_start = now_ - watching.started;
    const bool reads = watching.next <= now_;
    if (reads) {
        watching.move_beyond(now_);
        Result<std::vector<plan::Value>> in = machine_.read_inputs(id);
        if (!in.ok()) {
            machine_.fail_watch(id, in.error().what, now_);
            return;
        }
        check.in = std::move(in.value());
    }
    BusEvent event;
    if (!reads) {
        event = std::move(watching.events.front());
        watching.events.pop_front();
        check.in = watching.in;
        check.event = &event;
    }
    trigger_ = check.event != nullptr ? check.event->frame : 0;
    try {
        this->check(watching, check);
    } catch (const std::exception& error) {
        machine_.fail_watch(id, error.what(), now_);
    }
}

void VirtualTime::check(Watching& watching, const Check& check) {
    if (!std::exchange(watching.begun, true)) watching.code->started(check.in, watching.context);
    if (watching.period().count() == 0 && !check.event) {
        watching.in = check.in;
        return;
    }
    const auto given = watching.code->check(check);
    if (given && !passes_over(watching, *given)) machine_.raise(watching.id, *given, now_);
}

bool VirtualTime::passes_over(const Watching& by, const plan::Given& given) const {
    if (!options_.passes_over) return false;
    const auto loses = [&](const auto& other) {
        const bool is_ended = std::pair(other->level, !other->global) > std::pair(by.level, false);
        return other->id != by.id && is_ended && other->due(now_);
    };
    const bool tied = (code_ && !code_->told && code_->wake <= now_) ||
                      std::any_of(watching_.begin(), watching_.end(), loses);
    const plan::GraphSupervisor& of = *by.of;
    const auto outcome = static_cast<size_t>(given.outcome);
    return options_.passes_over({now_, machine_.path_at(by.level), of.name,
                                 of.of->outcomes[outcome].name,
                                 of.targets[outcome] == plan::kTargetIgnore, tied});
}

// The innermost code's wait is over, it has ended, it has stopped, or its grace time is over.
void VirtualTime::take_code() {
    Code& code = *code_;
    if (!code.ended && code.wake <= now_) {
        fiber_->go_on();
        after_turn();
        if (!code.ended) return;
    }
    if (!code.ended) {
        machine_.overstayed(code.activation, now_);
        return;
    }
    const plan::ActivationId activation = code.activation;
    trigger_ = code.heard;
    if (code.told) {
        if (code.told_at < now_) leave_out_missed(machine_.stopping_level());
        machine_.stopped(activation, now_);
    } else if (code.failed) {
        machine_.fail(activation, code.failure, now_);
    } else {
        machine_.end(activation, code.context->given(), now_);
    }
    if (keeps_unheard_ && !code.told) {
        for (const BusEvent& event : code.context->take_unheard()) between_.push(event);
    }
    code_.reset();
}

// The code has had its turn: it waits, or has ended, which counts at this instant.
void VirtualTime::after_turn() {
    if (code_->ended) code_->wake = now_;
}

// A stop that took time: what was due meanwhile is left out (P18a).
void VirtualTime::leave_out_missed(int level) {
    for (const auto& watching : watching_) {
        if (watching->level < level) continue;
        watching->events.clear();
        if (watching->next <= now_) watching->move_beyond(now_);
    }
}

void VirtualTime::emit(const BusEvent& event) {
    if (options_.on_emit) options_.on_emit(event);
    if (options_.surroundings) options_.surroundings->emit(now_, event);
    deliver(event);
}

// All that listen hear the event; each hearing is due at this instant (P22b).
void VirtualTime::deliver(const BusEvent& event) {
    for (const auto& watching : watching_) {
        const bool armed = watching->period().count() == 0 && watching->next == kNever;
        if (armed && may_check(*watching)) watching->events.push_back(event);
    }
    if (code_ && !code_->ended) deliver_to_code(event);
}

// Code that is being stopped hears on what it has asked to be kept: an answer of its node.
void VirtualTime::deliver_to_code(const BusEvent& event) {
    const bool kept = code_->context->keep(event);
    if (code_->wake <= now_) return;
    if (kept && code_->waits_kept) code_->wake = now_;
    if (code_->told || code_->wake <= now_) return;
    if (!code_->event.empty() && code_->event != event.name) return;
    code_->context->wake_with({.stop = false, .event = event});
    code_->wake = now_;
}

// ---- what has time of its own beside the plan ----

// Instants of the surroundings that the clock has come to begin before anything of the plan.
void VirtualTime::meet_surroundings() {
    Surroundings* const around = options_.surroundings;
    while (around && around->next() <= now_) {
        leave_surroundings();
        met_ = true;
        for (const BusEvent& event : pass(around->begin())) {
            if (options_.debugger) options_.debugger->heard();
            // Its turn is to come, or over.
            const bool later = code_ && (code_->ended ? keeps_unheard_ : code_->wake <= now_);
            deliver(event);
            if (later) code_->context->overhear(event);
            if (!code_ && keeps_unheard_) between_.push(event);
        }
    }
}

void VirtualTime::leave_surroundings() {
    if (std::exchange(met_, false)) options_.surroundings->end();
}

// ---- time ----

Time VirtualTime::own_due() const {
    if (begin_due_ || over_due_) return now_;
    Time next = kNever;
    for (const auto& watching : watching_) {
        if (!may_check(*watching)) continue;
        next = std::min(next, watching->events.empty() ? watching->next : now_);
    }
    if (code_) {
        next = std::min(next, code_->wake);
        if (code_->told) next = std::min(next, code_->grace_ends);
    }
    return next;
}

std::optional<Time> VirtualTime::next_due() const {
    Time next = own_due();
    if (options_.surroundings) next = std::min(next, options_.surroundings->next());
    return next == kNever ? std::nullopt : std::optional(next);
}

// What is due now is taken later, behind something of the surroundings: the clock moves on to that.
bool VirtualTime::waits_for_surroundings() {
    if (!options_.surroundings) return false;
    const Time at = options_.surroundings->late(now_);
    if (at <= now_ || own_due() > now_) return false;
    leave_surroundings();
    machine_.time_passed();
    now_ = at;
    return true;
}

// Jumps to the next thing due. False: max_time comes first, or nothing can ever fall due; then the
// run is to be aborted at the time that now is.
bool VirtualTime::advance() {
    leave_surroundings();
    const auto next = next_due();
    const bool limited = options_.max_time && !timed_out_;
    machine_.time_passed();
    if (limited && (!next || *options_.max_time <= *next)) {
        now_ = *options_.max_time;
        return false;
    }
    if (!next) return false;
    if (pause_comes_first(*next)) {
        now_ = *options_.debugger->instant();
        options_.debugger->reach_instant(now_);
        return true;
    }
    now_ = options_.surroundings ? options_.surroundings->late(*next) : *next;
    return true;
}

bool VirtualTime::pause_comes_first(Time next) const {
    if (!options_.debugger) return false;
    const std::optional<Time> instant = options_.debugger->instant();
    return instant && *instant <= next;
}

void VirtualTime::fail(std::string_view why) {
    machine_.fail_run(why, now_);
    obey();
}

// Listeners that hear of these writes may ask for more: those come next time.
void VirtualTime::write_from_outside() {
    for (const auto& [slot, value] : std::exchange(sets_asked_, {})) {
        if (machine_.write_outside(slot, value, now_).ok()) hand_out_trace();
    }
}

void VirtualTime::hand_out_trace() {
    for (plan::TraceEvent& event : machine_.take_trace()) {
        event.frame = trigger_;
        if (options_.debugger) options_.debugger->see(event);
        if (options_.on_trace) options_.on_trace(event);
    }
}

}  // namespace vagus::run
