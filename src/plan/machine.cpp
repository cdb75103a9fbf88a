#include "plan/machine.hpp"

#include <fmt/format.h>

#include <cassert>

#include "plan/machine_parts.hpp"

namespace vagus::plan {

// Outputs as they were started, and who gives them.
struct Machine::Writer {
    const Version& version;
    const std::vector<GraphOutput>& outputs;
    std::string_view by;
};

Machine::Machine(const Graph& graph) : graph_(&graph) {}
Machine::~Machine() = default;

// ---- starting ----

void Machine::start(const std::vector<std::pair<int, Value>>& outside, Time now) {
    assert(levels_.empty() && !over_);
    const GraphPlan& plan = graph_->plans.front();
    push_level(plan, plan.name);
    trace(0, now, PlanStarted{});
    for (const GraphVariable& variable : plan.variables) {
        trace(0, now, VariableWritten{variable.name, variable.initial, "initial"});
    }
    for (const auto& [slot, value] : outside) {
        cell(0, slot) = value;
        trace(0, now,
              VariableWritten{plan.variables[static_cast<size_t>(slot)].name, value, "outside"});
    }
    start_globals(0, now);
    activate(0, plan.start, now);
}

void Machine::push_level(const GraphPlan& plan, std::string path) {
    auto level = std::make_unique<Level>();
    level->path = std::move(path);
    level->now = make_version(depth(), plan, nullptr);
    level->globals.resize(plan.globals.size());
    levels_.push_back(std::move(level));
}

void Machine::start_globals(int level, Time) {
    for (size_t i = 0; i < at(level).globals.size(); ++i) {
        start_watch(level, true, static_cast<int>(i));
    }
}

void Machine::start_watch(int level, bool global, int index) {
    Level& l = at(level);
    const auto i = static_cast<size_t>(index);
    Watch& watch = global ? l.globals[i] : l.own[i];
    const GraphSupervisor& of = global ? l.now->plan->globals[i] : l.active->supervisors[i];
    watch = {.id = ++watches_,
             .level = level,
             .global = global,
             .index = index,
             .of = &of,
             .newest = &of,
             .version = l.now};
    commands_.emplace_back(StartWatch{watch.id, level, global, index, &of});
}

void Machine::activate(int level, int actor, Time now) {
    Level& l = at(level);
    l.begun = l.now;
    l.active = l.newest = &l.now->plan->actors[static_cast<size_t>(actor)];
    l.interrupted = false;
    if (at_once_ >= kActivationsAtOnceMax) {
        l.phase = Phase::None;
        fail_plan(level, l.active->name,
                  fmt::format("{} activations have come without any time passing: a loop that "
                              "never waits",
                              kActivationsAtOnceMax),
                  now);
        return;
    }
    ++at_once_;
    l.activation = ++activations_;
    l.phase = Phase::Pending;
    restart_globals(level);
    l.own.assign(l.active->supervisors.size(), {});
    for (size_t i = 0; i < l.own.size(); ++i) start_watch(level, false, static_cast<int>(i));
    commands_.emplace_back(Activate{l.activation, level});
}

void Machine::restart_globals(int level) {
    Level& l = at(level);
    const Template* of = l.active->of;
    const bool is_computation = of && of->kind == Kind::Computation;
    for (size_t i = 0; i < l.globals.size(); ++i) {
        Watch& watch = l.globals[i];
        if (watch.id != 0) {
            watch.of = watch.newest;
            watch.version = l.now;
        }
        if (watch.rest == Rest::Remedy) {
            if (!is_computation) watch.rest = Rest::Resting;
        } else if (watch.rest == Rest::Resting) {
            start_watch(level, true, static_cast<int>(i));
        }
    }
}

void Machine::begin(ActivationId activation, Time now) {
    const int level = level_of(activation);
    if (level < 0 || at(level).phase != Phase::Pending) return;
    Level& l = at(level);
    const GraphActor& actor = *l.active;
    Result<std::vector<Value>> in = read(*l.begun, actor.inputs);
    if (!in.ok()) {
        l.phase = Phase::None;
        fail_plan(level, actor.name, in.error().what, now);
        return;
    }
    ActorStarted started{actor.name, activation, {}};
    for (size_t i = 0; i < actor.inputs.size(); ++i) {
        started.in.emplace_back(actor.inputs[i].name, in.value()[i]);
    }
    trace(level, now, std::move(started));
    l.phase = Phase::Running;
    if (actor.of) {
        commands_.emplace_back(StartCode{activation, level, &actor, std::move(in.value())});
    } else if (depth() >= kPlanDepthMax) {
        fail(activation,
             fmt::format("plans are nested more than {} deep; the outermost counts as 1",
                         kPlanDepthMax),
             now);
    } else {
        begin_sub_plan(level, std::move(in.value()), now);
    }
}

// As the newest version of the inner plan says, also if the caller's actor was started before it.
void Machine::begin_sub_plan(int level, std::vector<Value> in, Time now) {
    const GraphActor& caller = *at(level).newest;
    const GraphPlan& plan = graph_->plans[static_cast<size_t>(caller.sub_plan)];
    push_level(plan, at(level).path + "/" + caller.name);
    const int inner = level + 1;
    trace(inner, now, PlanStarted{});
    for (const GraphVariable& variable : plan.variables) {
        if (variable.access == Access::Shared) continue;
        trace(inner, now, VariableWritten{variable.name, variable.initial, "initial"});
    }
    const Status fed = feed(inner, *at(level).active, in, now);
    if (!fed.ok()) return fail_plan(inner, caller.name, fed.error().what, now);
    start_globals(inner, now);
    activate(inner, plan.start, now);
}

// Its inputs were read as the caller's actor was started with them.
Status Machine::feed(int level, const GraphActor& caller, const std::vector<Value>& in, Time now) {
    const GraphPlan& plan = *at(level).now->plan;
    for (size_t i = 0; i < caller.inputs.size(); ++i) {
        const GraphInput& input = caller.inputs[i];
        const int slot = input.fed ? find_variable(plan, input.name) : -1;
        if (slot < 0) continue;
        const GraphVariable& variable = plan.variables[static_cast<size_t>(slot)];
        Result<Value> value = convert(in[i], variable.type);
        if (!value.ok()) {
            return Error{Code::BadInput,
                         fmt::format("the input \"{}\": {}", input.name, value.error().what)};
        }
        cell(level, slot) = value.value();
        trace(level, now, VariableWritten{variable.name, std::move(value.value()), "outside"});
    }
    return Status::done();
}

// ---- what happened ----

void Machine::end(ActivationId activation, const Given& given, Time now) {
    const int level = level_of(activation);
    if (level < 0 || at(level).phase != Phase::Running) return;
    Level& l = at(level);
    const GraphActor& actor = *l.active;
    const auto outcome = static_cast<size_t>(given.outcome);
    const int target = l.newest->targets[outcome];
    l.phase = Phase::None;
    trace(level, now,
          ActorEnded{actor.name, activation, actor.states[outcome], target_name(level, target)});
    const Status written =
        write_outputs(level, {*l.begun, actor.outputs, actor.name}, given.outputs, now);
    if (!written.ok()) {
        fail_plan(level, actor.name, written.error().what, now);
        return;
    }
    stop_own(level);
    follow(level, target, PlanResult::Ok, now);
}

void Machine::end_sub_plan(ActivationId activation, Time now) {
    const int level = level_of(activation);
    if (level < 0 || at(level).phase != Phase::SubEnded) return;
    Level& l = at(level);
    l.phase = Phase::Running;
    Given given{.outcome = static_cast<int>(l.sub_result), .outputs = std::move(l.sub_outputs)};
    if (l.sub_result == PlanResult::Error) given.outputs.assign(given.outputs.size(), {});
    end(activation, given, now);
}

void Machine::raise(WatchId id, const Given& given, Time now) {
    Watch* watch = find(id);
    if (!watch) return;
    const int level = watch->level;
    const GraphSupervisor& of = *watch->of;
    const auto outcome = static_cast<size_t>(given.outcome);
    const int target = watch->newest->targets[outcome];
    trace(level, now,
          EventRaised{of.name, of.of->outcomes[outcome].name, target_name(level, target),
                      watch->global, at(level).activation});
    if (target == kTargetIgnore) return;
    After after{.target = target};
    const Status written =
        write_outputs(level, {*watch->version, of.outputs, of.name}, given.outputs, now);
    stop_watch(*watch);
    if (watch->global) watch->rest = Rest::Remedy;
    if (!written.ok()) {
        after = {.failed = true, .message = sentence(level, of.name, written.error().what)};
        trace(level, now, ErrorFound{of.name, after.message});
    }
    interrupt(level, std::move(after), now);
}

void Machine::fail(ActivationId activation, std::string_view cause, Time now) {
    const int level = level_of(activation);
    if (level < 0 || at(level).phase != Phase::Running) return;
    at(level).phase = Phase::None;
    fail_plan(level, at(level).active->name, cause, now);
}

void Machine::fail_watch(WatchId id, std::string_view cause, Time now) {
    Watch* watch = find(id);
    if (!watch) return;
    const int level = watch->level;
    After after{.failed = true, .message = sentence(level, watch->of->name, cause)};
    trace(level, now, ErrorFound{watch->of->name, after.message});
    stop_watch(*watch);
    interrupt(level, std::move(after), now);
}

void Machine::stopped(ActivationId activation, Time now) {
    const int level = level_of(activation);
    if (level < 0 || at(level).phase != Phase::Stopping) return;
    finish_stop(now);
}

void Machine::overstayed(ActivationId activation, Time now) {
    const int innermost = level_of(activation);
    if (innermost < 0 || at(innermost).phase != Phase::Stopping) return;
    const GraphActor& actor = *at(innermost).active;
    const std::string message =
        sentence(innermost, actor.name,
                 fmt::format("it did not stop within its grace time of {} ms", actor.of->grace_ms));
    trace(innermost, now, ErrorFound{actor.name, message});
    stopping_from_ = -1;
    for (int level = innermost; level >= 0; --level) {
        at(level).phase = Phase::None;
        end_plan(level, PlanResult::Error, message, now);
    }
}

void Machine::abort(Time now) {
    if (over_ || levels_.empty()) return;
    interrupt(0, After{}, now);
}

void Machine::fail_run(std::string_view cause, Time now) {
    if (over_ || levels_.empty() || stopping_from_ == 0) return;
    const GraphActor* const active = at(0).active;
    const std::string_view element = active ? std::string_view(active->name) : "";
    After after{.failed = true, .message = sentence(0, element, cause)};
    trace(0, now, ErrorFound{element, after.message});
    interrupt(0, std::move(after), now);
}

void Machine::log(ActivationId activation, std::string text, Time now) {
    const int level = level_of(activation);
    if (level < 0) return;
    trace(level, now, TextLogged{at(level).active->name, std::move(text)});
}

void Machine::late(WatchId id, Duration by, Time now) {
    if (const Watch* watch = find(id)) trace(watch->level, now, CheckLate{watch->of->name, by});
}

void Machine::time_passed() {
    at_once_ = 0;
}

// ---- ending ----

// The activation at `level` is to be stopped, with all that runs inside it, innermost code first;
// then `after` follows (P18, P25). Code that was told before is not told again (P18a).
void Machine::interrupt(int level, After after, Time now) {
    Level& l = at(level);
    l.after = std::move(after);
    stopping_from_ = stopping_from_ < 0 ? level : std::min(stopping_from_, level);
    if (!l.interrupted) {
        l.interrupted = true;
        l.interrupted_at = now;
    }
    stop_own(level);
    for (int inner = level + 1; inner < depth(); ++inner) {
        Level& i = at(inner);
        if (!i.interrupted) {
            i.interrupted = true;
            i.interrupted_at = now;
        }
        stop_own(inner);
        stop_globals(inner);
    }
    Level& innermost = at(depth() - 1);
    if (innermost.phase == Phase::Stopping) return;
    if (innermost.phase == Phase::Running) {
        innermost.phase = Phase::Stopping;
        commands_.emplace_back(StopCode{innermost.activation});
        return;
    }
    finish_stop(now);
}

// Nothing runs any more from the innermost level to that of the interruption (P25a).
void Machine::finish_stop(Time now) {
    const int level = stopping_from_;
    stopping_from_ = -1;
    for (int inner = depth() - 1; inner >= level; --inner) {
        Level& l = at(inner);
        const bool ran = l.phase != Phase::Pending;
        trace(inner, now,
              ActorInterrupted{l.active->name, l.activation, ran, now - l.interrupted_at});
        l.phase = Phase::None;
        if (inner > level) {
            trace(inner, now, PlanEnded{PlanResult::Interrupted, {}});
            levels_.pop_back();
        }
    }
    const After after = std::move(at(level).after);
    if (after.failed) {
        end_plan(level, PlanResult::Error, after.message, now);
    } else {
        follow(level, after.target, PlanResult::Interrupted, now);
    }
}

void Machine::follow(int level, int target, PlanResult at_terminate, Time now) {
    assert(target != kTargetIgnore);
    if (target == kTargetTerminate) {
        end_plan(level, at_terminate, {}, now);
    } else {
        activate(level, target, now);
    }
}

// The plan at the innermost level ends; no code of it runs.
void Machine::end_plan(int level, PlanResult result, std::string message, Time now) {
    assert(level == depth() - 1);
    stop_own(level);
    stop_globals(level);
    trace(level, now, PlanEnded{result, message});
    if (level == 0) {
        over_ = true;
        result_ = result;
        message_ = std::move(message);
        levels_.clear();
        return;
    }
    Level& caller = at(level - 1);
    caller.phase = Phase::SubEnded;
    caller.sub_result = result;
    caller.sub_outputs = outputs_of(level);
    levels_.pop_back();
    commands_.emplace_back(SubPlanOver{caller.activation, level - 1});
}

// By the caller's declaration, as its actor was started: what is gone since then gives nothing.
std::vector<std::optional<Value>> Machine::outputs_of(int level) const {
    const Level& caller = at(level - 1);
    std::vector<std::optional<Value>> values;
    const GraphActor& actor = *caller.active;
    for (const std::string& name : actor.inner_outputs) {
        const int slot = find_variable(*at(level).now->plan, name);
        values.push_back(slot < 0 ? std::nullopt : std::optional(cell(level, slot)));
    }
    return values;
}

void Machine::fail_plan(int level, std::string_view element, std::string_view cause, Time now) {
    std::string message = sentence(level, element, cause);
    trace(level, now, ErrorFound{element, message});
    end_plan(level, PlanResult::Error, std::move(message), now);
}

void Machine::stop_watch(Watch& watch) {
    if (watch.id == 0) return;
    commands_.emplace_back(StopWatch{watch.id});
    watch.id = 0;
    watch.rest = Rest::No;
}

void Machine::stop_own(int level) {
    for (Watch& watch : at(level).own) stop_watch(watch);
}

void Machine::stop_globals(int level) {
    for (Watch& watch : at(level).globals) {
        stop_watch(watch);
        watch.rest = Rest::No;
    }
}

// ---- values ----

Result<std::vector<Value>> Machine::read(const Version& version,
                                         const std::vector<GraphInput>& inputs) {
    std::vector<Value> values;
    values.reserve(inputs.size());
    std::vector<Value> variables;
    for (const GraphInput& input : inputs) {
        if (!input.formula) {
            values.push_back(input.value);
            continue;
        }
        variables.clear();
        for (const int slot : input.slots) {
            variables.push_back(*version.cells[static_cast<size_t>(slot)]);
        }
        Result<Value> value = input.formula->evaluate(variables);
        if (value.ok() && input.type) value = convert(value.value(), *input.type);
        if (!value.ok()) {
            return Error{Code::BadInput,
                         fmt::format("the input \"{}\": {}", input.name, value.error().what)};
        }
        values.push_back(std::move(value.value()));
    }
    return values;
}

Result<std::vector<Value>> Machine::read_inputs(WatchId id) const {
    const Watch* watch = find(id);
    if (!watch) return Error{Code::NotFound, "this supervisor does not watch any more"};
    return read(*watch->version, watch->of->inputs);
}

// All are converted, then all are written (P17a). A variable that is gone since the writer was
// started is nobody's any more (P31).
Status Machine::write_outputs(int level, const Writer& writer,
                              const std::vector<std::optional<Value>>& values, Time now) {
    const GraphPlan& plan = *at(level).now->plan;
    std::vector<std::pair<int, Value>> writes;
    for (const GraphOutput& output : writer.outputs) {
        const auto source = static_cast<size_t>(output.source);
        if (source >= values.size() || !values[source]) continue;
        const auto& named = writer.version.plan->variables[static_cast<size_t>(output.slot)];
        const bool newest = writer.version.plan == &plan;
        const int slot = newest ? output.slot : find_variable(plan, named.name);
        if (slot < 0) continue;
        Result<Value> converted = convert(*values[source], named.type);
        if (!converted.ok()) {
            return Error{Code::BadInput,
                         fmt::format("the output \"{}\" for the variable \"{}\": {}", output.name,
                                     named.name, converted.error().what)};
        }
        writes.emplace_back(slot, std::move(converted.value()));
    }
    for (auto& [slot, value] : writes) {
        const GraphVariable& variable = plan.variables[static_cast<size_t>(slot)];
        trace(level, now, VariableWritten{variable.name, value, writer.by});
        cell(level, slot) = std::move(value);
    }
    return Status::done();
}

Value& Machine::cell(int level, int slot) const {
    return *at(level).now->cells[static_cast<size_t>(slot)];
}

const Value& Machine::variable(int slot) const {
    return cell(0, slot);
}

const Value& Machine::variable(int level, int slot) const {
    return cell(level, slot);
}

Status Machine::write_outside(int slot, const Value& value, Time now) {
    return write_outside(0, slot, value, now);
}

Status Machine::write_outside(int level, int slot, const Value& value, Time now) {
    const GraphVariable& variable = at(level).now->plan->variables[static_cast<size_t>(slot)];
    Value converted = TRY(convert(value, variable.type));
    trace(level, now, VariableWritten{variable.name, converted, "outside"});
    cell(level, slot) = std::move(converted);
    return Status::done();
}

std::string_view Machine::target_name(int level, int target) const {
    if (target == kTargetTerminate) return kTerminate;
    if (target == kTargetIgnore) return kIgnore;
    return at(level).now->plan->actors[static_cast<size_t>(target)].name;
}

// Names the plan's instance, the element and the cause (P27).
std::string Machine::sentence(int level, std::string_view element, std::string_view cause) const {
    return fmt::format("{}: {}: {}", at(level).path, element, cause);
}

// ---- what is going on ----

bool Machine::over() const {
    return over_;
}
PlanResult Machine::result() const {
    return result_;
}
const std::string& Machine::message() const {
    return message_;
}
bool Machine::watching(WatchId watch) const {
    return find(watch) != nullptr;
}
int Machine::depth() const {
    return static_cast<int>(levels_.size());
}
const GraphPlan& Machine::plan_at(int level) const {
    return *at(level).now->plan;
}
const std::string& Machine::path_at(int level) const {
    return at(level).path;
}
const GraphActor* Machine::actor_at(int level) const {
    return at(level).active;
}
ActivationId Machine::activation_at(int level) const {
    return at(level).activation;
}
Phase Machine::phase_at(int level) const {
    return at(level).phase;
}
WatchId Machine::watch_at(const WatchPlace& place) const {
    const Level& level = at(place.level);
    const auto& watches = place.global ? level.globals : level.own;
    const auto index = static_cast<size_t>(place.index);
    return index < watches.size() ? watches[index].id : 0;
}
WatchPlace Machine::place_of(WatchId id) const {
    const Watch* const watch = find(id);
    assert(watch);
    return {watch->level, watch->global, watch->index};
}
int Machine::stopping_level() const {
    return stopping_from_;
}

std::vector<Command> Machine::take_commands() {
    return std::exchange(commands_, {});
}
std::vector<TraceEvent> Machine::take_trace() {
    return std::exchange(trace_, {});
}

Machine::Level& Machine::at(int level) const {
    return *levels_[static_cast<size_t>(level)];
}

int Machine::level_of(ActivationId activation) const {
    for (int level = depth() - 1; level >= 0; --level) {
        if (at(level).activation == activation && at(level).phase != Phase::None) return level;
    }
    return -1;
}

Machine::Watch* Machine::find(WatchId id) const {
    if (id == 0) return nullptr;
    for (const auto& level : levels_) {
        for (auto* watches : {&level->globals, &level->own}) {
            for (Watch& watch : *watches) {
                if (watch.id == id) return &watch;
            }
        }
    }
    return nullptr;
}

void Machine::trace(int level, Time now, decltype(TraceEvent::what) what) {
    trace_.push_back({now, at(level).path, std::move(what)});
}

}  // namespace vagus::plan
