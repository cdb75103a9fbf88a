// `vagus exec`: compiles a script and runs it on one machine, without a network.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "aesl/compile.hpp"
#include "aesl/node_file.hpp"
#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "session/diagnostic_text.hpp"
#include "session/execute.hpp"
#include "session/script_file.hpp"

namespace vagus::cli {

namespace {

struct ExecOptions {
    std::string script;
    std::string node;
    std::string stimuli;
    uint32_t steps_per_event = session::kStepsPerEvent;
    aesl::Options compiler;
};

struct Input {
    aesl::NodeFile node;
    aesl::Script script;
    std::vector<aesl::Stimulus> stimuli;
};

// The script of a project that is for this node; the only one of a plain file.
Result<aesl::Script> choose_script(const session::ScriptFile& file, const aesl::Target& target) {
    if (file.plain) return file.project.scripts.at(0);
    const aesl::NodeName node{target.name};
    const int index = aesl::scripts_for(file.project, {&node, 1}).front();
    if (index >= 0) return file.project.scripts[static_cast<size_t>(index)];
    return Error{Code::NotFound, file.path + ": the project has no script for node " + target.name +
                                     ": add one, or give the node file of a node that it has"};
}

Result<Input> read_input(const ExecOptions& options) {
    Input input;
    const std::string node = TRY(read_file(options.node));
    input.node = TRY(aesl::parse_node_file(node, options.node));
    const std::string text = TRY(read_file(options.script));
    const session::ScriptFile file = TRY(session::read_script_file(text, options.script));
    input.script = TRY(choose_script(file, input.node.target));
    // The golden cases hold `exec` to the letter of the language: a byte-order mark is an error.
    if (file.plain) input.script.source = text;
    if (!file.plain) input.node.common = file.project.common;
    if (!options.stimuli.empty()) {
        const std::string stimuli = TRY(read_file(options.stimuli));
        input.stimuli = TRY(aesl::parse_stimuli(stimuli, options.stimuli));
    }
    return input;
}

void show_diagnostics(const ExecOptions& options, const aesl::Script& script,
                      const aesl::Compilation& done) {
    const session::SourceText text{options.script, script.source, script.first_line};
    for (const Diagnostic& one : session::diagnostics_of(text, done)) say(text_of(one) + "\n");
}

// Lines of a script are those of its file: in a project it begins further down.
int line_of_file(int line, const aesl::Script& script) {
    return line > 0 ? line + script.first_line - 1 : line;
}

int exec(const ExecOptions& options) {
    const Result<Input> read = read_input(options);
    if (!read.ok()) return complain(read.error(), kExitUsage);
    const Input& input = read.value();
    aesl::Options how = options.compiler;
    how.first_line = input.script.first_line;
    const aesl::Compilation done =
        aesl::compile(input.script.source, input.node.target, input.node.common, how);
    show_diagnostics(options, input.script, done);
    if (!done.ok()) {
        aesl::Diagnostic first = done.first_error();
        first.formal = first.formal_place();
        first.formal->line = line_of_file(first.formal->line, input.script);
        (void)print(session::format_compile_error(first));
        return kExitFailed;
    }
    Result<session::Execution> execution =
        session::execute(done.program, input.node, input.stimuli, options.steps_per_event);
    if (!execution.ok()) return complain(execution.error(), kExitUsage);
    auto& error = execution.value().error;
    if (error) error->line = line_of_file(error->line, input.script);
    (void)print(session::format_execution(execution.value()));
    return kExitDone;
}

}  // namespace

void add_exec(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("exec", "compiles a script and runs it on one machine");
    verb->footer(
        "Prints one JSON object: `memory` and `events_emitted` at the end, `runtime_error` if the\n"
        "script was stopped, or the first compile `error`. All errors go to stderr.\n\n"
        "Example:\n"
        "  vagus exec counter.aesl --node node.json --stimuli events.json");
    auto options = std::make_shared<ExecOptions>();  // owners: the options below, the callback
    CLI::Option* script =
        verb->add_option("FILE", options->script, "a script, a project, or - for standard input");
    script->required();
    takes_file(*script, {".aesl"});
    CLI::Option* node =
        verb->add_option("--node", options->node, "the node it runs on (node file)");
    node->required();
    takes_file(*node, {".json"});
    CLI::Option* stimuli =
        verb->add_option("--stimuli", options->stimuli,
                         "events and values to apply in order, after the start (JSON)");
    takes_file(*stimuli, {".json"});
    CLI::Option* steps = verb->add_option("--max-steps", options->steps_per_event,
                                          "instructions after which an event is stopped");
    steps->type_name("N")->capture_default_str();
    takes_whole_number(*steps, 1, UINT32_MAX);
    add_dialect_options(*verb, options->compiler);
    verb->callback([options, &exit_code] { exit_code = exec(*options); });
}

}  // namespace vagus::cli
