#include "plan/explore_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "plan/interface.hpp"

namespace vagus::plan {

namespace {

bool can_fail(const GraphActor& actor) {
    return actor.of ||
           std::any_of(actor.inputs.begin(), actor.inputs.end(),
                       [](const GraphInput& input) { return input.formula.has_value(); });
}

bool has_computation(const GraphActor& actor) {
    return actor.of && actor.of->kind == Kind::Computation;
}

// Two entries of one template that read the same: their texts agree, whatever their order.
bool same_inputs(const std::vector<Entry>& a, const std::vector<Entry>& b) {
    const auto in_b = [&b](const Entry& one) {
        return std::any_of(b.begin(), b.end(), [&one](const Entry& other) {
            return one.name == other.name && one.text == other.text;
        });
    };
    return a.size() == b.size() && std::all_of(a.begin(), a.end(), in_b);
}

std::string start_value_text(const Value& value) {
    if (value.type() == Type::Object) return "object";
    return fmt::format("{} {}", name_of(value.type()), text_of(value).value());
}

// Which supervisor raises or fails; of an actor, itself.
bool is_of_supervisor(WalkKind kind) {
    return kind == WalkKind::OwnEvent || kind == WalkKind::GlobalEvent ||
           kind == WalkKind::OwnError || kind == WalkKind::GlobalError;
}

bool is_of_global(WalkKind kind) {
    return kind == WalkKind::GlobalEvent || kind == WalkKind::GlobalError;
}

}  // namespace

Walk::Walk(const std::vector<Plan>& plans, const Graph& graph, const ExploreOptions& options)
    : plans_(plans), graph_(graph), options_(options) {
    assert(options.depth >= 1 && options.depth <= kExploreDepthMax);
    find_watchers();
    walk();
}

// ---- made once ----

void Walk::find_watchers() {
    for (size_t plan = 0; plan < graph_.plans.size(); ++plan) {
        const Plan& written = plans_[plan];
        const GraphPlan& made = graph_.plans[plan];
        Watchers watchers{.globals = watchers_of(written.globals, made.globals), .own = {}};
        // Of two global ones both can be taken at one instant, the second against the next
        // activation (P21a).
        for (Watcher& global : watchers.globals) {
            std::fill(global.beaten.begin(), global.beaten.end(), false);
        }
        for (size_t actor = 0; actor < made.actors.size(); ++actor) {
            watchers.own.push_back(
                watchers_of(written.actors[actor].supervisors, made.actors[actor].supervisors));
        }
        watchers_.push_back(std::move(watchers));
    }
}

std::vector<Walk::Watcher> Walk::watchers_of(const std::vector<Supervisor>& written,
                                             const std::vector<GraphSupervisor>& made) {
    std::vector<Watcher> watchers;
    for (size_t i = 0; i < made.size(); ++i) {
        Watcher watcher{.beaten = std::vector<bool>(made[i].targets.size()),
                        .look = look_of(made[i])};
        for (size_t before = 0; before < i; ++before) {
            const bool alike = made[before].of == made[i].of &&
                               made[before].period_us == made[i].period_us &&
                               same_inputs(written[before].in, written[i].in);
            if (!alike) continue;
            for (size_t event = 0; event < watcher.beaten.size(); ++event) {
                if (made[before].targets[event] != kTargetIgnore) watcher.beaten[event] = true;
            }
        }
        watchers.push_back(std::move(watcher));
    }
    return watchers;
}

int Walk::look_of(const GraphSupervisor& supervisor) {
    if (supervisor.period_us != 0) return -1;
    std::string text = fmt::format("{}", static_cast<const void*>(supervisor.of));
    for (const GraphInput& input : supervisor.inputs) {
        if (input.formula) return -1;
        text += "\n" + start_value_text(input.value);
    }
    return looks_.emplace(text, static_cast<int>(looks_.size())).first->second;
}

// ---- situations ----

size_t Walk::HashKey::operator()(const Key& key) const {
    uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, a word at a time, and its high bits mixed in
    for (const uint32_t word : key) {
        hash = (hash ^ word) * 0x100000001b3;
        hash ^= hash >> 29;
    }
    return static_cast<size_t>(hash);
}

// kOver and the result; or for each level its actor, then how its sub-plan ended (0: it has not)
// beside the number of those that rest, then these.
SituationId Walk::meet(Key key) {
    const auto [at, is_new] = ids_.emplace(std::move(key), count());
    if (!is_new) return at->second;
    keys_.push_back(&at->first);
    met_by_.push_back(steps_.size());
    distance_.push_back(at->second == 0 ? 0 : distance_[leaving_] + 1);
    return at->second;
}

SituationId Walk::meet(const Stack& stack) {
    Key key;
    for (const StackLevel& level : stack) {
        key.push_back(static_cast<uint32_t>(level.actor));
        const uint32_t ended = level.ended ? static_cast<uint32_t>(*level.ended) + 1 : 0;
        key.push_back(ended | static_cast<uint32_t>(level.resting.size()) << 2);
        key.insert(key.end(), level.resting.begin(), level.resting.end());
    }
    return meet(std::move(key));
}

Stack Walk::stack(SituationId situation) const {
    const Key& key = *keys_[situation];
    Stack stack;
    if (key[0] == kOver) return stack;
    for (size_t at = 0; at < key.size();) {
        StackLevel level{.plan = stack.empty() ? 0 : actor_of(stack.back()).sub_plan,
                         .actor = static_cast<int>(key[at]),
                         .ended = {},
                         .resting = {}};
        const uint32_t ended = key[at + 1] & 3;
        if (ended != 0) level.ended = static_cast<PlanResult>(ended - 1);
        const size_t resting = key[at + 1] >> 2;
        at += 2;
        for (size_t i = 0; i < resting; ++i) level.resting.push_back(static_cast<int>(key[at++]));
        stack.push_back(std::move(level));
    }
    return stack;
}

const GraphPlan& Walk::plan_of(const StackLevel& level) const {
    return graph_.plans[static_cast<size_t>(level.plan)];
}

const GraphActor& Walk::actor_of(const StackLevel& level) const {
    return plan_of(level).actors[static_cast<size_t>(level.actor)];
}

bool Walk::is_computation(int plan, int actor) const {
    return has_computation(
        graph_.plans[static_cast<size_t>(plan)].actors[static_cast<size_t>(actor)]);
}

StackLevel Walk::started(int plan) const {
    return {.plan = plan,
            .actor = graph_.plans[static_cast<size_t>(plan)].start,
            .ended = {},
            .resting = {}};
}

// Those that rested start again with this activation; but one that has just been taken (`raised`),
// or that was followed by computations only, rests through it (P23).
void Walk::activate(StackLevel& level, int actor, int raised) const {
    if (!is_computation(level.plan, level.actor)) level.resting.clear();
    if (raised >= 0) {
        level.resting.insert(std::lower_bound(level.resting.begin(), level.resting.end(), raised),
                             raised);
    }
    level.actor = actor;
    level.ended.reset();
}

// What runs inside the level is over; `raised` is the global supervisor that led here, or -1.
SituationId Walk::follow(Stack stack, int level, int target, PlanResult at_terminate, int raised) {
    if (target == kTargetTerminate) return end_plan(std::move(stack), level, at_terminate);
    stack.resize(static_cast<size_t>(level) + 1);
    activate(stack.back(), target, raised);
    return meet(stack);
}

SituationId Walk::end_plan(Stack stack, int level, PlanResult result) {
    if (level == 0) return meet(Key{kOver, static_cast<uint32_t>(result)});
    stack.resize(static_cast<size_t>(level));
    stack.back().ended = result;
    return meet(stack);
}

// ---- walking ----

void Walk::walk() {
    meet(Stack{started(0)});
    while (leaving_ < count()) {
        if (count() > options_.situations || steps_.size() > options_.steps) {
            complete_ = false;
            break;
        }
        first_step_.push_back(steps_.size());
        if (!is_over(leaving_)) leave(leaving_);
        ++leaving_;
    }
    first_step_.resize(static_cast<size_t>(count()) + 1, steps_.size());
}

void Walk::add(WalkStep step, SituationId to) {
    step.from = leaving_;
    step.to = to;
    steps_.push_back(step);
}

void Walk::leave(SituationId situation) {
    const Stack from = stack(situation);
    add_of_actor(from);
    add_events(from);
    add_errors(from);
}

const Walk::Watcher& Walk::watcher(const StackLevel& level, WalkKind kind, int index) const {
    const Watchers& watchers = watchers_[static_cast<size_t>(level.plan)];
    const auto& among =
        is_of_global(kind) ? watchers.globals : watchers.own[static_cast<size_t>(level.actor)];
    return among[static_cast<size_t>(index)];
}

// In the order of P21.
void Walk::add_events(const Stack& stack) {
    raised_before_.clear();
    for (int level = 0; level < static_cast<int>(stack.size()); ++level) {
        const StackLevel& at = stack[static_cast<size_t>(level)];
        const size_t before = raised_before_.size();
        std::vector<std::pair<int, size_t>> of_globals;
        for (int i = 0; i < static_cast<int>(plan_of(at).globals.size()); ++i) {
            if (std::binary_search(at.resting.begin(), at.resting.end(), i)) continue;
            add_events_of(stack, level, WalkKind::GlobalEvent, i);
            // Among themselves they do not beat each other.
            of_globals.insert(of_globals.end(),
                              raised_before_.begin() + static_cast<std::ptrdiff_t>(before),
                              raised_before_.end());
            raised_before_.resize(before);
        }
        raised_before_.insert(raised_before_.end(), of_globals.begin(), of_globals.end());
        for (int i = 0; i < static_cast<int>(actor_of(at).supervisors.size()); ++i) {
            add_events_of(stack, level, WalkKind::OwnEvent, i);
        }
    }
}

bool Walk::is_beaten(const Watcher& watcher, size_t event) const {
    if (watcher.beaten[event]) return true;
    return watcher.look >= 0 && std::find(raised_before_.begin(), raised_before_.end(),
                                          std::pair(watcher.look, event)) != raised_before_.end();
}

void Walk::add_events_of(const Stack& stack, int level, WalkKind kind, int index) {
    const StackLevel& at = stack[static_cast<size_t>(level)];
    const bool global = kind == WalkKind::GlobalEvent;
    const auto& among = global ? plan_of(at).globals : actor_of(at).supervisors;
    const GraphSupervisor& supervisor = among[static_cast<size_t>(index)];
    const Watcher& watches = watcher(at, kind, index);
    for (size_t event = 0; event < supervisor.targets.size(); ++event) {
        const int target = supervisor.targets[event];
        if (target == kTargetIgnore || is_beaten(watches, event)) continue;
        const SituationId to =
            follow(stack, level, target, PlanResult::Interrupted, global ? index : -1);
        add({.element = index,
             .outcome = static_cast<uint16_t>(event),
             .level = static_cast<uint8_t>(level),
             .kind = kind},
            to);
        if (watches.look >= 0) raised_before_.emplace_back(watches.look, event);
    }
}

// The code of the actor that runs may fail, and that of each supervisor that watches; a call only
// where a formula has to be read (P27).
void Walk::add_errors(const Stack& stack) {
    const int innermost = static_cast<int>(stack.size()) - 1;
    for (int level = 0; level <= innermost; ++level) {
        const StackLevel& at = stack[static_cast<size_t>(level)];
        WalkStep step{.level = static_cast<uint8_t>(level), .is_way = false};
        const auto& globals = plan_of(at).globals;
        int watching = 0;  // the first global one that does not rest
        while (std::binary_search(at.resting.begin(), at.resting.end(), watching)) ++watching;
        if (level == innermost && !at.ended && can_fail(actor_of(at))) {
            step.kind = WalkKind::ActorError;
            step.element = at.actor;
            step.is_way = actor_of(at).of && actor_of(at).of->only_fails;
        } else if (watching < static_cast<int>(globals.size())) {
            step.kind = WalkKind::GlobalError;
            step.element = watching;
        } else if (!actor_of(at).supervisors.empty()) {
            step.kind = WalkKind::OwnError;
        } else {
            continue;
        }
        add(step, end_plan(stack, level, PlanResult::Error));
    }
}

void Walk::add_of_actor(const Stack& stack) {
    const int level = static_cast<int>(stack.size()) - 1;
    const StackLevel& at = stack.back();
    const GraphActor& actor = actor_of(at);
    if (!actor.of && !at.ended) return add_call(stack);
    const size_t first = at.ended ? static_cast<size_t>(*at.ended) : 0;
    const size_t last = at.ended ? first + 1 : actor.targets.size();
    for (size_t state = first; state < last; ++state) {
        add({.element = at.actor,
             .outcome = static_cast<uint16_t>(state),
             .level = static_cast<uint8_t>(level),
             .kind = WalkKind::End,
             .timeless = at.ended || has_computation(actor)},
            follow(stack, level, actor.targets[state], PlanResult::Ok, -1));
    }
}

void Walk::add_call(const Stack& stack) {
    const StackLevel& at = stack.back();
    WalkStep step{.element = at.actor,
                  .level = static_cast<uint8_t>(stack.size() - 1),
                  .kind = WalkKind::Call,
                  .timeless = true};
    Stack inside = stack;
    if (static_cast<int>(stack.size()) < options_.depth) {
        inside.push_back(started(actor_of(at).sub_plan));
        return add(step, meet(inside));
    }
    skipped_ = true;
    step.kind = WalkKind::Skip;
    step.timeless = false;
    for (const PlanResult result : {PlanResult::Ok, PlanResult::Interrupted, PlanResult::Error}) {
        inside.back().ended = result;
        step.outcome = static_cast<uint16_t>(result);
        step.is_way = result != PlanResult::Error;
        add(step, meet(inside));
    }
}

// ---- telling ----

std::vector<size_t> Walk::way_to(SituationId situation) const {
    std::vector<size_t> way;
    while (situation != 0) {
        const size_t step = met_by_[situation];
        way.push_back(step);
        situation = steps_[step].from;
    }
    std::reverse(way.begin(), way.end());
    return way;
}

const GraphSupervisor& Walk::supervisor(const Stack& stack, const WalkStep& step) const {
    const StackLevel& at = stack[step.level];
    const auto& among = is_of_global(step.kind) ? plan_of(at).globals : actor_of(at).supervisors;
    return among[static_cast<size_t>(step.element)];
}

ExploreStep Walk::in_words(const WalkStep& step) const {
    const Stack from = stack(step.from);
    const StackLevel& at = from[step.level];
    ExploreStep words;
    words.plan = graph_.plans.front().name;
    for (size_t level = 0; level < step.level; ++level) {
        words.plan += "/" + actor_of(from[level]).name;
    }
    int target = kTargetIgnore;
    if (is_of_supervisor(step.kind)) {
        const GraphSupervisor& by = supervisor(from, step);
        words.element = by.name;
        words.kind = ExploreStep::Kind::Error;
        if (step.kind == WalkKind::OwnEvent || step.kind == WalkKind::GlobalEvent) {
            words.kind = ExploreStep::Kind::Event;
            words.outcome = by.of->outcomes[step.outcome].name;
            target = by.targets[step.outcome];
        }
    } else {
        const GraphActor& actor = actor_of(at);
        words.element = actor.name;
        if (step.kind == WalkKind::End) {
            if (at.ended) words.kind = ExploreStep::Kind::Return;
            words.outcome = actor.states[step.outcome];
            target = actor.targets[step.outcome];
        } else if (step.kind == WalkKind::Call) {
            words.kind = ExploreStep::Kind::Call;
            const GraphPlan& inner = graph_.plans[static_cast<size_t>(actor.sub_plan)];
            words.target = inner.actors[static_cast<size_t>(inner.start)].name;
        } else if (step.kind == WalkKind::Skip) {
            words.kind = ExploreStep::Kind::Skip;
            words.outcome = name_of(static_cast<PlanResult>(step.outcome));
        } else {
            words.kind = ExploreStep::Kind::Error;
        }
    }
    if (target == kTargetTerminate) words.target = kTerminate;
    if (target >= 0) words.target = plan_of(at).actors[static_cast<size_t>(target)].name;
    return words;
}

}  // namespace vagus::plan
