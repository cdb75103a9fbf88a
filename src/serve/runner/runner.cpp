#include "serve/runner/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>

#include "base/time.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/prepared_run.hpp"
#include "net/wall_clock.hpp"
#include "serve/runner/bus_clock.hpp"
#include "serve/runner/bus_run.hpp"
#include "serve/runner/hand.hpp"
#include "serve/runner/pacer.hpp"
#include "serve/runner/plan_runner.hpp"
#include "serve/runner/reliving.hpp"
#include "serve/runner/run_fleet.hpp"
#include "serve/runner/run_recording.hpp"
#include "serve/runner/world_show.hpp"
#include "serve/talk/scene.hpp"
#include "session/bus_names.hpp"
#include "session/plan_world.hpp"
#include "session/toolboxes.hpp"
#include "sim/world_threads.hpp"
#include "toolbox/needs_bus.hpp"

namespace vagus::serve {

namespace {

using net::wall_now;

constexpr Duration kTellEvery = 100ms;  // the clock, and what is slow: documents, pictures
constexpr Duration kPosesEvery = 33ms;  // where things are
constexpr int kPausedWaitMs = 20;       // while paused nothing moves but messages
constexpr int kAtOnceMs = 4;            // instants that are run together
constexpr int kHoldsAfterFrames = 20;   // instants in which nodes answer although time is stopped

class Runner {
public:
    explicit Runner(Pipe pipe) : pipe_(std::move(pipe)) {
        plan_.on_asked([this](const run::Request& request) { recording_.asked(request); });
        plan_.on_changed([this](const record::FilesSaved& files) { recording_.changed(files); });
    }

    RunnerEnd run() {
        while (!quits()) {
            if (!order_) pipe_.wait(1000);
            take_packets();
            teller_.tell(talk::Alive{});
            if (order_) serve();
        }
        return end_;
    }

private:
    // ---- orders ----
    bool quits() const { return quit_ || teller_.is_lost(); }
    // What runs has to end: another order waits, or nobody is there.
    bool has_to_end() const { return order_ || quits(); }

    void take_packets() {
        for (Packet& packet : pipe_.receive()) {
            if (quit_) break;  // behind what is no order nothing is one
            past_.is_on() ? keep(std::move(packet)) : take(packet);
        }
        if (pipe_.closed()) quit_ = true;
        if (quit_) stop_plan();
        tend_fleet();
    }

    // However time passes for the run, the fleet's is that of the wall.
    void tend_fleet() {
        if (!fleet_) return;
        if (fleet_->turn()) prepared_->hear({std::string(toolbox::kFleetNews), {}});
        for (RunFleet::Told& told : fleet_->take_told()) {
            teller_.tell(talk::ToldFleet{std::move(told.name), std::move(told.values)});
        }
    }

    // What is for the run waits until its past is over, but for another one in its place.
    void keep(Packet packet) {
        const auto order = talk::decode_order(packet);
        const bool waits = order.ok() && !std::holds_alternative<talk::Open>(order.value());
        waiting_.push_back(std::move(packet));
        if (!waits) take_waiting();
    }
    void take_waiting() {
        for (const Packet& packet : std::exchange(waiting_, {})) {
            if (!quit_) take(packet);
        }
    }

    void take(const Packet& packet) {
        const auto order = talk::decode_order(packet);
        if (order.ok()) return std::visit([this](const auto& one) { obey(one); }, order.value());
        const std::string& fault = order.error().what;
        end_ = {kExitNonsense, fmt::format("the studio sent {}; this run is ended", fault)};
        quit_ = true;
    }

    void obey(const talk::Open& order) {
        order_ = order;
        held_nodes_.clear();
    }
    void obey(const talk::SetPace& pace) {
        pacer_.set(pace.paused, pace.speed, wall_now());
        plan_.pace();
    }
    void obey(const talk::LetTimePass& order) {
        pacer_.step(std::chrono::milliseconds(order.milliseconds));
    }
    void obey(const talk::Show& show) { show_.want(show); }
    void obey(const talk::StepPlan&) { plan_.step(); }
    void obey(const talk::StopPlan&) {
        stop_plan();
        pacer_.set(false, pacer_.speed(), wall_now());
    }
    void obey(const talk::HoldNodes& order) {
        held_nodes_ = {order.nodes.begin(), order.nodes.end()};
        if (prepared_) prepared_->hold_nodes(held_nodes_);
    }
    void obey(const talk::SetBreakpoints& order) {
        plan_.want(order.list);
        plan_.tend_stops();
    }
    void obey(const talk::SetVariable& order) { plan_.obey(order); }
    void obey(const talk::RaiseEvent& order) { plan_.obey(order); }
    void obey(const talk::HandleHeld& order) { plan_.obey(order); }
    void obey(const talk::ChangePlan& order) { plan_.obey(order); }
    void obey(const talk::CheckPlan& order) { plan_.obey(order); }
    void obey(const talk::SendFrame& order) {
        if (!session_) return;
        session_->world().bus().receive(link_, order.frame.frame);
        holds_ = kHoldsAfterFrames;
    }
    void obey(const talk::ScriptLoaded& order) {
        recording_.loaded(order.node, order.file, order.text);
    }
    void obey(const talk::FlushRecording& order) { recording_.flush(order.request); }
    void obey(const talk::HearOfFleet& order) {
        if (!fleet_) return;
        prepared_->hear({toolbox::fleet_event(order.event, order.from), order.args});
    }
    // A hand from above.
    template <typename Hand>
    void obey(const Hand& order) {
        if (!session_) {
            const Error none{Code::Unavailable, "the world is just being opened; try again"};
            return teller_.answer(order.request, Status(none));
        }
        teller_.answer(order.request, act(order));
        next_poses_ = Time{};
    }
    template <typename Hand>
    auto act(const Hand& order) {
        return hand(session_->world(), order);
    }
    Status act(const talk::PressButton& order) { return buttons_.press(session_->world(), order); }

    void stop_plan() {
        // A plan that is held hears nothing but its debugger.
        if (plan_.is_on_bus() || plan_.is_paused()) plan_.abort();
        abort_prepared();
    }
    void abort_prepared() {
        if (prepared_ && !plan_.is_on_bus()) prepared_->abort();
    }

    void reseed(uint64_t seed) {
        if (prepared_) prepared_->reseed(seed);
        session_->world().reseed(seed);
    }

    // ---- opening ----
    // Serves one order to its end: a plan in its world, then the world alone.
    void serve() {
        talk::Open order = std::move(*order_);
        order_.reset();
        number_ = order.order;
        breakpoints_ = order.breakpoints;
        teller_.tell(talk::Opening{number_});
        const Status begun = past_.begin(order);
        if (!begun.ok()) return fail(begun.error().what);
        tells_past_ = order.past && !order.past->t;
        teller_.be_mute(past_.is_on(), tells_past_);
        plan_.relive(past_.is_on());
        order.plan.empty() ? run_world(order) : run_plan(order);
        session_ = nullptr;
        if (past_.is_on()) (void)past_.end();
        teller_.be_mute(false);
        plan_.relive(false);
    }

    void fail(const std::string& why) { teller_.tell(talk::OpenFailed{number_, why}); }

    // What a test says of its run, the run that shows it has, too.
    static Result<session::SimSession> open_world(const talk::Open& order) {
        session::SimOptions options;
        options.world = TRY(embed::world_options({order.seed, order.starts, order.chaos}));
        session::SimSession session =
            TRY(order.world_text ? session::open_sim_text(order.world, *order.world_text, options)
                                 : session::open_sim(order.world, options));
        for (const std::string& path : order.scripts) session.load(path, TRY(read_file(path)));
        return session;
    }

    void run_world(const talk::Open& order) {
        RunRecording::Files read(order);
        auto opened = open_world(order);
        if (!opened.ok()) return fail(opened.error().what);
        own_ = std::make_unique<session::SimSession>(std::move(opened.value()));
        (void)own_->settle();
        recording_.begin(order, read, *own_, nullptr);
        begin_session(*own_, order);
        live();
        recording_.end();
        own_.reset();
    }

    void run_plan(const talk::Open& order) {
        RunRecording::Files read(order);
        toolbox::Parts parts;
        run::CodeLibrary library;
        const Status added = session::add_toolboxes(library, parts, order.toolboxes);
        if (!added.ok()) return fail(added.error().what);
        const auto plan = embed::LoadedPlan::from_file(order.plan, library);
        if (!plan.ok()) return fail(plan.report());
        const Result<std::unique_ptr<RunFleet>> fleet = fleet_of(order, plan);
        if (!fleet.ok()) return fail(fleet.error().what);
        parts.fleet = fleet.value().get();
        auto prepared = embed::PreparedRun::prepare(plan, words_of(order), parts);
        if (!prepared.ok()) return fail(prepared.error().what);
        prepared_ = std::move(prepared.value());
        fleet_ = parts.fleet != nullptr ? fleet.value().get() : nullptr;
        heard_ = session::events_heard(plan.plans(), library.templates());
        plan_.want(order.breakpoints);
        const bool in_world = prepared_->world() != nullptr;
        if (fleet_ && !order.recording.empty()) {
            (void)read.take();  // new versions of the plan note what they read by themselves
            teller_.line(talk::LineKind::Note,
                         "this run is not recorded: its plan asks the fleet, and what other robots "
                         "say cannot be run again");
        } else if (in_world) {
            recording_.begin(order, read, prepared_->world()->session(), &*prepared_);
        }
        plan_.begin(plan, order.plan, in_world ? PlanRunner::On::World : PlanRunner::On::Bus);
        if (!in_world && !fleet_) {
            recording_.begin_on_bus(order, read, *prepared_, plan_.debugger());
        }
        in_world ? run_in_world(order) : run_on_bus(session::stop_events(library.templates()));
        plan_.forget();
        heard_.clear();
        recording_.end();
        session_ = nullptr;
        fleet_ = nullptr;
        prepared_.reset();
    }

    // nullptr: the plan asks no fleet, or the robot is in none. What a fleet says is not recorded.
    Result<std::unique_ptr<RunFleet>> fleet_of(const talk::Open& order,
                                               const embed::LoadedPlan& plan) {
        const bool asks = !toolbox::check_without_fleet(plan.graph()).ok();
        if (!asks || !order.member) return std::unique_ptr<RunFleet>();
        if (order.past) {
            return Error{Code::Unavailable,
                         "a run whose plan asks its fleet has no past to go on "
                         "from: what others said then is not recorded"};
        }
        return RunFleet::open(*order.member, number_, wall_now);
    }

    static embed::RunWords words_of(const talk::Open& order) {
        embed::RunWords words;
        words.world = order.world;
        words.bus = order.bus;
        words.project = order.project;
        words.robot = order.robot;
        words.from = order.from;
        words.max_time = kPlanMaxTime;
        words.seed = order.seed;
        words.poses = order.starts;
        words.chaos = order.chaos;
        for (const auto& [name, value] : order.set) words.set.push_back(name + "=" + value);
        return words;
    }

    void run_in_world(const talk::Open& order) {
        prepared_->listen([this](const plan::TraceEvent& event) { plan_.see(event); });
        prepared_->pace([this](Time) { instant(); });
        plan_.debugger().while_paused([this] { serve_paused(); });
        begin_session(prepared_->world()->session(), order);
        if (!past_.is_on() || tells_past_) plan_.tell_version();
        const auto ended = prepared_->run(&plan_.debugger());
        if (!ended.ok()) teller_.line(talk::LineKind::Error, ended.error().what);
        fleet_ = nullptr;
        tell_plan();
        plan_.end_talk();
        live();
    }

    // The plan alone, on a bus that the studio holds open.
    void run_on_bus(const std::set<std::string>& stops) {
        teller_.tell(talk::Opened{.order = number_, .hears = heard_, .stops = stops});
        plan_.tell_version();
        if (pacer_.held()) plan_.hold();
        prepared_->end_when_stopped();
        prepared_->hold_nodes(held_nodes_);
        bus_clock_.start(wall_now());
        {
            BusRun running(*prepared_, plan_.debugger());
            for (bool over = false; !over;) {
                pipe_.wait(kPausedWaitMs);
                take_packets();
                if (has_to_end()) plan_.abort();
                over = running.over();
                for (const BusRun::Line& line : running.take_lines()) {
                    teller_.line(line.kind, line.text);
                }
                for (const plan::TraceEvent& event : running.take()) plan_.see(event);
                hear_plan();  // where it is paused, after what led there
                recording_.tell();
                tell_bus_clock();
            }
        }
        recording_.let_go();
        plan_.tell();
        plan_.end_talk();
        teller_.tell(talk::PlanOver{});
    }

    void tell_bus_clock() {
        const Time wall = wall_now();
        bus_clock_.count(wall, pacer_.held());
        if (wall < next_tell_) return;
        next_tell_ = wall + kTellEvery;
        teller_.tell(talk::Clock{.t = bus_clock_.now(), .paused = pacer_.held(), .real = 1});
        plan_.tell();
    }

    void begin_session(session::SimSession& session, const talk::Open& order) {
        session_ = &session;
        buttons_.forget();
        session.world().stops_with_nodes();  // the server sees to that
        show_.begin();
        const auto link = session.world().bus().add({.name = "studio"});
        if (!link.ok()) return fail(link.error().what);
        link_ = link.value();
        put_robots(session.world(), order.poses);
        if (!past_.is_on()) return tell_opened({});
        if (tells_past_) show_.follow(session);
        past_.enter(session, link_);
    }

    void tell_opened(std::vector<std::string> others) {
        for (const Diagnostic& mistake : session_->mistakes()) {
            teller_.line(talk::LineKind::Error, text_of(mistake));
        }
        talk::Opened opened{.order = number_, .hears = heard_, .others = std::move(others)};
        opened.scene = scene_of(session_->world());
        for (const auto& [node, source] : session_->running_scripts()) {
            opened.programs.push_back({node, source});
        }
        teller_.tell(std::move(opened));
        tell_clock();
    }

    // ---- the past of a run that goes on from there ----
    // Between two instants. False: there is none, or not any more.
    bool relive() {
        if (!past_.is_on()) return false;
        show_.tell_frames(*session_, link_);  // nobody wants them
        if (tells_past_) show_.record(*session_);
        hear_plan();
        if (!past_.between_instants(session_->now())) return be_here(), false;
        if (++instants_ % 64 == 0) look_up();
        if (has_to_end() && prepared_) prepared_->abort();
        return true;
    }

    bool relive_held() {
        if (!past_.is_on()) return false;
        if (past_.while_held(session_->now())) return true;
        return be_here(), false;
    }

    // It says now and then how far it is.
    void look_up() {
        take_packets();
        const Time wall = wall_now();
        if (wall >= next_tell_) {
            next_tell_ = wall + kTellEvery;
            recording_.tell();
            tell_clock();
        }
        pipe_.flush();
        // The history is to have all of it.
        wait_for_history();
    }

    void wait_for_history() {
        while (tells_past_ && teller_.is_behind() && !has_to_end()) {
            pipe_.wait(kPausedWaitMs);
            take_packets();
            pipe_.flush();
        }
    }

    // Nobody has heard of it yet, and it does not go on by itself.
    void be_here() {
        show_.tell_frames(*session_, link_);  // of its last instant; they are in its history
        wait_for_history();
        show_.tell_past();
        std::vector<std::string> others = past_.end();
        teller_.be_mute(false);
        plan_.relive(false);
        pacer_.set(true, pacer_.speed(), wall_now());
        show_.begin();
        tell_opened(std::move(others));
        if (prepared_ && !tells_past_) plan_.tell_version();
        plan_.want(breakpoints_);
        plan_.tend_stops();
        next_tell_ = next_poses_ = Time{};
        take_waiting();
    }

    // ---- the plan ----
    void hear_plan() {
        plan_.hear();
        if (plan_.take_haste()) next_tell_ = Time{};
    }

    void tell_plan() {
        hear_plan();
        plan_.tell();
    }

    // In a world the plan has no thread of its own: while it is paused the runner hears and tells
    // from here, and the nodes answer.
    void serve_paused() {
        recording_.begin_turn();
        hear_plan();
        if (relive_held()) return;
        const Time wall = wall_now();
        if (wall >= next_tell_ || wall >= next_poses_) look_around(wall);
        if (has_to_end()) return plan_.abort();
        if (!pacer_.paused()) return plan_.go_on();
        wait_paused();
    }

    double run_time() const {
        if (plan_.is_on_bus()) return bus_clock_.now();
        return session_ ? seconds_of(session_->now()) : 0;
    }

    // ---- time ----
    // The world alone, until another order or the end.
    void live() {
        sim::WorldThreads threads(session_->world(), false);
        while (!has_to_end()) {
            instant();
            if (has_to_end()) return;
            threads.begin(wall_now);
            session_->begin_instant();
            session_->end_instant();
            threads.end(wall_now, sim::kNodeStep);
            (void)session_->take_notes();
        }
    }

    // Before each millisecond of simulated time: waits until it is due, hears and tells.
    void instant() {
        recording_.begin_turn();
        if (relive()) return;
        buttons_.release_due(session_->world());
        show_.tell_frames(*session_, link_);
        show_.record(*session_);
        for (;;) {
            const Time wall = wall_now();
            if (wall >= next_tell_ || wall >= next_poses_) look_around(wall);
            if (has_to_end()) {
                if (prepared_) prepared_->abort();
                return;
            }
            if (pacer_.paused()) {
                wait_paused();
                continue;
            }
            const Time due = pacer_.due(sim::kNodeStep, wall);
            if (due <= wall) {
                pacer_.passed(sim::kNodeStep, due);
                break;
            }
            // Not for each millisecond by itself: a few at a time cost far less. However slow time
            // is, the server hears from us.
            const Duration wait = std::min(due - wall, kTellEvery);
            pipe_.wait(std::max(kAtOnceMs, static_cast<int>(wait / 1ms)));
            take_packets();
        }
        if (++instants_ % 8 == 0) take_packets();
    }

    // The clock is paused, and the nodes still answer.
    void wait_paused() {
        pipe_.wait(holds_ > 0 ? 1 : kPausedWaitMs);
        take_packets();
        if (holds_ <= 0) return;
        --holds_;
        recording_.hold(session_->world());
        show_.tell_frames(*session_, link_);
    }

    void look_around(Time wall) {
        take_packets();
        pipe_.flush();
        recording_.tell();
        show_.tell_past();
        if (wall >= next_poses_) {
            next_poses_ = wall + kPosesEvery;
            show_.tell_poses(*session_);
        }
        if (wall < next_tell_) return;
        next_tell_ = wall + kTellEvery;
        tell_clock();
        show_.tell_scene(*session_);
        tell_plan();
        show_.tell_pictures(*session_);
    }

    void tell_clock() {
        talk::Clock clock{.t = seconds_of(session_->now()),
                          .paused = pacer_.held(),
                          .real = pacer_.real(wall_now())};
        if (const auto load = session_->world().bus_load()) {
            clock.load = 100 * load->all.share_of_last_second;
        }
        teller_.tell(clock);
    }

    Pipe pipe_;
    Teller teller_{pipe_};
    RunnerEnd end_;
    bool quit_ = false;
    std::optional<talk::Open> order_;  // that waits
    uint64_t number_ = 0;              // of the order that is served

    Pacer pacer_;
    WorldShow show_{teller_};
    RunRecording recording_{teller_};
    Buttons buttons_;
    PlanRunner plan_{teller_, pacer_, {.wall = wall_now, .run = [this] { return run_time(); }}};
    // What the debugger was told then it is told again by itself.
    Reliving past_{{.plan = plan_,
                    .recording = recording_,
                    .abort = [this] { abort_prepared(); },
                    .loaded = [this](uint16_t node) { show_.loaded(*session_, node); },
                    .reseed = [this](uint64_t seed) { reseed(seed); }}};
    bool tells_past_ = false;
    std::vector<Packet> waiting_;                          // until it is over
    std::vector<talk::BreakpointOrder> breakpoints_ = {};  // of the order
    std::unique_ptr<session::SimSession> own_;
    std::unique_ptr<embed::PreparedRun> prepared_;
    RunFleet* fleet_ = nullptr;               // of its plan
    session::SimSession* session_ = nullptr;  // of one of the two
    hub::LinkId link_;
    std::set<std::string> heard_;  // events, by the plan
    std::set<uint16_t> held_nodes_;
    BusClock bus_clock_;
    int holds_ = 0;
    uint64_t instants_ = 0;
    Time next_tell_{}, next_poses_{};
};

}  // namespace

RunnerEnd run_runner(Pipe pipe) {
    return Runner(std::move(pipe)).run();
}

}  // namespace vagus::serve
