#include "cli/plan/show.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/time.hpp"
#include "cli/live_screen.hpp"
#include "cli/output.hpp"
#include "cli/plan/story.hpp"
#include "cli/screen/pace.hpp"
#include "cli/sim/hands.hpp"
#include "cli/sim/view.hpp"
#include "net/links.hpp"
#include "run/options.hpp"
#include "session/plan_world.hpp"

namespace vagus::cli {

namespace {

// The screen is driven by the run: at each instant of the world it waits for the wall clock, and
// meanwhile looks at the keys and paints.
class PlanScreen {
public:
    PlanScreen(TerminalRun& run, std::unique_ptr<LiveScreen> screen)
        : run_(run), screen_(std::move(screen)) {}

    // To the end of the plan, and until nobody looks any more; again where a person restarts it.
    run::Ended run();
    // "the plan is over: OK", and when; nothing if it did not begin.
    const std::optional<HappeningView>& last_word() const { return last_word_; }
    // What was said on the screen for a while, for those who looked away.
    const std::vector<std::string>& notices() const { return notices_; }

private:
    sim::RobotId robot() const { return run_.prepared().world()->robot(); }
    sim::RobotType type_of_robot() { return session().world().robots()[robot().number - 1].type; }
    session::SimSession& session() { return run_.prepared().world()->session(); }
    void begin();
    size_t first_node();
    void see(const plan::TraceEvent& event);
    void wait(Time at);
    void look_at_the_end(const run::Ended& ended);
    bool leaves() const { return quit_ || restart_; }
    void turn();
    void act(Key key);
    void act_at_the_end(Key key);
    void leave(bool& why);
    std::vector<KeyHelp> key_help();
    void paint();
    PlanPanelView panel();

    TerminalRun& run_;
    std::unique_ptr<LiveScreen> screen_;
    std::optional<PlanStory> story_;
    std::optional<SimView> view_;  // of the world of this run
    net::Links clock_;
    Pace pace_;
    Hands hands_;
    std::string notice_;
    std::vector<std::string> notices_;
    std::string problem_;                     // the error that ended it
    std::optional<HappeningView> last_word_;  // it is over
    bool quit_ = false;
    bool restart_ = false;
    Time at_{};           // of the run
    Time real_before_{};  // when at_ was due
};

run::Ended PlanScreen::run() {
    run_.prepared().listen([this](const plan::TraceEvent& event) { see(event); });
    run_.prepared().pace([this](Time at) { wait(at); });
    run_.prepared().tell([this](const std::string& sentence) {
        notice_ = sentence;
        notices_.push_back(sentence);
    });
    while (true) {
        begin();
        const run::Ended ended = run_.run();
        if (last_word_ && !leaves()) look_at_the_end(ended);
        if (quit_ || !restart_) return ended;
        notice_ = "restarted";
        if (!run_.record().empty()) notice_ += "; " + run_.record() + " has the first run";
    }
}

void PlanScreen::begin() {
    story_.emplace(run_.graph(), run_.plan());
    view_.reset();
    hands_.forget();
    screen_->scroll_to_latest();
    problem_.clear();
    last_word_.reset();
    restart_ = false;
    at_ = {};
    real_before_ = clock_.now();
}

// That of the plan's robot, as a place in session().nodes().
size_t PlanScreen::first_node() {
    const auto nodes = session().nodes();
    const auto found = std::find_if(nodes.begin(), nodes.end(),
                                    [this](const auto& node) { return node.robot == robot(); });
    return static_cast<size_t>(found - nodes.begin());
}

void PlanScreen::see(const plan::TraceEvent& event) {
    story_->see(event);
    if (run::level_of(event) > 0 || !std::holds_alternative<plan::PlanEnded>(event.what)) return;
    last_word_ = {event.at, sentence_of(event).value_or(""), true};
}

void PlanScreen::look_at_the_end(const run::Ended& ended) {
    at_ = last_word_->at;
    notice_ = last_word_->text;
    problem_ = ended.message;
    while (!leaves() && !run_.prepared().abort_asked()) {
        turn();
        (void)clock_.poll(screen_->next());
    }
}

void PlanScreen::wait(Time at) {
    const Duration step = at - at_;
    at_ = at;
    if (!view_) view_.emplace(session());
    view_->follow(session(), first_node());
    hands_.release(session());
    if (screen_->is_due(clock_.now())) turn();
    Time due = pace_.end_of(real_before_, step, clock_.now());
    while (!leaves() && (pace_.paused() || clock_.now() < due)) {
        (void)clock_.poll(pace_.paused() ? screen_->next() : std::min(due, screen_->next()));
        if (screen_->is_due(clock_.now())) turn();
        if (pace_.paused()) due = clock_.now();
    }
    real_before_ = due;
}

void PlanScreen::turn() {
    run_.prepared().serve_hosts();
    for (const Key key : screen_->keys()) act(key);
    paint();
    if (run_.prepared().abort_asked()) quit_ = true;
}

void PlanScreen::act(Key key) {
    if (last_word_) return act_at_the_end(key);
    if (pace_.act(key)) return;
    switch (key) {
        case Key::Quit:
            return leave(quit_);
        case Key::Restart:
            return leave(restart_);
        case Key::Forward:
            return screen_->scroll(1);
        case Key::Backward:
            return screen_->scroll(-1);
        default:
            break;
    }
    // By hand a robot only gets what a plan does not give it.
    if (key != Key::Escape && key != Key::Centre && key != Key::Tap) return;
    notice_ = hands_.act(key, session(), robot());
}

// It stays until a key: any that does nothing else.
void PlanScreen::act_at_the_end(Key key) {
    if (key == Key::Forward) return screen_->scroll(1);
    if (key == Key::Backward) return screen_->scroll(-1);
    leave(key == Key::Restart ? restart_ : quit_);
}

void PlanScreen::leave(bool& why) {
    why = true;
    run_.prepared().abort_this();
}

PlanPanelView PlanScreen::panel() {
    PlanPanelView panel = story_->panel(at_);
    if (pace_.paused() && !panel.over) panel.state = "paused";
    const auto load = session().world().bus_load();
    if (!load) return panel;
    panel.load = load->all.share_of_last_second;
    for (const sim::NodeLoad& node : load->nodes) {
        panel.loads.push_back({node.load.name, node.load.share_of_last_second});
    }
    return panel;
}

std::vector<KeyHelp> PlanScreen::key_help() {
    const KeyHelp scroll{"PgUp PgDn", "scroll"};
    if (last_word_) return {{"q", "quit"}, {"r", "restart"}, scroll};
    std::vector<KeyHelp> keys = {{"space", pace_.paused() ? "continue" : "pause"}, {"q", "quit"}};
    for (KeyHelp& key : Hands::keys_beside_a_plan(type_of_robot())) keys.push_back(std::move(key));
    keys.insert(keys.end(), {{"+ -", "speed"}, {"r", "restart"}, scroll});
    return keys;
}

void PlanScreen::paint() {
    if (!view_) view_.emplace(session());
    View view = view_->view(session(), first_node());
    view.now = at_;
    view.plan = panel();
    view.speed = pace_.text();
    view.paused = pace_.paused();
    view.notice = notice_;
    view.keys = key_help();
    if (!problem_.empty()) {
        view.problems_title = notice_;
        view.problems = {{problem_, {}}};
    }
    const bool open = screen_->paint(std::move(view), clock_.now());
    if (!open && !quit_) leave(quit_);
}

// Lines of a run, on one of the two streams.
class Lines {
public:
    explicit Lines(PlanShown shown) : beside_(shown == PlanShown::LinesOnStderr) {}

    void operator()(Time at, const std::string& text) const {
        const double seconds = vagus::seconds_of(at);
        const std::string line = fmt::format("{:9.3f} s  {}\n", seconds, text);
        if (beside_) {
            say(line);
        } else {
            print(line);
        }
    }

private:
    bool beside_;  // of a trace that has stdout for itself
};

void tell_summary(const session::SimSession& session, const Lines& tell) {
    for (const sim::RobotView& robot : session.world().robots()) {
        tell(session.now(), fmt::format("{} is at {:.2f}, {:.2f} m", robot.name, robot.pose.at.x,
                                        robot.pose.at.y));
    }
    const auto load = session.world().bus_load();
    if (!load) return;
    std::string text = fmt::format("load of the bus {:.1f} %:", 100 * load->all.share_of_all);
    for (const sim::NodeLoad& node : load->nodes) {
        text += fmt::format(" {} {:.1f}", node.load.name, 100 * node.load.share_of_all);
    }
    tell(session.now(), text);
}

// Gives the exit code.
int tell_end(TerminalRun& run, const run::Ended& ended, const Lines& tell) {
    if (run.prepared().world() != nullptr) tell_summary(run.prepared().world()->session(), tell);
    if (!ended.message.empty()) complain(ended.message);
    return run.exit_status(ended);
}

}  // namespace

PlanShown how_to_show(const PlanRunOptions& options) {
    if (options.quiet) return PlanShown::Nowhere;
    const embed::RunWords& words = options.words;
    // stdout is for one reader at a time.
    if (words.trace == "-" || words.trace_all == "-") return PlanShown::LinesOnStderr;
    const bool screen = !words.world.empty() && words.clock != "virtual" && !options.headless &&
                        Terminal::can_draw();
    return screen ? PlanShown::Screen : PlanShown::Lines;
}

int run_on_screen(TerminalRun& run, const std::string& theme) {
    auto live = LiveScreen::open(theme);
    if (!live.ok()) return complain(live.error());
    auto screen = std::make_unique<PlanScreen>(run, std::move(live.value()));
    const run::Ended ended = screen->run();
    const auto last_word = screen->last_word();
    const auto notices = screen->notices();
    // What is said from here on is printed on the normal screen.
    screen.reset();
    run.prepared().tell([](const std::string& sentence) { complain(sentence); });
    for (const std::string& sentence : notices) complain(sentence);
    const Lines tell(PlanShown::Lines);
    if (last_word) tell(last_word->at, last_word->text);
    return tell_end(run, ended, tell);
}

int run_in_lines(TerminalRun& run, PlanShown shown) {
    const Lines tell(shown);
    run.prepared().listen([&tell](const plan::TraceEvent& event) {
        if (const auto sentence = sentence_of(event)) tell(event.at, *sentence);
    });
    const run::Ended ended = run.run();
    return tell_end(run, ended, tell);
}

}  // namespace vagus::cli
