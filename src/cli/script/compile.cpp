// vagus compile: scripts and projects to bytecode. Mistakes go to stderr as FILE:LINE:COL: error:
// sentence [CODE].
#include "aesl/compile.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "aesl/abo.hpp"
#include "aesl/listing.hpp"
#include "aesl/node_file.hpp"
#include "base/file.hpp"
#include "base/nearest.hpp"
#include "base/text.hpp"
#include "cli/kept_file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/script/compile_json.hpp"
#include "cli/verbs.hpp"
#include "session/diagnostic_text.hpp"
#include "session/known_nodes.hpp"
#include "session/script_file.hpp"

namespace vagus::cli {
namespace {

struct Options {
    std::string file;
    std::vector<std::string> node_files;
    std::string node_name;
    std::string format = "listing";
    std::string out;
    aesl::Options compile;
};

// What one script is compiled for.
struct Job {
    aesl::Script script;
    aesl::NodeFile node;
    aesl::CommonDefinitions common;  // the project's, or those of the node file
    bool plain = false;
};

Result<std::vector<aesl::NodeFile>> read_nodes(const std::vector<std::string>& paths) {
    std::vector<aesl::NodeFile> nodes;
    for (const std::string& path : paths) {
        if (path == "thymio-II" || path == "e-puck") {
            nodes.push_back({session::known_node(path), {}});
            continue;
        }
        const std::string text = TRY(read_file(path));
        nodes.push_back(TRY(aesl::parse_node_file(text, path)));
    }
    return nodes;
}

// The node file of the script's node; with one file only, that one; without any, a node that is
// built in.
aesl::NodeFile node_for(const aesl::Script& script, const std::vector<aesl::NodeFile>& nodes) {
    for (const aesl::NodeFile& node : nodes) {
        if (node.target.name == script.node) return node;
    }
    if (nodes.size() == 1) return nodes.front();
    return {session::known_node(script.node), {}};
}

Status check_name(const std::string& wanted, const std::vector<aesl::Script>& scripts) {
    std::vector<std::string> names;
    for (const aesl::Script& script : scripts) names.push_back(script.node);
    if (std::find(names.begin(), names.end(), wanted) != names.end()) return Status::done();
    const std::string guess = nearest(wanted, names);
    return Error{Code::NotFound,
                 "--node-name: there is no script for a node \"" + wanted +
                     "\" in the project; it has " +
                     (names.empty() ? "none" : list_of({names.begin(), names.end()})) +
                     (guess.empty() ? "" : "; did you mean " + guess + "?")};
}

// The scripts that are asked for, each with its node; Error for what the command line gets wrong.
Result<std::vector<Job>> jobs_of(const Options& options, const session::ScriptFile& file) {
    const std::vector<aesl::NodeFile> nodes = TRY(read_nodes(options.node_files));
    std::vector<aesl::Script> scripts = file.project.scripts;
    if (file.plain && nodes.size() == 1) scripts.front().node = nodes.front().target.name;
    if (file.plain && nodes.size() > 1) {
        return Error{Code::BadInput, "--node: a plain script is compiled for one node, found " +
                                         std::to_string(nodes.size()) + " node files; give one"};
    }
    if (!options.node_name.empty() && !file.plain) {
        TRY(check_name(options.node_name, scripts));
        std::erase_if(scripts,
                      [&](const auto& script) { return script.node != options.node_name; });
        scripts.resize(1);
    }
    std::vector<Job> jobs;
    for (const aesl::Script& script : scripts) {
        const aesl::NodeFile node = node_for(script, nodes);
        aesl::CommonDefinitions common = file.plain ? node.common : file.project.common;
        // A node file that lists events lists all of them: another name is a slip of the pen.
        if (file.plain && common.events.empty())
            common = session::with_emitted(common, script.source, node.target);
        jobs.push_back({script, node, std::move(common), file.plain});
    }
    const bool single = options.format == "hex" || options.format == "abo";
    if (!single || jobs.size() == 1) return jobs;
    return Error{Code::BadInput, "--format " + options.format +
                                     " writes the program of one node, " + options.file +
                                     " has scripts for " + std::to_string(jobs.size()) +
                                     "; choose with --node-name"};
}

void show(const session::SourceText& text, const aesl::Compilation& done) {
    for (const Diagnostic& one : session::diagnostics_of(text, done)) {
        say(stderr_is_terminal() ? report_of(one) : text_of(one) + "\n");
    }
}

std::string hex_of(const aesl::Program& program) {
    std::string text;
    for (const uint16_t word : program.bytecode) {
        for (int shift = 12; shift >= 0; shift -= 4)
            text += "0123456789abcdef"[(word >> shift) & 15];
        text += '\n';
    }
    return text;
}

std::string listings_of(const std::vector<CompiledNode>& nodes, const std::vector<Job>& jobs) {
    std::string text;
    for (size_t i = 0; i < nodes.size(); i++) {
        if (i > 0) text += "\n";
        if (nodes.size() > 1) text += "node " + nodes[i].name + "\n\n";
        const Job& job = jobs[i];
        text += aesl::listing(nodes[i].done.program, job.script.source, job.node.target, job.common,
                              job.script.first_line);
    }
    return text;
}

std::string output_of(const Options& options, const std::vector<CompiledNode>& nodes,
                      const std::vector<Job>& jobs) {
    if (options.format == "json") return compile_json(nodes);
    if (options.format == "listing") return listings_of(nodes, jobs);
    const aesl::Program& program = nodes.front().done.program;
    if (options.format == "hex") return hex_of(program);
    const Job& job = jobs.front();
    return aesl::format_abo(job.node.target, {.node_id = job.script.node_id}, program.bytecode);
}

int deliver(const Options& options, const std::string& content) {
    if (options.out.empty() && options.format == "abo" && stdout_is_terminal()) {
        return complain("an .abo file is binary: give -o OUT, or pipe it", kExitUsage);
    }
    if (options.out.empty() || options.out == "-") {
        options.format == "abo" ? print_file(content) : print(content);
        return kExitDone;
    }
    const Status written = write_file(options.out, content);
    return written.ok() ? kExitDone : complain(written.error());
}

int compile_all(const Options& options, const std::vector<Job>& jobs) {
    std::vector<CompiledNode> nodes;
    bool failed = false;
    for (const Job& job : jobs) {
        aesl::Options how = session::options_for(job.common, options.compile);
        how.first_line = job.script.first_line;
        nodes.push_back({job.script.node.empty() ? job.node.target.name : job.script.node,
                         aesl::compile(job.script.source, job.node.target, job.common, how)});
        show({options.file, job.script.source, job.script.first_line}, nodes.back().done);
        failed = failed || !nodes.back().done.ok();
    }
    if (!failed) return deliver(options, output_of(options, nodes, jobs));
    if (options.format == "json" && options.out.empty()) print(compile_json(nodes));
    if (jobs.front().plain && options.node_files.empty()) {
        complain(
            "compiled for the standard software node, because no node is given; for a robot add "
            "--node thymio-II, --node e-puck or --node NODE.json");
    }
    return kExitFailed;
}

// What a person has written, or a robot has done, is not replaced by what is compiled.
Status check_out(const Options& options) {
    std::error_code error;
    const auto is_out = [&](const std::string& path) {
        return std::filesystem::equivalent(options.out, path, error);
    };
    const bool is_read = is_out(options.file) || std::ranges::any_of(options.node_files, is_out);
    if (!is_read && !is_source_or_recording(options.out)) return Status::done();
    return Error{
        Code::Refused,
        fmt::format("-o {}: {}; name another file for what is compiled, as blink.hex", options.out,
                    is_read ? "is read for this" : "is there already, and no such output")};
}

int run(const Options& options) {
    const Status good = check_out(options);
    if (!good.ok()) return complain(good.error(), kExitUsage);
    const auto text = read_file(options.file);
    if (!text.ok()) return complain(text.error(), kExitUsage);
    const auto file = session::read_script_file(text.value(), options.file);
    if (!file.ok()) {
        say(file.error().what + "\n");
        return kExitFailed;
    }
    const auto jobs = jobs_of(options, file.value());
    if (!jobs.ok()) return complain(jobs.error(), kExitUsage);
    return compile_all(options, jobs.value());
}

}  // namespace

void add_compile(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("compile", "compiles a script or an .aesl project");
    auto options = std::make_shared<Options>();  // owners: CLI11's options and the callback
    takes_file(
        *verb->add_option("FILE", options->file, "a script, a project, or - for standard input")
             ->required(),
        {".aesl"});
    takes_file(
        *verb->add_option(
                 "--node", options->node_files,
                 "description of the node: a file, thymio-II or e-puck; once for each node of a "
                 "project. Without it: "
                 "thymio-II and e-puck are known by their names, any other name is a software node")
             ->allow_extra_args(false),
        {".json"});
    verb->add_option("--node-name", options->node_name,
                     "only the script of this node of the project")
        ->type_name("NAME");
    takes_one_of(*verb->add_option("--format", options->format, "what to write (default: listing)"),
                 {"listing", "json", "hex", "abo"});
    takes_file(
        *verb->add_option("-o,--out", options->out, "where to write it (default: standard output)"),
        {});
    add_dialect_options(*verb, options->compile);
    verb->footer(
        "Mistakes go to standard error as FILE:LINE:COL: error: sentence [CODE]; exit code 1 if "
        "there is one.\n"
        "\n"
        "Example:\n"
        "  vagus compile examples/thymio/explore.aesl\n"
        "  vagus compile blink.aesl --node node.json --format hex -o blink.hex");
    verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vagus::cli
