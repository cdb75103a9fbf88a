// What people ask of a run: targets, the clock, plans, the hand from above. A simulation is one
// process with the plan in it; on a bus the plan is a process of its own, joined to the bus by a
// local door. What follows from a command is decided by Life.
#include <fmt/format.h>

#include "serve/workbench/workbench.hpp"

#include <algorithm>
#include <filesystem>

#include "base/text.hpp"
#include "serve/edit/file_checks.hpp"
#include "serve/edit/named_paths.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

namespace {

constexpr const char* kNoWorld =
    "the project has no world to simulate; name one in vagus.json, or choose a robot";
constexpr const char* kBareNoWorld =
    "there is no world to simulate, for this was opened without a project; use Make a project, or "
    "choose a robot";
constexpr const char* kNoProject = "no project is open; open one first";

// Its size and when it was written; empty: it is not there.
std::string state_of_file(const std::string& path) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(path, failed);
    if (failed) return "";
    const auto written = std::filesystem::last_write_time(path, failed).time_since_epoch().count();
    return failed ? "" : fmt::format("{} {}", size, written);
}

}  // namespace

// ---- targets ----

// Nothing is left behind that moves: what is done then comes once the robot has stopped.
void Workbench::leave(const life::Cause& cause, std::function<void()> then) {
    const life::CallNumber number = ++calls_;
    leaving_.emplace(number, std::move(then));
    tell_life(life::Leave{number, cause, bus_ && target_.moved()});
    live();
}

const char* Workbench::no_world() const {
    return project_->project_file.empty() ? kBareNoWorld : kNoWorld;
}

Status Workbench::join_target(const std::string& target) {
    project_->target = target;
    desk_.topics().touch("studio");
    if (target == "sim") {
        if (project_->world.empty()) return Error{Code::Unavailable, no_world()};
        tell_life(life::Open{});
        live();
        return Status::done();
    }
    auto connected = BusCarrier::connect(links_, target);
    if (!connected.ok()) return connected.error();
    bus_ = std::move(connected.value());
    bus_->on_frame([this](const wire::Frame& frame) { scripts_recording_.frame(frame); });
    record_bus();
    bus_since_ = now_;
    target_.connect(*bus_, target, target, "bus", now_);
    tell_life(life::Joined{});
    live();
    return Status::done();
}

// ---- files that a run is made of ----

RunOrder Workbench::order_of(const std::string& plan, const Json& set) const {
    RunOrder order;
    order.world = project_->world.empty() ? "" : project_->real(project_->world);
    if (plan.empty()) return order;
    order.plan = project_->real(plan);
    for (const std::string& toolbox : project_->toolboxes) {
        order.toolboxes.push_back(project_->real(toolbox));
    }
    if (plan == project_->plan) {
        for (const auto& [name, value] : project_->start_set) order.set[name] = value;
    }
    order.set.update(set);
    order.breakpoints = plan_breakpoint_orders();
    return order;
}

// The file says something else than what is shown.
bool Workbench::world_has_changed() const {
    const auto text = files_.text(project_->world);
    return text.ok() && (text.value() != opened_world_ || picture_now_ != picture_then_);
}

void Workbench::note_opened_world(const std::string& text) {
    opened_world_ = text;
    world_touched_ = false;
    picture_.clear();
    for (const NamedPath& named : named_paths(project_->world, text)) {
        if (named.at.size() != 2 || named.at.front() != JsonStep::Key("ground")) continue;
        picture_ = project_->real(path_from(project_->world, named.text));
    }
    picture_now_ = picture_then_ = state_of_file(picture_);
    desk_.topics().touch("studio");
}

void Workbench::touch_world() {
    world_touched_ = true;
    if (run_is_over_ || run_.rests()) placed_by_hand_ = true;
}

// Another image in the file of the ground makes it another world.
void Workbench::look_at_picture() {
    if (picture_.empty() || !project_ || now_ < next_picture_look_) return;
    next_picture_look_ = now_ + kPictureEvery;
    const std::string now = state_of_file(picture_);
    if (now == std::exchange(picture_now_, now)) return;
    world_edited(project_->world);
}

void Workbench::file_saved(const std::string& path) {
    if (kind_of_file(path) == "plan") saved_plans_.push_back(path);
    world_saved(path);
}

// Together, once all of them are saved: they may need each other (P31).
void Workbench::change_plan() {
    std::vector<std::string> files;
    for (const std::string& path : std::exchange(saved_plans_, {})) {
        if (project_) files.push_back(project_->real(path));
    }
    if (!files.empty() && run_.plan_runs()) run_.change_plan(files);
}

void Workbench::check_change(const Call& call) {
    const std::string doc = call.in["doc"];
    const auto text = files_.text(doc);
    if (!text.ok()) return call.fail(text.error());
    if (!project_ || !run_.plan_runs()) {
        return call.done({{"runs", false}, {"reasons", Json::array()}});
    }
    run_.check_change({{project_->real(doc), text.value()}}, [call](const Run::Reasons& reasons) {
        call.done({{"runs", reasons.has_value()},
                   {"reasons", reasons.value_or(std::vector<std::string>())}});
    });
}

// A world that does not run shows at once what was saved.
void Workbench::world_saved(const std::string& path) {
    if (!project_ || path != project_->world || !simulates() || !run_.rests()) return;
    if (life_.state() != Life::State::Ready || !world_has_changed()) return;
    tell_life(life::Open{});
    live();
}

void Workbench::world_edited(const std::string& path) {
    if (!project_ || path != project_->world) return;
    world_edited_ = now_;
    desk_.topics().touch("studio");
}

bool Workbench::is_being_opened() const {
    return life_.state() == Life::State::Opening || life_.state() == Life::State::Loading;
}

// A world in which nothing has run yet shows its file as it is edited, saved or not. What a hand
// has done there is not lost by that, and a file with errors waits until it has none.
void Workbench::follow_world_text() {
    if (!world_edited_ || now_ < *world_edited_ + kWorldFollowsAfter || is_being_opened()) return;
    world_edited_.reset();
    const bool at_start = life_.state() == Life::State::Ready && run_.rests() && run_.time() == 0;
    const bool failed = life_.state() == Life::State::None;  // to open: a picture that is none
    const bool stands = run_.is_open() && !bus_ && (failed || (simulates() && at_start));
    if (!project_ || !stands || world_touched_ || !world_has_changed()) return;
    const std::vector<DocFinding> found = check_world_file(files_, project_->world).findings;
    const auto is_error = [](const DocFinding& one) { return one.severity == Severity::Error; };
    if (std::any_of(found.begin(), found.end(), is_error)) return;
    tell_life(life::Open{});
    live();
}

bool Workbench::save_all(const Call& call) {
    std::vector<std::string> saved;
    const Status all = files_.save_all(saved);
    for (const std::string& path : saved) {
        if (kind_of_file(path) == "plan") saved_plans_.push_back(path);
    }
    if (all.ok()) return true;
    const bool conflict = all.error().code == Code::Refused;
    conflict ? call.fail("conflict", all.error().what) : call.fail(all.error());
    return false;
}

// ---- run, pause, step, stop ----

void Workbench::start(const Call& call) {
    if (!project_) return call.fail("unavailable", kNoProject);
    if (!save_all(call)) return;
    if (!bus_ && !simulates()) {
        if (project_->world.empty()) return call.fail("unavailable", no_world());
        project_->target = "sim";
    }
    start_with(call, project_->plan, {.go = true});
}

// `call` may say with which values, and from which actor.
void Workbench::start_with(const Call& call, const std::string& plan, life::Start start) {
    if (!plan.empty() && !bus_ && project_->world.empty()) {
        return call.fail("unavailable", no_world());
    }
    if (bus_ && !target_.all_described(1)) {
        const std::string why = bus_->why();
        return call.fail("unavailable", why.empty() ? "no node is there yet" : why);
    }
    start.call = keep(call);
    start.plan = !plan.empty();
    const bool ended = !life_.is_live() && (run_is_over_ || life_.is_stopping());
    const bool at_start = ended && !placed_by_hand_;
    start.world_again = !bus_ && (!simulates() || world_has_changed() || at_start);
    start.by = who_asks(call);
    // A node that is paused inside its script goes on there.
    start.quiet = !bus_ || target_.quiet() || (plan.empty() && target_.is_paused_inside());
    if (start.plan) {
        // What begins does so with what is saved.
        if (!life_.plan_runs() || start.again) saved_plans_.clear();
        RunOrder order = order_of(plan, call.in.value("set", Json::object()));
        order.from = call.in.value("from", "");
        orders_.emplace(start.call, std::move(order));
    }
    tell_life(start);
    live();
}

void Workbench::step(const Call& call) {
    if (bus_ || target_.is_paused_inside()) {
        return target_.step_paused([call](const std::vector<std::string>& failed) {
            if (failed.empty()) return call.done();
            call.fail("failed", joined_lines(failed));
        });
    }
    if (!simulates()) return call.fail("unavailable", "nothing runs; Run starts it");
    if (!run_.paused()) return call.fail("unavailable", "it runs; pause it first");
    run_.step(call.in.value("ms", kStepMs));
    call.done();
}

void Workbench::stop(const Call& call, life::Cause cause) {
    tell_life(life::Stop{keep(call), std::move(cause)});
    live();
}

void Workbench::somebody_stops(uint32_t member) {
    ++stops_;
    stopped_();
    desk_.count_stop(member);
}

void Workbench::end_by(const std::string& by, life::Why why) {
    if (!life_.is_live() && !(bus_ && target_.moved())) return;
    tell_life(life::Stop{0, {by, why}});
    live();
}

// Nobody looks any more, and the project says that it does not work alone. A page that is connected
// and does not answer is nobody.
void Workbench::people_changed() {
    desk_.topics().touch("studio");
    target_.end_leases();
    const size_t people = desk_.present();
    const bool left = std::exchange(people_, people) > 0 && people == 0;
    if (left && project_ && project_->stops_alone) end_by("nobody", life::Why::Alone);
}

void Workbench::declare_run_commands() {
    desk_.command("stop", [this](const Call& call) {
        somebody_stops(call.member);
        stop(call, {who_asks(call), life::Why::Stop});
    });
    desk_.command("end.acknowledge", [this](const Call& call) {
        if (!ends_.acknowledge(static_cast<uint64_t>(call.in["number"]))) {
            return call.fail("not_found", "another end was told since");
        }
        target_.acknowledge_stop();
        desk_.topics().touch("end");
        call.done();
    });
    desk_.command("run.start", [this](const Call& call) { start(call); });
    desk_.command("run.step", [this](const Call& call) { step(call); });
    desk_.command("run.pause", [this](const Call& call) {
        tell_life(life::Pause{keep(call)});
        live();
    });
    desk_.command("run.continue", [this](const Call& call) { continue_from(call); });
    desk_.command("recording.list", [this](const Call& call) { list_recordings(call); });
    desk_.command("recording.open", [this](const Call& call) { open_recording(call); });
    desk_.command("test.keep", [this](const Call& call) { keep_test(call); });
    desk_.command("run.reset", [this](const Call& call) { reset(call); });
    desk_.command("run.end", [this](const Call& call) {
        run_.kill();
        call.done();
    });
    desk_.command("clock.speed", [this](const Call& call) {
        run_.set_speed(call.in["speed"]);
        call.done();
    });
    desk_.command("target.choose", [this](const Call& call) { choose_target(call); });
    desk_.command("target.leave", [this](const Call& call) {
        leave({who_asks(call), life::Why::Target}, [call] { call.done(); });
    });
}

void Workbench::reset(const Call& call) {
    if (!project_) return call.fail("unavailable", kNoProject);
    if (bus_) {
        return call.fail("unavailable",
                         "a robot cannot be put back to its start; Reset of a node starts its "
                         "program again");
    }
    if (project_->world.empty()) return call.fail("unavailable", no_world());
    if (!save_all(call)) return;
    tell_life(life::Open{keep(call), false, who_asks(call)});
    live();
}

void Workbench::choose_target(const Call& call) {
    const std::string target = call.in["target"];
    if (project_) {
        return leave({who_asks(call), life::Why::Target}, [this, call, target] {
            if (!project_) return call.fail("unavailable", kNoProject);
            call.answer(join_target(target));
        });
    }
    // A robot to look at, or the simulator: each needs a project around it.
    const auto made = target == "sim" ? library_.copy_of_example("thymio", true)
                                      : library_.make_robot_project(target);
    const Status opened = made.ok() ? open(made.value(), now_) : Status(made.error());
    call.answer(opened);
}

// ---- plans ----

void Workbench::declare_plan_commands() {
    desk_.command("plan.start", [this](const Call& call) {
        if (!project_) return call.fail("unavailable", kNoProject);
        const std::string plan = call.in.value("doc", project_->plan);
        if (plan.empty()) return call.fail("not_found", "the project has no plan");
        if (!save_all(call)) return;
        start_with(call, plan, {.go = true, .again = true});
    });
    const auto while_it_runs = [this](const char* name, std::function<void(const Call&)> act) {
        desk_.command(name, [this, act = std::move(act)](const Call& call) {
            if (!run_.plan_runs()) return call.fail("unavailable", "no plan runs");
            act(call);
        });
    };
    desk_.command("plan.check_change", [this](const Call& call) { check_change(call); });
    while_it_runs("plan.pause", [this](const Call& call) {
        tell_life(life::HoldPlan{keep(call)});
        live();
    });
    while_it_runs("plan.continue", [this](const Call& call) {
        tell_life(life::ContinuePlan{keep(call)});
        live();
    });
    while_it_runs("plan.stop", [this](const Call& call) {
        tell_life(life::EndThePlan{keep(call), who_asks(call)});
        live();
    });
    while_it_runs("plan.set", [this](const Call& call) {
        run_.set_variable(call.in["level"], call.in["name"], call.in["value"],
                          [call](const std::string& why) {
                              if (why.empty()) return call.done();
                              call.fail("bad_input", why);
                          });
    });
    desk_.command("plan.step", [this](const Call& call) {
        if (run_.plan_runs()) {
            run_.step_plan();
            return call.done();
        }
        if (!project_ || project_->plan.empty()) {
            return call.fail("not_found", "the project has no plan");
        }
        if (!save_all(call)) return;
        start_with(call, project_->plan, {.go = false, .again = true});
    });
}

// ---- the world, by hand ----

void Workbench::declare_world_commands() {
    for (const char* const command :
         {"world.move", "world.put", "world.take", "world.press", "world.tap", "world.light"}) {
        desk_.command(command, [this, hand = std::string(command)](const Call& call) {
            if (!simulates()) return call.fail("unavailable", "there is no simulated world");
            const Json& in = call.in;
            for (const auto& [list, count] : {std::pair{"at", 2}, {"size", 2}, {"colour", 3}}) {
                if (!in.contains(list) || in[list].size() == static_cast<size_t>(count)) continue;
                return call.fail("bad_input", fmt::format("in.{}: expected {} numbers, found {}",
                                                          list, count, in[list].size()));
            }
            if (hand == "world.move" && !in.contains("robot") && !in.contains("object")) {
                return call.fail("bad_input", "say what is to be moved: a robot or an object");
            }
            if (hand != "world.press" && hand != "world.tap") touch_world();
            run_.lend_hand(hand_order(hand, in),
                           [call](std::optional<uint32_t> number, const std::string& why) {
                               if (!why.empty()) return call.fail("bad_input", why);
                               call.done(number ? Json{{"number", *number}} : Json::object());
                           });
        });
    }
}

}  // namespace vagus::serve
