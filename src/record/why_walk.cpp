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

std::string Walk::robot_of(uint32_t number) const {
    if (!all_.is_fleet() || number == 0) return "";
    return session()->world().definition().robots[number - 1].name;
}

std::string Walk::node_name(const sim::WitnessedNode& node) const {
    for (const session::NodeState& one : session()->nodes()) {
        if (one.id == node.id && one.robot.number == node.robot) return one.name;
    }
    return "node " + std::to_string(node.id);
}

std::string Walk::place_of(const sim::WitnessedNode& node, uint16_t pc) const {
    const aesl::Program* const program = session()->program(node.id);
    if (program == nullptr || pc >= program->lines.size()) return "";
    const auto place = session()->place_of(node.id, program->lines[pc]);
    if (!place) return "";
    return fmt::format("{}:{}", rerun_.name_of(place->first), place->second);
}

std::string Walk::local_name(const sim::WitnessedNode& node, int event) const {
    const aesl::Target* const target = session()->target(node.id);
    const auto index = static_cast<size_t>(event);
    return target != nullptr && index < target->local_events.size()
               ? target->local_events[index].name
               : std::to_string(event);
}

std::string Walk::local_help(const sim::WitnessedNode& node, int event) const {
    const aesl::Target* const target = session()->target(node.id);
    const auto index = static_cast<size_t>(event);
    return target != nullptr && index < target->local_events.size()
               ? target->local_events[index].doc
               : "";
}

// ---- frames, handlers, the world ----

void Walk::frame(uint32_t number) {
    if (const BusCauses::Message* const brought = bus_->message(number)) return message(*brought);
    if (const BusCauses::News* const told = bus_->news(number)) return news(*told);
    const BusCauses::Frame* const one = bus_->frame(number);
    if (one == nullptr) return;
    if (one->of_bus) return frame_of_bus_node(number, *one);
    if (one->node.robot == 0) return frame_of_plan(*one);
    const bool more =
        add_of(one->node, {one->at,
                           fmt::format("the script of {} emitted {}", node_name(one->node),
                                       one->event.empty() ? "a message" : one->event),
                           place_of(one->node, one->deed.pc), words_text(one->arguments)});
    if (more) run(one->deed.run);
}

void Walk::frame_of_plan(const BusCauses::Frame& frame) {
    if (frame.by.empty() && bus_->message(frame.cause) != nullptr) return this->frame(frame.cause);
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
    const std::optional<Time> heard = bus_->heard_at(frame.cause);
    if (heard && *heard >= lines()[*start].event.at) return this->frame(frame.cause);
    line(*start);
}

// It sends when its watching begins and ends, which follows from what the plan decided last; or
// when it has heard something.
void Walk::frame_of_supervisor(const BusCauses::Frame& frame) {
    const auto its = last_line(std::min(frame.line, lines().size()), [&](size_t i) {
        return (leads_on(i) || what<plan::PlanStarted>(i) != nullptr) &&
               !places().element(lines()[i].event.plan, frame.by).empty();
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
    const BusCauses::HandlerRun* const one = bus_->run(number);
    if (one == nullptr) return;
    if (one->event >= 0) return local_event(*one);
    const BusCauses::Frame* const by = bus_->frame(one->frame);
    const std::string event = by != nullptr ? by->event : "an event of a host";
    const bool more = add_of(
        one->node, {one->at, fmt::format("{} heard {}", node_name(one->node), event),
                    place_of(one->node, one->pc), by != nullptr ? words_text(by->arguments) : ""});
    if (more) frame(one->frame);
}

void Walk::local_event(const BusCauses::HandlerRun& run) {
    const std::string event = local_name(run.node, run.event);
    const std::string node = node_name(run.node);
    const std::string place = place_of(run.node, run.pc);
    const std::string felt = is_timer(event) ? fmt::format("a timer of {} ran out: {}", node, event)
                                             : fmt::format("{} felt {}", node, event);
    const std::string about = local_help(run.node, run.event);
    if (!kDone.contains(event) || run.call == 0) {
        if (add_of(run.node, {run.at, felt, place, about})) happening(run.happening);
        return;
    }
    if (add_of(run.node, {run.at, fmt::format("{} felt {}", node, event), place, about})) {
        call(run.call);
    }
}

void Walk::call(uint32_t number) {
    const BusCauses::Call* const one = bus_->call(number);
    if (one == nullptr) return;
    const aesl::Target* const target = session()->target(one->node.id);
    const std::string native = target->natives[one->native].name;
    const bool more =
        add_of(one->node, {one->deed.at,
                           fmt::format("the script of {} called {}", node_name(one->node), native),
                           place_of(one->node, one->deed.pc), ""});
    if (more) run(one->deed.run);
}

void Walk::happening(uint32_t number) {
    const Happening* const one = all_.happenings().find(number);
    if (one == nullptr || chain_.size() >= kLinksMax) return;
    std::string place;
    if (one->kind == Happening::Kind::Timeline) place = places().timeline(one->entry);
    // The timeline is nobody's.
    const bool of_robot = one->kind != Happening::Kind::Timeline;
    chain_.push_back({.at = one->at,
                      .what = one->what,
                      .place = place,
                      .value = "",
                      .robot = of_robot ? robot_of(one->robot) : ""});
    happening(one->before);
}

// What was broken when it happened, or shortly before. Nothing tells that it follows from that.
void Walk::chaos() {
    constexpr Duration kFeltFor = std::chrono::seconds(4);  // a node is missed after three
    const auto& happenings = all_.happenings().all();
    for (size_t i = happenings.size(); i-- > 0 && !chain_.empty();) {
        const Happening& one = happenings[i];
        const Time at = chain_.front().at;
        if (one.kind != Happening::Kind::Chaos || one.at > at) continue;
        const std::string robot = robot_of(one.robot);
        const auto is_of = [&robot](const Link& link) { return link.robot == robot; };
        if (!robot.empty() && std::ranges::none_of(chain_, is_of)) continue;
        const auto end = sim::end_of(session()->world().chaos()[one.entry]);
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
        if (add({event.at, fmt::format("the plan {} began", event.plan), places().plan(event.plan),
                 ""})) {
            before_plan_began(index);
        }
    } else if (const auto* over = what<plan::PlanEnded>(index)) {
        if (add({event.at, fmt::format("the plan {} ended: {}", event.plan, name_of(over->result)),
                 places().plan(event.plan), over->message})) {
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
    if (bus_->by_hand(index)) {
        add({event.at, "a person raised it in the debugger of the plan", "", ""});
        return;
    }
    const bool told = raised.target != kIgnore && rerun_.past_bus() == nullptr;
    if (bus_->tied(index) && told) ties_.push_back({chain_.size() - 1, index_, index});
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
    const std::optional<Time> heard = bus_->heard_at(event.frame);
    if (heard && begin && *heard >= lines()[*begin].event.at) {
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
    if (bus_->stopped() && bus_->stopped()->first <= at) return happening(bus_->stopped()->second);
    if (rerun_.ended_by()) {
        add({at, "somebody ended the run", "", *rerun_.ended_by()});
    } else if (!rerun_.about().max_time.empty()) {
        add({at, "the time of the run was over", "", "--max-time " + rerun_.about().max_time});
    } else {
        add({at, "the time of the run was over, or nothing could happen any more", "", ""});
    }
}

// ---- what scripts and hosts write ----

void Walk::wrote(const sim::WitnessedNode& node, const BusCauses::Deed& deed,
                 const std::string& name) {
    const std::string value = std::to_string(deed.value);
    if (deed.host) {
        add_of(node,
               {deed.at, fmt::format("a host set {} of {}", name, node_name(node)), "", value});
        return;
    }
    add_of(node, {deed.at, fmt::format("the script of {} wrote {}", node_name(node), name),
                  place_of(node, deed.pc), value});
    if (deed.run != 0) return run(deed.run);
    add_of(node, {deed.at, fmt::format("the script of {} began", node_name(node)), "", ""});
}

}  // namespace vagus::record
