#include "serve/host/run_host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "embed/loaded_plan.hpp"
#include "embed/prepared_run.hpp"
#include "serve/host/bus_clock.hpp"
#include "serve/host/bus_run.hpp"
#include "serve/host/frames.hpp"
#include "serve/host/hand.hpp"
#include "serve/host/pacer.hpp"
#include "serve/host/plan_change.hpp"
#include "serve/host/plan_follower.hpp"
#include "serve/host/plan_held.hpp"
#include "serve/host/plan_stops.hpp"
#include "serve/host/plan_talk.hpp"
#include "serve/host/raised_event.hpp"
#include "serve/host/recorder.hpp"
#include "serve/host/scene.hpp"
#include "serve/plan_value.hpp"
#include "serve/process.hpp"
#include "session/bus_names.hpp"
#include "session/plan_world.hpp"
#include "session/toolboxes.hpp"

namespace vagus::serve {

namespace {

using Json = nlohmann::json;

constexpr Duration kTellEvery = 100ms;  // the clock, and what is slow: documents, pictures
constexpr Duration kPosesEvery = 33ms;  // where things are
constexpr int kPausedWaitMs = 20;       // while paused nothing moves but messages
constexpr int kAtOnceMs = 4;            // instants that are run together
constexpr int kHoldsAfterFrames = 20;   // instants in which nodes answer although time stands

Time wall_now() {
    return std::chrono::duration_cast<Time>(std::chrono::steady_clock::now().time_since_epoch());
}

class Host {
public:
    Host() : pipe_(kTalkDescriptor) {}

    int run() {
        while (!quit_) {
            if (!open_) pipe_.wait(1000);
            take_packets();
            tell({{"say", "alive"}});
            if (open_) serve();
        }
        return 0;
    }

private:
    // ---- talking ----
    void tell(const Json& message) {
        if (!pipe_.send('J', message.dump(-1, ' ', false, Json::error_handler_t::replace))) {
            quit_ = true;
        }
    }
    // Each request with a number gets one.
    void tell_answer(uint64_t request, const std::string& why,
                     std::optional<uint32_t> number = std::nullopt) {
        Json told = {{"say", "answer"}, {"request", request}, {"why", why}};
        if (number) told["number"] = *number;
        tell(told);
    }
    void tell_answer(const PlanChange::Answer& one) {
        Json told = {{"say", "answer"}, {"request", one.request}, {"why", one.why}};
        if (one.reasons) told["reasons"] = *one.reasons;
        tell(told);
    }
    void tell_line(const char* kind, const std::string& text) {
        tell({{"say", "line"}, {"kind", kind}, {"text", text}});
    }

    void take_packets() {
        for (const Packet& packet : pipe_.receive()) {
            if (packet.kind == 'F') {
                take_frame(packet.bytes);
            } else {
                obey(Json::parse(packet.bytes));
            }
        }
        if (pipe_.closed()) quit_ = true;
        if (quit_) stop_plan();
    }

    void take_frame(const std::string& bytes) {
        wire::Frame frame;
        if (session_ && decode_frame(bytes, frame)) {
            session_->world().bus().receive(link_, frame);
            holds_ = kHoldsAfterFrames;
        }
    }

    void send_frames() {
        wire::Frame frame;
        while (session_->world().bus().take(link_, frame)) {
            pipe_.send('F', stamped(encode_frame(frame)));
        }
    }

    // What changed in the world. A server that takes nothing misses it, not the run.
    void send_records() {
        if (recorder_.overflows()) recorder_.forget();
        if (pipe_.has_unsent()) return;
        const std::string records = recorder_.take();
        if (!records.empty()) pipe_.send('H', records);
    }

    // ---- opening ----
    void obey(const Json& told) {
        const std::string what = told["do"];
        if (what == "open") {
            order_ = told;
            open_ = true;
        } else if (what == "pace") {
            set_pace(told["paused"], told["speed"]);
        } else if (what == "plan.set") {
            set_variable(told);
        } else if (what == "plan.change" || what == "plan.check") {
            change_plan(told);
        } else if (what == "plan.raise") {
            ask_held(told["request"], raised_event(told));
        } else if (what == "plan.held") {
            handle_held(told);
        } else if (what == "plan.breakpoints") {
            stops_.want(told["list"]);
            tend_stops();
        } else if (what == "step") {
            pacer_.step(std::chrono::milliseconds(told["ms"].get<int>()));
        } else if (what == "plan.step") {
            step_to_actor();
        } else if (what == "plan.stop") {
            stop_plan();
            pacer_.set(false, pacer_.speed(), wall_now());
        } else if (what == "show") {
            show_rays_ = told["rays"];
            pictured_ = told["pictures"].get<std::vector<std::string>>();
        } else if (session_) {
            act(what, told);
        } else {
            tell_answer(told["request"], "the world is just being opened; try again");
        }
    }

    // Serves one order to its end: a plan in its world, then the world alone.
    void serve() {
        open_ = false;
        const Json order = order_;
        order_number_ = order["order"];
        tell({{"say", "opening"}, {"order", order_number_}});
        if (order.contains("plan") && !order["plan"].get<std::string>().empty()) {
            run_plan(order);
        } else {
            run_world(order);
        }
        session_ = nullptr;
    }

    void fail(const std::string& why) {
        tell({{"say", "failed"}, {"order", order_number_}, {"why", why}});
    }

    void run_world(const Json& order) {
        auto opened = session::open_sim(order["world"], {});
        if (!opened.ok()) return fail(opened.error().what);
        own_ = std::make_unique<session::SimSession>(std::move(opened.value()));
        (void)own_->settle();
        begin_session(*own_, order);
        live();
        own_.reset();
    }

    void run_plan(const Json& order) {
        toolbox::Parts parts;
        run::CodeLibrary library;
        const std::vector<std::string> toolboxes = order["toolboxes"];
        const Status added = session::add_toolboxes(library, parts, toolboxes);
        if (!added.ok()) return fail(added.error().what);
        const auto plan = embed::LoadedPlan::from_file(order["plan"], library);
        if (!plan.ok()) return fail(plan.report());
        embed::RunWords words;
        words.world = order["world"];
        words.bus = order.value("bus", "");
        words.project = order.value("project", "");
        words.robot = order.value("robot", "");
        words.from = order.value("from", "");
        words.max_time = "1e13";  // the person at the studio ends it
        for (const auto& [name, value] : order["set"].items()) {
            words.set.push_back(name + "=" +
                                (value.is_string() ? value.get<std::string>() : value.dump()));
        }
        auto prepared = embed::PreparedRun::prepare(plan, words, parts);
        if (!prepared.ok()) return fail(prepared.error().what);
        prepared_ = std::move(prepared.value());
        heard_ = session::events_heard(plan.plans(), library.templates());
        follower_.emplace(plan.plans(), [](const std::string& file) { return file; });
        talk_.emplace(plan.graph());
        change_.emplace(plan, order["plan"], *talk_,
                        [this](const PlanChange::Answer& one) { tell_answer(one); });
        stops_.want(order.value("breakpoints", Json::array()));
        stops_.tend(*talk_);
        if (on_bus()) return run_on_bus();
        prepared_->listen([this](const plan::TraceEvent& event) { see(event); });
        prepared_->pace([this](Time at) { instant(at); });
        talk_->debugger().while_paused([this] { stand(); });
        begin_session(prepared_->world()->session(), order);
        const auto ended = prepared_->run(&talk_->debugger());
        if (!ended.ok()) tell_line("error", ended.error().what);
        tell_plan();
        end_talk();
        live();
        forget_plan();
    }

    // Nobody comes to what was asked and not answered yet.
    void end_talk() {
        talk_->forget();
        talk_.reset();
        stops_.forget();
        held_.forget();
        tell_stops();
        broken_at_.clear();
    }

    void forget_plan() {
        follower_.reset();
        change_.reset();
        heard_.clear();
        session_ = nullptr;
        prepared_.reset();
    }

    // ---- a plan on a bus ----
    bool on_bus() const { return talk_ && prepared_ && prepared_->world() == nullptr; }

    // The plan alone, on a bus that the studio holds open.
    void run_on_bus() {
        tell({{"say", "opened"},
              {"order", order_number_},
              {"programs", Json::array()},
              {"hears", heard_}});
        if (pacer_.held()) talk_->hold();
        bus_clock_.start(wall_now());
        {
            BusRun running(*prepared_, *talk_);
            for (bool over = false; !over;) {
                pipe_.wait(kPausedWaitMs);
                take_packets();
                if (open_ || quit_) talk_->abort();
                over = running.over();
                for (const BusRun::Line& line : running.take_lines()) {
                    tell_line(line.kind, line.text);
                }
                for (const plan::TraceEvent& event : running.take()) see(event);
                hear_plan();  // where it stands, after what led there
                tell_bus_clock();
            }
        }
        tell_plan_at(bus_clock_.now());
        end_talk();
        forget_plan();
        tell({{"say", "over"}});
    }

    void tell_bus_clock() {
        const Time wall = wall_now();
        bus_clock_.count(wall, pacer_.held());
        if (wall < next_tell_) return;
        next_tell_ = wall + kTellEvery;
        const double t = bus_clock_.now();
        tell({{"say", "clock"}, {"t", t}, {"paused", pacer_.held()}, {"speed", 1}, {"real", 1}});
        tell_plan_at(t);
    }

    // ---- the plan, by its debugger ----
    void set_pace(bool paused, double speed) {
        pacer_.set(paused, speed, wall_now());
        if (!paused) broken_at_.clear();
        if (!talk_) return;
        if (!on_bus()) return talk_->give_up_step();  // the clock holds the plan of a world
        paused ? talk_->hold() : talk_->go_on();
    }

    void step_to_actor() {
        if (talk_) talk_->step();
        let_time_pass();
    }

    void let_time_pass() {
        broken_at_.clear();
        pacer_.set(false, pacer_.speed(), wall_now());
    }

    void stop_plan() {
        // A plan that is held hears nothing but its debugger.
        if (talk_ && (on_bus() || talk_->stands())) talk_->abort();
        if (prepared_ && !on_bus()) prepared_->abort();
    }

    void set_variable(const Json& told) {
        ask_held(told["request"],
                 run::SetVariable{told["level"], told["name"], plan_value(told["value"])});
    }

    // Events of the bus that wait for the plan.
    void handle_held(const Json& told) {
        const uint64_t request = told["request"];
        if (!talk_) return tell_answer(request, "no plan runs");
        if (!plan_is_held()) return tell_answer(request, kPlanDoesNotStand);
        const bool steps = told["act"] == "step";
        PlanHeld::act(*talk_, told, [this, request, steps](const Result<run::Reply>& reply) {
            tell_answer(request, reply.ok() ? "" : reply.error().what);
            if (steps && reply.ok()) let_time_pass();
        });
        next_tell_ = Time{};  // the answer is heard at once
    }

    // By its debugger, not by the clock of its world.
    bool plan_is_held() const { return talk_->stands() || (on_bus() && pacer_.held()); }

    void ask_held(uint64_t request, run::Request asked) {
        if (!talk_) return tell_answer(request, "no plan runs");
        // In a world the clock holds the plan, not its debugger.
        const bool stays = on_bus() && pacer_.held();
        talk_->ask_held(
            std::move(asked),
            [this, request](const Result<run::Reply>& reply) {
                tell_answer(request, reply.ok() ? "" : reply.error().what);
            },
            stays ? PlanTalk::Then::Hold : PlanTalk::Then::GoOn);
        // A run answers between two decisions: one instant must pass.
        if (!on_bus() && !talk_->stands() && pacer_.paused()) pacer_.step(1ms);
    }

    // A new version of the plan, or the question whether it could take over (P31).
    void change_plan(const Json& told) {
        if (!change_) return tell_answer(told["request"], "no plan runs");
        using Ask = PlanChange::Ask;
        if (told["do"] == "plan.check") {
            return change_->check(told, on_bus() ? Ask::ByTheTalk : Ask::AtOnce);
        }
        change_->take(told);
        // A run answers between two decisions: one instant must pass.
        if (!on_bus() && !talk_->stands() && pacer_.paused()) pacer_.step(1ms);
    }

    void hear_plan() {
        if (!talk_) return;
        const PlanTalk::Heard heard = talk_->hear();
        tend_stops();
        if (heard.stepped) stand_at(*heard.stepped, {});
        if (heard.broken) stand_at(heard.broken->where, stops_.numbers(heard.broken->breakpoints));
    }

    // What the plan came to holds it, and the clock of its world with it.
    void stand_at(const run::Where& where, std::vector<uint64_t> breakpoints) {
        follower_->stand_at(where);
        broken_at_ = std::move(breakpoints);
        pacer_.set(true, pacer_.speed(), wall_now());
        next_tell_ = Time{};
    }

    void tend_stops() {
        if (!talk_) return;
        stops_.tend(*talk_);
        held_.tend(*talk_);
        tell_stops();
    }

    void tell_stops() {
        Json list;
        if (stops_.tell(list)) tell({{"say", "breakpoints"}, {"list", std::move(list)}});
        std::optional<double> since;
        if (talk_ && plan_is_held()) since = on_bus() ? bus_clock_.now() : seconds(session_->now());
        if (held_.tell(since, list)) tell({{"say", "held"}, {"held", std::move(list)}});
    }

    // In a world the plan has no thread of its own: while it stands the host hears and tells from
    // here, and the nodes answer.
    void stand() {
        hear_plan();
        const Time wall = wall_now();
        if (wall >= next_tell_ || wall >= next_poses_) look_around(wall);
        if (quit_ || open_) return talk_->abort();
        if (!pacer_.paused()) {
            broken_at_.clear();
            return talk_->go_on();
        }
        pipe_.wait(holds_ > 0 ? 1 : kPausedWaitMs);
        take_packets();
        if (holds_ > 0) hold();
    }

    void begin_session(session::SimSession& session, const Json& order) {
        session_ = &session;
        recorder_.begin();
        const auto link = session.world().bus().add({.name = "studio"});
        if (!link.ok()) return fail(link.error().what);
        link_ = link.value();
        put_robots(order);
        for (const Diagnostic& mistake : session.mistakes()) tell_line("error", text_of(mistake));
        Json programs = Json::array();
        for (const auto& [node, source] : session.running_scripts()) {
            programs.push_back({{"node", node}, {"source", source}});
        }
        tell({{"say", "opened"},
              {"order", order_number_},
              {"scene", scene_of(session.world())},
              {"programs", std::move(programs)},
              {"hears", heard_}});
        tell_clock();
    }

    // Where they stood before the run, if a hand put them there.
    void put_robots(const Json& order) {
        if (!order.contains("poses")) return;
        const auto robots = session_->world().robots();
        std::vector<sim::RobotId> ids;
        for (const sim::RobotView& robot : robots) ids.push_back(robot.id);
        for (size_t i = 0; i < ids.size() && i < order["poses"].size(); ++i) {
            const Json& pose = order["poses"][i];
            (void)session_->world().move(ids[i], {{pose[0], pose[1]}, pose[2]}).ok();
        }
    }

    // ---- time ----
    // The world alone, until another order or the end.
    void live() {
        while (!quit_ && !open_) {
            instant(session_->now() + sim::kNodeStep);
            if (quit_ || open_) return;
            session_->begin_instant();
            session_->end_instant();
            (void)session_->take_notes();
        }
    }

    // Before each millisecond of simulated time: waits until it is due, and meanwhile hears and
    // tells.
    void instant(Time at) {
        at_ = at;
        send_frames();
        recorder_.look(session_->world());
        if (recorder_.is_due_to_send()) send_records();
        for (;;) {
            const Time wall = wall_now();
            if (wall >= next_tell_ || wall >= next_poses_) look_around(wall);
            if (quit_ || open_) {
                if (prepared_) prepared_->abort();
                return;
            }
            if (pacer_.paused()) {
                pipe_.wait(holds_ > 0 ? 1 : kPausedWaitMs);
                take_packets();
                if (holds_ > 0) hold();
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

    // Time stands, and the nodes still answer.
    void hold() {
        --holds_;
        session_->world().hold_instant();
        send_frames();
    }

    void look_around(Time wall) {
        take_packets();
        pipe_.flush();
        send_records();
        if (wall >= next_poses_) {
            next_poses_ = wall + kPosesEvery;
            pipe_.send('P', stamped(poses_of(session_->world())));
            if (show_rays_) pipe_.send('R', stamped(rays_of(session_->world())));
        }
        if (wall < next_tell_) return;
        next_tell_ = wall + kTellEvery;
        tell_clock();
        tell_scene();
        tell_plan();
        for (const std::string& name : pictured_) {
            const auto robot = session_->world().find_robot(name);
            const std::string picture = robot ? picture_of(session_->world(), *robot) : "";
            if (!picture.empty()) pipe_.send('I', stamped(with_name(name, picture)));
        }
    }

    std::string stamped(const std::string& bytes) const {
        const double t = seconds(session_->now());
        return std::string(reinterpret_cast<const char*>(&t), sizeof t) + bytes;
    }

    void tell_clock() {
        Json clock = {{"say", "clock"},
                      {"t", seconds(session_->now())},
                      {"paused", pacer_.held()},
                      {"speed", pacer_.speed()},
                      {"real", pacer_.real(wall_now())}};
        if (const auto load = session_->world().bus_load()) {
            clock["load"] = 100 * load->all.share_of_last_second;
        }
        tell(clock);
    }

    void tell_scene() {
        Json scene = scene_of(session_->world());
        if (scene == scene_told_) return;
        scene_told_ = scene;
        tell({{"say", "scene"}, {"scene", std::move(scene)}});
    }

    // ---- the plan ----
    void see(const plan::TraceEvent& event) {
        if (const auto* changed = std::get_if<plan::PlanChanged>(&event.what)) {
            follower_->change(change_->took(*changed->graph));
        }
        follower_->see(event);
        tell({{"say", "trace"}, {"line", plan::format_trace(event)}});
    }

    void tell_plan() {
        hear_plan();
        tell_plan_at(session_ ? seconds(session_->now()) : 0);
    }
    void tell_plan_at(double t) {
        if (!follower_) return;
        Json plan = follower_->document(t, pacer_.held());
        if (!broken_at_.empty() && !follower_->over()) plan["stands_at"] = broken_at_;
        tell({{"say", "plan"}, {"plan", std::move(plan)}});
    }

    // ---- a hand from above ----
    void act(const std::string& what, const Json& told) {
        const auto done = hand(session_->world(), what, told);
        tell_answer(told["request"], done.ok() ? "" : done.error().what,
                    done.ok() ? done.value() : std::nullopt);
        next_poses_ = Time{};
    }

    Pipe pipe_;
    bool quit_ = false;
    bool open_ = false;  // another order waits
    Json order_;
    uint64_t order_number_ = 0;  // of what is served

    std::unique_ptr<session::SimSession> own_;
    std::unique_ptr<embed::PreparedRun> prepared_;
    session::SimSession* session_ = nullptr;  // of one of the two
    hub::LinkId link_;
    std::optional<PlanFollower> follower_;
    std::set<std::string> heard_;  // events, by the plan
    std::optional<PlanTalk> talk_;
    std::optional<PlanChange> change_;
    PlanStops stops_;
    PlanHeld held_;
    std::vector<uint64_t> broken_at_;  // breakpoints that hold the plan, by their numbers
    BusClock bus_clock_;

    Recorder recorder_;
    Pacer pacer_;
    int holds_ = 0;
    uint64_t instants_ = 0;
    Time at_{};
    Time next_tell_{}, next_poses_{};
    Json scene_told_;
    bool show_rays_ = false;
    std::vector<std::string> pictured_;  // robots whose cameras somebody looks through
};

}  // namespace

int run_host() {
    return Host().run();
}

}  // namespace vagus::serve
