#include "serve/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "serve/json.hpp"
#include "serve/plan_value.hpp"

namespace vagus::serve {

namespace {

// Of an answer only why it was not done.
auto why_to(Run::SetDone done) {
    return [done = std::move(done)](const talk::Answer& answer) { done(answer.why); };
}

class RunChild final : public RunProcess {
public:
    explicit RunChild(Child child) : child_(std::move(child)) {}
    Pipe& pipe() override { return child_.pipe(); }
    std::optional<ChildEnd> ended() override { return child_.ended(); }
    void kill() override { child_.kill(); }

private:
    Child child_;
};

}  // namespace

StartRunProcess start_runner(std::string program, std::string verb, size_t memory_max) {
    const ChildOptions options{.program = std::move(program),
                               .arguments = {std::move(verb)},
                               .name = "vagus",
                               .memory_max = memory_max};
    return [options]() -> Result<std::unique_ptr<RunProcess>> {
        return std::unique_ptr<RunProcess>(std::make_unique<RunChild>(TRY(Child::start(options))));
    };
}

Run::Run(Desk& desk, StartRunProcess start)
    : desk_(desk), start_(std::move(start)), flows_(desk.topics()) {
    forget_held();
    declare_topics();
}

// ---- its life ----

Status Run::open(const RunOrder& order, Time now) {
    const bool hangs = child_ && now > heard_ + kHangingAfter;
    if (!child_ || hangs || child_->ended()) {
        child_ = TRY(start_());
        ++generation_;
    }
    forget_run();
    keeps_objects_ = order.keep_objects;
    keep_hands();
    opening_ = true;
    rests_ = order.paused && !order.past;
    state_ = order.paused ? State::Paused : State::Running;
    heard_ = now_ = now;
    pace(order.paused, speed_);
    tell(open_order(order));
    desk_.topics().touch("clock");
    desk_.topics().touch("plan");
    return Status::done();
}

// All but the scene: that is shown until the next world is open.
void Run::forget_run() {
    forget_asked("the run was started again");
    forget_held();
    has_world_ = false;
    why_.clear();
    t_ = 0;
    plan_.reset();
    plan_texts_.clear();
    change_ = nullptr;
    last_actor_.clear();
    late_checks_ = 0;
    frames_.clear();
    shown_.reset();
    held_nodes_.clear();
}

talk::Open Run::open_order(const RunOrder& order) {
    talk::Open open;
    open.order = ++orders_;
    open.world = order.world;
    open.world_text = order.world_text;
    open.plan = order.plan;
    open.toolboxes = order.toolboxes;
    for (const auto& [name, value] : order.set.items()) {
        open.set[name] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    open.breakpoints = order.breakpoints;
    open.robot = order.robot;
    open.from = order.from;
    open.bus = order.bus;
    open.project = order.project;
    open.target = order.target;
    open.recording = order.recording;
    open.past = order.past;
    open.member = member_;
    if (order.keep_poses) open.poses = flows_.poses_now();
    return open;
}

void Run::close() {
    let_end();
    forget_asked("the run has ended");
    forget_held();
    breakpoints_told_({});
    has_world_ = false;
    programs_.clear();
    state_ = State::None;
    t_ = 0;
    load_.reset();
    scene_.reset();
    plan_.reset();
    flows_.forget();
    desk_.topics().touch("clock");
    desk_.topics().touch("plan");
    desk_.topics().touch("scene");
}

// What it was told last is read before the end of its pipe. One that hangs is killed later.
void Run::let_end() {
    if (!child_) return;
    child_->pipe().flush();
    child_->pipe().close();
    if (closed_.size() == kClosedMax) closed_.erase(closed_.begin());
    closed_.push_back({std::move(child_), std::nullopt});
}

void Run::end_closed() {
    std::erase_if(closed_, [this](Closed& one) {
        if (!one.until) one.until = now_ + kClosedEndsWithin;
        return one.process->ended() || now_ >= *one.until;
    });
}

void Run::give_up(const std::string& what) {
    if (child_) be_over(what);
}

int Run::descriptor() {
    return child_ ? child_->pipe().descriptor() : -1;
}

void Run::kill() {
    if (child_) child_->kill();
}

void Run::tick(Time now) {
    now_ = now;
    end_closed();
    if (!child_) return;
    child_->pipe().flush();
    hear_all();
    if (!child_) return;
    if (const auto end = child_->ended()) return hear_end("the run " + end->what);
    const bool silent = now > heard_ + kHangingAfter;
    if (silent && state_ != State::Hanging) {
        state_ = State::Hanging;
        desk_.topics().touch("clock");
        say_("warning", "the run does not answer; End run ends it");
    }
    show_what_is_watched();
}

Time Run::next_tick() const {
    if (!closed_.empty()) return now_ + 5ms;
    if (!child_) return Time::max();
    // The socket is watched for reading only, and a process that closed it is about to end.
    const Pipe& pipe = child_->pipe();
    return pipe.has_unsent() || pipe.closed() ? now_ + 5ms : heard_ + kHangingAfter + 1ms;
}

// ---- orders ----

void Run::tell(const talk::Order& order) {
    if (child_) child_->pipe().send(talk::encode(order));
}

void Run::hear_of_fleet(const talk::HearOfFleet& event) {
    tell(event);
}

void Run::pace(bool paused, double speed) {
    if (!paused) rests_ = false;
    paused_ = paused;
    speed_ = speed;
    if (state_ == State::Running || state_ == State::Paused) {
        state_ = paused ? State::Paused : State::Running;
    }
    tell(talk::SetPace{paused, speed});
    desk_.topics().touch("clock");
}

void Run::step(int milliseconds) {
    rests_ = false;
    tell(talk::LetTimePass{static_cast<uint32_t>(milliseconds)});
    desk_.topics().touch("clock");
}

void Run::begin() {
    if (!plan_ || plan_->stands_at.empty()) return go_on();
    rests_ = false;
    desk_.topics().touch("clock");
}

void Run::rest() {
    rests_ = true;
    pause();
}

// Rays and pictures cost time: only while somebody looks.
void Run::show_what_is_watched() {
    talk::Show show;
    for (const Json& of : desk_.topics().subjects("picture")) show.pictures.insert(of["robot"]);
    show.rays = desk_.topics().watched("rays");
    if (show == shown_) return;
    shown_ = show;
    flows_.keep_pictures_of(show.pictures);
    tell(std::move(show));
}

// ---- orders that are answered ----

// Numbered, so that a late answer of a run before is nobody else's.
template <typename Request>
void Run::ask(Request order, Answered answered) {
    order.request = ++asked_;
    answers_.emplace(asked_, std::move(answered));
    tell(std::move(order));
}

// Nobody will answer any more.
void Run::forget_asked(const std::string& why) {
    for (const auto& [number, answered] : std::exchange(answers_, {})) {
        answered({.request = number, .why = why});
    }
}

void Run::lend_hand(HandOrder order, HandDone done) {
    Answered answered = [this, order, done = std::move(done)](const talk::Answer& answer) {
        if (answer.why.empty()) note_hand(order);
        done(answer.number, answer.why);
    };
    std::visit([&](auto& one) { ask(std::move(one), std::move(answered)); }, order);
}

// The numbers of objects count up, so the same orders give the same numbers in the same world.
void Run::note_hand(const HandOrder& order) {
    const bool changes = std::holds_alternative<talk::MoveObject>(order) ||
                         std::holds_alternative<talk::PutObject>(order) ||
                         std::holds_alternative<talk::TakeObject>(order) ||
                         std::holds_alternative<talk::SwitchLight>(order);
    if (!changes) return;
    const auto* const move = std::get_if<talk::MoveObject>(&order);
    const auto* const before =
        by_hand_.empty() ? nullptr : std::get_if<talk::MoveObject>(&by_hand_.back());
    const bool goes_on = move && before && move->object == before->object;
    if (goes_on) by_hand_.pop_back();
    if (by_hand_.size() < kHandsKept) by_hand_.push_back(order);
}

// One that could not be opened has not had them yet.
void Run::keep_hands() {
    if (!keeps_objects_) by_hand_next_.clear();
    if (keeps_objects_ && by_hand_next_.empty()) by_hand_next_ = std::move(by_hand_);
    by_hand_.clear();
}

void Run::script_loaded(uint16_t node, const std::string& file, const std::string& text) {
    if (has_world()) tell(talk::ScriptLoaded{node, file, text});
}

void Run::flush_recording(std::function<void()> done) {
    if (!is_open() || opening_) return done();
    ask(talk::FlushRecording{}, [done = std::move(done)](const talk::Answer&) { done(); });
}

// ---- the plan ----

bool Run::plan_runs() const {
    return is_open() && plan_ && plan_->state != talk::PlanState::Ended;
}

void Run::step_plan() {
    tell(talk::StepPlan{});
}

void Run::stop_plan() {
    tell(talk::StopPlan{});
}

void Run::hold_nodes(std::vector<uint16_t> nodes) {
    if (!plan_runs() || nodes == held_nodes_) return;
    held_nodes_ = std::move(nodes);
    tell(talk::HoldNodes{held_nodes_});
}

void Run::set_breakpoints(const std::vector<talk::BreakpointOrder>& list) {
    tell(talk::SetBreakpoints{list});
}

void Run::set_variable(int level, const std::string& name, const Json& value, SetDone done) {
    ask(talk::SetVariable{0, static_cast<uint32_t>(level), name, plan_value(value)},
        why_to(std::move(done)));
}

void Run::raise(const std::string& supervisor, const std::string& event, const Json& outputs,
                SetDone done) {
    talk::RaiseEvent order{0, supervisor, event, {}};
    for (const auto& [name, value] : outputs.items()) order.outputs[name] = plan_value(value);
    ask(std::move(order), why_to(std::move(done)));
}

void Run::handle_held(talk::HeldAct act, std::optional<uint64_t> number, SetDone done) {
    ask(talk::HandleHeld{0, act, number}, why_to(std::move(done)));
}

// What waited for a plan that has ended waits no more.
void Run::forget_held() {
    held_ = {{"stands", false}, {"events", Json::array()}, {"more", 0}, {"dropped", 0}};
    desk_.topics().touch("held");
}

// ---- a new version of the plan (P31) ----

void Run::change_plan(const std::vector<std::string>& files) {
    ask(talk::ChangePlan{0, files},
        [this, files](const talk::Answer& answer) { keep_change(files, answer); });
}

void Run::keep_change(const std::vector<std::string>& files, const talk::Answer& answer) {
    const Reasons reasons = reasons_in(answer);
    if (!reasons) return;  // none of its files, or the plan has ended
    Json docs = Json::array();
    for (const std::string& file : files) docs.push_back(doc_of_(file));
    const bool taken = reasons->empty();
    change_ = {{"number", ++changes_},
               {"t", t_},
               {"state", taken ? "taken" : "refused"},
               {"docs", docs},
               {"reasons", *reasons}};
    desk_.topics().touch("plan");
    if (taken) return;
    std::string text = "the running plan cannot take this change; it continues unchanged:";
    for (const std::string& reason : *reasons) text += "\n" + reason;
    say_("warning", text);
}

Run::Reasons Run::reasons_in(const talk::Answer& answer) const {
    if (!answer.reasons) return std::nullopt;
    std::vector<std::string> reasons;
    for (const std::string& reason : *answer.reasons) reasons.push_back(short_(reason));
    return reasons;
}

void Run::check_change(const std::map<std::string, std::string>& texts,
                       std::function<void(const Reasons& reasons)> done) {
    ask(talk::CheckPlan{0, texts},
        [this, done = std::move(done)](const talk::Answer& answer) { done(reasons_in(answer)); });
}

std::optional<std::string> Run::plan_text(const std::string& doc) const {
    const auto found = plan_texts_.find(doc);
    if (!plan_runs() || found == plan_texts_.end()) return std::nullopt;
    return found->second;
}

// ---- Carrier ----

void Run::send(const wire::Frame& frame) {
    ++frames_out_;
    tell(talk::SendFrame{{frame}});
}

Connection Run::connection() const {
    switch (state_) {
        case State::None:
            return Connection::Connecting;
        case State::Running:
        case State::Paused:
        case State::Hanging:
            return Connection::Connected;
        case State::Dead:
            return Connection::Lost;
    }
    return Connection::Lost;
}

std::vector<LinkView> Run::links() const {
    std::vector<uint16_t> nodes;
    for (const talk::SceneRobot& robot : robots()) {
        nodes.insert(nodes.end(), robot.nodes.begin(), robot.nodes.end());
    }
    return {{"simulator", nodes, frames_in_, frames_out_, 0}};
}

// ---- the world ----

const std::vector<talk::SceneRobot>& Run::robots() const {
    static const std::vector<talk::SceneRobot> kNone;
    return scene_ ? scene_->robots : kNone;
}

size_t Run::node_count() const {
    size_t count = 0;
    for (const talk::SceneRobot& robot : robots()) count += robot.nodes.size();
    return count;
}

std::string Run::robot_of(uint16_t node) const {
    for (const talk::SceneRobot& robot : robots()) {
        if (std::ranges::count(robot.nodes, node) > 0) return robot.name;
    }
    return {};
}

}  // namespace vagus::serve
