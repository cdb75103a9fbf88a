// Which bus a question of why.hpp is about: of a world whose robots have projects of their own each
// has one, with a plan beside it.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "record/why_walk.hpp"

namespace vagus::record {

namespace {

constexpr size_t kRobotsNamed = 10;  // in a sentence

// "r1, r2 and 8 more".
std::string some_of(const std::vector<std::string>& names) {
    std::vector<std::string_view> some(names.begin(), names.end());
    std::string more;
    if (some.size() > kRobotsNamed) {
        more = fmt::format("{} more", some.size() - kRobotsNamed);
        some.resize(kRobotsNamed);
        some.push_back(more);
    }
    return list_of(some);
}

// "r4/takeTask" is "takeTask" of r4. A name of a robot may have a slash, too: the longest counts.
void take_robot_of_name(Question& question, const sim::World& world) {
    for (const sim::RobotDefinition& robot : world.definition().robots) {
        const bool longer = robot.name.size() > question.robot.size();
        if (longer && question.name.starts_with(robot.name + "/")) question.robot = robot.name;
    }
    if (!question.robot.empty()) question.name.erase(0, question.robot.size() + 1);
}

std::string had_by_then(const Question& question, size_t robots) {
    if (question.about == About::End) {
        return fmt::format("by then the plans of {} robots had ended", robots);
    }
    const char* const kind = question.about == About::Actor      ? "actor"
                             : question.about == About::Variable ? "variable"
                                                                 : "event";
    return fmt::format("by then {} robots had {} {} \"{}\"", robots,
                       question.about == About::Variable ? "a" : "an", kind, question.name);
}

}  // namespace

Status Walk::ask(const Question& question) {
    switch (question.about) {
        case About::Actor:
            return actor(question.name);
        case About::Variable:
            return variable(question.name);
        case About::Motor:
            return motor(question.name);
        case About::Event:
            return event(question.name);
        case About::End:
            return end();
    }
    return Status::done();
}

Status Walk::ask_one_bus(const Question& question) {
    if (question.robot.empty()) return ask(question);
    return Error{
        Code::Refused,
        fmt::format("--robot {}: this run has one bus and at most one plan, so it is asked "
                    "without --robot; of several robots a variable of a node is named as "
                    "{}/drive.token",
                    question.robot, question.robot)};
}

Status Walk::ask_fleet(Question question) {
    if (question.about == About::Motor) {
        if (!question.robot.empty() && question.robot != question.name) {
            return Error{Code::Refused,
                         fmt::format("--robot {}: motor {} names its robot already; leave --robot "
                                     "out",
                                     question.robot, question.name)};
        }
        question.robot = question.name;
    } else if (question.robot.empty()) {
        take_robot_of_name(question, session()->world());
    }
    return question.robot.empty() ? ask_all(question) : ask_robot(std::move(question));
}

Status Walk::ask_robot(Question question) {
    const sim::World& world = session()->world();
    if (!world.find_robot(question.robot)) {
        return Error{Code::NotFound,
                     sim::no_robot(world.definition(), question.robot, " in this run")};
    }
    const std::optional<size_t> bus = all_.bus_of(question.robot);
    const bool of_plan = question.about == About::Actor || question.about == About::End;
    if (of_plan && (!bus || all_.bus(*bus).bus().plan == nullptr)) {
        return Error{
            Code::NotFound,
            fmt::format("{} has no plan; ask for its wheels, an event or a variable of its "
                        "nodes",
                        question.robot)};
    }
    // On the common bus its nodes are named with it.
    if (!bus && question.about == About::Variable) {
        question.name = question.robot + "/" + question.name;
    }
    whose_ = question.about == About::Motor ? "" : question.robot;
    Status asked = Status::done();
    on_bus(bus.value_or(0), [&] { asked = ask(question); });
    return asked;
}

Status Walk::ask_all(const Question& question) {
    std::vector<size_t> found;
    Status asked = Status::done();
    for (size_t i = 0; i < all_.buses(); ++i) {
        chain_.clear();
        on_bus(i, [&] { asked = ask(question); });
        if (asked.ok()) found.push_back(i);
    }
    if (found.empty()) return asked;
    chain_.clear();
    ties_.clear();
    if (found.size() > 1) return several_have(question, found);
    on_bus(found.front(), [&] { asked = ask(question); });
    return asked;
}

std::vector<std::string> Walk::robots_on(size_t bus) const {
    if (bus > 0) return {all_.bus(bus).bus().robot};
    std::vector<std::string> names;
    for (const sim::RobotDefinition& one : session()->world().definition().robots) {
        if (one.project.empty()) names.push_back(one.name);
    }
    return names;
}

Error Walk::several_have(const Question& question, const std::vector<size_t>& buses) const {
    std::vector<std::string> robots;
    for (const size_t bus : buses) {
        for (std::string& one : robots_on(bus)) robots.push_back(std::move(one));
    }
    return {Code::Refused,
            fmt::format("{}: {}; say which one, as --robot {}",
                        had_by_then(question, robots.size()), some_of(robots), robots.front())};
}

}  // namespace vagus::record
