#include "embed/prepared_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <random>

#include "base/file.hpp"
#include "base/line_sink.hpp"
#include "base/text.hpp"
#include "embed/answered_plan.hpp"
#include "embed/bus_check.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/plan_bus.hpp"
#include "embed/world_pace.hpp"
#include "net/links.hpp"
#include "plan/trace.hpp"
#include "run/execution.hpp"
#include "run/firing.hpp"
#include "run/traced_variables.hpp"
#include "session/plan_world.hpp"
#include "session/safe_stop.hpp"
#include "sim/world_threads.hpp"
#include "toolbox/bus.hpp"
#include "toolbox/core_values.hpp"
#include "toolbox/needs_bus.hpp"

namespace vagus::embed {

namespace {

constexpr const char* kSomebody = "somebody";  // who ends a run, if nobody says
constexpr int kExitTraceLost = 1;  // the plan ended well, but not all of its trace is written

void tell_on_stderr(const std::string& sentence) {
    write_to_stderr(sentence + "\n");
}

Result<LoadedPlan> start_of(const LoadedPlan& what, const std::string& actor) {
    if (actor.empty()) return what;
    Result<LoadedPlan> started = what.starting_at(actor);
    if (started.ok()) return started;
    return Error{Code::BadInput, fmt::format("--from {}: {}", actor, started.error().what)};
}

Result<session::BusNames> names_of_project(const std::string& path) {
    const std::string text = TRY(read_file(path));
    return session::BusNames(TRY(aesl::parse_project(text, path)).common, path);
}

}  // namespace

class PreparedRun::Insides {
public:
    Insides(const LoadedPlan& its_what, RunWords its_words, toolbox::Parts& its_parts)
        : what(its_what), words(std::move(its_words)), parts(its_parts) {}
    // As it goes, the bus may have something to tell.
    ~Insides() { bus.reset(); }
    Insides(const Insides&) = delete;
    Insides& operator=(const Insides&) = delete;

    Status take_options();
    Status open_world();
    Status listen();
    Status open_sinks();
    Result<PlanBusOptions> bus_options();
    Status open_bus(PlanBusOptions options);
    Status check_alone() const;
    void trace(const plan::TraceEvent& event);
    void stop_after_error(const plan::TraceEvent& event);
    void write(LineSink& to, std::string_view lines);
    bool complete(LineSink& one);
    Result<run::Ended> run_beside_world();
    run::Ended run_on_bus();
    void leave_bus(const run::Ended& ended);
    void stop_guests(const run::Ended& ended);
    void tell_rest(const std::string& sentence, const std::vector<session::StopNode>& found);
    run::Ended run_with(run::Clock clock, const std::function<run::Ended(run::Execution&)>& go);
    void abort(const std::string& by);
    void abort_this();
    void follow_bus(BusTap* follows);
    void set(int slot, plan::Value value);
    void hear(run::BusEvent event);
    void reseed(uint64_t with);
    void defer_aborts(bool deferred) { deferred_ = deferred; }
    std::optional<std::string> take_abort();
    // What ended this run; empty if it ended by itself.
    std::string ended_by() {
        const std::lock_guard lock(mutex_);
        return ended_by_;
    }
    bool abort_asked() {
        const std::lock_guard lock(mutex_);
        return abort_asked_;
    }

    const LoadedPlan what;
    const RunWords words;
    toolbox::Parts& parts;
    std::optional<uint64_t> seed;
    std::unique_ptr<AnsweredPlan> answered;  // nullptr: code works
    run::RunOptions how;
    std::map<int, std::function<void(const plan::TraceEvent&)>> listeners;  // by number
    run::Firing firing;                                                     // of this run
    std::function<void(Time)> wait;
    toolbox::BusNodes nodes;
    std::unique_ptr<session::PlanWorld> world;
    bool world_used = false;
    std::unique_ptr<net::Links> hosts;  // after the world: its links leave that bus first
    std::string listening;
    std::unique_ptr<PlanBus> bus;
    BusTap* tap = nullptr;
    LineSink sink;
    LineSink sink_all;
    std::function<void(const std::string&)> tell = tell_on_stderr;
    std::function<void(const std::string&)> report;  // empty: as `tell`

private:
    void abort_it(const std::string& by);

    std::mutex mutex_;  // guards what follows
    run::Execution* execution_ = nullptr;
    bool abort_asked_ = false;  // this run, and each that follows
    std::string who_aborts_;
    std::string ended_by_;  // this run
    bool deferred_ = false;
    // Where it is deferred, and not done yet; each instant of a recorded run looks.
    std::atomic<bool> is_asked_ = false;
    std::string asked_by_;
};

// ---- making it ready ----

Status PreparedRun::Insides::take_options() {
    TRY(check_words(words));
    if (!words.seed.empty()) seed = TRY(parse_seed(words.seed));
    how.seed = seed.value_or(1);
    for (const std::string& text : words.set) {
        how.set.push_back(TRY(parse_set(what.graph().plans.front(), text)));
    }
    if (!words.max_time.empty()) {
        how.max_time = TRY(parse_max_time(words.max_time));
    } else if (!words.world.empty()) {
        how.max_time = kWorldMaxTime;
    }
    how.on_trace = [this](const plan::TraceEvent& event) { trace(event); };
    if (!words.world.empty()) TRY(open_world());
    if (!words.answers.empty()) {
        answered = TRY(AnsweredPlan::read(words.answers, what.graph(), words.world.empty()));
    } else if (words.world.empty() && words.bus.empty()) {
        TRY(check_alone());
    }
    if (parts.fleet == nullptr) TRY(toolbox::check_without_fleet(what.graph()));
    // On a bus scripts begin to run: all that may be wrong with the command is found before.
    PlanBusOptions on_bus;
    if (!words.bus.empty()) on_bus = TRY(bus_options());
    TRY(open_sinks());
    if (!words.bus.empty()) TRY(open_bus(std::move(on_bus)));
    return Status::done();
}

Status PreparedRun::Insides::open_sinks() {
    // In real time what a run did is there even if the process is killed.
    const auto when =
        words.clock == "virtual" ? LineSink::When::WithinASecond : LineSink::When::AtOnce;
    sink = TRY(LineSink::open(words.trace, when, plan::kTraceBegins));
    sink_all = TRY(LineSink::open(words.trace_all, when, plan::kTraceBegins));
    return Status::done();
}

Status PreparedRun::Insides::open_world() {
    hosts.reset();
    std::optional<unsigned> threads;
    if (!words.threads.empty()) threads = TRY(parse_threads(words.threads));
    std::vector<sim::RobotStart> starts;
    for (const std::string& pose : words.poses) starts.push_back(TRY(parse_pose(pose)));
    session::PlanWorldOptions options{.path = words.world,
                                      .seed = seed,
                                      .starts = starts,
                                      .threads = threads,
                                      .chaos = {},
                                      .traced = !words.trace_all.empty(),
                                      .robot = words.robot,
                                      .needs = toolbox::nodes_needed(what.graph())};
    if (!words.chaos.empty()) options.chaos = TRY(read_chaos_words(words.chaos));
    if (!words.listen.empty()) {
        options.guests = TRY(session::safe_stop_around(words.world, words.toolboxes));
    }
    world = TRY(session::PlanWorld::open(options, nodes));
    if (!world_used) {  // said once, however often it is run
        for (const std::string& hint : world->session().hints()) tell_on_stderr(hint);
    }
    world_used = false;
    parts.bus = &nodes;
    parts.camera = world->camera();
    hosts = std::make_unique<net::Links>();
    TRY(listen());
    return check_names(world->names(), what);
}

// Again where it was, if this is not the first world.
Status PreparedRun::Insides::listen() {
    if (words.listen.empty()) return Status::done();
    const net::Target target = TRY(net::parse_target(listening.empty() ? words.listen : listening));
    const auto opened = TRY(hosts->listen(world->session().world().bus(), target));
    listening = net::to_string(opened.target);
    return Status::done();
}

Result<PlanBusOptions> PreparedRun::Insides::bus_options() {
    PlanBusOptions options;
    options.target = words.bus;
    options.tell = [this](const std::string& sentence) { tell(sentence); };
    options.seed = std::random_device()();
    options.needs = toolbox::nodes_needed(what.graph());
    options.starts = toolbox::starts_on(options.needs, what.library().templates());
    options.stops = session::stop_events(what.library().templates());
    options.works_anywhere = session::sends_events(what.plans());
    const std::string& from = words.project.empty() ? what.plans().front().file : words.project;
    options.safe_stop = TRY(session::safe_stop_around(from, words.toolboxes));
    if (!words.project.empty()) {
        const std::string text = TRY(read_file(words.project));
        options.common = TRY(aesl::parse_project(text, words.project)).common;
        options.project = words.project;
    } else if (session::uses_bus(what.plans(), what.library().templates())) {
        return Error{Code::BadInput,
                     "--bus without --project: the plan uses events, and only a project gives them "
                     "their numbers; name the one that the nodes were loaded with, as --project "
                     "arm.aesl"};
    }
    TRY(check_names(session::BusNames(options.common, options.project), what));
    return options;
}

Status PreparedRun::Insides::open_bus(PlanBusOptions options) {
    bus = TRY(PlanBus::open(std::move(options), nodes));
    parts.bus = &nodes;
    return Status::done();
}

Status PreparedRun::Insides::check_alone() const {
    const Status alone = toolbox::check_without_bus(what.graph());
    if (alone.ok()) return alone;
    return Error{alone.error().code,
                 alone.error().what + "; give it a world (--world FILE) or a bus (--bus TARGET)"};
}

// ---- running ----

void PreparedRun::Insides::write(LineSink& to, std::string_view lines) {
    const bool good = to.state().ok();
    to.write(lines);
    if (good && !to.state().ok()) tell(to.state().error().what);
}

// Writes what waits; false if a line was lost, now or before.
bool PreparedRun::Insides::complete(LineSink& one) {
    const bool good = one.state().ok();
    const Status written = one.flush();
    if (good && !written.ok()) tell(written.error().what);
    return written.ok();
}

// The plan is over, but its run only when all its code has ended, which may be never.
void PreparedRun::Insides::stop_after_error(const plan::TraceEvent& event) {
    const auto* ended = std::get_if<plan::PlanEnded>(&event.what);
    const bool failed = ended && ended->result == plan::PlanResult::Error;
    if (bus && failed && run::level_of(event) == 0) bus->stop_robot();
}

void PreparedRun::Insides::trace(const plan::TraceEvent& event) {
    stop_after_error(event);
    if (sink || sink_all) {
        const std::string line = plan::format_trace(event) + "\n";
        write(sink, line);
        if (sink_all) write(sink_all, world->session().take_trace() + line);
    }
    for (const auto& [number, listener] : listeners) listener(event);
    if (const auto sentence = firing.see(event)) tell("note: " + *sentence);
}

Result<run::Ended> PreparedRun::Insides::run_beside_world() {
    if (world_used) TRY(open_world());
    world_used = true;
    WorldPace pace(*hosts);
    sim::WorldThreads threads(world->session().world(), !words.threads.empty());
    const auto clock = [this] { return hosts->now(); };
    const bool paced = words.clock != "virtual";
    world->before_each([this, &pace, &threads, clock, paced](Time at) {
        threads.end(clock, sim::kNodeStep);
        if (!listening.empty()) (void)hosts->poll(hosts->now());
        if (wait) {
            wait(at);
        } else if (paced) {
            pace.wait(at);
        }
        threads.begin(clock);
    });
    world->join(how);
    const run::Ended ended =
        run_with(run::Clock::Virtual, [](run::Execution& run) { return run.run(); });
    write(sink_all, world->session().take_trace());
    stop_guests(ended);
    return ended;
}

// Real nodes may have joined the bus of the world. In virtual time nobody can.
void PreparedRun::Insides::stop_guests(const run::Ended& ended) {
    const bool well = ended.result != plan::PlanResult::Error && ended_by().empty();
    const auto ending = well ? session::Stopping::How::Rest : session::Stopping::How::Stop;
    session::SimSession& session = world->session();
    if (listening.empty() || !session.stop_guests(ending)) return;
    const Time latest = hosts->now() + kRestWithin;
    while (!session.guests_rest() && hosts->now() < latest) {
        (void)hosts->poll(hosts->now() + sim::kNodeStep);
        session.step(sim::kNodeStep);
    }
    (void)hosts->poll(hosts->now());
    tell_rest(
        std::string("the nodes that had joined this bus were ") + (well ? "made safe" : "stopped"),
        session.guests());
}

run::Ended PreparedRun::Insides::run_on_bus() {
    bus->join(how);
    return run_with(run::Clock::Real, [this](run::Execution& run) {
        bus->start(*run.real_time());
        const run::Ended ended = run.run();
        leave_bus(ended);
        return ended;
    });
}

// A plan that has come to its end, or to that of its time, leaves the scripts as they are; every
// other end stops them, too.
void PreparedRun::Insides::leave_bus(const run::Ended& ended) {
    const std::string by = ended_by();
    const bool well = ended.result != plan::PlanResult::Error && by.empty();
    const auto found =
        bus->leave(well ? session::Stopping::How::Rest : session::Stopping::How::Stop);
    std::string sentence = by.empty() ? "the plan has ended" : by + " has ended the plan";
    sentence += fmt::format(" ({}{})", plan::name_of(ended.result),
                            ended.timed_out ? ", its time was over" : "");
    if (!well) sentence += "; the robot was stopped";
    tell_rest(sentence, found);
}

void PreparedRun::Insides::tell_rest(const std::string& sentence,
                                     const std::vector<session::StopNode>& found) {
    const std::string rest = session::describe(found);
    const bool at_rest = std::all_of(found.begin(), found.end(), [](const auto& node) {
        return node.state == session::StopNode::State::Stopped;
    });
    (at_rest && report ? report : tell)(rest.empty() ? sentence : sentence + "; " + rest);
}

// While it runs, abort() reaches it.
run::Ended PreparedRun::Insides::run_with(run::Clock clock,
                                          const std::function<run::Ended(run::Execution&)>& go) {
    std::optional<run::AnsweringCode> code;  // of this run
    if (answered) how.code_source = &code.emplace(answered->answers());
    const plan::Graph& graph = answered ? answered->graph() : what.graph();
    run::Execution execution(graph, what.library(), how, clock);
    {
        const std::lock_guard lock(mutex_);
        execution_ = &execution;
        ended_by_.clear();
        if (abort_asked_) abort_it(who_aborts_);
    }
    const run::Ended ended = go(execution);
    const std::lock_guard lock(mutex_);
    execution_ = nullptr;
    return ended;
}

// The robot is stopped while the plan ends, not when it has: nothing is waited for.
void PreparedRun::Insides::abort_it(const std::string& by) {
    if (!execution_) return;
    if (deferred_) {
        asked_by_ = by;
        is_asked_ = true;
        return;
    }
    ended_by_ = by;
    if (tap) tap->aborts(by);
    execution_->abort();
    if (bus) bus->stop_robot();
    if (world) world->close_but_for(session::stop_events(what.library().templates()));
}

std::optional<std::string> PreparedRun::Insides::take_abort() {
    if (!is_asked_) return std::nullopt;
    const std::lock_guard lock(mutex_);
    is_asked_ = deferred_ = false;
    abort_it(asked_by_);
    deferred_ = true;
    return asked_by_;
}

void PreparedRun::Insides::follow_bus(BusTap* follows) {
    if (!bus) return;
    const std::lock_guard lock(mutex_);
    tap = follows;
    bus->tap(tap);
    if (!tap) return nodes.listen({});
    nodes.listen([this](const std::string& name, auto change) { tap->node(name, change); });
}

void PreparedRun::Insides::set(int slot, plan::Value value) {
    const std::lock_guard lock(mutex_);
    if (execution_ != nullptr) execution_->set(slot, std::move(value));
}

void PreparedRun::Insides::hear(run::BusEvent event) {
    if (world) return world->bring(std::move(event));
    const std::lock_guard lock(mutex_);
    run::RealTime* const run = execution_ != nullptr ? execution_->real_time() : nullptr;
    if (run != nullptr) run->hear(std::move(event));
}

void PreparedRun::Insides::reseed(uint64_t with) {
    const std::lock_guard lock(mutex_);
    if (execution_ != nullptr) execution_->reseed(with);
}

void PreparedRun::Insides::abort_this() {
    const std::lock_guard lock(mutex_);
    abort_it(kSomebody);
}

void PreparedRun::Insides::abort(const std::string& by) {
    const std::lock_guard lock(mutex_);
    abort_asked_ = true;
    who_aborts_ = by;
    abort_it(by);
}

// ---- the public side ----

PreparedRun::PreparedRun(std::unique_ptr<Insides> insides) : insides_(std::move(insides)) {}
PreparedRun::~PreparedRun() = default;

Result<std::unique_ptr<PreparedRun>> PreparedRun::prepare(const LoadedPlan& what,
                                                          const RunWords& words,
                                                          toolbox::Parts& parts) {
    auto insides = std::make_unique<Insides>(TRY(start_of(what, words.from)), words, parts);
    TRY(insides->take_options());
    // make_unique cannot reach the constructor.
    return std::unique_ptr<PreparedRun>(new PreparedRun(std::move(insides)));
}

bool PreparedRun::in_virtual_time() const {
    return insides_->words.clock == "virtual" || insides_->world;
}

session::PlanWorld* PreparedRun::world() {
    return insides_->world.get();
}

int PreparedRun::listen(std::function<void(const plan::TraceEvent&)> listener) {
    auto& all = insides_->listeners;
    const int number = all.empty() ? 1 : all.rbegin()->first + 1;
    all.emplace(number, std::move(listener));
    return number;
}

void PreparedRun::unlisten(int listener) {
    insides_->listeners.erase(listener);
}

void PreparedRun::pass_over(std::function<bool(const run::Raising&)> passes) {
    insides_->how.passes_over = std::move(passes);
}

void PreparedRun::pace(std::function<void(Time)> wait) {
    insides_->wait = std::move(wait);
}

Result<run::Ended> PreparedRun::run(run::Debugger* debugger) {
    insides_->how.debugger = debugger;
    insides_->firing = {};
    // In real time no robot waits for a reader. A debugger's own lines keep their place in a trace.
    const bool may_wait = debugger != nullptr || insides_->words.clock == "virtual";
    if (!may_wait) {
        insides_->sink.never_wait();
        insides_->sink_all.never_wait();
    }
    if (insides_->world) return insides_->run_beside_world();
    if (insides_->bus) return insides_->run_on_bus();
    return insides_->run_with(in_virtual_time() ? run::Clock::Virtual : run::Clock::Real,
                              [](run::Execution& run) { return run.run(); });
}

void PreparedRun::abort(const std::string& by) {
    insides_->abort(by.empty() ? kSomebody : by);
}

void PreparedRun::tap(BusTap* tap) {
    insides_->follow_bus(tap);
}

void PreparedRun::end_when_stopped() {
    if (insides_->bus) insides_->bus->end_when_stopped();
}

void PreparedRun::brake_as_a_whole() {
    if (insides_->bus) insides_->bus->brake_as_a_whole();
}

void PreparedRun::hold_nodes(std::set<uint16_t> nodes) {
    if (insides_->bus) insides_->bus->hold_nodes(std::move(nodes));
}

void PreparedRun::report(std::function<void(const std::string&)> report) {
    insides_->report = std::move(report);
}

void PreparedRun::tell(std::function<void(const std::string&)> tell) {
    insides_->tell = std::move(tell);
}

int PreparedRun::exit_status(const run::Ended& ended) {
    const bool traced = insides_->complete(insides_->sink);
    const bool all_traced = insides_->complete(insides_->sink_all);
    const int status = run::exit_status(ended);
    return status == 0 && !(traced && all_traced) ? kExitTraceLost : status;
}

void PreparedRun::abort_this() {
    insides_->abort_this();
}

void PreparedRun::set(int slot, plan::Value value) {
    insides_->set(slot, std::move(value));
}

void PreparedRun::hear(run::BusEvent event) {
    insides_->hear(std::move(event));
}

void PreparedRun::reseed(uint64_t seed) {
    insides_->reseed(seed);
}

void PreparedRun::defer_aborts(bool deferred) {
    if (insides_->world) insides_->defer_aborts(deferred);
}

std::optional<std::string> PreparedRun::take_abort() {
    return insides_->take_abort();
}

bool PreparedRun::abort_asked() const {
    return insides_->abort_asked();
}

std::string PreparedRun::listening() const {
    return insides_->listening;
}

void PreparedRun::serve_hosts() {
    if (!insides_->listening.empty()) (void)insides_->hosts->poll(insides_->hosts->now());
}

std::vector<std::string> PreparedRun::files() const {
    const RunWords& words = insides_->words;
    std::vector<std::string> files = words.toolboxes;
    for (const std::string& one : {words.world, words.project}) {
        if (!one.empty()) files.push_back(one);
    }
    if (insides_->world) {
        const auto scripts = insides_->world->session().script_paths();
        files.insert(files.end(), scripts.begin(), scripts.end());
    }
    return files;
}

// ---- before a run ----

Result<plan::Findings> check_bus(const LoadedPlan& plan, const RunWords& words) {
    if (!words.project.empty()) {
        return missing_names(TRY(names_of_project(words.project)), plan);
    }
    if (words.world.empty()) return plan::Findings();
    toolbox::BusNodes nodes;
    const auto world = TRY(session::PlanWorld::open(
        {.path = words.world, .robot = words.robot, .needs = toolbox::nodes_needed(plan.graph())},
        nodes));
    return missing_names(world->names(), plan);
}

}  // namespace vagus::embed
