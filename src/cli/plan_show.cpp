#include "cli/plan_show.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cli/output.hpp"
#include "cli/plan_story.hpp"
#include "cli/screen/keys.hpp"
#include "cli/sim_view.hpp"
#include "cli/terminal.hpp"
#include "net/network.hpp"
#include "run/options.hpp"
#include "session/plan_world.hpp"

namespace vagus::cli {

namespace {

using namespace std::chrono_literals;

constexpr Duration kFrameEvery = 40ms;  // of the screen, in real time
constexpr Duration kBehindMax = 200ms;  // a machine that cannot keep up slows time down instead
constexpr Duration kButtonFor = 200ms;  // simulated: how long a key holds a robot's button
constexpr Duration kLastLookFor = 30s;  // the last page stays so long, unless a person quits
constexpr std::array<double, 9> kSpeeds = {0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50};
constexpr size_t kRealTime = 3;  // among them

// What a key holds down for a moment.
struct Held {
    sim::RobotId robot;
    std::string button;
    Time until{};
};

// The screen is driven by the run: at each instant of the world it waits for the wall clock, and
// meanwhile looks at the keys and paints.
class PlanScreen {
public:
    PlanScreen(PlanRun& run, Terminal terminal)
        : run_(run),
          terminal_(std::move(terminal)),
          story_(run.graph(), run.plan()),
          view_(session()),
          look_(look_of_environment()) {}

    // To the end of the plan, and until nobody looks any more.
    run::Ended run();
    // "the plan is over: OK", and when; nothing if it did not begin.
    const std::optional<HappeningView>& last_word() const { return last_word_; }

private:
    session::SimSession& session() { return run_.prepared().world()->session(); }
    void see(const plan::TraceEvent& event);
    void wait(Time at);
    void look_at_the_end(const run::Ended& ended);
    void turn();
    void keys();
    void act(Key key);
    void press_escape();
    void release_buttons();
    void paint();
    PlanPanelView panel();

    PlanRun& run_;
    Terminal terminal_;
    PlanStory story_;
    SimView view_;
    Look look_;
    net::Network clock_;
    Grid shown_{Size{1, 1}};
    std::string keys_rest_;
    std::string notice_;
    std::string problem_;                     // the error that ended it
    std::optional<HappeningView> last_word_;  // it is over
    size_t speed_ = kRealTime;
    bool paused_ = false;
    bool quit_ = false;
    std::vector<Held> held_;
    Time at_{};           // of the run
    Time real_before_{};  // when at_ was due
    Time next_frame_{};
};

run::Ended PlanScreen::run() {
    run_.prepared().listen([this](const plan::TraceEvent& event) { see(event); });
    run_.prepared().pace([this](Time at) { wait(at); });
    real_before_ = clock_.now();
    const run::Ended ended = run_.run();
    if (last_word_ && !quit_) look_at_the_end(ended);
    return ended;
}

void PlanScreen::see(const plan::TraceEvent& event) {
    story_.see(event);
    if (run::level_of(event) > 0 || !std::holds_alternative<plan::PlanEnded>(event.what)) return;
    last_word_ = {event.at, sentence_of(event).value_or(""), true};
}

void PlanScreen::look_at_the_end(const run::Ended& ended) {
    at_ = last_word_->at;
    notice_ = last_word_->text;
    problem_ = ended.message;
    const Time close = clock_.now() + kLastLookFor;
    while (!quit_ && !end_asked() && clock_.now() < close) {
        turn();
        (void)clock_.poll(std::min(close, next_frame_));
    }
}

void PlanScreen::wait(Time at) {
    const Duration step = at - at_;
    at_ = at;
    view_.follow(session(), 0);
    release_buttons();
    const auto real = std::chrono::duration_cast<Duration>(step / kSpeeds.at(speed_));
    Time due = real_before_ + real;
    if (clock_.now() > due + kBehindMax) due = clock_.now();
    if (clock_.now() >= next_frame_) turn();
    while (!quit_ && (paused_ || clock_.now() < due)) {
        (void)clock_.poll(paused_ ? next_frame_ : std::min(due, next_frame_));
        if (clock_.now() >= next_frame_) turn();
        if (paused_) due = clock_.now();
    }
    real_before_ = due;
}

void PlanScreen::turn() {
    keys();
    paint();
    if (end_asked() && !quit_) act(Key::Quit);
}

void PlanScreen::keys() {
    for (const Key key : keys_of(terminal_.read(), keys_rest_)) act(key);
}

void PlanScreen::act(Key key) {
    if (last_word_ && key != Key::Quit && key != Key::Redraw) return;
    switch (key) {
        case Key::Quit:
            quit_ = true;
            run_.prepared().abort();
            break;
        case Key::Pause:
            paused_ = !paused_;
            break;
        case Key::Faster:
            speed_ = std::min(speed_ + 1, kSpeeds.size() - 1);
            break;
        case Key::Slower:
            speed_ = speed_ > 0 ? speed_ - 1 : 0;
            break;
        case Key::Escape:
        case Key::Centre:
            press_escape();
            break;
        case Key::Tap:
            (void)session().world().tap(sim::RobotId{1}).ok();  // none is there: nothing to tap
            break;
        case Key::Redraw:
            shown_ = Grid(Size{1, 1});
            break;
        case Key::Reset:
        case Key::NextRobot:
        case Key::LastRobot:
        case Key::Forward:
        case Key::Backward:
        case Key::Left:
        case Key::Right:
            break;
    }
}

// The first robot's button that ends plans: that of this name, or the one in the middle.
void PlanScreen::press_escape() {
    const auto robots = session().world().robots();
    if (robots.empty()) return;
    const auto names = sim::buttons_of(robots.front().type);
    const bool has = std::find(names.begin(), names.end(), "escape") != names.end();
    const std::string button = has ? "escape" : "center";
    const Status pressed = session().world().press(robots.front().id, button);
    notice_ = pressed.ok() ? button + " is pressed" : pressed.error().what;
    if (pressed.ok()) held_.push_back({robots.front().id, button, at_ + kButtonFor});
}

void PlanScreen::release_buttons() {
    std::erase_if(held_, [this](const Held& held) {
        if (at_ < held.until) return false;
        (void)session().world().release(held.robot, held.button).ok();
        return true;
    });
}

PlanPanelView PlanScreen::panel() {
    PlanPanelView panel = story_.panel(at_);
    if (paused_ && !panel.over) panel.state = "paused";
    const auto load = session().world().bus_load();
    if (!load) return panel;
    panel.load = load->all.share_of_last_second;
    for (const sim::NodeLoad& node : load->nodes) {
        panel.loads.push_back({node.load.name, node.load.share_of_last_second});
    }
    return panel;
}

void PlanScreen::paint() {
    next_frame_ = clock_.now() + kFrameEvery;
    View view = view_.view(session(), 0);
    view.now = at_;
    view.plan = panel();
    view.button_does = "escape button";
    view.speed = "x" + fmt::format("{}", kSpeeds.at(speed_));
    view.paused = paused_;
    view.notice = notice_;
    if (!problem_.empty()) {
        view.problems_title = notice_;
        view.problems = {problem_};
    }
    const Grid page = cli::draw(view, terminal_.size(), look_);
    const Grid* before = terminal_.take_lost() ? nullptr : &shown_;
    const bool open = terminal_.write(repaint(before, page, look_.depth));
    if (!open && !quit_) act(Key::Quit);
    shown_ = page;
}

void print_line(Time at, const std::string& text) {
    const double seconds = std::chrono::duration<double>(at).count();
    print(fmt::format("{:9.3f} s  {}\n", seconds, text));
}

void print_summary(const session::SimSession& session) {
    for (const sim::RobotView& robot : session.world().robots()) {
        print_line(session.now(), fmt::format("{} stands at {:.2f}, {:.2f} m", robot.name,
                                              robot.pose.at.x, robot.pose.at.y));
    }
    const auto load = session.world().bus_load();
    if (!load) return;
    std::string text = fmt::format("load of the bus {:.1f} %:", 100 * load->all.share_of_all);
    for (const sim::NodeLoad& node : load->nodes) {
        text += fmt::format(" {} {:.1f}", node.load.name, 100 * node.load.share_of_all);
    }
    print_line(session.now(), text);
}

// Gives the exit code.
int tell_end(PlanRun& run, const run::Ended& ended) {
    print_summary(run.prepared().world()->session());
    if (!ended.message.empty()) complain(ended.message);
    return run::exit_status(ended);
}

}  // namespace

PlanShown how_to_show(const PlanRunOptions& options) {
    const embed::RunWords& words = options.words;
    // stdout is for one reader at a time.
    if (words.world.empty() || words.trace == "-" || words.trace_all == "-") {
        return PlanShown::Nowhere;
    }
    const bool screen = words.clock != "virtual" && !options.headless && Terminal::can_draw();
    return screen ? PlanShown::Screen : PlanShown::Lines;
}

int run_on_screen(PlanRun& run) {
    watch_for_end();
    auto terminal = Terminal::open();
    if (!terminal.ok()) return complain(terminal.error());
    auto screen = std::make_unique<PlanScreen>(run, std::move(terminal.value()));
    const run::Ended ended = screen->run();
    const auto last_word = screen->last_word();
    // What is said from here on stands on the normal screen.
    screen.reset();
    if (last_word) print_line(last_word->at, last_word->text);
    return end_as_asked(tell_end(run, ended));
}

int run_in_lines(PlanRun& run) {
    run.prepared().listen([](const plan::TraceEvent& event) {
        if (const auto sentence = sentence_of(event)) print_line(event.at, *sentence);
    });
    const run::Ended ended = run.run();
    return tell_end(run, ended);
}

}  // namespace vagus::cli
