#include "cli/plan/debug.hpp"

#include <fmt/format.h>

#include <atomic>
#include <set>
#include <thread>

#include "base/file.hpp"
#include "base/nearest.hpp"
#include "cli/output.hpp"
#include "cli/plan/debug_lines.hpp"
#include "cli/plan/debug_text.hpp"
#include "cli/record/chain_text.hpp"
#include "net/end_signal.hpp"
#include "plan/formula_words.hpp"
#include "plan/trace.hpp"
#include "run/debugger.hpp"
#include "session/plan_world.hpp"
#include "toolbox/core_values.hpp"

namespace vagus::cli {

namespace {

using namespace std::chrono_literals;
using run::Reply;

// How often a wait looks whether Ctrl-C was pressed.
constexpr Duration kPromptLooksEvery = 100ms;

PromptWords words_of(const plan::Graph& graph, std::vector<std::string> commands) {
    std::set<std::string> words = {"actor", "state", "event", "when", "in",
                                   "if",    "count", "go",    "step", "drop"};
    const auto add = [&words](const plan::GraphSupervisor& supervisor) {
        words.insert(supervisor.name);
        for (const plan::Outcome& event : supervisor.of->outcomes) words.insert(event.name);
    };
    for (const plan::GraphPlan& plan : graph.plans) {
        words.insert(plan.name);
        for (const auto& variable : plan.variables) words.insert(variable.name);
        for (const auto& supervisor : plan.globals) add(supervisor);
        for (const auto& actor : plan.actors) {
            words.insert(actor.name);
            words.insert(actor.states.begin(), actor.states.end());
            for (const auto& supervisor : actor.supervisors) add(supervisor);
        }
    }
    for (const plan::FormulaFunction& one : plan::formula_functions()) words.emplace(one.name);
    for (const std::string_view word : plan::reserved_words()) words.emplace(word);
    return {std::move(commands), {words.begin(), words.end()}};
}

// `asked`: what it stands behind.
Result<Time> instant_of(std::string_view given, std::string_view asked, std::string_view example) {
    const Result<double> seconds = plan::float_from_text(given);
    if (seconds.ok()) return toolbox::duration_of(seconds.value());
    return Error{Code::BadInput, fmt::format("{} {}: expected seconds since the start of the run, "
                                             "as {}",
                                             asked, given, example)};
}

class Prompt {
public:
    explicit Prompt(TerminalRun& run);
    int run();

private:
    struct Command {
        std::string name;
        std::string usage;
        std::string help;
        Status (Prompt::*obey)(std::string_view rest);
    };
    static const std::vector<Command>& commands();
    static std::vector<std::string> command_names();

    Status obey(std::string_view line);
    Status add_breakpoint(std::string_view rest);
    Status remove(std::string_view rest);
    Status enable(std::string_view rest) { return enable(rest, true); }
    Status disable(std::string_view rest) { return enable(rest, false); }
    Status list(std::string_view rest);
    Status go_on(std::string_view rest);
    Status step(std::string_view rest);
    Status pause(std::string_view rest);
    Status print_value(std::string_view rest);
    Status set(std::string_view rest);
    Status raise(std::string_view rest);
    Status held(std::string_view rest);
    Status where(std::string_view rest);
    Status why(std::string_view rest);
    Status trace(std::string_view rest);
    Status help(std::string_view rest);
    Status quit(std::string_view rest);

    Status enable(std::string_view rest, bool enabled);
    Result<std::vector<int>> ids_of(std::string_view rest);
    Result<std::vector<run::Breakpoint>> breakpoints();
    Result<run::Where> look();
    Result<int> take_level(std::string_view& rest);
    Result<plan::Value> evaluate(int level, const std::string& expression);

    Result<Reply> ask(run::Request request);
    Status do_and_settle(run::Request request);
    Status wait_for_stop();
    void interrupt();
    std::string robot_text();
    void take(const run::Report& report);
    void start_run();

    TerminalRun& run_;
    run::Debugger debugger_;
    PromptLines lines_;
    std::thread runner_;
    run::Ended ended_;  // of the last run; read when its thread has been joined
    std::atomic<bool> trace_on_ = false;
    bool started_ = false;  // this run
    bool running_ = false;
    bool quit_ = false;
    bool pause_asked_ = false;  // by Ctrl-C, and not yet taken
    int runs_over_ = 0;
    int exit_code_ = kExitDone;
};

const std::vector<Prompt::Command>& Prompt::commands() {
    static const std::vector<Command> kCommands = {
        {"break",
         "break [in PLAN] actor NAME | state ACTOR [STATE] | event SUPERVISOR [EVENT] | "
         "when CONDITION  [count N] [if CONDITION]",
         "stops where the actor is about to begin, has ended, the event is raised, the condition "
         "becomes true",
         &Prompt::add_breakpoint},
        {"delete", "delete N… | all", "removes breakpoints", &Prompt::remove},
        {"enable", "enable N… | all", "lets breakpoints stop again", &Prompt::enable},
        {"disable", "disable N… | all", "keeps breakpoints but does not stop at them",
         &Prompt::disable},
        {"list", "list", "the breakpoints, with how often each was hit", &Prompt::list},
        {"run", "run [&]", "starts the run or goes on; with & the prompt does not wait",
         &Prompt::go_on},
        {"continue", "continue [&]", "the same", &Prompt::go_on},
        {"step", "step", "goes on to the next actor that is about to begin", &Prompt::step},
        {"pause", "pause [SECONDS]",
         "pauses now, or at that time of the run (so does Ctrl-C, and a second one aborts)",
         &Prompt::pause},
        {"print", "print [in LEVEL] [EXPRESSION]", "a formula; without one all variables",
         &Prompt::print_value},
        {"set", "set [in LEVEL] NAME = EXPRESSION", "sets a variable while paused", &Prompt::set},
        {"raise", "raise SUPERVISOR EVENT [OUTPUT=EXPRESSION]…",
         "raises an event by hand while paused", &Prompt::raise},
        {"held", "held [go | step | drop] [N | all]",
         "events of the bus that wait while paused; lets them go, goes on with one alone, drops "
         "them",
         &Prompt::held},
        {"where", "where", "the plans that run, their actors, who watches", &Prompt::where},
        {"why", "why QUESTION [at SECONDS] [all]",
         "why something is as it is, now or at that time of the run: actor NAME, variable "
         "NODE.NAME, variable NAME, motor ROBOT, event NAME, end",
         &Prompt::why},
        {"trace", "trace on | off", "prints the lines of the trace as they come", &Prompt::trace},
        {"help", "help [COMMAND]", "this", &Prompt::help},
        {"quit", "quit", "aborts what runs and leaves; so does the end of the input",
         &Prompt::quit},
    };
    return kCommands;
}

std::vector<std::string> Prompt::command_names() {
    std::vector<std::string> names;
    for (const Command& command : commands()) names.push_back(command.name);
    return names;
}

Prompt::Prompt(TerminalRun& run)
    : run_(run),
      debugger_(run.graph(), run::Debugger::At::Start),
      lines_(words_of(run.graph(), command_names())) {
    run_.prepared().listen([this](const plan::TraceEvent& event) {
        if (trace_on_) print(plan::format_trace(event) + "\n");
    });
}

int Prompt::run() {
    if (lines_.at_terminal()) print("`help` lists the commands; `run` starts the plan.\n");
    start_run();
    while (!quit_) {
        const std::optional<std::string> line = lines_.next("(plan) ");
        if (!line) break;
        if (lines_.take_interrupt()) interrupt();
        const Status obeyed = obey(*line);
        if (!obeyed.ok()) complain(obeyed.error());
    }
    const bool aborts = started_ || net::end_asked();
    lines_.let_interrupts_end();
    if (runner_.joinable()) {
        (void)debugger_.post(run::Abort{}).ok();  // refused only where thousands wait already
        runner_.join();
    }
    return aborts ? run_.exit_status(ended_) : exit_code_;
}

void Prompt::start_run() {
    if (runner_.joinable()) runner_.join();
    started_ = running_ = pause_asked_ = false;
    run_.set_debugger(debugger_);
    runner_ = std::thread([this] { ended_ = run_.run(); });
}

// ---- talking to the run ----

Result<Reply> Prompt::ask(run::Request request) {
    const uint64_t number = TRY(debugger_.post(std::move(request)));
    for (;;) {
        std::optional<run::Report> report = debugger_.wait_report(kPromptLooksEvery);
        if (!report) continue;
        auto* answer = std::get_if<run::Answer>(&*report);
        if (answer && answer->request == number) return std::move(answer->reply);
        // A run that has ended must begin again, or nobody answers.
        take(*report);
    }
}

void Prompt::take(const run::Report& report) {
    if (const auto* stopped = std::get_if<run::Stopped>(&report)) {
        running_ = pause_asked_ = false;
        if (stopped->why != run::Stopped::Why::Start) print(text_of(*stopped) + robot_text());
    } else if (const auto* over = std::get_if<run::RunOver>(&report)) {
        print(text_of(*over));
        if (runner_.joinable()) runner_.join();
        exit_code_ = run_.exit_status(ended_);
        ++runs_over_;
        start_run();
    }
}

Status Prompt::wait_for_stop() {
    while (running_ && !quit_) {
        const std::optional<run::Report> report = debugger_.wait_report(kPromptLooksEvery);
        if (report) take(*report);
        if (lines_.take_interrupt()) interrupt();
        if (net::end_asked()) quit_ = true;
    }
    return Status::done();
}

// Ctrl-C pauses the run; a second one before it pauses aborts it, and leaves. At a prompt in a
// terminal it only begins a new line; where no person types there is nothing to go back to.
void Prompt::interrupt() {
    if (running_ && !pause_asked_) {
        pause_asked_ = true;
        (void)debugger_.post(run::Pause{}).ok();  // refused only where thousands wait already
    } else if (running_ || !lines_.at_terminal()) {
        quit_ = true;
    }
}

// The trace of what was done by hand has been printed when the next request is answered.
Status Prompt::do_and_settle(run::Request request) {
    TRY(ask(std::move(request)));
    TRY(ask(run::AskWhere{}));
    return Status::done();
}

Result<run::Where> Prompt::look() {
    const Reply reply = TRY(ask(run::AskWhere{}));
    return std::get<run::Where>(reply);
}

Result<std::vector<run::Breakpoint>> Prompt::breakpoints() {
    const Reply reply = TRY(ask(run::ListBreakpoints{}));
    return std::get<std::vector<run::Breakpoint>>(reply);
}

// ---- commands ----

// The whole name, or a beginning that only one has.
Status Prompt::obey(std::string_view line) {
    const std::string word = take_word(line);
    if (word.empty() || word.starts_with('#')) return Status::done();
    std::vector<const Command*> meant;
    for (const Command& command : commands()) {
        if (command.name == word) return (this->*command.obey)(line);
        if (command.name.starts_with(word)) meant.push_back(&command);
    }
    if (meant.size() == 1) return (this->*meant.front()->obey)(line);
    if (!meant.empty()) {
        return Error{Code::BadInput, fmt::format("\"{}\" can be {} or {}; type more of it", word,
                                                 meant[0]->name, meant[1]->name)};
    }
    const std::string near = nearest(word, command_names());
    return Error{Code::NotFound,
                 fmt::format("there is no command \"{}\"; {}`help` lists them", word,
                             near.empty() ? "" : fmt::format("did you mean {}? ", near))};
}

Status Prompt::add_breakpoint(std::string_view rest) {
    run::Breakpoint wanted = TRY(parse_breakpoint(rest));
    const Reply reply = TRY(ask(run::AddBreakpoint{std::move(wanted)}));
    const int id = std::get<int>(reply);
    for (const run::Breakpoint& one : TRY(breakpoints())) {
        if (one.id == id) print("breakpoint " + text_of(one));
    }
    return Status::done();
}

Result<std::vector<int>> Prompt::ids_of(std::string_view rest) {
    std::vector<int> ids;
    if (rest == "all") {
        for (const run::Breakpoint& one : TRY(breakpoints())) ids.push_back(one.id);
        return ids;
    }
    for (std::string word = take_word(rest); !word.empty(); word = take_word(rest)) {
        const auto id = plan::int_from_digits(word);
        if (!id || *id < 1 || *id > INT32_MAX) {
            return Error{
                Code::BadInput,
                fmt::format("\"{}\" is not the number of a breakpoint; `list` shows them", word)};
        }
        ids.push_back(static_cast<int>(*id));
    }
    if (!ids.empty()) return ids;
    return Error{Code::BadInput, "which breakpoint? its number, or all"};
}

Status Prompt::remove(std::string_view rest) {
    for (const int id : TRY(ids_of(rest))) TRY(ask(run::RemoveBreakpoint{id}));
    return Status::done();
}

Status Prompt::enable(std::string_view rest, bool enabled) {
    for (const int id : TRY(ids_of(rest))) TRY(ask(run::EnableBreakpoint{id, enabled}));
    return Status::done();
}

Status Prompt::list(std::string_view) {
    const auto all = TRY(breakpoints());
    if (all.empty()) print("no breakpoints; `break actor NAME` sets one\n");
    for (const run::Breakpoint& one : all) print(text_of(one));
    return Status::done();
}

Status Prompt::go_on(std::string_view rest) {
    TRY(ask(run::Continue{}));
    started_ = running_ = true;
    return rest == "&" ? Status::done() : wait_for_stop();
}

Status Prompt::step(std::string_view) {
    TRY(ask(run::Step{}));
    started_ = running_ = true;
    return wait_for_stop();
}

Status Prompt::held(std::string_view rest) {
    if (rest.empty()) {
        const Reply reply = TRY(ask(run::ListHeld{}));
        print(text_of(std::get<run::HeldNow>(reply)));
        return Status::done();
    }
    run::Request request = TRY(parse_held(rest));
    const bool steps = std::holds_alternative<run::StepEvent>(request);
    TRY(ask(std::move(request)));
    if (!steps) return Status::done();
    running_ = true;
    return wait_for_stop();
}

Status Prompt::pause(std::string_view rest) {
    run::Pause wanted;
    if (!rest.empty()) wanted.at = TRY(instant_of(rest, "pause", "pause 2.5"));
    TRY(ask(wanted));
    return wanted.at ? Status::done() : wait_for_stop();
}

// `in LEVEL`; -1 without.
Result<int> Prompt::take_level(std::string_view& rest) {
    std::string_view behind = rest;
    if (take_word(behind) != "in") return -1;
    const std::string word = take_word(behind);
    const auto level = plan::int_from_digits(word);
    if (!level || *level < 0 || *level >= plan::kPlanDepthMax) {
        return Error{Code::BadInput, fmt::format("in \"{}\": expected the number of a level, as "
                                                 "`where` shows them; 0 is the outermost plan",
                                                 word)};
    }
    rest = behind;
    return static_cast<int>(*level);
}

// Without a level: of the innermost plan that can.
Result<plan::Value> Prompt::evaluate(int level, const std::string& expression) {
    const run::Where now = TRY(look());
    const int innermost = static_cast<int>(now.levels.size()) - 1;
    Result<Reply> first = ask(run::Evaluate{level < 0 ? innermost : level, expression});
    if (first.ok()) return std::get<plan::Value>(first.value());
    for (int outer = innermost - 1; level < 0 && outer >= 0; --outer) {
        const Result<Reply> reply = ask(run::Evaluate{outer, expression});
        if (reply.ok()) return std::get<plan::Value>(reply.value());
    }
    return first.error();
}

Status Prompt::print_value(std::string_view rest) {
    const int level = TRY(take_level(rest));
    if (!rest.empty()) {
        print(value_text(TRY(evaluate(level, std::string(rest)))) + "\n");
        return Status::done();
    }
    const run::Where now = TRY(look());
    for (size_t i = 0; i < now.levels.size(); ++i) {
        if (level >= 0 && static_cast<size_t>(level) != i) continue;
        print(fmt::format("{} {}\n{}", i, now.levels[i].path, variables_of(now.levels[i])));
    }
    return Status::done();
}

Status Prompt::set(std::string_view rest) {
    int level = TRY(take_level(rest));
    const size_t equals = rest.find('=');
    if (equals == std::string_view::npos) {
        return Error{Code::BadInput, "set: expected NAME = EXPRESSION, as set speed = 2 * speed"};
    }
    std::string_view left = rest.substr(0, equals);
    const std::string name = take_word(left);
    const run::Where now = TRY(look());
    const int innermost = static_cast<int>(now.levels.size()) - 1;
    for (int at = innermost; level < 0 && at >= 0; --at) {
        for (const auto& variable : now.levels[static_cast<size_t>(at)].variables) {
            if (variable.name == name) level = at;
        }
    }
    if (level < 0) level = innermost;
    const plan::Value value = TRY(evaluate(level, std::string(rest.substr(equals + 1))));
    return do_and_settle(run::SetVariable{level, name, value});
}

Status Prompt::raise(std::string_view rest) {
    run::RaiseEvent wanted{take_word(rest), take_word(rest)};
    if (wanted.event.empty()) {
        return Error{Code::BadInput, "raise: expected SUPERVISOR EVENT; `where` shows who watches"};
    }
    for (std::string word = take_word(rest); !word.empty(); word = take_word(rest)) {
        const size_t equals = word.find('=');
        if (equals == std::string::npos) {
            return Error{
                Code::BadInput,
                fmt::format("raise: \"{}\": expected OUTPUT=EXPRESSION without spaces", word)};
        }
        wanted.outputs.emplace_back(word.substr(0, equals),
                                    TRY(evaluate(-1, word.substr(equals + 1))));
    }
    return do_and_settle(std::move(wanted));
}

Status Prompt::where(std::string_view) {
    const run::Where now = TRY(look());
    print(text_of(now));
    if (now.paused) print(robot_text());
    return Status::done();
}

// Where the plan's robot is in its world; only while the run, whose thread moves it, is paused.
std::string Prompt::robot_text() {
    session::PlanWorld* const world = run_.prepared().world();
    if (!world) return "";
    const auto robots = world->session().world().robots();
    return robots.empty() ? "" : text_of(robots[world->robot().number - 1]);
}

// The same questions as `vagus why`, of what has been recorded of this run so far: that much is run
// again.
Status Prompt::why(std::string_view rest) {
    std::vector<std::string> words;
    std::optional<Time> at;
    bool all = false;
    for (std::string word = take_word(rest); !word.empty(); word = take_word(rest)) {
        if (words.empty() || (word != "at" && word != "all")) {
            words.push_back(std::move(word));
        } else if (word == "all") {
            all = true;
        } else {
            at = TRY(instant_of(take_word(rest), "why: at", "at 2.5"));
        }
    }
    const record::Question question = TRY(record::read_question(words));
    if (runs_over_ > 0 && started_) {
        return Error{Code::NotFound,
                     "why: only the first run is recorded; leave and begin again to ask about "
                     "another one"};
    }
    const std::string path = TRY(run_.recorded());
    const MappedFile file = TRY(MappedFile::open(path));
    const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), "this run"));
    print(chain_text(TRY(record::why(reader, question, at)), all ? "" : "all shows them"));
    return Status::done();
}

Status Prompt::trace(std::string_view rest) {
    if (rest != "on" && rest != "off") {
        return Error{Code::BadInput, fmt::format("trace \"{}\": expected on or off", rest)};
    }
    trace_on_ = rest == "on";
    return Status::done();
}

Status Prompt::help(std::string_view rest) {
    const std::string wanted = take_word(rest);
    bool any = false;
    for (const Command& command : commands()) {
        if (!wanted.empty() && command.name != wanted) continue;
        print(fmt::format("{}\n    {}\n", command.usage, command.help));
        any = true;
    }
    if (any) return Status::done();
    return Error{Code::NotFound, fmt::format("there is no command \"{}\"; they are {}", wanted,
                                             fmt::join(command_names(), ", "))};
}

Status Prompt::quit(std::string_view) {
    quit_ = true;
    return Status::done();
}

}  // namespace

int debug_plan(const PlanRunOptions& options) {
    net::watch_for_end();  // Ctrl-C means something else from the prompt on
    PlanRunOptions asked = options;
    asked.asked = true;
    const std::unique_ptr<TerminalRun> run = TerminalRun::prepare(asked);
    if (!run || net::end_asked()) return kExitUsage;
    run->prepared().brake_as_a_whole();
    return Prompt(*run).run();
}

}  // namespace vagus::cli
