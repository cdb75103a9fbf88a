// What a question of why.hpp is about: the newest link of its chain.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "embed/loaded_plan.hpp"
#include "record/why_walk.hpp"

namespace vagus::record {

namespace {

// Who has written what the plan begins with, or a new version of it; what a person set while the
// plan ran, or before it began, and in a plan inside another the actor that it is.
constexpr std::string_view kInitial = "initial";
constexpr std::string_view kChange = "change";
constexpr std::string_view kOutside = "outside";

// Variables by which scripts command wheels; robots of other kinds do it by natives.
constexpr std::string_view kMotors[] = {"motor.left.target", "motor.right.target", "speed.left",
                                        "speed.right"};
constexpr std::string_view kDriving = "drive.";

const std::vector<aesl::VariablePlace> kNoVariables;

// Whether a node has that variable by itself, as sensors are.
bool is_of_node(const session::SimSession& session, uint16_t id, std::string_view name) {
    const aesl::Target* const target = session.target(id);
    return target != nullptr && std::any_of(target->variables.begin(), target->variables.end(),
                                            [name](const auto& one) { return one.name == name; });
}

}  // namespace

// Of several buses that were asked, what any of them has is known.
Error Walk::nothing_of(std::string_view kind, const std::string& name) {
    std::sort(known_.begin(), known_.end());
    known_.erase(std::unique(known_.begin(), known_.end()), known_.end());
    const std::string near = nearest(name, known_);
    const char* const there = known_.size() == 1 ? "; there is " : "; there are: ";
    const std::string hint =
        !near.empty() ? "; did you mean " + near + "?"
        : known_.empty()
            ? ""
            : there + list_of(std::vector<std::string_view>(known_.begin(), known_.end()));
    const std::string whose = whose_.empty() ? "" : " of " + whose_;
    return {Code::NotFound,
            fmt::format("by then there was no {} \"{}\"{}{}", kind, name, whose, hint)};
}

Status Walk::actor(const std::string& name) {
    // A plan that is paused before an actor has told already what leads to it.
    bool begun = false;
    for (size_t i = lines().size(); i-- > 0;) {
        const auto* const started = what<plan::ActorStarted>(i);
        const auto* const ended = what<plan::ActorEnded>(i);
        const auto* const broken = what<plan::ActorInterrupted>(i);
        const auto* const raised = what<plan::EventRaised>(i);
        if (started != nullptr) known_.emplace_back(started->actor);
        begun = begun || started != nullptr;
        const bool leads_there = (ended != nullptr && ended->target == name) ||
                                 (raised != nullptr && raised->target == name);
        if ((!begun && leads_there) || (started != nullptr && started->actor == name) ||
            (ended != nullptr && ended->actor == name) ||
            (broken != nullptr && broken->actor == name)) {
            line(i);
            return Status::done();
        }
    }
    if (known_.empty()) {
        return Error{
            Code::NotFound,
            fmt::format("actor {}: no actor had begun by then; let the plan run on, or ask "
                        "about a later instant",
                        name)};
    }
    return nothing_of("actor", name);
}

// "drive.token", and in a world of several robots "r1/drive.token".
std::optional<session::NodeState> Walk::node_of(const std::string& variable) const {
    if (session() == nullptr) return std::nullopt;
    const auto& robots = session()->world().definition().robots;
    for (const session::NodeState& one : session()->nodes()) {
        if (one.name.empty()) continue;
        const std::string& robot = robots[one.robot.number - 1].name;
        if (variable.starts_with(one.name + ".") ||
            variable.starts_with(robot + "/" + one.name + ".")) {
            return one;
        }
    }
    return std::nullopt;
}

Status Walk::variable(const std::string& name) {
    if (const auto node = node_of(name)) return variable_of_node(*node, name);
    for (size_t i = lines().size(); i-- > 0;) {
        const auto* const written = what<plan::VariableWritten>(i);
        if (written == nullptr) continue;
        known_.emplace_back(written->variable);
        if (written->variable != name) continue;
        variable_written(i, *written);
        return Status::done();
    }
    return nothing_of("variable", name);
}

void Walk::variable_written(size_t index, const plan::VariableWritten& written) {
    const plan::TraceEvent& event = lines()[index].event;
    const std::string value = value_text(written.value);
    const std::string name(written.variable);
    if (written.by == kInitial || written.by == kChange) {
        const char* const from = written.by == kInitial ? "the plan" : "a new version of the plan";
        add({event.at, fmt::format("{} gave the variable {} its initial value", from, name),
             places().variable(event.plan, name), value});
        return;
    }
    const size_t slash = event.plan.rfind('/');
    const bool is_inner = slash != std::string::npos;
    if (written.by == kOutside && !is_inner) {
        add({event.at, fmt::format("a person gave the variable {} its value", name), "", value});
        return;
    }
    if (written.by == kOutside) {
        add({event.at,
             fmt::format("the actor {} gave the variable {} its value",
                         event.plan.substr(slash + 1), name),
             places().variable(event.plan, name), value});
        return before_plan_began(index);
    }
    add_element(event.at, fmt::format("{} wrote the variable {}", written.by, name), event.plan,
                written.by, value);
    const auto by = last_line(index, [&](size_t i) {
        const auto* const ended = what<plan::ActorEnded>(i);
        const auto* const raised = what<plan::EventRaised>(i);
        return same_plan(i, index) && ((ended != nullptr && ended->actor == written.by) ||
                                       (raised != nullptr && raised->supervisor == written.by));
    });
    if (by && lines()[*by].event.at == event.at) line(*by);
}

// "watch.left[2]" as "watch.left" and 2.
std::pair<std::string, std::optional<size_t>> element_of(const std::string& name) {
    const size_t bracket = name.find('[');
    if (bracket == std::string::npos || !name.ends_with(']')) return {name, std::nullopt};
    size_t index = 0;
    const char* const end = name.data() + name.size() - 1;
    const auto read = std::from_chars(name.data() + bracket + 1, end, index);
    if (read.ec != std::errc() || read.ptr != end) return {name, std::nullopt};
    return {name.substr(0, bracket), index};
}

Status Walk::variable_of_node(const session::NodeState& node, const std::string& asked) {
    const size_t begin = asked.find(node.name + ".", asked.find('/') + 1) + node.name.size() + 1;
    const std::string full = asked.substr(begin);
    const auto [name, element] = element_of(full);
    const aesl::Program* const program = session()->program(node.id);
    const sim::WitnessedNode witnessed{node.robot.number, node.id};
    for (const aesl::VariablePlace& place :
         program != nullptr ? program->variables : kNoVariables) {
        known_.push_back(place.name);
        if (place.name != name) continue;
        if (element && *element >= place.size) {
            return Error{Code::NotFound,
                         fmt::format("{} of {} has {} elements, from 0 on; found {}", name,
                                     node.name, place.size, full)};
        }
        const auto address = static_cast<uint16_t>(place.address + element.value_or(0));
        const auto deed = bus_->last_write(witnessed, address, element ? 1 : place.size);
        if (deed) {
            wrote(witnessed, *deed, full);
        } else if (is_of_node(*session(), node.id, name)) {
            add_of(witnessed,
                   {Time{},
                    fmt::format("{} itself sets {}; no script has written it", node.name, full), "",
                    ""});
        } else {
            add_of(witnessed,
                   {Time{}, fmt::format("no script has written {} of {} yet", full, node.name), "",
                    ""});
        }
        return Status::done();
    }
    return nothing_of("variable of " + node.name, name);
}

Status Walk::motor(const std::string& name) {
    const session::SimSession* const session = this->session();
    if (session == nullptr) return nothing_of("robot", name);
    for (const sim::RobotView& robot : session->world().robots()) {
        known_.emplace_back(robot.name);
        if (robot.name != name) continue;
        std::optional<BusCauses::Deed> last;
        std::string variable;
        sim::WitnessedNode witnessed{robot.id.number, robot.node};
        if (const aesl::Program* const program = session->program(robot.node)) {
            for (const aesl::VariablePlace& place : program->variables) {
                if (std::find(std::begin(kMotors), std::end(kMotors), place.name) ==
                    std::end(kMotors)) {
                    continue;
                }
                const auto deed = bus_->last_write(witnessed, place.address, place.size);
                if (!deed || (last && deed->at < last->at)) continue;
                last = deed;
                variable = place.name;
            }
        }
        const uint32_t called = bus_->last_call(robot.id.number, kDriving);
        if (last && (called == 0 || bus_->call(called)->deed.at < last->at)) {
            wrote(witnessed, *last, variable);
        } else if (called != 0) {
            call(called);
        } else {
            add_of(
                witnessed,
                {Time{}, fmt::format("no script has told the wheels of {} to turn", name), "", ""});
        }
        return Status::done();
    }
    return nothing_of("robot", name);
}

// One of the bus, or one that a supervisor of the plan raised; of both names the newer.
Status Walk::event(const std::string& name) {
    const uint32_t number = bus_->last_event(name);
    const auto raised = last_line(lines().size(), [&](size_t i) {
        const auto* const one = what<plan::EventRaised>(i);
        if (one != nullptr) known_.emplace_back(one->event);
        return one != nullptr && one->event == name;
    });
    if (number != 0 && (!raised || bus_->heard_at(number) > lines()[*raised].event.at)) {
        frame(number);
        return Status::done();
    }
    if (raised) {
        line(*raised);
        return Status::done();
    }
    for (std::string& one : bus_->events_seen()) known_.push_back(std::move(one));
    if (session() != nullptr) {
        for (const aesl::GlobalEvent& one : session()->common().events) {
            known_.push_back(one.name);
        }
    }
    return nothing_of("event", name);
}

Status Walk::end() {
    const auto over = last_line(lines().size(), [&](size_t i) {
        return what<plan::PlanEnded>(i) != nullptr &&
               lines()[i].event.plan.find('/') == std::string::npos;
    });
    if (!over) return Error{Code::NotFound, "by then no plan had ended"};
    line(*over);
    return Status::done();
}

}  // namespace vagus::record
