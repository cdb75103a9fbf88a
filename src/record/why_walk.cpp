#include "record/why_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/json.hpp"
#include "embed/loaded_plan.hpp"
#include "wire/protocol.hpp"

namespace vagus::record {

namespace {

// Local events of nodes that come when what a native began is done.
const std::set<std::string_view> kDone = {"arrived", "turned", "halted", "sound.finished"};

constexpr std::string_view kIgnore = "@ignore";
constexpr std::string_view kTerminate = "@terminate";

bool is_timer(std::string_view event) {
    return event == "tick" || event.starts_with("timer");
}

}  // namespace

std::string words_text(const std::vector<int16_t>& words) {
    std::string text;
    for (const int16_t word : words) text += (text.empty() ? "" : " ") + std::to_string(word);
    return text;
}

std::string value_text(const plan::Value& value) {
    switch (value.type()) {
        case plan::Type::String:
            return json_quote(value.string());
        case plan::Type::Bool:
            return value.boolean() ? "true" : "false";
        case plan::Type::Int:
            return std::to_string(value.integer());
        case plan::Type::Float:
            return fmt::format("{:g}", value.number());
        case plan::Type::Object:
            break;
    }
    return "an object";
}

std::string Walk::node_name(const sim::WitnessedNode& node) const {
    for (const session::NodeState& one : rerun_.session()->nodes()) {
        if (one.id == node.id && one.robot.number == node.robot) return one.name;
    }
    return "node " + std::to_string(node.id);
}

std::string Walk::place_of(const sim::WitnessedNode& node, uint16_t pc) const {
    const aesl::Program* const program = rerun_.session()->program(node.id);
    if (program == nullptr || pc >= program->lines.size()) return "";
    const auto place = rerun_.session()->place_of(node.id, program->lines[pc]);
    if (!place) return "";
    return fmt::format("{}:{}", rerun_.name_of(place->first), place->second);
}

std::string Walk::local_name(const sim::WitnessedNode& node, int event) const {
    const aesl::Target* const target = rerun_.session()->target(node.id);
    const auto index = static_cast<size_t>(event);
    return target != nullptr && index < target->local_events.size()
               ? target->local_events[index].name
               : std::to_string(event);
}

std::string Walk::local_help(const sim::WitnessedNode& node, int event) const {
    const aesl::Target* const target = rerun_.session()->target(node.id);
    const auto index = static_cast<size_t>(event);
    return target != nullptr && index < target->local_events.size()
               ? target->local_events[index].doc
               : "";
}

// ---- frames, handlers, the world ----

void Walk::frame(uint32_t number) {
    const Causes::Frame* const one = causes_.frame(number);
    if (one == nullptr) return;
    if (one->of_bus) return frame_of_bus_node(number, *one);
    if (one->node.robot == 0) return frame_of_plan(*one);
    const bool more = add({one->at,
                           fmt::format("the script of {} emitted {}", node_name(one->node),
                                       one->event.empty() ? "a message" : one->event),
                           place_of(one->node, one->deed.pc), words_text(one->arguments)});
    if (more) run(one->deed.run);
}

void Walk::frame_of_plan(const Causes::Frame& frame) {
    if (frame.by.empty()) {
        const char* const who = rerun_.about().verb == kStudioVerb ? "the studio" : "a host";
        add({frame.at, fmt::format("{} sent {}", who, frame.event), "",
             words_text(frame.arguments)});
        return;
    }
    const auto start = last_line(std::min(frame.line, lines().size()), [&](size_t i) {
        const auto* const started = what<plan::ActorStarted>(i);
        return started != nullptr && started->actor == frame.by;
    });
    if (!start) return frame_of_supervisor(frame);
    if (!add_element(frame.at,
                     fmt::format("the actor {} of the plan sent {}", frame.by, frame.event),
                     lines()[*start].event.plan, frame.by, words_text(frame.arguments))) {
        return;
    }
    // It was being stopped, it had heard something, or that is how it begins.
    const uint64_t activation = what<plan::ActorStarted>(*start)->activation;
    const auto stop = last_line(std::min(frame.line, lines().size()), [&](size_t i) {
        const auto* const raised = what<plan::EventRaised>(i);
        if (raised == nullptr || raised->target == kIgnore || i < *start) return false;
        return raised->activation == activation ||
               lines()[*start].event.plan.starts_with(lines()[i].event.plan + "/");
    });
    if (stop) return line(*stop);
    const Causes::Frame* const heard = causes_.frame(frame.cause);
    if (heard != nullptr && heard->at >= lines()[*start].event.at) return this->frame(frame.cause);
    line(*start);
}

// It sends when its watching begins and ends, which follows from what the plan decided last; or
// when it has heard something.
void Walk::frame_of_supervisor(const Causes::Frame& frame) {
    const auto its = last_line(std::min(frame.line, lines().size()), [&](size_t i) {
        return (leads_on(i) || what<plan::PlanStarted>(i) != nullptr) &&
               !places_.element(lines()[i].event.plan, frame.by).empty();
    });
    if (!add_element(frame.at,
                     fmt::format("the supervisor {} of the plan sent {}", frame.by, frame.event),
                     its ? lines()[*its].event.plan : "", frame.by, words_text(frame.arguments))) {
        return;
    }
    const uint32_t decided_by = its ? lines()[*its].event.frame : 0;
    if (frame.cause != 0 && frame.cause != decided_by) return this->frame(frame.cause);
    if (its) line(*its);
}

void Walk::run(uint32_t number) {
    const Causes::HandlerRun* const one = causes_.run(number);
    if (one == nullptr) return;
    if (one->event >= 0) return local_event(*one);
    const Causes::Frame* const by = causes_.frame(one->frame);
    const std::string event = by != nullptr ? by->event : "an event of a host";
    const bool more =
        add({one->at, fmt::format("{} heard {}", node_name(one->node), event),
             place_of(one->node, one->pc), by != nullptr ? words_text(by->arguments) : ""});
    if (more) frame(one->frame);
}

void Walk::local_event(const Causes::HandlerRun& run) {
    const std::string event = local_name(run.node, run.event);
    const std::string node = node_name(run.node);
    const std::string place = place_of(run.node, run.pc);
    const std::string felt = is_timer(event) ? fmt::format("a timer of {} ran out: {}", node, event)
                                             : fmt::format("{} felt {}", node, event);
    const std::string about = local_help(run.node, run.event);
    if (!kDone.contains(event) || run.call == 0) {
        if (add({run.at, felt, place, about})) happening(run.happening);
        return;
    }
    if (add({run.at, fmt::format("{} felt {}", node, event), place, about})) {
        call(run.call);
    }
}

void Walk::call(uint32_t number) {
    const Causes::Call* const one = causes_.call(number);
    if (one == nullptr) return;
    const aesl::Target* const target = rerun_.session()->target(one->node.id);
    const std::string native = target->natives[one->native].name;
    const bool more =
        add({one->deed.at, fmt::format("the script of {} called {}", node_name(one->node), native),
             place_of(one->node, one->deed.pc), ""});
    if (more) run(one->deed.run);
}

void Walk::happening(uint32_t number) {
    if (number == 0) return;
    const Causes::Happening& one = causes_.happenings()[number - 1];
    std::string place;
    if (one.kind == Causes::Happening::Kind::Timeline) place = places_.timeline(one.entry);
    if (add({one.at, one.what, place, ""})) happening(one.before);
}

// What was broken when it happened, or shortly before. Nothing tells that it follows from that.
void Walk::chaos() {
    constexpr Duration kFeltFor = std::chrono::seconds(4);  // a node is missed after three
    const auto& happenings = causes_.happenings();
    for (size_t i = happenings.size(); i-- > 0 && !chain_.empty();) {
        const Causes::Happening& one = happenings[i];
        const Time at = chain_.front().at;
        if (one.kind != Causes::Happening::Kind::Chaos || one.at > at) continue;
        const auto end = sim::end_of(rerun_.session()->world().chaos()[one.entry]);
        if (end && *end + kFeltFor < at) continue;
        add({one.at, "perhaps " + one.what, "", ""});
        return;
    }
}

// ---- the plan ----

// A line that another actor, or the end of the plan, follows from.
bool Walk::leads_on(size_t index) const {
    const auto* const raised = what<plan::EventRaised>(index);
    if (raised != nullptr) return raised->target != kIgnore;
    return what<plan::ActorEnded>(index) != nullptr;
}

void Walk::line(size_t index) {
    const plan::TraceEvent& event = lines()[index].event;
    if (const auto* started = what<plan::ActorStarted>(index)) {
        if (add_element(event.at, fmt::format("the actor {} began", started->actor), event.plan,
                        started->actor)) {
            before_started(index, *started);
        }
    } else if (const auto* ended = what<plan::ActorEnded>(index)) {
        if (add_element(event.at,
                        fmt::format("the actor {} ended with {}", ended->actor, ended->state),
                        event.plan, ended->actor)) {
            before_ended(index, *ended);
        }
    } else if (const auto* broken = what<plan::ActorInterrupted>(index)) {
        if (add_element(event.at, fmt::format("the actor {} was interrupted", broken->actor),
                        event.plan, broken->actor)) {
            interrupted(index, *broken);
        }
    } else if (const auto* one = what<plan::EventRaised>(index)) {
        raised(index, *one);
    } else if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        if (add({event.at, fmt::format("the plan {} began", event.plan), places_.plan(event.plan),
                 ""})) {
            before_plan_began(index);
        }
    } else if (const auto* over = what<plan::PlanEnded>(index)) {
        if (add({event.at, fmt::format("the plan {} ended: {}", event.plan, name_of(over->result)),
                 places_.plan(event.plan), over->message})) {
            before_plan_ended(index, *over);
        }
    }
}

void Walk::raised(size_t index, const plan::EventRaised& raised) {
    const plan::TraceEvent& event = lines()[index].event;
    if (!add_element(event.at,
                     fmt::format("the supervisor {} raised {}", raised.supervisor, raised.event),
                     event.plan, raised.supervisor)) {
        return;
    }
    if (causes_.by_hand(index)) {
        add({event.at, "a person raised it in the debugger of the plan", "", ""});
        return;
    }
    const bool told = raised.target != kIgnore && rerun_.past_bus() == nullptr;
    if (causes_.tied(index) && told) ties_.emplace_back(chain_.size() - 1, index);
    if (event.frame != 0) frame(event.frame);
}

// An actor begins by an event that interrupted another, by the state of another, or at the start.
void Walk::before_started(size_t index, const plan::ActorStarted& started) {
    const auto before = last_line(index, [&](size_t i) {
        const auto* const raised = what<plan::EventRaised>(i);
        const auto* const ended = what<plan::ActorEnded>(i);
        if (!same_plan(i, index)) return false;
        return (raised != nullptr && raised->target == started.actor) ||
               (ended != nullptr && ended->target == started.actor) ||
               what<plan::PlanStarted>(i) != nullptr;
    });
    if (before) line(*before);
}

// An actor that is a plan ended with that plan; another one because of what it heard, or of what
// it was begun for.
void Walk::before_ended(size_t index, const plan::ActorEnded& ended) {
    const plan::TraceEvent& event = lines()[index].event;
    const auto begin = last_line(index, [&](size_t i) {
        const auto* const started = what<plan::ActorStarted>(i);
        return started != nullptr && started->activation == ended.activation;
    });
    const std::string inner = fmt::format("{}/{}", event.plan, ended.actor);
    const auto inner_end = last_line(index, [&](size_t i) {
        return what<plan::PlanEnded>(i) != nullptr && lines()[i].event.plan == inner;
    });
    if (inner_end && begin && *inner_end > *begin) return line(*inner_end);
    const Causes::Frame* const heard = causes_.frame(event.frame);
    if (heard != nullptr && begin && heard->at >= lines()[*begin].event.at) {
        return frame(event.frame);
    }
    if (begin) line(*begin);
}

// By an event against it or against a plan around it, by a supervisor that failed, or from outside.
void Walk::interrupted(size_t index, const plan::ActorInterrupted& broken) {
    const plan::TraceEvent& event = lines()[index].event;
    const auto is_around = [&](size_t i) {
        const std::string& plan = lines()[i].event.plan;
        return event.plan == plan || event.plan.starts_with(plan + "/");
    };
    const auto by = last_line(index, [&](size_t i) {
        return (is_around(i) && leads_on(i)) || what<plan::ActorStarted>(i) != nullptr ||
               (is_around(i) && what<plan::ErrorFound>(i) != nullptr);
    });
    const auto* const raised = by ? what<plan::EventRaised>(*by) : nullptr;
    const bool is_own = raised != nullptr && same_plan(*by, index);
    if (raised != nullptr && (!is_own || raised->activation == broken.activation)) return line(*by);
    if (by && what<plan::ErrorFound>(*by) != nullptr) {
        return failed(*by, *what<plan::ErrorFound>(*by));
    }
    ended_from_outside(event.at);
}

// A plan inside another began with the actor that it is.
void Walk::before_plan_began(size_t index) {
    const std::string& path = lines()[index].event.plan;
    const size_t slash = path.rfind('/');
    if (slash == std::string::npos) return;
    const auto actor = last_line(index, [&](size_t i) {
        const auto* const started = what<plan::ActorStarted>(i);
        return started != nullptr && lines()[i].event.plan == path.substr(0, slash) &&
               started->actor == path.substr(slash + 1);
    });
    if (actor) line(*actor);
}

void Walk::before_plan_ended(size_t index, const plan::PlanEnded& ended) {
    const plan::TraceEvent& event = lines()[index].event;
    const auto by = last_line(index, [&](size_t i) {
        return same_plan(i, index) && (leads_on(i) || what<plan::ErrorFound>(i) != nullptr);
    });
    if (by && what<plan::ErrorFound>(*by) != nullptr && ended.result == plan::PlanResult::Error) {
        return failed(*by, *what<plan::ErrorFound>(*by));
    }
    const auto* const raised = by ? what<plan::EventRaised>(*by) : nullptr;
    const auto* const over = by ? what<plan::ActorEnded>(*by) : nullptr;
    const std::string_view target = raised != nullptr ? raised->target
                                    : over != nullptr ? over->target
                                                      : std::string_view();
    if (target == kTerminate) return line(*by);
    // A plan inside another that was interrupted with it.
    const auto around = last_line(index, [&](size_t i) {
        return what<plan::EventRaised>(i) != nullptr && leads_on(i) &&
               event.plan.starts_with(lines()[i].event.plan + "/");
    });
    if (around && lines()[*around].event.at == event.at) return line(*around);
    ended_from_outside(event.at);
}

void Walk::failed(size_t index, const plan::ErrorFound& error) {
    const plan::TraceEvent& event = lines()[index].event;
    if (!add_element(event.at, fmt::format("{} failed", error.element), event.plan, error.element,
                     error.message)) {
        return;
    }
    const auto start = last_line(index, [&](size_t i) {
        const auto* const started = what<plan::ActorStarted>(i);
        return started != nullptr && same_plan(i, index) && started->actor == error.element;
    });
    if (start) return line(*start);
    if (event.frame != 0) frame(event.frame);
}

void Walk::ended_from_outside(Time at) {
    if (rerun_.ended_by()) {
        add({at, "somebody ended the run", "", *rerun_.ended_by()});
    } else if (!rerun_.about().max_time.empty()) {
        add({at, "the time of the run was over", "", "--max-time " + rerun_.about().max_time});
    } else {
        add({at, "the time of the run was over, or nothing could happen any more", "", ""});
    }
}

// ---- what scripts and hosts write ----

void Walk::wrote(const sim::WitnessedNode& node, const Causes::Deed& deed,
                 const std::string& name) {
    const std::string value = std::to_string(deed.value);
    if (deed.host) {
        add({deed.at, fmt::format("a host set {} of {}", name, node_name(node)), "", value});
        return;
    }
    add({deed.at, fmt::format("the script of {} wrote {}", node_name(node), name),
         place_of(node, deed.pc), value});
    if (deed.run != 0) return run(deed.run);
    add({deed.at, fmt::format("the script of {} began", node_name(node)), "", ""});
}

}  // namespace vagus::record
