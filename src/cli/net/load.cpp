// vagus net load: compiles the scripts of a project for the nodes that are there, then loads them,
// all or none.
#include <algorithm>
#include <utility>

#include "base/json.hpp"
#include "cli/net/show.hpp"
#include "cli/net/verbs.hpp"
#include "cli/output.hpp"
#include "session/diagnostic_text.hpp"

namespace vagus::cli {
namespace {

struct Job {
    debug::NodeId id = 0;
    const aesl::Program* program = nullptr;
};

// Says what is wrong and what is doubtful.
void report(const session::ScriptFile& scripts, const aesl::Script& script,
            const aesl::Compilation& done) {
    const session::SourceText text{scripts.path, script.source, script.first_line};
    for (const Diagnostic& one : session::diagnostics_of(text, done)) say(report_of(one));
}

void say_unused(const NetSession& session) {
    const session::ScriptFile& scripts = *session.project();
    for (const aesl::Script& script : scripts.project.scripts) {
        bool used = false;
        for (const debug::NodeId id : session.connected()) {
            used = used || session.script_of(id) == &script;
        }
        const std::string where = scripts.path + ":" + std::to_string(script.first_line);
        if (!used) {
            complain(where + ": the script for \"" + script.node +
                     "\" was not loaded: no such node is there");
        }
    }
}

std::string of(uint16_t used, uint16_t size) {
    return std::to_string(used) + " of " + std::to_string(size);
}

std::string show_loaded(const NetSession& session, const std::vector<Job>& jobs) {
    std::vector<std::vector<std::string>> rows;
    for (const Job& job : jobs) {
        const debug::NodeView& node = session.view(job.id);
        const aesl::Used& used = job.program->used;
        rows.push_back({std::to_string(job.id), node.name,
                        "loaded, " + std::string(name_of(node.state)),
                        "bytecode " + of(used.bytecode, node.target->bytecode_size),
                        "variables " + of(used.variables, node.target->variables_size),
                        "stack " + of(used.stack, node.target->stack_size) + " words"});
    }
    return table(rows);
}

std::string show_loaded_json(const NetSession& session, const std::vector<Job>& jobs) {
    std::vector<std::string> elements;
    for (const Job& job : jobs) {
        const aesl::Used& used = job.program->used;
        elements.push_back("{ \"id\": " + std::to_string(job.id) +
                           ", \"name\": " + json_quote(session.view(job.id).name) +
                           ", \"used\": { \"bytecode\": " + std::to_string(used.bytecode) +
                           ", \"variables\": " + std::to_string(used.variables) +
                           ", \"stack\": " + std::to_string(used.stack) + " } }");
    }
    return json_list(elements);
}

// Which nodes get a script: the one that is named, or all that have one.
Result<std::vector<debug::NodeId>> receivers(NetSession& session, session::ScriptFile scripts,
                                             const std::string& named) {
    std::vector<debug::NodeId> ids = TRY(session.nodes({named.empty() ? "all" : named}));
    if (scripts.plain && ids.size() > 1 && named != "all") {
        return Error{Code::BadInput, scripts.path + " is one script, and there are " +
                                         std::to_string(ids.size()) +
                                         " nodes: say for which it is meant, or all"};
    }
    if (scripts.plain) {  // made a project with that script for each
        const aesl::Script script = scripts.project.scripts.front();
        scripts.project.scripts.clear();
        scripts.project.common = session.network().common();
        for (const debug::NodeId id : ids) {
            const aesl::Target& target = session.view(id).target;
            scripts.project.common =
                session::with_emitted(scripts.project.common, script.source, target);
            scripts.project.scripts.push_back(script);
            scripts.project.scripts.back().node = target.name;
            scripts.project.scripts.back().node_id = id;
        }
    }
    session.use_project(std::move(scripts));
    const size_t before = ids.size();
    std::erase_if(ids, [&session](debug::NodeId id) { return session.script_of(id) == nullptr; });
    if (!ids.empty()) return ids;
    std::string wanted;
    for (const aesl::Script& script : session.project()->project.scripts) {
        wanted += (wanted.empty() ? "\"" : ", \"") + script.node + "\"";
    }
    return Error{
        Code::NotFound,
        session.project()->path + " has no script for " +
            (before == 1 ? "this node" : "any of these " + std::to_string(before) + " nodes") +
            "; it has scripts for " + (wanted.empty() ? "none" : wanted)};
}

}  // namespace

Verdict net_load(NetSession& session, const session::ScriptFile& scripts, const std::string& node) {
    const std::vector<debug::NodeId> ids = TRY(receivers(session, scripts, node));
    std::vector<Job> jobs;
    bool good = true;
    for (const debug::NodeId id : ids) {
        NetSession::Compiled& script = session.compiled(id);
        jobs.push_back({id, &script.done.program});
        good = script.done.ok() && good;
        if (!std::exchange(script.told, true)) report(scripts, *script.script, script.done);
    }
    if (!good) return kExitFailed;
    if (node.empty()) say_unused(session);
    session.take_events();
    std::vector<Asked> asked;
    for (const Job& job : jobs) {
        const auto sent = TRY(session.network().load(job.id, *job.program));
        asked.push_back({job.id, sent});
    }
    // A node answers in order: a fault of the first moment comes before the answer to this.
    for (const Job& job : jobs) {
        const auto sent = TRY(session.network().query(job.id));
        asked.push_back({job.id, sent});
    }
    const std::vector<debug::Event> events = TRY(wait_all(session, asked));
    const Failures failures = complain_failed(asked, events);
    std::erase_if(jobs, [&failures](const Job& job) { return failures.nodes.contains(job.id); });
    int code = failures.code;
    for (const Job& job : jobs) {
        if (session.view(job.id).connected) continue;
        code = complain("node " + std::to_string(job.id) +
                        " left while it was loaded; load it again when it is back");
    }
    code = std::max(code, complain_unreached(session, {node.empty() ? "all" : node}));
    if (jobs.empty()) return code;
    for (const debug::Event& event : events) {
        const auto* fault = std::get_if<debug::Fault>(&event.what);
        if (fault == nullptr) continue;
        complain("node " + node_name(session, event.node) + ": " + fault->text + " at " +
                 show_place(session, event.node, fault->at));
    }
    print(session.options().json ? show_loaded_json(session, jobs) : show_loaded(session, jobs));
    return code;
}

}  // namespace vagus::cli
