// vagus net TARGET VERB …: looks at the nodes of a live network and works with them. Here is the
// command line; what the verbs do is in nodes.cpp, variables.cpp, load.cpp, break.cpp, record.cpp
// and show.cpp.
#include <CLI/CLI.hpp>
#include <charconv>
#include <functional>
#include <memory>

#include "cli/net/verbs.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"

namespace vagus::cli {
namespace {

constexpr int kWordMin = -32768;
constexpr int kWordMax = 65535;  // 0x8000 … 0xffff are the negative ones

// What all verbs fill; CLI11 keeps pointers to its members.
struct Call {
    NetOptions net;
    std::vector<std::string> nodes, variables;
    std::string node, variable, event, file;
    std::vector<int> values;
    bool leave = false;              // of set: returns at once
    std::vector<std::string> place;  // of break: FILE:LINE [if CONDITION]
    BreakOptions at;
};

// Owners of a Call: the callbacks of all verbs, which CLI11 keeps.
using SharedCall = std::shared_ptr<Call>;
using Act = std::function<Verdict(NetSession&, const Call&)>;

// "0x10" and "0b101", as scripts write numbers, become decimal; everything else stays as it is.
std::string in_decimal(std::string given) {
    const size_t sign = given.starts_with('-') ? 1 : 0;
    const int base = given.compare(sign, 2, "0x") == 0   ? 16
                     : given.compare(sign, 2, "0b") == 0 ? 2
                                                         : 0;
    if (base == 0) return given;
    const char* const end = given.data() + given.size();
    uint16_t value = 0;
    const auto read = std::from_chars(given.data() + sign + 2, end, value, base);
    if (read.ec != std::errc() || read.ptr != end) return given;
    return given.substr(0, sign) + std::to_string(value);
}

void takes_words(CLI::Option& option) {
    option.transform(CLI::Validator(
        [](std::string& given) -> std::string {
            given = in_decimal(given);
            return "";
        },
        ""));
    takes_whole_number(option, kWordMin, kWordMax);
}

std::vector<int16_t> words_of(const std::vector<int>& values) {
    std::vector<int16_t> words;
    for (const int value : values) words.push_back(static_cast<int16_t>(value));
    return words;
}

// Connects, gives the project's names, lets the verb act, says what failed.
int run(const Call& call, const Act& act) {
    session::ScriptFile project;
    if (!call.net.project_file.empty()) {
        Result<session::ScriptFile> read = read_scripts(call.net.project_file);
        if (!read.ok()) return complain(read.error(), kExitUsage);
        if (read.value().plain) {
            return complain(call.net.project_file +
                                " is a script, not a project: --project takes "
                                "an .aesl file with <network>",
                            kExitUsage);
        }
        project = std::move(read.value());
    }
    Result<std::unique_ptr<NetSession>> session = NetSession::open(call.net);
    if (!session.ok()) {
        const bool mistyped = session.error().code == Code::BadInput;
        return complain(session.error(), mistyped ? kExitUsage : kExitFailed);
    }
    if (!project.path.empty()) session.value()->use_project(std::move(project));
    const Verdict verdict = act(*session.value(), call);
    session.value()->farewell();
    return verdict.ok() ? verdict.value() : complain(verdict.error());
}

CLI::App* add_verb(CLI::App& net, const char* name, const char* what, const char* footer) {
    CLI::App* verb = net.add_subcommand(name, what);
    verb->footer(footer);
    verb->fallthrough();  // --json, --project and --wait may follow the verb, too
    return verb;
}

void acts(CLI::App* verb, const SharedCall& call, int& exit_code, Act act) {
    verb->callback([call, &exit_code, act = std::move(act)] { exit_code = run(*call, act); });
}

void add_looking_verbs(CLI::App& net, const SharedCall& call, int& exit_code) {
    CLI::App* list = add_verb(
        net, "list", "who is there, one node a line",
        "Ends when nobody has answered for 0.3 s, or for as long as answers took so far (--wait:\n"
        "another time).\n"
        "\"program unknown\": the node has executed nothing since its "
        "start, so nobody can\ntell whether it has one. Exit code 1 if no node "
        "answers.\n"
        "Example:\n  vagus net tcp:127.0.0.1:33333 list --json");
    acts(list, call, exit_code, [](NetSession& s, const Call&) { return net_list(s); });

    CLI::App* describe =
        add_verb(net, "describe", "memory, variables, events and natives of a node",
                 "With --json it is a node file, for `vagus compile --node`.\n"
                 "Example:\n  vagus net tcp:127.0.0.1:33333 describe thymio-II "
                 "--json > thymio.json");
    describe->add_option("NODE", call->nodes, "number or name of a node, or all")->required();
    acts(describe, call, exit_code,
         [](NetSession& s, const Call& c) { return net_describe(s, c.nodes); });

    CLI::App* log =
        add_verb(net, "log", "prints events, faults and changes of state as they happen",
                 "Ends with Ctrl-C, or after --wait seconds.\n"
                 "Example:\n  vagus net tcp:127.0.0.1:33333 log --project explore.aesl");
    log->add_option("NODE", call->nodes, "only these nodes (0: hosts); default: all");
    acts(log, call, exit_code, [](NetSession& s, const Call& c) { return net_log(s, c.nodes); });
}

void add_variable_verbs(CLI::App& net, const SharedCall& call, int& exit_code) {
    const char* variable = "NAME, NAME[INDEX] or NAME[FIRST:LAST]";
    CLI::App* get = add_verb(net, "get", "prints variables",
                             "Without a variable: all. Variables of the script need --project.\n"
                             "Example:\n  vagus net tcp:127.0.0.1:33333 get thymio-II "
                             "prox.horizontal 'acc[0]'");
    get->add_option("NODE", call->node, "number or name of a node")->required();
    get->add_option("VARIABLE", call->variables, variable);
    acts(get, call, exit_code,
         [](NetSession& s, const Call& c) { return net_get(s, c.node, c.variables); });

    CLI::App* set = add_verb(
        net, "set", "writes a variable",
        "A variable that drives the node, as `safe_stop` of the --project or of the program says,\n"
        "is set until Ctrl-C or for --wait seconds: then the node is stopped. Exit code 1 if it\n"
        "cannot be read back at rest.\n"
        "Example:\n  vagus net tcp:127.0.0.1:33333 set thymio-II motor.left.target 100");
    set->add_option("NODE", call->node, "number or name of a node")->required();
    set->add_option("VARIABLE", call->variable, variable)->required();
    CLI::Option* value = set->add_option(
        "VALUE", call->values, "as many as the range has words, or fewer; also 0x1f and 0b101");
    value->required();
    takes_words(*value);
    set->add_flag("--leave", call->leave, "returns at once, also if the node is left driving");
    acts(set, call, exit_code, [](NetSession& s, const Call& c) {
        return net_set(s, c.node, c.variable, words_of(c.values), c.leave);
    });

    CLI::App* emit = add_verb(net, "emit", "sends an event to all nodes",
                              "Names of events need --project; a number works without.\n"
                              "Example:\n  vagus net tcp:127.0.0.1:33333 --project explore.aesl "
                              "emit speed 200 -50");
    emit->add_option("EVENT", call->event, "name or number")->required();
    takes_words(*emit->add_option("ARGUMENT", call->values, "words"));
    acts(emit, call, exit_code,
         [](NetSession& s, const Call& c) { return net_emit(s, c.event, words_of(c.values)); });

    CLI::App* watch =
        add_verb(net, "watch", "prints variables whenever they change",
                 "Looks ten times a second; ends with Ctrl-C, or after --wait "
                 "seconds.\nExample:\n  vagus net tcp:127.0.0.1:33333 watch thymio-II "
                 "prox.horizontal motor.left.speed");
    watch->add_option("NODE", call->node, "number or name of a node")->required();
    watch->add_option("VARIABLE", call->variables, variable)->required();
    acts(watch, call, exit_code,
         [](NetSession& s, const Call& c) { return net_watch(s, c.node, c.variables); });
}

struct ControlVerb {
    debug::Control::Kind kind;
    const char* name;
    const char* what;
    const char* footer;
};
constexpr ControlVerb kControlVerbs[] = {
    {debug::Control::Kind::Run, "run", "lets nodes run, or go on from a breakpoint",
     "Example:\n  vagus net tcp:127.0.0.1:33333 run all"},
    {debug::Control::Kind::Pause, "pause", "stops nodes where they are",
     "Other nodes of the robot that move are paused too, and made safe; `run all` continues.\n"
     "Example:\n  vagus net tcp:127.0.0.1:33333 pause thymio-II"},
    {debug::Control::Kind::Step, "step", "lets a paused node execute one line",
     "Without --project one instruction: lines are known from the script only.\n"
     "Example:\n  vagus net tcp:127.0.0.1:33333 step thymio-II --project explore.aesl"},
    {debug::Control::Kind::Reset, "reset",
     "restarts the programs of nodes, paused before the first line",
     "Variables keep their values. `run` continues. Other nodes of the robot that move are "
     "paused.\n"
     "Example:\n  vagus net tcp:127.0.0.1:33333 reset "
     "all"},
    {debug::Control::Kind::Stop, "stop",
     "ends what nodes are doing and brings them to rest; they ignore events until `run`",
     "Writes what `safe_stop` of the --project or of the program says, and reads back whether the "
     "nodes\nare at rest, for 5 seconds (--wait: another time). Exit code 1 if one is not, or does "
     "not answer.\nOther nodes of the robot that move are paused.\n"
     "Example:\n  vagus net tcp:127.0.0.1:33333 stop all"},
    {debug::Control::Kind::Save, "save", "makes nodes store their programs for their next start",
     "Nodes without flash ignore it and cannot say so.\nExample:\n  vagus net tcp:127.0.0.1:33333 "
     "save 1"},
};

void add_control_verbs(CLI::App& net, const SharedCall& call, int& exit_code) {
    for (const ControlVerb& entry : kControlVerbs) {
        CLI::App* verb = add_verb(net, entry.name, entry.what, entry.footer);
        verb->add_option("NODE", call->nodes, "numbers or names of nodes, or all")->required();
        acts(verb, call, exit_code, [kind = entry.kind](NetSession& s, const Call& c) {
            const bool stops = kind == debug::Control::Kind::Stop;
            return stops ? net_stop(s, c.nodes) : net_control(s, kind, c.nodes);
        });
    }
}

int load(const Call& call) {
    const Result<session::ScriptFile> scripts = read_scripts(call.file);
    if (!scripts.ok()) return complain(scripts.error(), kExitUsage);
    return run(call, [&scripts](NetSession& s, const Call& c) {
        return net_load(s, scripts.value(), c.node);
    });
}

void add_load(CLI::App& net, const SharedCall& call, int& exit_code) {
    CLI::App* verb =
        add_verb(net, "load", "compiles scripts, loads them into their nodes and runs them",
                 "A project: each node gets the script of its name. A plain script: "
                 "NODE, or the only node.\nNothing is loaded if any script has an error.\n"
                 "Example:\n  vagus net tcp:127.0.0.1:33333 load explore.aesl");
    takes_file(*verb->add_option("FILE", call->file, ".aesl project, or the text of one script")
                    ->required(),
               {".aesl"});
    verb->add_option("NODE", call->node, "only this node; number, name or all");
    verb->callback([call, &exit_code] { exit_code = load(*call); });
}

int record(const Call& call) {
    const FilesRead files;  // from here on: the project
    return run(call,
               [&files](NetSession& s, const Call& c) { return net_record(s, c.file, files); });
}

void add_record(CLI::App& net, const SharedCall& call, int& exit_code) {
    CLI::App* verb = add_verb(
        net, "record", "records all that goes over the bus, for vagus why and vagus compare",
        "Ends with Ctrl-C, or after --wait seconds. Exit code 1 if the connection is lost, or the "
        "file cannot\nbe written; what was recorded by then is in it. Nodes are asked who they "
        "are, "
        "and for their\nvariables: one node each 0.1 s, each once a second at most. With --project "
        "events and variables\nof scripts have their names.\n"
        "Example:\n  vagus net tcp:127.0.0.1:33333 record monday.mcap --project explore.aesl");
    takes_file(*verb->add_option("FILE", call->file, "the recording")->required(), {".mcap"});
    verb->callback([call, &exit_code] { exit_code = record(*call); });
}

// "FILE:LINE", then "if" and a condition in any number of words. A sentence if it is wrong, else
// nothing.
std::string read_place(const std::vector<std::string>& words, BreakOptions& at) {
    const std::string& place = words.front();
    const size_t colon = place.rfind(':');
    const char* end = place.data() + place.size();
    if (colon == std::string::npos || colon == 0 ||
        std::from_chars(place.data() + colon + 1, end, at.line).ptr != end || at.line <= 0) {
        return "\"" + place + "\": a place is FILE:LINE, for instance explore.aesl:12";
    }
    at.file = place.substr(0, colon);
    if (words.size() > 1 && words[1] != "if") {
        return "after the place comes if CONDITION, found \"" + words[1] + "\"";
    }
    for (size_t i = 2; i < words.size(); i++) at.condition += (i > 2 ? " " : "") + words[i];
    const bool empty = words.size() == 2;
    return empty ? "after if comes a condition, for instance if 'speed > 100'" : "";
}

int breakpoint(Call& call) {
    call.at.node = call.node;
    std::string wrong;
    if (call.place.empty() && !call.at.clear) wrong = "say where: FILE:LINE, or --clear";
    if (!call.place.empty()) wrong = read_place(call.place, call.at);
    if (!wrong.empty()) return complain("net break: " + wrong, kExitUsage);
    return run(call, [](NetSession& s, const Call& c) { return net_break(s, c.at); });
}

void add_break(CLI::App& net, const SharedCall& call, int& exit_code) {
    CLI::App* verb = add_verb(
        net, "break", "waits until a node is about to execute a line, and leaves it paused there",
        "FILE is the project or script that the node runs, LINE a line of that file. The condition "
        "is an\nexpression of AESL over the node's variables. Ends at the first hit, after --wait "
        "seconds (exit 1)\nor with Ctrl-C, and removes the breakpoint again. Then `step` or "
        "`run`.\nAt each hit the other nodes of the robot that move are paused, and made safe.\n"
        "Example:\n  vagus net tcp:127.0.0.1:33333 break thymio-II explore.aesl:12 if 'speed > "
        "100'");
    verb->add_option("NODE", call->node, "number or name of a node")->required();
    verb->add_option("PLACE", call->place, "FILE:LINE [if CONDITION]");
    verb->add_flag("--clear", call->at.clear, "first removes all breakpoints of the node");
    verb->add_flag("--keep", call->at.keep, "leaves it set at the end, but without its condition");
    verb->callback([call, &exit_code] { exit_code = breakpoint(*call); });
}

}  // namespace

void add_net(CLI::App& app, int& exit_code) {
    const auto call = std::make_shared<Call>();
    CLI::App* net =
        app.add_subcommand("net", "looks at the nodes of a live network and works with them");
    net->add_option("TARGET", call->net.target, "tcp:HOST:PORT, ser:DEVICE or can:INTERFACE")
        ->required();
    net->add_flag("--json", call->net.json, "results as JSON");
    takes_file(*net->add_option("--project", call->net.project_file,
                                "an .aesl project: names of events, script variables, lines"),
               {".aesl"});
    takes_seconds(*net->add_option("--wait", call->net.wait_s,
                                   "seconds to wait for nodes or for an end; see the verbs"),
                  Seconds::Instant);
    net->require_subcommand(1);
    net->footer(
        "Nodes are named by number or name. Exit codes: 0 done, 1 no such node or no answer, 2 "
        "wrong "
        "command line.\n"
        "Example:\n  vagus net tcp:127.0.0.1:33333 list\n"
        "  vagus net tcp:127.0.0.1:33333 load explore.aesl\n"
        "  vagus net tcp:127.0.0.1:33333 log --project explore.aesl");
    add_looking_verbs(*net, call, exit_code);
    add_variable_verbs(*net, call, exit_code);
    add_control_verbs(*net, call, exit_code);
    add_load(*net, call, exit_code);
    add_break(*net, call, exit_code);
    add_record(*net, call, exit_code);
}

}  // namespace vagus::cli
