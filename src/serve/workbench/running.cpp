// What runs: targets, the clock, plans, the hand from above. A simulation is one process with the
// plan in it; on a bus the plan is a process of its own, joined to the bus by a local door.
#include <fmt/format.h>

#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

using Json = nlohmann::json;

namespace {

constexpr Duration kPlanEndsWithin = 300ms;  // of Stop; then the nodes are stopped all the same
constexpr Duration kRollOut =
    500ms;  // a simulation goes on so long after Stop: wheels come to rest
constexpr const char* kBeingStarted = "the run is just being started";
constexpr const char* kStoppedMeanwhile = "it was stopped before it ran";
constexpr const char* kNoWorld =
    "the project has no world to simulate; name one in vagus.json, or choose a robot";

std::string joined(const std::vector<std::string>& sentences) {
    std::string text;
    for (const std::string& one : sentences) text += (text.empty() ? "" : "\n") + one;
    return text;
}

}  // namespace

// ---- targets ----

Status Workbench::choose_target(const std::string& target) {
    leave_target();
    project_->target = target;
    desk_.board().touch("studio");
    if (target == "sim") {
        if (project_->world.empty()) return Error{Code::Unavailable, kNoWorld};
        return open_world("", Json::object(), false, false);
    }
    auto connected = BusCarrier::connect(network_, target);
    if (!connected.ok()) return connected.error();
    bus_ = std::move(connected.value());
    bus_since_ = now_;
    record_bus("");
    robot_.connect(*bus_, target, target, "bus", now_);
    return Status::done();
}

void Workbench::leave_target() {
    give_up_start("the target was left");
    rest_at_.reset();
    nodes_stop_at_.reset();
    for (const Call& call : std::exchange(stop_calls_, {})) call.done({{"stood", Json::array()}});
    robot_.disconnect();
    run_.close();
    bus_.reset();
    loaded_by_world_.clear();
}

// ---- the world ----

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

Status Workbench::open_world(const std::string& plan, const Json& set, bool keep_poses,
                             bool then_go) {
    return open_order(order_of(plan, set), keep_poses, then_go);
}

Status Workbench::open_order(RunOrder order, bool keep_poses, bool then_go) {
    order.keep_poses = keep_poses;
    const auto text = files_.text(project_->world);
    opened_world_ = text.ok() ? text.value() : "";
    rest_at_.reset();
    ++start_;
    opening_ = Opening{now_ + kDescribeWithin, false, then_go};
    loaded_by_world_.clear();
    record_plan(order);
    return run_.open(order, now_);
}

// The file says something else than what stands there.
bool Workbench::world_has_changed() const {
    const auto text = files_.text(project_->world);
    return text.ok() && text.value() != opened_world_;
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

// A world that only stands there shows at once what was saved.
void Workbench::world_saved(const std::string& path) {
    if (!project_ || path != project_->world || !simulates() || !run_.rests()) return;
    if (opening_ || opening_call_ || !world_has_changed()) return;
    const Status opened = open_world("", Json::object(), false, false);
    if (!opened.ok()) say("error", opened.error().what);
}

void Workbench::world_opened() {
    if (bus_) return plan_joined_bus();
    // Stopped while its world opened: the plan is given up, the world stays.
    if (!opening_ && run_.opens_plan()) return reopen_world();
    if (!opening_) opening_ = Opening{};
    loaded_by_world_ = run_.programs();
    opening_->opened = true;
    opening_->until = now_ + kDescribeWithin;
    robot_.connect(run_, "sim", "Simulator", "simulator", now_);
    desk_.board().touch("robot");
}

// Once the nodes of a world have described themselves they get what differs from the texts, and
// their breakpoints; then time may pass.
void Workbench::get_nodes_ready() {
    if (!opening_ || !opening_->opened) return;
    if (!robot_.all_described(run_.node_count()) && now_ < opening_->until) return;
    const bool go = opening_->go;
    opening_.reset();
    robot_.place_breakpoints();
    robot_.load_changed(true, [this, go, start = start_](const std::vector<std::string>& failed) {
        tell_failed_loads(failed);
        if (start != start_) return;
        if (go) run_.begin();
        if (go) ++runs_;
        end_start();
    });
}

void Workbench::end_start() {
    begun_ = start_;
    const std::optional<Call> call = opening_call_;
    opening_call_.reset();
    if (call) call->done();
}

void Workbench::tell_failed_loads(const std::vector<std::string>& failed) {
    if (failed.empty()) return;
    failed_loads_ = joined(failed);
    say("error", failed_loads_);
}

void Workbench::give_up_start(const std::string& why) {
    if (const auto into = std::exchange(into_, std::nullopt)) into->call.fail("failed", why);
    ++start_;
    opening_.reset();
    const std::optional<Call> call = opening_call_;
    opening_call_.reset();
    if (call) call->fail("failed", why);
}

void Workbench::world_failed(const std::string& why) {
    give_up_start(why);
    // A plan that cannot run leaves the world as it was.
    if (!run_.opens_plan() || bus_ || !project_ || project_->world.empty()) return;
    reopen_world();
}

// The world alone, with its robots where they stand.
void Workbench::reopen_world() {
    const Status opened = open_world("", Json::object(), true, false);
    if (!opened.ok()) say("error", opened.error().what);
}

// ---- run, pause, step, stop ----

bool Workbench::save_all(const Call& call) {
    const auto saved = files_.save_all();
    if (!saved.ok()) {
        call.fail(saved.error());
        return false;
    }
    for (const std::string& path : saved.value()) {
        if (kind_of_file(path) == "plan") saved_plans_.push_back(path);
    }
    return true;
}

void Workbench::start(const Call& call) {
    if (!project_) return call.fail("unavailable", "no project is open; open one first");
    if (!save_all(call)) return;
    if (!bus_ && !simulates()) {
        if (project_->world.empty()) return call.fail("unavailable", kNoWorld);
        project_->target = "sim";
    }
    if (bus_ && !robot_.all_described(1)) {
        const std::string why = bus_->why();
        return call.fail("unavailable", why.empty() ? "no node is there yet" : why);
    }
    if (run_.plan_runs() || (run_.plan_begins() && begun_ == start_)) return go_on(call);
    if (!project_->plan.empty()) {
        return start_plan(call, project_->plan, true);
    }
    start_scripts(call);
}

// A plan that was held, and the nodes that stand.
void Workbench::go_on(const Call& call) {
    robot_.load_changed(true, [this, call, start = start_](const std::vector<std::string>& failed) {
        tell_failed_loads(failed);
        if (start != start_) return call.fail("failed", kStoppedMeanwhile);
        if (!bus_) return let_go(call);
        run_.go_on();
        robot_.run_all([](auto) {});
        call.done();
    });
}

// The nodes that stand go on, and a world's time with them. One that comes to its next breakpoint
// before all of them run has stopped time again: it stays so.
void Workbench::let_go(const Call& call) {
    robot_.run_standing(
        [this, call, start = start_, stops = stops_](const std::vector<std::string>& stayed) {
            if (!stayed.empty()) say("warning", joined(stayed));
            if (start != start_) return call.fail("failed", kStoppedMeanwhile);
            if (simulates() && stops == stops_) run_.go_on();
            call.done();
        });
}

// The nodes get their scripts, then the plan joins the bus and waits until they run.
void Workbench::start_plan_on_bus(const Call& call, RunOrder order, bool go) {
    order.world.clear();
    const auto door = bus_->open_door();
    if (!door.ok()) return call.fail(door.error());
    order.bus = door.value();
    order.project = project_->scripts.empty() ? "" : project_->real(project_->scripts.front());
    opening_call_.emplace(call);
    ++start_;
    robot_.load_changed(true, [this, order = std::move(order), go,
                               start = start_](const std::vector<std::string>& failed) {
        tell_failed_loads(failed);
        if (start != start_) return;
        opening_ = Opening{.go = go};
        record_bus(order.plan);
        const Status opened = run_.open(order, now_);
        if (!opened.ok()) world_failed(opened.error().what);
    });
}

// It stands before its first actor.
void Workbench::plan_joined_bus() {
    if (!opening_) return run_.tell({{"do", "plan.stop"}});  // Stop came meanwhile
    const bool go = opening_->go;
    opening_.reset();
    robot_.run_all([this, go, start = start_](const std::vector<std::string>& failed) {
        if (!failed.empty()) say("warning", joined(failed));
        if (start != start_) return;
        go ? run_.go_on() : run_.tell({{"do", "plan.step"}});
        ++runs_;
        end_start();
    });
}

// What it had begun goes on at the nodes, and nobody is left who would end it.
void Workbench::plan_died() {
    if (!bus_) return;
    robot_.stop_all([this](const std::vector<uint16_t>&) {
        say("note", "the nodes were stopped, since the plan that used them is gone");
    });
}

void Workbench::start_plan(const Call& call, const std::string& plan, bool go) {
    if (opening_call_) return call.fail("conflict", kBeingStarted);
    saved_plans_.clear();  // it begins with what is saved
    RunOrder order = order_of(plan, call.in.value("set", Json::object()));
    order.from = call.in.value("from", "");
    if (bus_) return start_plan_on_bus(call, std::move(order), go);
    if (project_->world.empty()) return call.fail("unavailable", kNoWorld);
    const bool keep = run_.time() > 0 && !world_has_changed();
    opening_call_.emplace(call);
    const Status opened = open_order(std::move(order), keep, go);
    if (!opened.ok()) world_failed(opened.error().what);
}

void Workbench::start_scripts(const Call& call) {
    const bool again = !bus_ && (!simulates() || world_has_changed());
    if (again) {
        if (opening_call_) return call.fail("conflict", kBeingStarted);
        opening_call_.emplace(call);
        const Status opened = open_world("", Json::object(), false, true);
        if (!opened.ok()) world_failed(opened.error().what);
        return;
    }
    rest_at_.reset();
    robot_.load_changed(true, [this, call, start = start_](const std::vector<std::string>& failed) {
        tell_failed_loads(failed);
        if (start != start_) return call.fail("failed", kStoppedMeanwhile);
        ++runs_;
        let_go(call);
    });
}

void Workbench::step(const Call& call) {
    if (bus_ || robot_.stands_inside()) {
        return robot_.step_standing([call](const std::vector<std::string>& failed) {
            if (failed.empty()) return call.done();
            call.fail("failed", joined(failed));
        });
    }
    if (!simulates()) return call.fail("unavailable", "nothing runs; Run starts it");
    if (!run_.paused()) return call.fail("unavailable", "it runs; pause it first");
    run_.step(call.in.value("ms", kStepMs));
    call.done();
}

void Workbench::stop(const Call& call) {
    give_up_start("it was stopped");
    if (run_.plan_runs()) run_.tell({{"do", "plan.stop"}});
    if (!nodes_stop_at_) nodes_stop_at_ = now_ + (run_.plan_runs() ? kPlanEndsWithin : Duration{});
    stop_calls_.push_back(call);
    stop_nodes();
}

// The plan ends first, so that its last words still find their nodes; it has no more than a moment.
void Workbench::stop_nodes() {
    if (!nodes_stop_at_ || (run_.plan_runs() && now_ < *nodes_stop_at_)) return;
    nodes_stop_at_.reset();
    if (simulates()) rest_at_ = now_ + kRollOut;
    robot_.stop_all([this, calls = std::exchange(stop_calls_, {})](const auto& stood) {
        for (const Call& call : calls) call.done({{"stood", stood}});
        say("note", "stopped");
    });
}

// The wheels have come to rest. A plan that waits for nodes that stand is given up.
void Workbench::rest() {
    if (!rest_at_ || now_ < *rest_at_) return;
    // One that hangs is left as it is: what it did until then is what people look for.
    if (run_.is_silent()) return;
    rest_at_.reset();
    if (!run_.plan_runs() || bus_) return run_.rest();
    reopen_world();
}

void Workbench::stop_everything() {
    if (run_.plan_runs()) run_.tell({{"do", "plan.stop"}});
    if (bus_) robot_.stop_all([](const std::vector<uint16_t>&) {});
    robot_.tick(now_);
}

void Workbench::declare_run_commands() {
    desk_.command("stop", [this](const Call& call) {
        stopped_();
        stop(call);
    });
    desk_.command("run.start", [this](const Call& call) { start(call); });
    desk_.command("run.step", [this](const Call& call) { step(call); });
    desk_.command("run.pause", [this](const Call& call) {
        if (run_.is_open()) run_.pause();
        if (!bus_) return call.done();
        robot_.pause_all([call](const std::vector<std::string>& failed) {
            if (failed.empty()) return call.done();
            call.fail("failed", joined(failed));
        });
    });
    desk_.command("run.reset", [this](const Call& call) {
        if (!project_) return call.fail("unavailable", "no project is open; open one first");
        if (bus_) {
            return call.fail("unavailable",
                             "a robot cannot be put back to its start; Reset of a node begins its "
                             "program anew");
        }
        if (project_->world.empty()) return call.fail("unavailable", kNoWorld);
        if (opening_call_) return call.fail("conflict", kBeingStarted);
        if (!save_all(call)) return;
        opening_call_.emplace(call);
        const Status opened = open_world("", Json::object(), false, false);
        if (!opened.ok()) world_failed(opened.error().what);
    });
    desk_.command("run.end", [this](const Call& call) {
        run_.kill();
        call.done();
    });
    desk_.command("clock.speed", [this](const Call& call) {
        run_.set_speed(call.in["speed"]);
        call.done();
    });
    desk_.command("target.choose", [this](const Call& call) {
        const std::string target = call.in["target"];
        if (!project_) {
            // A robot to look at, or the simulator: each needs a project around it.
            const auto made = target == "sim" ? library_.copy_of_example("thymio", true)
                                              : library_.make_robot_project(target);
            const Status opened = made.ok() ? open(made.value(), now_) : Status(made.error());
            return call.answer(opened);
        }
        call.answer(choose_target(target));
    });
    desk_.command("target.leave", [this](const Call& call) {
        leave_target();
        call.done();
    });
}

// ---- plans ----

void Workbench::declare_plan_commands() {
    desk_.command("plan.start", [this](const Call& call) {
        if (!project_) return call.fail("unavailable", "no project is open; open one first");
        const std::string plan = call.in.value("doc", project_->plan);
        if (plan.empty()) return call.fail("not_found", "the project has no plan");
        if (!save_all(call)) return;
        start_plan(call, plan, true);
    });
    const auto while_it_runs = [this](const char* name, std::function<void(const Call&)> act) {
        desk_.command(name, [this, act = std::move(act)](const Call& call) {
            if (!run_.plan_runs()) return call.fail("unavailable", "no plan runs");
            act(call);
        });
    };
    desk_.command("plan.check_change", [this](const Call& call) { check_change(call); });
    while_it_runs("plan.pause", [this](const Call& call) {
        run_.pause();
        call.done();
    });
    while_it_runs("plan.continue", [this](const Call& call) {
        run_.go_on();
        call.done();
    });
    while_it_runs("plan.stop", [this](const Call& call) {
        run_.tell({{"do", "plan.stop"}});
        call.done();
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
            run_.tell({{"do", "plan.step"}});
            return call.done();
        }
        if (!project_ || project_->plan.empty()) {
            return call.fail("not_found", "the project has no plan");
        }
        if (!save_all(call)) return;
        start_plan(call, project_->plan, false);
    });
}

// ---- the world, by hand ----

void Workbench::declare_world_commands() {
    static constexpr std::pair<const char*, const char*> kHands[] = {
        {"world.move", "move"},   {"world.put", "put"}, {"world.take", "take"},
        {"world.press", "press"}, {"world.tap", "tap"}, {"world.light", "light"},
    };
    for (const auto& [command, told_as] : kHands) {
        desk_.command(command, [this, hand = told_as](const Call& call) {
            if (!simulates()) return call.fail("unavailable", "there is no simulated world");
            Json told = call.in;
            for (const char* pair : {"at", "size"}) {
                if (!told.contains(pair) || told[pair].size() == 2) continue;
                return call.fail("bad_input", fmt::format("in.{}: expected two numbers, found {}",
                                                          pair, told[pair].size()));
            }
            told["do"] = hand;
            if (told["do"] == "move" && !told.contains("robot") && !told.contains("object")) {
                return call.fail("bad_input", "say what is to be moved: a robot or an object");
            }
            run_.lend_hand(told, [call](std::optional<uint32_t> number, const std::string& why) {
                if (!why.empty()) return call.fail("bad_input", why);
                call.done(number ? Json{{"number", *number}} : Json::object());
            });
        });
    }
}

}  // namespace vagus::serve
