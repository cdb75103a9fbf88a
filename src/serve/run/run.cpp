#include "serve/run/run.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>

#include "serve/host/frames.hpp"

namespace vagus::serve {

using Json = nlohmann::json;

// The document held without a plan that stands.
static Json nothing_held() {
    return {{"stands", false}, {"events", Json::array()}, {"more", 0}, {"dropped", 0}};
}
static constexpr const char* kLateInTrace = "\"kind\":\"late\"";  // docs/formats.md, traces

// The latest bytes of a kind, sent when they are new.
struct FlowWatch final : BinaryWatch {
    explicit FlowWatch(const Run::Flow& its_flow) : flow(its_flow) {}
    std::optional<std::pair<double, std::string>> next() override {
        if (flow.number == sent || flow.bytes.empty()) return std::nullopt;
        sent = flow.number;
        return std::pair(flow.t, flow.bytes);
    }
    const Run::Flow& flow;
    uint64_t sent = 0;
};

// The same of one robot's camera.
struct PictureWatch final : BinaryWatch {
    PictureWatch(const Run& its_run, std::string its_robot)
        : run(its_run), robot(std::move(its_robot)) {}
    std::optional<std::pair<double, std::string>> next() override {
        const auto found = run.pictures_.find(robot);
        if (found == run.pictures_.end() || found->second.number == sent) return std::nullopt;
        sent = found->second.number;
        return std::pair(found->second.t, found->second.bytes);
    }
    const Run& run;
    const std::string robot;
    uint64_t sent = 0;
};

Run::Run(Desk& desk, std::string program)
    : desk_(desk), program_(std::move(program)), held_(nothing_held()) {
    declare_topics();
}

void Run::declare_topics() {
    Board& board = desk_.board();
    board.document("clock", [this](const Json&) { return clock_document(); });
    board.document("plan", [this](const Json&) { return plan_document(); });
    board.document("held", [this](const Json&) { return held_; });
    board.document("scene", [this](const Json&) {
        if (scene_.contains("robots")) return scene_;
        return Json{{"name", ""},          {"size", {1, 1}},          {"open", true},
                    {"ground", {1, 1, 1}}, {"robots", Json::array()}, {"objects", Json::array()}};
    });
    board.binary("poses", [this](const Json&) { return std::make_unique<FlowWatch>(poses_); });
    board.binary("rays", [this](const Json&) { return std::make_unique<FlowWatch>(rays_); });
    board.binary("picture", [this](const Json& of) {
        return std::make_unique<PictureWatch>(*this, of["robot"]);
    });
}

// ---- the host ----

Status Run::open(const RunOrder& order, Time now) {
    const auto poses = poses_now();
    if (!child_ || child_->ended()) {
        child_.emplace(TRY(Child::start({program_, {"run-host"}, "vagus"})));
        ++generation_;
    }
    forget_asked("the run began anew");
    forget_held();
    opening_ = true;
    has_world_ = false;
    rests_ = order.paused;
    opens_plan_ = !order.plan.empty();
    state_ = order.paused ? State::Paused : State::Running;
    why_.clear();
    heard_ = now_ = now;
    t_ = 0;
    plan_ = Json::object();
    change_ = nullptr;
    trace_.clear();
    late_checks_ = 0;
    frames_.clear();
    shown_ = Json::object();
    Json told = {{"do", "open"},
                 {"order", ++orders_},
                 {"world", order.world},
                 {"plan", order.plan},
                 {"toolboxes", order.toolboxes},
                 {"set", order.set},
                 {"breakpoints", order.breakpoints},
                 {"robot", order.robot},
                 {"from", order.from},
                 {"bus", order.bus},
                 {"project", order.project}};
    if (order.keep_poses && !poses.empty()) told["poses"] = poses;
    pace(order.paused, speed_);
    tell(told);
    desk_.board().touch("clock");
    desk_.board().touch("plan");
    return Status::done();
}

void Run::close() {
    child_.reset();
    forget_asked("the run has ended");
    forget_held();
    breakpoints_told_(Json::array());
    has_world_ = false;
    programs_.clear();
    state_ = State::None;
    scene_ = Json::object();
    plan_ = Json::object();
    poses_ = rays_ = {};
    pictures_.clear();
    desk_.board().touch("clock");
    desk_.board().touch("plan");
    desk_.board().touch("scene");
}

int Run::descriptor() {
    return child_ ? child_->pipe().descriptor() : -1;
}

void Run::tell(const Json& message) {
    if (child_) child_->pipe().send('J', message.dump());
}

void Run::step(int milliseconds) {
    rests_ = false;
    tell({{"do", "step"}, {"ms", milliseconds}});
    desk_.board().touch("clock");
}

void Run::begin() {
    if (!plan_.contains("stands_at")) return go_on();
    rests_ = false;
    desk_.board().touch("clock");
}

void Run::rest() {
    rests_ = true;
    pause();
}

void Run::kill() {
    if (child_) child_->kill();
}

// Numbered, so that a late answer of a run before is nobody else's.
void Run::ask(Json order, Answer answer) {
    order["request"] = ++asked_;
    answers_.emplace(asked_, std::move(answer));
    tell(order);
}

void Run::lend_hand(const Json& order, HandDone done) {
    ask(order, [done = std::move(done)](const Json& told) {
        done(told.contains("number") ? std::optional<uint32_t>(told["number"]) : std::nullopt,
             told["why"]);
    });
}

void Run::set_variable(int level, const std::string& name, const Json& value, SetDone done) {
    ask({{"do", "plan.set"}, {"level", level}, {"name", name}, {"value", value}},
        [done = std::move(done)](const Json& told) { done(told["why"]); });
}

// ---- a new version of the plan (P31) ----

void Run::change_plan(const std::vector<std::string>& files) {
    ask({{"do", "plan.change"}, {"files", files}},
        [this, files](const Json& told) { keep_change(files, told); });
}

void Run::keep_change(const std::vector<std::string>& files, const Json& told) {
    const Reasons reasons = reasons_in(told);
    if (!reasons) return;  // none of its files, or the plan has ended
    Json docs = Json::array();
    for (const std::string& file : files) docs.push_back(doc_of_(file));
    const bool taken = reasons->empty();
    change_ = {{"number", ++changes_},
               {"t", t_},
               {"state", taken ? "taken" : "refused"},
               {"docs", docs},
               {"reasons", *reasons}};
    desk_.board().touch("plan");
    if (taken) return;
    std::string text = "the plan that runs cannot change so; it goes on as it was:";
    for (const std::string& reason : *reasons) text += "\n" + reason;
    say_("warning", text);
}

Run::Reasons Run::reasons_in(const Json& told) const {
    if (!told.contains("reasons")) return std::nullopt;
    std::vector<std::string> reasons;
    for (const std::string reason : told["reasons"]) reasons.push_back(short_(reason));
    return reasons;
}

void Run::check_change(const std::map<std::string, std::string>& texts,
                       std::function<void(const Reasons& reasons)> done) {
    ask({{"do", "plan.check"}, {"texts", texts}},
        [this, done = std::move(done)](const Json& told) { done(reasons_in(told)); });
}

void Run::raise(const std::string& supervisor, const std::string& event, const Json& outputs,
                SetDone done) {
    ask({{"do", "plan.raise"}, {"supervisor", supervisor}, {"event", event}, {"outputs", outputs}},
        [done = std::move(done)](const Json& told) { done(told["why"]); });
}

void Run::handle_held(const std::string& act, std::optional<uint64_t> number, SetDone done) {
    Json order = {{"do", "plan.held"}, {"act", act}};
    if (number) order["number"] = *number;
    ask(order, [done = std::move(done)](const Json& told) { done(told["why"]); });
}

// What waited for a plan that has ended waits no more.
void Run::forget_held() {
    held_ = nothing_held();
    desk_.board().touch("held");
}

// Nobody will answer any more.
void Run::forget_asked(const std::string& why) {
    for (const auto& [number, answer] : std::exchange(answers_, {})) answer({{"why", why}});
}

void Run::pace(bool paused, double speed) {
    if (!paused) rests_ = false;
    paused_ = paused;
    speed_ = speed;
    if (state_ == State::Running || state_ == State::Paused) {
        state_ = paused ? State::Paused : State::Running;
    }
    tell({{"do", "pace"}, {"paused", paused}, {"speed", speed}});
    desk_.board().touch("clock");
}

bool Run::plan_runs() const {
    return is_open() && plan_.contains("state") && plan_["state"] != "ended";
}

void Run::send(const wire::Frame& frame) {
    ++frames_out_;
    if (child_) child_->pipe().send('F', encode_frame(frame));
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
    for (const Json& robot : scene_.value("robots", Json::array())) {
        for (const Json& node : robot["nodes"]) nodes.push_back(node);
    }
    return {{"simulator", nodes, frames_in_, frames_out_, 0}};
}

size_t Run::node_count() const {
    size_t count = 0;
    for (const Json& robot : scene_.value("robots", Json::array())) count += robot["nodes"].size();
    return count;
}

std::string Run::robot_of(uint16_t node) const {
    for (const Json& robot : scene_.value("robots", Json::array())) {
        for (const Json& one : robot["nodes"]) {
            if (one == node) return robot["name"];
        }
    }
    return {};
}

// From the last frame of poses (protocol.json): robots in the order of the scene.
std::vector<std::array<double, 3>> Run::poses_now() const {
    std::vector<std::array<double, 3>> found;
    uint16_t robots = 0;
    if (poses_.bytes.size() < 4) return found;
    std::memcpy(&robots, poses_.bytes.data(), 2);
    for (size_t i = 0; i < robots && poses_.bytes.size() >= 4 + (i + 1) * 12; ++i) {
        std::array<float, 3> pose;
        std::memcpy(pose.data(), poses_.bytes.data() + 4 + i * 12, 12);
        found.push_back({pose[0], pose[1], pose[2]});
    }
    return found;
}

// ---- hearing ----

void Run::hear(const Packet& packet) {
    heard_ = now_;
    if (packet.kind == 'J') return hear_json(Json::parse(packet.bytes, nullptr, false));
    if (opening_) return;
    if (packet.kind == 'H') return told_.records(packet.bytes);
    if (packet.kind != 'F') return hear_flow(packet);
    Carried carried{{}, 0.0};
    if (packet.bytes.size() < sizeof(double)) return;
    std::memcpy(&*carried.t, packet.bytes.data(), sizeof(double));
    if (!decode_frame(packet.bytes.substr(sizeof(double)), carried.frame)) return;
    ++frames_in_;
    frames_.push_back(carried);
}

void Run::hear_flow(const Packet& packet) {
    if (packet.bytes.size() < sizeof(double)) return;
    const auto flow = [&](Flow& to, std::string bytes) {
        std::memcpy(&to.t, packet.bytes.data(), sizeof(double));
        to.bytes = std::move(bytes);
        ++to.number;
    };
    std::string bytes = packet.bytes.substr(sizeof(double));
    if (packet.kind == 'P') flow(poses_, std::move(bytes));
    if (packet.kind == 'R') flow(rays_, std::move(bytes));
    if (packet.kind != 'I') return;  // a newer host may tell more
    auto picture = take_name(bytes);
    if (picture) flow(pictures_[picture->first], std::move(picture->second));
}

void Run::hear_json(const Json& told) {
    if (!told.is_object() || !told.contains("say")) return;
    const std::string what = told["say"];
    if (what == "line") {
        say_(told["kind"], told["text"]);
    } else if (what == "answer") {
        hear_answer(told);
    } else if (what == "opening" || what == "opened" || what == "failed") {
        if (told["order"] == orders_) hear_beginning(what, told);
    } else if (opening_) {
        return;
    } else if (what == "clock") {
        t_ = told["t"];
        paused_ = told["paused"];
        real_ = told["real"];
        if (told.contains("load")) load_ = told["load"];
        if (state_ != State::Dead) state_ = paused_ ? State::Paused : State::Running;
        desk_.board().touch("clock");
    } else if (what == "scene") {
        scene_ = told["scene"];
        desk_.board().touch("scene");
    } else if (what == "plan") {
        plan_ = told["plan"];
        desk_.board().touch("plan");
    } else if (what == "held") {
        held_ = told["held"];
        desk_.board().touch("held");
    } else if (what == "breakpoints") {
        breakpoints_told_(told["list"]);
    } else if (what == "trace") {
        trace_.push_back(told["line"]);
        if (trace_.back().find(kLateInTrace) != std::string::npos) ++late_checks_;
        told_.trace(trace_.back());
        if (trace_.size() > kTraceKept) trace_.pop_front();
    } else if (what == "over") {
        rest();
    }
}

// Only of the order that was given last: another may have overtaken one before.
void Run::hear_beginning(const std::string& what, const Json& told) {
    opening_ = false;
    if (what == "opened") {
        scene_ = told.value("scene", Json::object());
        has_world_ = told.contains("scene");
        programs_.clear();
        for (const Json& one : told["programs"]) programs_.emplace(one["node"], one["source"]);
        hears_ = told["hears"].get<std::set<std::string>>();
        desk_.board().touch("scene");
        opened_();
    } else if (what == "failed") {
        why_ = told["why"];
        state_ = State::None;
        say_("error", why_);
        failed_(why_);
        desk_.board().touch("clock");
    }
}

void Run::hear_answer(const Json& told) {
    const auto found = answers_.find(told["request"].get<uint64_t>());
    if (found == answers_.end()) return;
    const Answer answer = std::move(found->second);
    answers_.erase(found);
    answer(told);
}

void Run::hear_end(const ChildEnd& end) {
    const std::string actor = last_actor();
    const std::string last = actor.empty() ? "" : "; the active actor was " + actor;
    why_ = fmt::format(
        "the run {} at {:.3f} s{}. Everything that was recorded is kept; run it "
        "again to begin anew",
        end.what, t_, last);
    const bool with_plan = plan_runs() || plan_begins();
    state_ = State::Dead;
    has_world_ = false;
    child_.reset();
    ++deaths_;
    if (plan_.contains("state") && plan_["state"] != "ended") {
        plan_["state"] = "ended";
        plan_["result"] = "Error";
        plan_["message"] = why_;
        desk_.board().touch("plan");
    }
    forget_asked(why_);
    forget_held();
    breakpoints_told_(Json::array());
    opens_plan_ = false;
    failed_(why_);
    say_("error", why_);
    if (with_plan) plan_died_();
    died_();
    desk_.board().touch("clock");
    desk_.board().touch("robot");
}

// The trace knows it to the last moment, documents only to the last tenth of a second.
std::string Run::last_actor() const {
    for (auto line = trace_.rbegin(); line != trace_.rend(); ++line) {
        const Json event = Json::parse(*line, nullptr, false);
        if (event.is_object() && event.value("kind", "") == "actor-start") {
            return event.value("actor", "");
        }
    }
    return {};
}

void Run::tick(Time now) {
    now_ = now;
    if (!child_) return;
    child_->pipe().flush();
    for (const Packet& packet : child_->pipe().receive()) hear(packet);
    if (const auto end = child_->ended()) return hear_end(*end);
    const bool silent = now > heard_ + kHangingAfter;
    if (silent && state_ != State::Hanging) {
        state_ = State::Hanging;
        desk_.board().touch("clock");
        say_("warning", "the run does not answer; End run ends it");
    }
    show_what_is_watched();
}

// Rays and pictures cost time: only while somebody looks.
void Run::show_what_is_watched() {
    std::set<std::string> robots;
    for (const Json& of : desk_.board().subjects("picture")) robots.insert(of["robot"]);
    const Json show = {
        {"do", "show"}, {"rays", desk_.board().watched("rays")}, {"pictures", robots}};
    if (show == shown_) return;
    shown_ = show;
    std::erase_if(pictures_, [&](const auto& one) { return !robots.contains(one.first); });
    tell(show);
}

Time Run::next_tick() const {
    if (!child_) return Time::max();
    // The socket is watched for reading only, and a process that closed it is about to end.
    const Pipe& pipe = child_->pipe();
    return pipe.has_unsent() || pipe.closed() ? now_ + 5ms : heard_ + kHangingAfter + 1ms;
}

// ---- documents ----

Json Run::clock_document() const {
    static constexpr const char* kNames[] = {"none", "running", "paused", "hanging", "dead"};
    Json clock = {
        {"t", t_},
        {"wall", desk_.wall_ms()},
        {"state", rests_ && state_ == State::Paused ? "none" : kNames[static_cast<size_t>(state_)]},
        {"speed", speed_},
        {"real", real_}};
    if (!why_.empty()) clock["why"] = why_;
    return clock;
}

Json Run::plan_document() const {
    if (!plan_.contains("state")) {
        return {{"state", "none"}, {"t", t_}, {"levels", Json::array()}, {"story", Json::array()}};
    }
    Json plan = plan_;
    plan["doc"] = doc_of_(plan["doc"]);
    for (Json& level : plan["levels"]) level["doc"] = doc_of_(level["doc"]);
    if (!change_.is_null()) plan["change"] = change_;
    return plan;
}

}  // namespace vagus::serve
