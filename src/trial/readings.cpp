#include "trial/readings.hpp"

#include <fmt/format.h>

#include <numbers>

#include "base/nearest.hpp"

namespace vagus::trial {

namespace {

constexpr double kPercent = 100;
constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

// -180 < degrees <= 180.
double degrees_of(double radians) {
    const double degrees = std::remainder(radians * kDegreesPerRadian, 360);
    return degrees == -180 ? 180 : degrees;
}

}  // namespace

ReadWorld read_world_of(session::PlanWorld* world) {
    if (world == nullptr) return {};
    return {&world->session(), world->robot()};
}

void hear_events(session::SimSession& session,
                 const std::function<void(Time, const std::string& name)>& told) {
    session.on_heard([told, &session](const debug::Event& event) {
        const auto* const sent = std::get_if<debug::UserEvent>(&event.what);
        if (sent != nullptr) told(session.now(), sent->name);
    });
}

void Readings::line(const plan::TraceEvent& event) {
    now_ = event.at;
    variables_.see(event);
    started_ = started_ || std::holds_alternative<plan::ActorStarted>(event.what);
    over_ = run::level_of(event) == 0 && std::holds_alternative<plan::PlanEnded>(event.what);
    const auto level = static_cast<size_t>(run::level_of(event));
    const auto* const raised = std::get_if<plan::EventRaised>(&event.what);
    event_ = raised != nullptr ? std::string(raised->event) : "";
    if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        actors_.resize(level + 1);
        actors_[level] = started->actor;
    } else if (std::holds_alternative<plan::ActorEnded>(event.what) ||
               std::holds_alternative<plan::ActorInterrupted>(event.what) ||
               std::holds_alternative<plan::PlanEnded>(event.what)) {
        actors_.resize(level);
    }
}

void Readings::event(Time at, std::string_view name) {
    now_ = at;
    event_ = name;
}

void Readings::instant() {
    now_ = session().now();
    event_.clear();
    const bool touched = session().world().touches(world_.robot);
    contact_ = touched ? contact_ + sim::kNodeStep : Duration{};
}

Result<std::vector<plan::Value>> Readings::values(const Condition& condition) const {
    std::vector<plan::Value> values;
    for (const Condition::Name& name : condition.names()) values.push_back(TRY(value(name)));
    return values;
}

plan::Value Readings::of_robot(SignalId id) const {
    const auto robots = session().world().robots();
    for (const sim::RobotView& robot : robots) {
        if (robot.id != world_.robot) continue;
        if (id == SignalId::X) return plan::Value(robot.pose.at.x);
        if (id == SignalId::Y) return plan::Value(robot.pose.at.y);
        return plan::Value(degrees_of(robot.pose.angle));
    }
    return plan::Value(0.0);
}

double Readings::bus_percent() const {
    const auto load = session().world().bus_load(world_.robot);
    return load ? load->all.share_of_last_second * kPercent : 0;
}

plan::Value Readings::signal(SignalId id) const {
    switch (id) {
        case SignalId::Actor:
            return plan::Value(actors_.empty() ? std::string() : actors_.back());
        case SignalId::Event:
            return plan::Value(event_);
        case SignalId::Time:
            return plan::Value(seconds_of(now_));
        case SignalId::Contact:
            return plan::Value(seconds_of(contact_));
        case SignalId::Bus:
            return plan::Value(bus_percent());
        case SignalId::X:
        case SignalId::Y:
        case SignalId::Angle:
            break;
    }
    return of_robot(id);
}

// ---- words of nodes ----

namespace {

const session::NodeState* find_node(const std::vector<session::NodeState>& nodes,
                                    sim::RobotId robot, std::string_view name) {
    for (const session::NodeState& node : nodes) {
        if (node.robot == robot && node.name == name) return &node;
    }
    return nullptr;
}

Error no_such_node(const Condition::Name& name, sim::RobotId robot, std::string_view node,
                   const std::vector<session::NodeState>& nodes) {
    std::vector<std::string> names;
    for (const session::NodeState& one : nodes) {
        if (one.robot == robot) names.push_back(one.name);
    }
    return Error{Code::NotFound, fmt::format("{}: the robot has no node \"{}\"; {}", name.shown,
                                             node, known_instead(std::string(node), names))};
}

}  // namespace

// Of the robot that signals are about; for a robot's name before it, "thymio/thymio-II", of that
// one.
Result<int16_t> Readings::word(const Condition::Name& name) const {
    sim::RobotId robot = world_.robot;
    std::string_view its_name = name.node;
    const size_t slash = its_name.find('/');
    if (slash != std::string_view::npos) {
        const auto found = session().world().find_robot(its_name.substr(0, slash));
        if (!found) return no_such_node(name, robot, its_name, session().nodes());
        robot = *found;
        its_name.remove_prefix(slash + 1);
    }
    const session::SimSession& on = world_.buses != nullptr ? world_.buses->of(robot) : session();
    const std::vector<session::NodeState> nodes = on.nodes();
    const session::NodeState* const node = find_node(nodes, robot, its_name);
    if (node == nullptr) return no_such_node(name, robot, its_name, nodes);
    return word_of(name, on, *node);
}

Result<int16_t> Readings::word_of(const Condition::Name& name, const session::SimSession& on,
                                  const session::NodeState& node) {
    std::vector<std::string> known;
    const std::span<const int16_t> memory = on.world().variables(node.robot, node.id);
    const auto take = [&](const std::string& its, size_t address,
                          size_t size) -> std::optional<Result<int16_t>> {
        known.push_back(its);
        if (its != name.variable) return std::nullopt;
        if (name.element < size && address + name.element < memory.size()) {
            return Result<int16_t>(memory[address + name.element]);
        }
        return Result<int16_t>(Error{
            Code::NotFound,
            fmt::format("{}: \"{}\" has {} elements, counted from 0", name.shown, its, size)});
    };
    if (const aesl::Program* program = on.program(node.id)) {
        for (const aesl::VariablePlace& place : program->variables) {
            if (auto found = take(place.name, place.address, place.size)) return *found;
        }
    } else if (const aesl::Target* target = on.target(node.id)) {
        size_t address = 0;
        for (const aesl::NamedVariable& variable : target->variables) {
            if (auto found = take(variable.name, address, variable.size)) return *found;
            address += variable.size;
        }
    }
    return Error{Code::NotFound,
                 fmt::format("{}: the node \"{}\" has no variable \"{}\"; {}", name.shown,
                             name.node, name.variable, known_instead(name.variable, known))};
}

Status Readings::check(const Condition::Name& name) const {
    if (name.of != Condition::Name::Of::Word) return Status::done();
    (void)TRY(word(name));
    return Status::done();
}

Result<plan::Value> Readings::value(const Condition::Name& name) const {
    if (name.signal != nullptr) return signal(name.signal->id);
    if (name.of == Condition::Name::Of::Word) return plan::Value(int64_t{TRY(word(name))});
    return variables_.value(0, name.slot);
}

}  // namespace vagus::trial
