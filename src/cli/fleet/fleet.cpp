// vagus fleet: robots of a fleet, and a broker for one. Here are the command line and the verbs
// that look and order; `init` and `serve` are in broker.cpp.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "base/json_part.hpp"
#include "base/text.hpp"
#include "cli/fleet/broker.hpp"
#include "cli/fleet/broker_options.hpp"
#include "cli/fleet/deploy.hpp"
#include "cli/fleet/keep.hpp"
#include "cli/fleet/session.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "fleet/limits.hpp"
#include "fleet/robot_names.hpp"
#include "net/end_signal.hpp"

namespace vagus::cli {
namespace {

using fleet::Kind;
using namespace std::chrono_literals;

constexpr double kTold_s = fleet::kTellFor / 1s;
constexpr Duration kForEver = Duration::max() / 4;
constexpr uint64_t kForgotten = 1;  // number of the last message that is taken back

using SharedCall = std::shared_ptr<FleetCall>;

Duration wait_of(const FleetCall& call) {
    return std::chrono::duration_cast<Duration>(
        std::chrono::duration<double>(call.wait_s.value_or(kFleetWait_s)));
}

// ---- who is there ----

std::string since_of(const fleet::State& state) {
    return fmt::format("{} s", (state.clock - state.since) / 1000);
}

// Whether something of it is known that still counts.
bool is_fresh(const fleet::Known& robot) {
    return fleet::Operator::is_online(robot) && robot.state && robot.state_at;
}

std::string line_of(const std::string& name, const fleet::Known& robot) {
    const std::string connection = robot.connection ? robot.connection->state : "unknown";
    std::string line = fmt::format("{}: {}", name, connection);
    if (!fleet::Operator::is_online(robot)) return line;
    if (!is_fresh(robot)) return line + ", stale";
    line += fmt::format(", {} for {}", robot.state->state, since_of(*robot.state));
    if (!robot.state->actor.empty()) line += ", " + robot.state->actor;
    if (robot.description) line += fmt::format(" ({})", robot.description->project);
    for (const std::string& problem : robot.state->problems) line += "; " + problem;
    return line;
}

std::string json_of(const std::string& name, const fleet::Known& robot) {
    std::vector<JsonMember> members = {json_member("robot", std::string_view(name))};
    const auto add = [&members](const char* key, const fleet::Message& message) {
        const auto json = read_json(fleet::payload_of(message));
        members.push_back(json_member(key, std::get<JsonValue>(json)));
    };
    if (robot.connection) add("connection", *robot.connection);
    if (robot.description) add("description", *robot.description);
    if (is_fresh(robot)) add("state", *robot.state);
    return format_json_line(json_object(std::move(members)));
}

std::vector<std::string> names_of(FleetSession& session, const FleetCall& call) {
    std::vector<std::string> names = session.desk().chosen(chosen_by(call));
    std::ranges::sort(names, fleet::counted_before);
    return names;
}

std::string nobody(const FleetSession& session, const FleetCall& call) {
    const std::string group =
        call.group.empty() ? "" : fmt::format("group \"{}\" of the ", call.group);
    return fmt::format("no robot of the {}fleet \"{}\" is there", group, session.fleet());
}

int list(FleetSession& session, const FleetCall& call) {
    // A robot that works tells its state within kStateEveryMax.
    const auto is_known = [&] { return session.desk().all_are_fresh(); };
    session.wait_until(is_known, fleet::kStateEveryMax + 1s);
    bool all_answer = true;
    const std::vector<std::string> names = names_of(session, call);
    if (names.empty() && !call.json) print(nobody(session, call) + "\n");
    for (const std::string& name : names) {
        const auto found = session.desk().robots().find(name);
        const fleet::Known robot =
            found == session.desk().robots().end() ? fleet::Known{} : found->second;
        all_answer = all_answer && is_fresh(robot);
        print((call.json ? json_of(name, robot) : line_of(name, robot)) + "\n");
    }
    return all_answer ? kExitDone : kExitFailed;
}

// ---- until Ctrl-C, or as long as --wait says ----

// The robots that are meant; of a group, those that are in it now.
bool is_meant(FleetSession& session, const FleetCall& call, const std::string& robot) {
    const std::vector<std::string> names = names_of(session, call);
    return std::find(names.begin(), names.end(), robot) != names.end();
}

std::string event_line(const fleet::Heard& heard, const fleet::Event& event) {
    std::string line = fmt::format("{}: {}", heard.topic.robot, heard.topic.name);
    for (const int16_t value : event.args) line += fmt::format(" {}", value);
    return line;
}

std::string heard_line(const fleet::Heard& heard, const FleetCall& call, FleetSession& session) {
    const std::string& robot = heard.topic.robot;
    if (call.json) {
        const std::string payload = fleet::payload_of(heard.message);
        return fmt::format("{{ \"topic\": {}, \"payload\": {} }}",
                           json_quote(fleet::text_of(session.fleet(), heard.topic)), payload);
    }
    if (const auto* event = std::get_if<fleet::Event>(&heard.message)) {
        return event_line(heard, *event);
    }
    if (const auto* variable = std::get_if<fleet::Variable>(&heard.message)) {
        return fmt::format("{}: {}.{} = {}", robot, heard.topic.node, heard.topic.name,
                           fmt::join(variable->values, " "));
    }
    return line_of(robot, session.desk().robots().at(robot));
}

// What a state says besides its clock: what is told again is not printed again.
std::string news_of(const fleet::Known& robot) {
    std::string news = robot.connection ? robot.connection->state : "";
    if (robot.state) {
        news += robot.state->state + robot.state->actor + joined_lines(robot.state->problems);
    }
    return news;
}

int follow(FleetSession& session, const FleetCall& call, bool events) {
    std::map<std::string, std::string> told;
    bool reads_on = true;
    session.on_event([&](const fleet::LinkEvent& event) {
        const auto* received = std::get_if<fleet::Received>(&event);
        if (received == nullptr) return;
        const fleet::Heard& heard = received->heard;
        const bool is_event = heard.topic.kind == Kind::Event;
        const bool is_variable = heard.topic.kind == Kind::Variable;
        if (heard.topic.robot.empty() || is_event != events) return;
        if (!is_event && !is_variable) {
            if (heard.topic.kind != Kind::State && heard.topic.kind != Kind::Connection) return;
            if (!session.desk().robots().contains(heard.topic.robot)) return;
            const std::string news = news_of(session.desk().robots().at(heard.topic.robot));
            if (std::exchange(told[heard.topic.robot], news) == news) return;
        }
        if (!is_meant(session, call, heard.topic.robot)) return;
        reads_on = print(heard_line(heard, call, session) + "\n") && reads_on;
    });
    session.wait_until([&] { return !reads_on; }, call.wait_s ? wait_of(call) : kForEver);
    session.on_event([](auto&) {});
    return kExitDone;
}

// ---- orders ----

// `connection`: "lost", "offline"; empty where it is online.
std::string outcome_line(const fleet::Outcome& one, const std::string& done,
                         const std::string& connection) {
    if (!one.answered && connection.empty()) return one.robot + ": did not answer";
    if (!one.answered) return fmt::format("{}: did not answer ({})", one.robot, connection);
    if (one.answer.done) return one.robot + ": " + done;
    std::string line = one.robot + ": not done";
    if (!one.answer.what.empty()) line += ": " + one.answer.what;
    if (!one.answer.silent.empty()) {
        line += fmt::format("; not known to have stopped: {}", fmt::join(one.answer.silent, ", "));
    }
    return line;
}

std::string missing_connection(FleetSession& session, const std::string& robot) {
    const auto known = session.desk().robots().find(robot);
    if (known == session.desk().robots().end()) return "no robot of that name is known";
    if (!known->second.connection) return "unknown";
    return fleet::Operator::is_online(known->second) ? "" : known->second.connection->state;
}

int order(FleetSession& session, const FleetCall& call) {
    const fleet::Command& command = call.command;
    const fleet::OrderNumber number =
        session.desk().begin({command, chosen_by(call)}, session.now());
    session.wait_until([&] { return session.desk().is_over(number); }, wait_of(call));
    std::vector<fleet::Outcome> outcomes = session.desk().outcomes(number);
    std::ranges::sort(outcomes, fleet::counted_before, &fleet::Outcome::robot);
    if (outcomes.empty()) return complain(nobody(session, call) + " that this is for");
    const std::string done = command.verb == "stop" ? "stopped" : "done";
    size_t good = 0;
    for (const fleet::Outcome& one : outcomes) {
        print(outcome_line(one, done, missing_connection(session, one.robot)) + "\n");
        good += one.answered && one.answer.done ? 1 : 0;
    }
    print(fmt::format("{} of {} robots: {}\n", good, outcomes.size(), done));
    const std::string refused = session.desk().refusal(number);
    if (!refused.empty()) {
        return complain("the broker does not pass it on: " + refused +
                        "; use the --login of an operator");
    }
    return good == outcomes.size() ? kExitDone : kExitFailed;
}

// Those that answered are followed.
int tell_variable(FleetSession& session, const FleetCall& call) {
    FleetCall asks = call;
    if (call.command.node.empty()) {
        return complain("\"" + visible(call.variable) + "\": expected NODE.NAME", kExitUsage);
    }
    asks.wait_s = kFleetWait_s;
    // The first value may be faster than the answer, and is the last one if it never changes.
    std::string early;
    session.on_event([&](const fleet::LinkEvent& event) {
        const auto* received = std::get_if<fleet::Received>(&event);
        if (received == nullptr || received->heard.topic.kind != Kind::Variable) return;
        if (!is_meant(session, call, received->heard.topic.robot)) return;
        early += heard_line(received->heard, call, session) + "\n";
    });
    const int asked = order(session, asks);
    session.on_event([](auto&) {});
    if (asked != kExitDone) return asked;
    print(early);
    asks.wait_s = std::min(call.wait_s.value_or(kTold_s), kTold_s);
    return follow(session, asks, false);
}

// What a broker keeps of a robot that is gone for good. It needs the rights of the robot itself.
int forget(FleetSession& session, const FleetCall& call) {
    // A robot's own login says nothing that comes back to it (FleetSession::know_all).
    const auto& robots = session.desk().robots();
    session.wait_until([&] { return robots.contains(call.robot); }, wait_of(call));
    const auto found = robots.find(call.robot);
    if (found == robots.end()) {
        if (!session.is_connected()) return complain(session.why_unknown(wait_of(call)));
        return complain("the broker knows no robot \"" + visible(call.robot) + "\"");
    }
    if (fleet::Operator::is_online(found->second)) {
        return complain(call.robot + " is online; stop its `vagus serve` first");
    }
    std::optional<std::string> answered;
    session.on_event([&](const fleet::LinkEvent& event) {
        const auto* told = std::get_if<fleet::Acknowledged>(&event);
        if (told != nullptr && told->number == kForgotten) answered = told->refused;
    });
    for (const Kind kind : {Kind::Description, Kind::State, Kind::Version, Kind::Connection}) {
        const bool last = kind == Kind::Connection;
        session.publish(
            {.topic = fleet::text_of(session.fleet(), {.kind = kind, .robot = call.robot}),
             .payload = "",
             .qos = 1,
             .retained = true,
             .number = last ? kForgotten : uint64_t{0}});
    }
    session.wait_until([&] { return answered.has_value(); }, wait_of(call));
    if (answered && answered->empty()) return kExitDone;
    return complain(answered ? "the broker refuses: " + *answered + "; use the robot's own --login"
                             : "the broker did not answer");
}

// ---- the command line ----

using Act = std::function<int(FleetSession&, const FleetCall&)>;

int run(const FleetCall& call, fleet::Operator::Options wants, const Act& act) {
    auto session = FleetSession::open(call, std::move(wants));
    if (!session.ok()) return complain_of(session.error());
    const bool waits_itself = call.command.verb == "forget";
    const Status known = waits_itself ? Status::done() : session.value()->know_all(wait_of(call));
    if (!known.ok()) return complain_of(known.error());
    return act(*session.value(), call);
}

CLI::App* add_verb(CLI::App& app, const SharedCall& call, const char* name, const char* what,
                   const char* footer) {
    CLI::App* verb = app.add_subcommand(name, what);
    verb->fallthrough();
    verb->footer(footer);
    verb->preparse_callback([call, name](size_t) { call->command.verb = name; });
    return verb;
}

void is_for(CLI::App* verb, const SharedCall& call) {
    const auto all = [call](const std::string& robot) {
        // No robot that `fleet init` knows has such a name.
        if (robot.find("..") != std::string::npos && fleet::names_in(robot).front() == robot) {
            throw CLI::ValidationError("ROBOT", fleet::no_range(robot));
        }
        if (robot != "all") call->robot = robot;
    };
    verb->add_option_function<std::string>("ROBOT", all, "its name, t1..t30, or all");
    verb->add_option("--group", call->group, "those of this group")->type_name("GROUP");
}

void need_target(const FleetCall& call) {
    if (!call.broker.target.empty()) return;
    throw CLI::ValidationError(
        "TARGET", "which fleet? Write vagus fleet mqtt://HOST[:PORT]/FLEET " + call.command.verb);
}

void acts(CLI::App* verb, const SharedCall& call, int& exit_code, Act act,
          fleet::Operator::Options wants = {}) {
    verb->callback([call, &exit_code, act = std::move(act), wants = std::move(wants)] {
        need_target(*call);
        if (!call->robot.empty() && !call->group.empty()) {
            throw CLI::ValidationError("ROBOT",
                                       "found a name and a --group; expected one of the two");
        }
        exit_code = run(*call, wants, act);
    });
}

// Whom it is for is always said: for verbs that take nothing behind it.
void need_choice(const CLI::App& verb) {
    const bool is_said =
        verb.get_option("ROBOT")->count() + verb.get_option("--group")->count() > 0;
    if (is_said) return;
    throw CLI::ValidationError("ROBOT", "which robots? Write a name, all, or --group GROUP");
}

void order_acts(CLI::App* verb, const SharedCall& call, int& exit_code) {
    verb->get_option("ROBOT")->required();
    acts(verb, call, exit_code, order);
}

void add_looking_verbs(CLI::App& app, const SharedCall& call, int& exit_code) {
    CLI::App* verb = add_verb(app, call, "list", "who is in the fleet, and what each robot does",
                              "Exit code 1 if a robot that did not say good-bye is not there.\n"
                              "Example:\n  vagus fleet mqtt://broker/lab list");
    is_for(verb, call);
    acts(verb, call, exit_code, list);
    verb = add_verb(app, call, "watch", "prints what robots do, whenever it changes",
                    "Ends with Ctrl-C, or after --wait seconds.\n"
                    "Example:\n  vagus fleet mqtt://broker/lab watch");
    is_for(verb, call);
    acts(verb, call, exit_code,
         [](FleetSession& session, const FleetCall& c) { return follow(session, c, false); },
         {.variables = true});
    verb = add_verb(app, call, "log", "prints the events that robots send",
                    "Ends with Ctrl-C, or after --wait seconds.\n"
                    "Example:\n  vagus fleet mqtt://broker/lab log r1 --json");
    is_for(verb, call);
    acts(verb, call, exit_code,
         [](FleetSession& session, const FleetCall& c) { return follow(session, c, true); },
         {.events = true});
    verb = add_verb(app, call, "forget", "what the broker keeps of a robot that is gone for good",
                    "Only the robot itself may do that: use its --login.\n"
                    "Example:\n  vagus fleet mqtt://broker/lab forget r1 --login r1.login");
    verb->add_option("ROBOT", call->robot, "its name")->required();
    acts(verb, call, exit_code, forget);
}

// It needs no operator beside it: the keeper is a machine of its own.
void add_keep(CLI::App& app, const SharedCall& call, int& exit_code) {
    CLI::App* verb =
        add_verb(app, call, "keep", "keeps tasks and shared values of the fleet, until Ctrl-C",
                 "Only the user keeper may do that. While another keeper is there, this one stays "
                 "out; it\ntakes its place when that one is gone.\n"
                 "Example:\n  vagus fleet mqtts://broker/lab keep --login keeper.login");
    verb->callback([call, &exit_code] {
        need_target(*call);
        exit_code = keep(call->broker);
    });
}

void add_deploy(CLI::App& app, const SharedCall& call, int& exit_code) {
    CLI::App* verb =
        add_verb(app, call, "deploy", "another version of their project for robots, in steps",
                 "Robots fetch it from this program, check it, stop, and start it, as with `vagus "
                 "deploy`. A robot is\nwell that has started, has no fault for 3 s, and meets the "
                 "\"healthy\" of its project's fleet. The first\nthat is not ends the roll-out: "
                 "those that have the version keep it until --rollback\ntakes it back. --wait: for "
                 "each robot, 60 s unless told.\n"
                 "Example:\n"
                 "  vagus fleet mqtts://broker/lab deploy all --project picker --listen "
                 "0.0.0.0:8443 \\\n"
                 "    --host broker --serve-cert broker/broker.crt --serve-key broker/broker.key\n"
                 "  vagus fleet mqtts://broker/lab deploy all --rollback");
    is_for(verb, call);
    CLI::Option* project =
        verb->add_option("--project", call->project, "a folder with a vagus.json");
    takes_file(*project, {"vagus.json"});
    CLI::Option* back = verb->add_flag("--rollback", call->rollback,
                                       "instead: the version before is in force again");
    back->excludes(project);
    verb->add_option("--steps", call->steps,
                     "how many robots have it after each step (default: 1,10%,100%)")
        ->type_name("STEPS");
    add_shelf_options(*verb, call->shelf,
                      {.listen = "where robots fetch it (default: 127.0.0.1, a free port)",
                       .host = "name of this computer for robots",
                       .host_option = "--host"});
    verb->parse_complete_callback([call, verb] {
        need_choice(*verb);
        if (call->project.empty() && !call->rollback) {
            throw CLI::ValidationError("--project",
                                       "which version? Name its folder, or --rollback");
        }
    });
    acts(verb, call, exit_code, deploy, {.versions = true});
}

struct PlainVerb {
    const char* name;
    const char* what;
    const char* footer;
};
constexpr PlainVerb kPlainVerbs[] = {
    {"stop", "stops robots; asks again until each has answered that all its nodes are at rest",
     "Exit code 1 if one did not answer within --wait seconds (10), or a node of it is not known "
     "to stand.\nExample:\n  vagus fleet mqtt://broker/lab stop all"},
    {"pause", "pauses robots", "Example:\n  vagus fleet mqtt://broker/lab pause r1"},
    {"continue", "lets robots go on that are paused",
     "Example:\n  vagus fleet mqtt://broker/lab continue r1"},
    {"start", "starts scripts and plans", "Example:\n  vagus fleet mqtt://broker/lab start all"},
    {"identify",
     "the event identify on the bus of robots: what their projects do then shows which "
     "ones they are",
     "Example:\n  vagus fleet mqtt://broker/lab identify r1"},
};

int16_t word_of(int value) {
    return static_cast<int16_t>(value);
}

void take_values(FleetCall& call) {
    call.command.values.clear();
    for (const int value : call.values) call.command.values.push_back(word_of(value));
}

// "NODE.NAME" of a node's variable, "NAME" of the plan's.
void take_variable(FleetCall& call) {
    const size_t dot = call.variable.find('.');
    const bool of_node = dot != std::string::npos;
    call.command.node = of_node ? call.variable.substr(0, dot) : "";
    call.command.name = of_node ? call.variable.substr(dot + 1) : call.variable;
}

void add_ordering_verbs(CLI::App& app, const SharedCall& call, int& exit_code) {
    for (const PlainVerb& one : kPlainVerbs) {
        CLI::App* verb = add_verb(app, call, one.name, one.what, one.footer);
        is_for(verb, call);
        verb->parse_complete_callback([verb] { need_choice(*verb); });
        acts(verb, call, exit_code, order);
    }
    CLI::App* set =
        add_verb(app, call, "set", "writes a variable of a node, or of the plan",
                 "Example:\n  vagus fleet mqtt://broker/lab set r1 thymio-II.speed 100");
    is_for(set, call);
    set->add_option("VARIABLE", call->variable, "NODE.NAME, or NAME of a variable of the plan")
        ->required();
    CLI::Option* value = set->add_option("VALUE", call->values, "as many as it has words");
    value->required();
    takes_whole_number(*value, INT16_MIN, INT16_MAX);
    order_acts(set, call, exit_code);

    CLI::App* raise = add_verb(app, call, "raise", "raises an event of a supervisor of the plan",
                               "Example:\n  vagus fleet mqtt://broker/lab raise r1 guard Danger");
    is_for(raise, call);
    raise->add_option("SUPERVISOR", call->command.supervisor, "one that watches")->required();
    raise->add_option("EVENT", call->command.event, "one of its events")->required();
    order_acts(raise, call, exit_code);

    CLI::App* emit = add_verb(app, call, "emit", "an event on the bus of robots",
                              "Example:\n  vagus fleet mqtt://broker/lab emit all alarm 1");
    is_for(emit, call);
    emit->add_option("EVENT", call->command.event, "of their projects")->required();
    takes_whole_number(*emit->add_option("ARGUMENT", call->values, "words"), INT16_MIN, INT16_MAX);
    order_acts(emit, call, exit_code);
    CLI::App* tell = add_verb(app, call, "tell", "asks robots to tell a variable, and prints it",
                              "For a minute; ends then, with Ctrl-C, or after --wait seconds.\n"
                              "Example:\n  vagus fleet mqtt://broker/lab tell r1 thymio-II.speed");
    is_for(tell, call);
    tell->add_option("VARIABLE", call->variable, "NODE.NAME")->required();
    tell->get_option("ROBOT")->required();
    acts(tell, call, exit_code, tell_variable, {.variables = true});

    for (CLI::App* verb : {set, raise, emit, tell}) {
        verb->parse_complete_callback([call] {
            take_values(*call);
            if (!call->variable.empty()) take_variable(*call);
        });
    }
}

}  // namespace

void add_fleet(CLI::App& app, int& exit_code) {
    const auto call = std::make_shared<FleetCall>();  // owners: CLI11 and the callbacks
    CLI::App* verb = app.add_subcommand("fleet", "many robots, and a broker that joins them");
    verb->add_option("TARGET", call->broker.target, "mqtt[s]://HOST[:PORT]/FLEET");
    verb->add_flag("--json", call->json, "results as JSON");
    takes_seconds(
        *verb->add_option("--wait", call->wait_s, "seconds to wait for answers, or for an end"),
        Seconds::Instant);
    add_broker_options(*verb, call->broker);
    verb->require_subcommand(1);
    verb->footer(
        "Exit codes: 0 done, 1 somebody did not answer or it was not done, 2 wrong command line.\n"
        "Example:\n"
        "  vagus fleet init broker && vagus fleet serve broker\n"
        "  vagus fleet mqtts://localhost:8883/lab stop all --tls-ca broker/ca.crt --login "
        "broker/operator.login");
    add_broker_verbs(*verb, exit_code);
    add_keep(*verb, call, exit_code);
    add_looking_verbs(*verb, call, exit_code);
    add_ordering_verbs(*verb, call, exit_code);
    add_deploy(*verb, call, exit_code);
}

}  // namespace vagus::cli
