// vagus net load: compiles the scripts of a project for the nodes that are there, then loads them,
// all or none.
#include <algorithm>
#include <cstdio>

#include "base/json.hpp"
#include "cli/net_show.hpp"
#include "cli/net_verbs.hpp"
#include "cli/output.hpp"
#include "session/diagnostic_text.hpp"

namespace vagus::cli {
namespace {

struct Job {
    debug::NodeId id = 0;
    aesl::Compilation done;
};

// Says what is wrong and what is doubtful; false if it is wrong.
bool report(const session::ScriptFile& scripts, const aesl::Script& script,
            const aesl::Compilation& done) {
    const session::SourceText text{scripts.path, script.source, script.first_line};
    for (const std::string& line : session::diagnostic_report(text, done)) {
        std::fputs((line + "\n").c_str(), stderr);
    }
    return done.ok();
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
        const aesl::Used& used = job.done.program.used;
        rows.push_back({std::to_string(job.id), node.name,
                        "loaded, " + std::string(name_of(node.state)),
                        "bytecode " + of(used.bytecode, node.target.bytecode_size),
                        "variables " + of(used.variables, node.target.variables_size),
                        "stack " + of(used.stack, node.target.stack_size) + " words"});
    }
    return table(rows);
}

std::string show_loaded_json(const NetSession& session, const std::vector<Job>& jobs) {
    std::vector<std::string> elements;
    for (const Job& job : jobs) {
        const aesl::Used& used = job.done.program.used;
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
        const aesl::Script& script = *session.script_of(id);
        const aesl::Options how = session::options_for(session.network().common(), {});
        jobs.push_back({id, session.network().compile(id, script.source, how)});
        good = report(scripts, script, jobs.back().done) && good;
    }
    if (!good) return kExitFailed;
    if (node.empty()) say_unused(session);
    session.take_events();
    std::vector<debug::RequestId> requests;
    for (const Job& job : jobs) {
        requests.push_back(TRY(session.network().load(job.id, job.done.program)));
    }
    // A node answers in order: a fault of the first moment comes before the answer to this.
    for (const Job& job : jobs) requests.push_back(TRY(session.network().query(job.id)));
    std::vector<debug::Event> events;
    (void)TRY(session.wait_done(requests, events));
    int code = kExitDone;
    for (const debug::RequestId request : requests) {
        if (const auto error = error_of(events, request)) code = complain(*error);
    }
    for (const Job& job : jobs) {
        if (code == kExitDone && !session.view(job.id).connected) {
            code = complain("node " + std::to_string(job.id) +
                            " left while it was loaded; load it again when it is back");
        }
    }
    if (code != kExitDone) return code;
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
