#include "cli/sim/run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/file.hpp"
#include "base/line_sink.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "cli/file_watch.hpp"
#include "cli/live_screen.hpp"
#include "cli/output.hpp"
#include "cli/screen/pace.hpp"
#include "cli/sim/fleet_door.hpp"
#include "cli/sim/hands.hpp"
#include "cli/sim/lines.hpp"
#include "cli/sim/view.hpp"
#include "embed/prepared_run.hpp"
#include "embed/robots_run.hpp"
#include "net/end_signal.hpp"
#include "net/links.hpp"
#include "plan/trace.hpp"
#include "record/sim_recording.hpp"
#include "serve/field/world_versions.hpp"
#include "session/safe_stop.hpp"
#include "sim/world_threads.hpp"

namespace vagus::cli {
namespace {

using namespace std::chrono_literals;

constexpr Duration kTurn = 10ms;        // of the loop, in real time
constexpr Duration kHeadlessFor = 20s;  // simulated, unless --duration says otherwise
constexpr Duration kReaderHas = 1s;     // to take lines, where nobody else waits
constexpr Duration kGuestsWithin = 3s;  // for nodes on the bus to be read back at rest

// A robot's own port.
struct Port {
    net::PlaceId place;
    sim::RobotId robot;
};

class SimRun {
public:
    SimRun(const SimRunOptions& options, embed::RobotsRun& robots)
        : options_(options),
          robots_(robots),
          session_(robots.buses().common()),
          // stdout is for one reader at a time.
          lines_(robots.buses(), options.trace == "-" ? LinesOn::Stderr : LinesOn::Stdout),
          view_(session_),
          watch_(options.watch ? robots.buses().script_paths() : std::vector<std::string>()),
          pace_(options.speed),
          threads_(session_.world(), options.threads.has_value()) {}

    Status listen();
    Status open_trace();
    Status begin_recording(const FilesRead& files);
    // Steps until the scripts run, so that their mistakes are known before the screen appears.
    // False if there are some, or a script did not arrive, and nobody watches their files.
    bool settle();
    // At time 0, where robots have projects: their plans begin, and they join their fleets.
    Status start();
    int run();
    void stop_guests();

private:
    bool on_terminal() const { return screen_ != nullptr; }
    void pass_all();
    Duration patience() const;
    Duration end() const;
    bool ended() const { return session_.now() >= end() || net::end_asked() || closed_; }
    void turn();
    void pass_time(Time real);
    Duration to_next_step() const;
    void advance(Duration span);
    void notice(const net::Event& event);
    void look_at_files();
    void tell_notes();
    void write_trace();
    void keys();
    void act(Key key);
    void act_on_robot(Key key);
    void select(size_t step);
    void restart();
    void end_recording();
    std::vector<KeyHelp> key_help() const;
    void show();

    const SimRunOptions& options_;
    embed::RobotsRun& robots_;
    session::SimSession& session_;  // of the common bus
    net::Links links_;              // its links leave the buses before those go
    SimLines lines_;
    SimView view_;
    FileWatch watch_;
    std::unique_ptr<LiveScreen> screen_;  // nullptr: plain lines
    std::string listening_;
    std::string notice_;
    LineSink trace_;
    std::unique_ptr<record::SimRecording> recording_;
    bool all_recorded_ = true;  // none of its recordings ended because it could not be written
    Pace pace_;
    sim::WorldThreads threads_;
    bool running_ = false;  // run() has begun
    bool closed_ = false;   // nobody reads, or a person quits
    size_t selected_ = 0;
    Hands hands_;
    std::vector<Port> ports_;
    Time real_before_{};
    std::unique_ptr<serve::WorldVersions> versions_;  // of robots in a fleet
};

Status SimRun::start() {
    if (!options_.fleet.target.empty()) {
        versions_ = TRY(serve::WorldVersions::open(
            robots_, {.authority = options_.fleet.ca, .wake = [this] { links_.wake(); }}));
    }
    return robots_.start();
}

Status SimRun::listen() {
    if (!options_.listen.empty()) {
        const auto target = TRY(net::parse_target(options_.listen));
        const auto listening = TRY(links_.listen(session_.world().bus(), target));
        listening_ = net::to_string(listening.target);
        lines_.put("listening " + listening_ + "\n");
    }
    const auto& robots = session_.world().definition().robots;
    const auto views = session_.world().robots();
    for (size_t i = 0; i < robots.size() && i < views.size(); i++) {
        hub::Hub* hub = session_.world().private_bus(views[i].id);
        if (hub == nullptr) continue;
        const net::Target target{net::TcpPlace{"127.0.0.1", *robots[i].port}};
        const auto listening = TRY(links_.listen(*hub, target, {.clients = net::Clients::One}));
        ports_.push_back({listening.place, views[i].id});
        lines_.put("listening " + net::to_string(listening.target) + " " + robots[i].name + "\n");
    }
    return Status::done();
}

Status SimRun::open_trace() {
    // On stdout, a line appears at once: another program may be reading.
    const auto when =
        options_.trace == "-" ? LineSink::When::AtOnce : LineSink::When::WithinASecond;
    trace_ = TRY(LineSink::open(options_.trace, when, plan::kTraceBegins));
    return Status::done();
}

namespace {

// What cannot be run again is not recorded as if it could.
Status check_recording(const SimRunOptions& options, bool has_ports) {
    const auto refuse = [&](const std::string& why) {
        return Error{Code::Refused, "--record " + options.record + ": " + why};
    };
    if (has_ports) {
        return refuse(
            "robots of this world have ports of their own, and what comes there is not "
            "recorded; take \"port\" out of the world file, and use --listen");
    }
    if (options.watch) return refuse("not together with --watch; leave one of them out");
    if (!options.fleet.target.empty()) {
        return refuse("not together with --fleet; leave one of them out");
    }
    const aesl::Options usual;
    if (options.compile.dialect != usual.dialect || !options.compile.ontimer.empty()) {
        return refuse("not together with --dialect or --ontimer; leave them out");
    }
    return Status::done();
}

}  // namespace

Status SimRun::begin_recording(const FilesRead& files) {
    const auto& robots = session_.world().definition().robots;
    const bool has_ports = std::any_of(robots.begin(), robots.end(),
                                       [](const auto& robot) { return robot.port.has_value(); });
    TRY(check_recording(options_, has_ports));
    if (options_.record_camera) TRY(record::check_cameras(&session_.world()));
    record::RunFile about;
    about.verb = "sim";
    about.world = options_.world;
    about.loads = options_.loads;
    if (options_.seed) about.seed = std::to_string(*options_.seed);
    about.poses = options_.poses;
    const auto pace = pace_.hurries() ? record::Pace::Waits : record::Pace::NeverWaits;
    recording_ = TRY(record::SimRecording::begin(options_.record, about, files, robots_, pace));
    if (options_.record_camera) recording_->follow_cameras();
    return Status::done();
}

void SimRun::end_recording() {
    if (!recording_) return;
    const Status written = recording_->end();
    if (!written.ok()) complain(written.error());
    all_recorded_ = all_recorded_ && written.ok();
    complain_left_out(options_.record, recording_->dropped(), "variables, poses and cameras");
    recording_.reset();
}

bool SimRun::settle() {
    // Scripts that take longer to load than the run is to last are loaded all the same.
    // Beside robots with projects they are loaded before time 0.
    while (!robots_.has_projects() && !session_.settled() &&
           session_.now() < session_.settles_within()) {
        session_.step(sim::kNodeStep);
    }
    session::WorldBuses& buses = robots_.buses();
    if (robots_.has_projects()) (void)buses.settle();
    const std::vector<std::string> missing = buses.without_script();
    if (options_.watch || (missing.empty() && buses.mistakes().empty())) return true;
    lines_.tell(buses.take_notes());
    if (buses.mistakes().empty()) {
        const std::vector<std::string_view> names(missing.begin(), missing.end());
        complain("without the script that is meant for them: " + list_of(names));
    }
    return false;
}

Duration SimRun::end() const {
    if (options_.duration) return from_seconds(*options_.duration);
    const bool is_among_others = !options_.fleet.target.empty();
    return on_terminal() || is_among_others ? Duration::max() : kHeadlessFor;
}

int SimRun::run() {
    net::watch_for_end();
    // Without a keyboard, or on a terminal that cannot move its cursor, lines are what helps.
    if (!options_.headless && Terminal::can_draw()) {
        auto opened = LiveScreen::open(options_.theme);
        if (!opened.ok()) return complain(opened.error());
        screen_ = std::move(opened.value());
    }
    pass_all();
    const Status traced = trace_.flush();
    if (!traced.ok()) return complain(traced.error());
    return net::end_as_asked(robots_.has_failed() || !all_recorded_ ? kExitFailed : kExitDone);
}

void SimRun::pass_all() {
    std::optional<OutputNeverWaits> never;
    if (!on_terminal()) never.emplace(patience());
    trace_.never_wait(patience());
    running_ = true;
    real_before_ = links_.now();
    while (!ended()) turn();
    end_recording();
    robots_.end();
    versions_.reset();
    tell_notes();
    write_trace();
    screen_.reset();
    stop_guests();
}

// A run in real time, or with hosts on its bus, waits for no reader. One that only hurries may.
Duration SimRun::patience() const {
    const bool alone = listening_.empty() && ports_.empty();
    return alone && pace_.hurries() ? kReaderHas : Duration{};
}

// Real nodes on this bus may do what robots of this world tell them: nobody does any more.
void SimRun::stop_guests() {
    if (listening_.empty() || !session_.stop_guests()) return;
    const Time latest = links_.now() + kGuestsWithin;
    while (!session_.guests_rest() && links_.now() < latest) {
        (void)links_.poll(links_.now() + sim::kNodeStep);
        session_.step(sim::kNodeStep);
    }
    (void)links_.poll(links_.now());
    say("the nodes that had joined this bus were stopped; " + session::describe(session_.guests()) +
        "\n");
}

void SimRun::turn() {
    const Time now = links_.now();
    pass_time(now);
    hands_.release(session_);
    look_at_files();
    view_.follow(session_, selected_);
    tell_notes();
    write_trace();
    if (on_terminal()) {
        keys();
        if (screen_->is_due(links_.now())) show();
    }
    const bool late = pace_.owes() >= sim::kNodeStep;
    const bool hurry = !pace_.paused() && (pace_.hurries() || late);
    for (const net::Event& event : links_.poll(hurry ? now : now + kTurn)) notice(event);
}

void SimRun::notice(const net::Event& event) {
    if (event.kind == net::EventKind::Opened) notice_ = event.what + " is connected";
    if (event.kind == net::EventKind::Closed || event.kind == net::EventKind::Failed) {
        notice_ = event.what;
    }
    if (event.kind != net::EventKind::Closed) return;
    for (const Port& port : ports_) {
        if (port.place == event.place) session_.world().host_left(port.robot);
    }
}

// Simulated time follows real time by what is due, not by counting turns: it does not drift.
void SimRun::pass_time(Time real) {
    const Duration passed = real - real_before_;
    real_before_ = real;
    if (pace_.paused()) return;
    if (pace_.hurries()) {
        // As much as fits between two looks at keys and sockets.
        while (!ended() && links_.now() - real < kTurn) advance(to_next_step());
        return;
    }
    Duration due = pace_.due(passed);
    const Time deadline = real + kTurn;  // hosts want an answer, too
    while (due >= sim::kNodeStep && !ended() && links_.now() < deadline) {
        const Duration span = std::min(due - due % sim::kNodeStep, to_next_step());
        advance(span);
        pace_.pay(span);
        due -= span;
    }
}

// Whole steps of the physics end on their multiples, so that lines of each second name its end.
Duration SimRun::to_next_step() const {
    return sim::kPhysicsStep - session_.now() % sim::kPhysicsStep;
}

void SimRun::advance(Duration span) {
    const Duration passes = std::min(span, end() - session_.now());
    const auto clock = [this] { return links_.now(); };
    threads_.begin(clock);
    robots_.step(passes);
    if (versions_) versions_->pass(passes);
    threads_.end(clock, passes);
    // Plain lines stand for moments of simulated time, however many of them pass in a turn.
    if (running_ && !on_terminal()) tell_notes();
}

void SimRun::look_at_files() {
    for (const std::string& path : watch_.changed(links_.now())) {
        const auto text = read_file(path);
        // Gone again already: the next look finds what replaces it.
        if (text.ok()) robots_.buses().reload(path, text.value());
    }
}

void SimRun::tell_notes() {
    const std::vector<session::Note> notes = robots_.buses().take_notes();
    if (!on_terminal()) {
        closed_ = !lines_.tell(notes) || !lines_.tell_state() || closed_;
        return;
    }
    for (const session::Note& note : notes) {
        if (note.kind != session::NoteKind::Event)
            notice_ = note.text.substr(0, note.text.find('\n'));
    }
}

void SimRun::write_trace() {
    if (!trace_) return;
    trace_.write(robots_.buses().take_trace());
    trace_.pass(links_.now());
    // A run that is traced is made for its trace.
    closed_ = !trace_.state().ok() || trace_.abandoned() || closed_;
}

void SimRun::keys() {
    for (const Key key : screen_->keys()) act(key);
}

void SimRun::act(Key key) {
    if (pace_.act(key)) return;
    switch (key) {
        case Key::Restart:
            restart();
            break;
        case Key::NextRobot:
            select(1);
            break;
        case Key::LastRobot:
            select(session_.nodes().size() - 1);
            break;
        case Key::Quit:
            closed_ = true;
            break;
        default:
            act_on_robot(key);
    }
}

void SimRun::select(size_t step) {
    const size_t nodes = session_.nodes().size();
    selected_ = nodes > 0 ? (selected_ + step) % nodes : 0;
    screen_->scroll_to_latest();
}

void SimRun::act_on_robot(Key key) {
    const auto nodes = session_.nodes();
    if (selected_ >= nodes.size()) return;
    const std::string done = hands_.act(key, session_, nodes[selected_].robot);
    if (!done.empty()) notice_ = done;
}

void SimRun::restart() {
    const bool recorded = recording_ != nullptr;
    end_recording();
    const Status begun = robots_.restart();
    view_.forget();
    hands_.forget();
    pace_.forget();
    screen_->scroll_to_latest();
    notice_ = begun.ok() ? "restarted" : begun.error().what;
    if (recorded) notice_ += "; " + options_.record + " has the run before";
}

std::vector<KeyHelp> SimRun::key_help() const {
    const auto nodes = session_.nodes();
    std::vector<KeyHelp> keys = {{"space", pace_.paused() ? "continue" : "pause"},
                                 {"q", "quit"},
                                 {"r", "restart"},
                                 {"+ -", "speed"}};
    if (selected_ < nodes.size()) {
        const auto& robots = session_.world().definition().robots;
        for (KeyHelp& key : Hands::keys(robots[nodes[selected_].robot.number - 1].type)) {
            keys.push_back(std::move(key));
        }
        if (nodes.size() > 1) keys.push_back({"tab", robots.size() > 1 ? "robot" : "node"});
    }
    if (session_.events().size() > 1) keys.push_back({"PgUp PgDn", "events"});
    return keys;
}

void SimRun::show() {
    View view = view_.view(session_, selected_);
    view.speed = pace_.text();
    view.paused = pace_.paused();
    view.listening = listening_;
    view.notice = notice_;
    view.keys = key_help();
    closed_ = !screen_->paint(std::move(view), links_.now()) || closed_;
}

// A broker knows no other time than the real one.
Status check_fleet(const SimRunOptions& options) {
    if (options.fleet.target.empty() || options.speed == 1) return Status::done();
    return Error{Code::BadInput, "--fleet needs real time; leave --speed out"};
}

Result<std::unique_ptr<embed::RobotsRun>> open_robots(const SimRunOptions& options) {
    session::SimOptions made{{}, options.compile, !options.trace.empty()};
    made.world = TRY(embed::world_options({.poses = options.poses, .chaos = options.chaos}));
    made.world.seed = options.seed;
    made.world.threads = options.threads;
    made.world.sd_folder = options.sd_folder;
    if (!options.listen.empty()) made.guests = TRY(session::safe_stop_around(options.world, {}));
    TRY(check_fleet(options));
    auto door = TRY(door_to_fleet(options));
    auto robots =
        TRY(embed::RobotsRun::open({.world = options.world, .sim = made, .door = std::move(door)}));
    if (!options.fleet.target.empty() && !robots->has_projects()) {
        return Error{Code::BadInput,
                     options.world +
                         ": --fleet: no robot of this world has a \"project\"; those "
                         "that have one become members of the fleet"};
    }
    for (const std::string& path : options.loads) {
        const std::string text = TRY(read_file(path));
        robots->buses().common().load(path, text);
    }
    return robots;
}

}  // namespace

int run_sim(const SimRunOptions& options) {
    std::optional<FilesRead> files;  // all that is read from here on
    if (!options.record.empty()) files.emplace();
    const auto robots = open_robots(options);
    if (!robots.ok()) return complain(robots.error(), kExitUsage);
    SimRun run(options, *robots.value());
    const Status traced = run.open_trace();
    if (!traced.ok()) return complain(traced.error(), kExitUsage);
    const Status recording = files ? run.begin_recording(*files) : Status::done();
    if (!recording.ok()) return complain(recording.error(), kExitUsage);
    const Status listening = run.listen();
    if (!listening.ok()) {
        const bool wrong = listening.error().code == Code::BadInput;
        return complain(listening.error(), wrong ? kExitUsage : kExitFailed);
    }
    if (!run.settle()) return kExitFailed;
    const Status begun = run.start();
    if (!begun.ok()) return complain(begun.error(), kExitUsage);
    return run.run();
}

}  // namespace vagus::cli
