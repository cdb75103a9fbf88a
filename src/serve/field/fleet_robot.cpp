#include "serve/field/fleet_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.hpp"
#include "fleet/limits.hpp"
#include "fleet/topic.hpp"
#include "serve/process.hpp"

namespace vagus::serve {

namespace {

bool is_for_nodes(const fleet::MemberAction& action) {
    return std::holds_alternative<fleet::EmitOnBus>(action) ||
           std::holds_alternative<fleet::Obey>(action) ||
           std::holds_alternative<fleet::StopAlone>(action);
}

std::vector<fleet::Tells> words_of(const std::string& condition) {
    std::vector<fleet::Tells> words;
    const auto formula = plan::WordFormula::parse(condition);
    if (!formula.ok()) return words;
    for (const plan::WordFormula::Name& name : formula.value().names()) {
        if (name.of == plan::WordFormula::Name::Of::Word) {
            words.push_back({name.node, name.variable});
        }
    }
    return words;
}

}  // namespace

Result<std::unique_ptr<FleetRobot>> FleetRobot::join(Workbench& bench, const FleetOptions& options,
                                                     Talk talk, Time now) {
    const OpenedProject none;
    const OpenedProject& project = bench.project() ? *bench.project() : none;
    auto [instance, epoch] = member_identity();
    fleet::MemberOptions member{
        .robot = robot_name(options),
        .instance = std::move(instance),
        .epoch = epoch,
        .project = project.fleet,
        .description = fleet::description_of(project.fleet, project.name, project.plan)};
    member.description.vagus = VAGUS_VERSION;
    member.description.studio = talk.studio;
    LinkOptions link = TRY(link_options(options, member.robot + "-" + member.instance));
    if (link.target.fleet.empty()) link.target.fleet = project.fleet.name;
    member.fleet = link.target.fleet;
    if (member.fleet.empty()) {
        return Error{Code::BadInput, options.target +
                                         ": which fleet? Write mqtt://HOST/FLEET, or \"fleet\": { "
                                         "\"name\": … } in the project"};
    }
    if (!fleet::is_robot_name(member.robot)) {
        return Error{Code::BadInput,
                     fmt::format("\"{}\" cannot be the name of a robot: expected 1 to {} bytes, "
                                 "neither \"all\" nor \"group\"; choose one with --robot",
                                 member.robot, fleet::kNameBytesMax)};
    }
    link.will = fleet::Member(member, now).will();
    talk::MemberOf asks{.target = to_string(link.target),
                        .robot = member.robot,
                        .instance = member.instance,
                        .ca = options.ca,
                        .certificate = options.certificate,
                        .key = options.key,
                        .login = options.login};
    std::unique_ptr<FleetRobot> robot(
        new FleetRobot(bench, project, std::move(member), std::move(link), std::move(talk), now));
    robot->let_plans_ask(std::move(asks));
    return robot;
}

FleetRobot::FleetRobot(Workbench& bench, const OpenedProject& project, fleet::MemberOptions options,
                       LinkOptions link, Talk talk, Time now)
    : bench_(bench),
      talk_(std::move(talk)),
      project_(options.project),
      name_(project.name),
      plan_(project.plan),
      member_(options, now),
      tell_list_(options.project.tell),
      link_(std::move(link), talk_.wake),
      now_(now) {
    if (project_.healthy) condition_words_ = words_of(project_.healthy->condition);
    bench_.look_for_endless_loops(true);
    tell_variables();
}

void FleetRobot::tell_variables() {
    const auto event = [this](const std::string& name, const std::vector<int16_t>& args) {
        member_.emitted(name, args, now_);
    };
    std::vector<fleet::Tells> all = tell_list_.all();
    const std::set<fleet::Tells> told(all.begin(), all.end());
    const auto variable = [this, told](const fleet::Tells& one,
                                       const std::vector<int16_t>& values) {
        if (told.contains(one)) member_.changed(one.node, one.name, values);
        read_[one] = values;
    };
    if (reads_condition_) all.insert(all.end(), condition_words_.begin(), condition_words_.end());
    bench_.on_tells(std::move(all), {.event = event, .variable = variable});
}

void FleetRobot::read_condition(bool wanted) {
    if (wanted == reads_condition_) return;
    reads_condition_ = wanted;
    tell_variables();
}

Result<plan::Value> FleetRobot::read(const plan::WordFormula::Name& name) {
    if (name.of != plan::WordFormula::Name::Of::Word) return bench_.plan_variable(name.variable);
    const fleet::Tells word{name.node, name.variable};
    const Status there = bench_.find_variable(word.node, word.name);
    if (!there.ok()) {
        read_.erase(word);  // what it was before says nothing any more
        return there.error();
    }
    const auto found = read_.find(word);
    if (found == read_.end()) {
        return Error{Code::Unavailable, name.shown + " was not read yet"};
    }
    if (name.element < found->second.size()) {
        return plan::Value(int64_t{found->second[name.element]});
    }
    return Error{Code::NotFound, fmt::format("{}: \"{}\" has {} elements, counted from 0",
                                             name.shown, word.name, found->second.size())};
}

// A plan is another process, with a link of its own; what it tells goes over this one.
void FleetRobot::let_plans_ask(talk::MemberOf member) {
    bench_.join_fleet(std::move(member), [this](const talk::ToldFleet& told) {
        member_.changed("plan", told.name, told.values);
    });
}

FleetRobot::~FleetRobot() {
    bench_.look_for_endless_loops(false);
    bench_.on_tells({}, {});
    bench_.join_fleet({}, {});
    member_.leave();
    perform_all();
}

bool FleetRobot::is_of(const OpenedProject& project) const {
    return project.name == name_ && project.plan == plan_ && project.fleet == project_;
}

// One that is started again and again is not shown as running and stopped in turn.
fleet::Shown FleetRobot::shown() const {
    fleet::Shown shown = bench_.shown();
    if (refused_.empty()) return shown;
    shown.state = "fault";
    shown.problems.insert(shown.problems.begin(),
                          std::string(utf8_prefix(refused_, fleet::kLineBytesMax)));
    if (shown.problems.size() > fleet::kProblemsMax) shown.problems.resize(fleet::kProblemsMax);
    return shown;
}

void FleetRobot::tick(Time now) {
    now_ = now;
    for (const fleet::LinkEvent& event : link_.take()) member_.hear(event, now);
    if (tell_list_.forget_old(now)) tell_variables();
    member_.show(shown(), now);
    member_.tick(now);
    perform_all();
}

void FleetRobot::perform_all() {
    for (;;) {
        const std::vector<fleet::MemberAction> actions = member_.take();
        if (actions.empty()) return;
        for (const fleet::MemberAction& action : actions) {
            std::visit([this](const auto& one) { perform(one); }, action);
        }
        // What nodes are to do leaves now, and not when something else happens.
        if (std::any_of(actions.begin(), actions.end(), is_for_nodes)) bench_.tick(now_);
    }
}

void FleetRobot::perform(const fleet::EmitOnBus& event) {
    const Status sent =
        bench_.hear_of_fleet({.event = event.event, .from = event.from, .args = event.args});
    if (sent.ok()) return;
    talk_.log("warning", fmt::format("fleet: the event {} of {} could not be passed on: {}",
                                     event.event, event.from, sent.error().what));
}

fleet::Answer FleetRobot::tell_for_a_minute(const fleet::Command& command) {
    const Status known = bench_.find_variable(command.node, command.name);
    if (!known.ok()) {
        return {.what = std::string(utf8_prefix(known.error().what, fleet::kLineBytesMax))};
    }
    if (!tell_list_.add({command.node, command.name}, now_)) {
        return {.what = fmt::format("{} variables are told already because somebody asked for "
                                    "them; wait a minute",
                                    fleet::kTellMax)};
    }
    member_.tell_again(command.node, command.name);
    tell_variables();
    return {.done = true};
}

// The answer may come at once, or in a later turn.
void FleetRobot::perform(const fleet::Obey& obey) {
    talk_.log("note", fmt::format("fleet: {}", obey.command.verb));
    if (obey.command.verb == "tell") {
        return member_.answer(obey.command, tell_for_a_minute(obey.command));
    }
    bench_.obey(obey.command, [this, command = obey.command](fleet::Answer answer) {
        member_.answer(command, std::move(answer));
    });
}

void FleetRobot::perform(const fleet::StopAlone& stop) {
    talk_.log("warning", "fleet: " + stop.why + "; the robot stops, as its project says");
    bench_.stop_for("the fleet (" + stop.why + ")");
}

}  // namespace vagus::serve
