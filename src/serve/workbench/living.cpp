// What the life of a run wants done, and what it is told: the wires between it and the process of
// the run, the nodes, and who waits for answers.
#include <fmt/format.h>

#include "serve/workbench/workbench.hpp"

#include "base/seconds.hpp"
#include "base/text.hpp"
#include "record/replay.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

// ---- in ----

life::CallNumber Workbench::keep(const Call& call) {
    waiting_.emplace(++calls_, call);
    return calls_;
}

std::string Workbench::who_asks(const Call& call) const {
    const Clients::Member* member = desk_.clients().find(call.member);
    if (!member) return call.way.empty() ? kTheServer : call.way;
    return member->name.empty() ? "a page" : member->name;
}

// What comes while something is being done is told behind it.
void Workbench::tell_life(life::Input input) {
    told_life_.push_back(std::move(input));
}

void Workbench::live() {
    if (std::exchange(lives_, true)) return;
    while (!told_life_.empty()) {
        const life::Input input = std::move(told_life_.front());
        told_life_.pop_front();
        for (const life::Action& action : life_.take(input, now_)) perform(action);
    }
    lives_ = false;
    // What nodes were told is on its way at once, before all else that this turn has to do.
    if (!std::exchange(send_at_once_, false)) return;
    target_.tick(now_);
    links_.flush();
}

void Workbench::tick_life() {
    if (life_.waits_for_nodes()) {
        if (run_.has_world() && target_.all_described(run_.node_count())) {
            tell_life(life::Described{});
        }
        if (!breakpoints_.waits_for_once()) tell_life(life::BreakpointsSet{});
    }
    watch_stop();
    live();
    lives_ = true;
    for (const life::Action& action : life_.tick(now_, run_.is_silent())) perform(action);
    lives_ = false;
    live();
}

// A plan that wakes does not know what its robot has done meanwhile. Its process notices, too, and
// says how long it was; here it is told why everything was stopped.
void Workbench::watch_sleep() {
    if (sleep_.has_slept() && bus_ && life_.plan_runs()) end_by("server", life::Why::Slept);
}

// Nodes that were silent, or moved, when the end was told are asked on.
void Workbench::watch_stop() {
    if (!ends_.open()) return;
    const StopReport now = target_.stop_report();
    if (!now.nodes.empty() && ends_.differs(now)) tell_life(life::Stopped{stop_number_, now});
}

void Workbench::hear_run() {
    run_.on_opened([this] { tell_life(life::Opened{}); });
    run_.on_failed(
        [this](const std::string& why) { tell_life(life::Failed{with_short_paths(why)}); });
    run_.on_death([this](const std::string& why) {
        tell_life(life::Died{with_short_paths(why)});
        died_();
    });
    run_.on_plan_ended([this](const Run::PlanEnd& end) {
        tell_life(life::PlanEnded{end.result, with_short_paths(end.message)});
    });
}

// ---- out ----

void Workbench::perform(const life::Action& action) {
    std::visit([this](const auto& one) { perform(one); }, action);
}

void Workbench::perform(const life::OpenRunner& open) {
    const auto order = orders_.find(open.call);
    const Status opened = order != orders_.end()
                              ? open_plan(order->second)
                              : open_world(order_of("", Json::object()),
                                           open.what == life::OpenRunner::What::WorldAgain);
    if (opened.ok()) return;
    say("error", opened.error().what);
    tell_life(life::Failed{opened.error().what});
}

// A run begins at the start of its world. Robots stay where they are if somebody has put them there
// since the run before, or if the plan begins at a later actor.
Status Workbench::open_plan(RunOrder order) {
    const bool stays = (placed_by_hand_ || !order.from.empty()) && !world_has_changed();
    if (!bus_) return open_world(order, stays && !order.past);
    order.world.clear();
    order.bus = TRY(bus_->open_door());
    order.project = project_->scripts.empty() ? "" : project_->real(project_->scripts.front());
    order.target = project_->target;
    end_scripts_recording();
    record_bus();
    // A robot keeps several versions of its project, and has no room for the runs of each.
    if (!places_.serves) record_run(order);
    return run_.open(order, now_);
}

Status Workbench::open_world(RunOrder order, bool keep_poses) {
    order.keep_poses = keep_poses;
    order.keep_objects = keep_poses && !world_has_changed();
    if (!keep_poses) run_is_over_ = placed_by_hand_ = false;
    loaded_by_world_.clear();
    continues_.reset();
    if (order.past && order.past->t) continues_ = {*order.past->t, order.set_then};
    if (!continues_) record_plan(order);
    if (!order.past) {
        const auto text = files_.text(project_->world);
        note_opened_world(text.ok() ? text.value() : "");
        if (text.ok() && order.plan.empty()) order.world_text = text.value();
    }
    record_run(order);
    return run_.open(order, now_);
}

void Workbench::perform(const life::ConnectWorld&) {
    loaded_by_world_ = run_.programs();
    if (const auto continues = std::exchange(continues_, std::nullopt)) take_changes(*continues);
    target_.connect(run_, "sim", "Simulator", "simulator", now_);
    desk_.topics().touch("robot");
}

// The run is at the instant that it continues from: what has been changed since counts from here.
void Workbench::take_changes(const Continues& continues) {
    history_.continue_from(seconds_of(record::instant_of(from_seconds(continues.t))));
    std::vector<std::string> plans = run_.changed_since();
    std::erase_if(plans, [](const std::string& file) { return kind_of_file(file) != "plan"; });
    if (!plans.empty()) run_.change_plan(plans);
    for (const Json& one : continues.set) {
        const std::string name = one["name"];
        run_.set_variable(one["level"], name, one["value"], [this, name](const std::string& why) {
            if (!why.empty()) say("error", name + " keeps the value that it had then: " + why);
        });
    }
}

// Scripts that are loaded again while they run are the same run.
void Workbench::perform(const life::BeginScripts&) {
    if (!std::exchange(scripts_run_, true)) record_scripts();
}

void Workbench::perform(const life::LoadNodes& load) {
    if (load.fresh) target_.place_breakpoints();
    target_.load_changed(true, [this, start = load.start](const std::vector<std::string>& failed) {
        if (!failed.empty()) failed_loads_ = joined_lines(failed);
        if (!failed.empty()) say("error", failed_loads_);
        tell_life(life::Loaded{start});
    });
}

// A node that does not go is no reason to hold the others.
void Workbench::perform(const life::LetNodesGo& go) {
    const auto went = [this, start = go.start](const std::vector<std::string>& stayed) {
        if (!stayed.empty()) say("warning", joined_lines(stayed));
        tell_life(life::Went{start});
    };
    go.all ? target_.run_all(went) : target_.run_paused(went);
}

void Workbench::perform(const life::BeginRun&) {
    target_.will_move();
    run_.begin();
}

void Workbench::perform(const life::ContinueRun&) {
    target_.will_move();
    run_.go_on();
}

void Workbench::perform(const life::StepPlan&) {
    target_.will_move();
    run_.step_plan();
}

void Workbench::perform(const life::PauseRun&) {
    if (run_.is_open()) run_.pause();
}

void Workbench::perform(const life::RestRun&) {
    run_.rest();
}

void Workbench::perform(const life::PauseNodes& pause) {
    target_.pause_all([this, call = pause.call](const std::vector<std::string>& failed) {
        tell_life(life::NodesPaused{call, joined_lines(failed)});
    });
}

// From here on the clock of a bus is that of the run.
void Workbench::perform(const life::CountStart&) {
    if (!bus_since_) bus_since_ = now_;
    run_is_over_ = placed_by_hand_ = false;
    ++runs_;
}

// Of what the plan still says the bus gets no more than that work ends.
void Workbench::perform(const life::EndPlan& end) {
    run_.stop_plan();
    if (end.silence && bus_) bus_->close_door_but_for(stop_events());
}

// As the bus knows them, by number.
std::set<uint16_t> Workbench::stop_events() const {
    std::set<uint16_t> numbers;
    if (!project_ || project_->scripts.empty()) return numbers;
    const aesl::CommonDefinitions* common = scripts_.common(project_->scripts.front());
    if (!common) return numbers;
    for (size_t i = 0; i < common->events.size(); ++i) {
        if (!run_.stop_events().contains(common->events[i].name)) continue;
        numbers.insert(static_cast<uint16_t>(i));
    }
    return numbers;
}

void Workbench::perform(const life::StopNodes& stop) {
    send_at_once_ = true;
    stop_number_ = stop.number;
    target_.stop_all([this, number = stop.number](const StopReport& report) {
        tell_life(life::Stopped{number, report});
    });
}

void Workbench::perform(const life::MakeSafe& safe) {
    send_at_once_ = true;
    if (safe.number == 0) return target_.make_safe();
    stop_number_ = safe.number;
    target_.make_safe([this, number = safe.number](const StopReport& report) {
        tell_life(life::Stopped{number, report});
    });
}

void Workbench::perform(const life::EndRunner& end) {
    run_.give_up("the run " + end.why);
}

void Workbench::perform(const life::Disconnect&) {
    end_scripts_recording();
    target_.disconnect();
    recordings_.over(run_has_begun());
    run_.close();
    bus_.reset();
    loaded_by_world_.clear();
}

void Workbench::perform(const life::GoOnLeaving& leaving) {
    const auto found = leaving_.find(leaving.call);
    const auto then = std::move(found->second);
    leaving_.erase(found);
    then();
}

void Workbench::perform(const life::Answer& answer) {
    const auto found = waiting_.find(answer.call);
    const Call call = std::move(found->second);
    waiting_.erase(found);
    orders_.erase(answer.call);
    const auto result = results_.extract(answer.call);
    if (!answer.why.empty()) return call.fail(answer.code, answer.why);
    call.done(result ? result.mapped() : Json::object());
}

void Workbench::perform(const life::AnswerStop& answer) {
    const auto found = waiting_.find(answer.call);
    const Call call = std::move(found->second);
    waiting_.erase(found);
    call.done(answer_of(answer.report));
}

void Workbench::perform(const life::Tell& told) {
    desk_.topics().touch("end");
    if (told.again) return ends_.renew(told.end);
    end_scripts_recording();
    if (!bus_since_) bus_since_ = now_;
    run_is_over_ = true;
    ends_.add(told.end, clock(), desk_.wall_ms());
    say(ends_.kind(), ends_.sentence());
    ended_(told.end);
}

}  // namespace vagus::serve
