#include "cli/sim_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "base/file.hpp"
#include "cli/file_watch.hpp"
#include "cli/output.hpp"
#include "cli/screen/keys.hpp"
#include "cli/sim_lines.hpp"
#include "cli/sim_view.hpp"
#include "cli/terminal.hpp"
#include "net/network.hpp"
#include "session/sim_session.hpp"

namespace vagus::cli {
namespace {

using namespace std::chrono_literals;

constexpr Duration kTurn = 10ms;        // of the loop, in real time
constexpr Duration kFrameEvery = 40ms;  // of the screen
constexpr Duration kBehindMax = 200ms;  // a machine that cannot keep up slows time down instead
constexpr Duration kSettleWithin = 5s;  // simulated: robots describe themselves in far less
constexpr Duration kHeadlessFor = 20s;  // simulated, unless --duration says otherwise
constexpr Duration kButtonFor = 200ms;  // simulated: how long a key holds a robot's button
// How the arrows drive a robot by hand, until its script misses signs of life: mm/s, 0.1 deg/s.
constexpr int16_t kHandSpeed = 200;
constexpr int16_t kHandRate = 600;
constexpr int16_t kTokenMax = 0x7fff;
constexpr std::array<double, 10> kSpeeds = {0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 0};  // 0: max

std::string speed_text(double speed) {
    if (speed == 0) return "max";
    std::string digits = std::to_string(speed);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) digits.pop_back();
    return "x" + digits;
}

Duration seconds(double value) {
    return Duration(std::llround(value * 1e6));
}

// A button that a key holds down for a moment.
struct Held {
    sim::RobotId robot;
    std::string name;
    Time until{};
};

// A robot's own port.
struct Port {
    net::PlaceId place;
    sim::RobotId robot;
};

class SimRun {
public:
    SimRun(const SimRunOptions& options, session::SimSession session)
        : options_(options),
          session_(std::move(session)),
          lines_(session_),
          view_(session_),
          watch_(options.watch ? session_.script_paths() : std::vector<std::string>()),
          speed_(options.speed) {}

    Status listen();
    Status open_trace();
    // Steps until the scripts run, so that their mistakes are known before the screen appears.
    // False if there are some and nobody watches their files.
    bool settle();
    int run();

private:
    bool on_terminal() const { return terminal_ != nullptr; }
    Duration end() const;
    bool ended() const { return session_.now() >= end() || end_asked() || closed_; }
    void turn();
    void pass_time(Time real);
    Duration to_next_step() const;
    void advance(Duration span);
    void set_speed(double speed);
    void step_speed(int direction);
    void notice(const net::Event& event);
    void look_at_files();
    void tell_notes();
    void write_trace();
    void keys();
    void act(Key key);
    void press(const std::string& button);
    void arrow(const std::string& button, int16_t speed, int16_t rate);
    bool has_button(std::string_view button) const;
    void release_buttons();
    void reset();
    void show();

    const SimRunOptions& options_;
    session::SimSession session_;
    net::Network network_;  // after the session: its links leave the session's bus first
    SimLines lines_;
    SimView view_;
    FileWatch watch_;
    std::unique_ptr<Terminal> terminal_;  // nullptr: plain lines
    Look look_;
    Grid shown_{Size{1, 1}};
    std::string keys_rest_;
    std::string listening_;
    std::string notice_;
    std::ofstream trace_;
    double speed_;
    bool running_ = false;  // run() has begun
    bool paused_ = false;
    bool closed_ = false;  // nobody reads, or a person quits
    size_t selected_ = 0;
    std::vector<Held> held_;
    int16_t hand_token_ = 0;  // of the last command by hand
    std::vector<Port> ports_;
    Time real_before_{};
    Duration owed_{};  // simulated time that is due
    Time next_frame_{};
};

Status SimRun::listen() {
    if (!options_.listen.empty()) {
        const auto target = TRY(net::parse_target(options_.listen));
        const auto listening = TRY(network_.listen(session_.world().bus(), target));
        listening_ = net::to_string(listening.target);
        print("listening " + listening_ + "\n");
    }
    const auto& robots = session_.world().definition().robots;
    const auto views = session_.world().robots();
    for (size_t i = 0; i < robots.size() && i < views.size(); i++) {
        hub::Hub* hub = session_.world().private_bus(views[i].id);
        if (hub == nullptr) continue;
        const net::Target target{net::TcpPlace{"127.0.0.1", *robots[i].port}};
        const auto listening = TRY(network_.listen(*hub, target, {.clients = net::Clients::One}));
        ports_.push_back({listening.place, views[i].id});
        print("listening " + net::to_string(listening.target) + " " + robots[i].name + "\n");
    }
    return Status::done();
}

Status SimRun::open_trace() {
    if (options_.trace.empty() || options_.trace == "-") return Status::done();
    trace_.open(options_.trace, std::ios::binary);
    if (trace_.is_open()) return Status::done();
    return Error{Code::Unavailable, "--trace: " + options_.trace +
                                        " cannot be written; name a file in a folder that exists"};
}

bool SimRun::settle() {
    while (!session_.settled() && session_.now() < kSettleWithin) advance(sim::kNodeStep);
    const bool good = session_.mistakes().empty();
    if (!good && !options_.watch) {
        lines_.tell(session_.take_notes());
        return false;
    }
    return true;
}

Duration SimRun::end() const {
    if (options_.duration) return seconds(*options_.duration);
    return on_terminal() ? Duration::max() : kHeadlessFor;
}

int SimRun::run() {
    watch_for_end();
    // Without a keyboard, or on a terminal that cannot move its cursor, lines are what helps.
    if (!options_.headless && Terminal::can_draw()) {
        auto opened = Terminal::open();
        if (!opened.ok()) return complain(opened.error());
        terminal_ = std::make_unique<Terminal>(std::move(opened.value()));
        look_ = look_of_environment();
    }
    running_ = true;
    real_before_ = network_.now();
    while (!ended()) turn();
    tell_notes();
    write_trace();
    terminal_.reset();
    trace_.close();
    if (!options_.trace.empty() && options_.trace != "-" && trace_.fail()) {
        return complain("--trace: " + options_.trace +
                        " could not be written to its end; is the disk full?");
    }
    return end_as_asked(kExitDone);
}

void SimRun::turn() {
    const Time now = network_.now();
    pass_time(now);
    release_buttons();
    look_at_files();
    view_.follow(session_, selected_);
    tell_notes();
    write_trace();
    if (on_terminal()) {
        keys();
        if (network_.now() >= next_frame_) show();
    }
    const bool hurry = speed_ == 0 && !paused_;
    for (const net::Event& event : network_.poll(hurry ? now : now + kTurn)) notice(event);
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
    if (paused_) return;
    if (speed_ == 0) {
        // As much as fits between two looks at keys and sockets.
        while (!ended() && network_.now() - real < kTurn) advance(to_next_step());
        return;
    }
    owed_ += Duration(std::llround(static_cast<double>(passed.count()) * speed_));
    owed_ = std::min(owed_, Duration(std::llround(static_cast<double>(kBehindMax.count()) *
                                                  std::max(speed_, 1.0))));
    const Time deadline = real + kBehindMax;
    while (owed_ >= sim::kNodeStep && !ended() && network_.now() < deadline) {
        const Duration span = std::min(owed_ - owed_ % sim::kNodeStep, to_next_step());
        advance(span);
        owed_ -= span;
    }
}

// Whole steps of the physics end on their multiples, so that lines of each second name its end.
Duration SimRun::to_next_step() const {
    return sim::kPhysicsStep - session_.now() % sim::kPhysicsStep;
}

void SimRun::advance(Duration span) {
    session_.step(std::min(span, end() - session_.now()));
    // Plain lines stand for moments of simulated time, however many of them pass in a turn.
    if (running_ && !on_terminal()) tell_notes();
}

void SimRun::set_speed(double speed) {
    speed_ = speed;
    owed_ = {};
}

void SimRun::step_speed(int direction) {
    const auto rank = [](double speed) { return speed == 0 ? 1e9 : speed; };
    if (direction > 0) {
        const auto next = std::find_if(kSpeeds.begin(), kSpeeds.end(),
                                       [&](double speed) { return rank(speed) > rank(speed_); });
        if (next != kSpeeds.end()) set_speed(*next);
        return;
    }
    const auto next = std::find_if(kSpeeds.rbegin(), kSpeeds.rend(),
                                   [&](double speed) { return rank(speed) < rank(speed_); });
    if (next != kSpeeds.rend()) set_speed(*next);
}

void SimRun::look_at_files() {
    for (const std::string& path : watch_.changed(network_.now())) {
        const auto text = read_file(path);
        // Gone again already: the next look finds what replaces it.
        if (text.ok()) session_.reload(path, text.value());
    }
}

void SimRun::tell_notes() {
    const std::vector<session::Note> notes = session_.take_notes();
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
    if (options_.trace.empty()) return;
    const std::string text = session_.take_trace();
    if (options_.trace != "-") {
        trace_ << text;
    } else if (!text.empty()) {
        closed_ = !print(text) || closed_;
    }
}

void SimRun::keys() {
    for (const Key key : keys_of(terminal_->read(), keys_rest_)) act(key);
}

void SimRun::act(Key key) {
    const size_t nodes = session_.nodes().size();
    switch (key) {
        case Key::Pause:
            paused_ = !paused_;
            break;
        case Key::Reset:
            reset();
            break;
        case Key::Faster:
            step_speed(1);
            break;
        case Key::Slower:
            step_speed(-1);
            break;
        case Key::NextRobot:
            selected_ = nodes > 0 ? (selected_ + 1) % nodes : 0;
            break;
        case Key::LastRobot:
            selected_ = nodes > 0 ? (selected_ + nodes - 1) % nodes : 0;
            break;
        case Key::Escape:
        case Key::Centre:
            press(has_button("escape") ? "escape" : "center");
            break;
        case Key::Forward:
            arrow("forward", kHandSpeed, 0);
            break;
        case Key::Backward:
            arrow("backward", -kHandSpeed, 0);
            break;
        case Key::Left:
            arrow("left", 0, kHandRate);
            break;
        case Key::Right:
            arrow("right", 0, -kHandRate);
            break;
        case Key::Tap: {
            const auto states = session_.nodes();
            if (selected_ >= states.size()) break;
            const Status done = session_.world().tap(states[selected_].robot);
            notice_ = done.ok() ? "tapped" : done.error().what;
            break;
        }
        case Key::Quit:
            closed_ = true;
            break;
        case Key::Redraw:
            shown_ = Grid(Size{1, 1});
            break;
    }
    next_frame_ = {};  // an answer to a key is seen at once
}

void SimRun::press(const std::string& button) {
    const auto nodes = session_.nodes();
    if (selected_ >= nodes.size()) return;
    const Status done = session_.world().press(nodes[selected_].robot, button);
    notice_ = done.ok() ? "button " + button : done.error().what;
    if (done.ok()) held_.push_back({nodes[selected_].robot, button, session_.now() + kButtonFor});
}

bool SimRun::has_button(std::string_view button) const {
    const auto nodes = session_.nodes();
    if (selected_ >= nodes.size()) return true;
    const size_t robot = nodes[selected_].robot.number - 1;
    const auto names = sim::buttons_of(session_.world().definition().robots[robot].type);
    return std::find(names.begin(), names.end(), button) != names.end();
}

// A button of that name; on a robot without it the driving events of docs/carbot.md, if its script
// has them. Each key is a command of its own, so that one after a touch is obeyed.
void SimRun::arrow(const std::string& button, int16_t speed, int16_t rate) {
    if (has_button(button)) return press(button);
    hand_token_ = hand_token_ == kTokenMax ? int16_t{1} : static_cast<int16_t>(hand_token_ + 1);
    const std::array<int16_t, 3> arguments = {hand_token_, speed, rate};
    const Status done = session_.emit("drive.steer", arguments, session_.now());
    notice_ =
        done.ok() ? "driven by hand" : "this robot has no buttons that the arrows could press";
}

void SimRun::release_buttons() {
    std::erase_if(held_, [this](const Held& held) {
        if (session_.now() < held.until) return false;
        const Status released = session_.world().release(held.robot, held.name);
        if (!released.ok()) notice_ = released.error().what;
        return true;
    });
}

void SimRun::reset() {
    session_.reset();
    view_.forget();
    held_.clear();
    owed_ = {};
    notice_ = "begun again";
}

void SimRun::show() {
    next_frame_ = network_.now() + kFrameEvery;
    View view = view_.view(session_, selected_);
    view.speed = speed_text(speed_);
    view.paused = paused_;
    view.listening = listening_;
    view.notice = notice_;
    const Grid page = draw(view, terminal_->size(), look_);
    const Grid* before = terminal_->take_lost() ? nullptr : &shown_;
    closed_ = !terminal_->write(repaint(before, page, look_.depth)) || closed_;
    shown_ = page;
}

Result<session::SimSession> open_session(const SimRunOptions& options) {
    session::SimOptions made{{}, options.compile, !options.trace.empty()};
    made.world.seed = options.seed;
    made.world.sd_folder = options.sd_folder;
    session::SimSession session = TRY(session::open_sim(options.world, made));
    for (const std::string& path : options.loads) {
        const std::string text = TRY(read_file(path));
        session.load(path, text);
    }
    return session;
}

}  // namespace

int run_sim(const SimRunOptions& options) {
    auto session = open_session(options);
    if (!session.ok()) return complain(session.error(), kExitUsage);
    SimRun run(options, std::move(session.value()));
    const Status traced = run.open_trace();
    if (!traced.ok()) return complain(traced.error(), kExitUsage);
    const Status listening = run.listen();
    if (!listening.ok()) {
        const bool wrong = listening.error().code == Code::BadInput;
        return complain(listening.error(), wrong ? kExitUsage : kExitFailed);
    }
    if (!run.settle()) return kExitFailed;
    return run.run();
}

}  // namespace vagus::cli
