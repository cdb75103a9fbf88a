// The verbs of `vagus net`: what each takes, and what it does on a connected session. net.cpp reads
// the command line.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "cli/net/session.hpp"
#include "debug/control.hpp"

namespace vagus::cli {

// An exit code, or an Error that is said and ends with 1.
using Verdict = Result<int>;

// ---- nodes.cpp ----
// One request that was made of one node.
struct Asked {
    debug::NodeId node = 0;
    debug::RequestId request;
};
Result<std::vector<debug::Event>> wait_all(NetSession& session, const std::vector<Asked>& asked);
// Says which failed, and why; many that did not answer are told in one line.
struct Failures {
    int code = 0;  // kExitDone or kExitFailed
    std::set<debug::NodeId> nodes;
};
Failures complain_failed(const std::vector<Asked>& asked, const std::vector<debug::Event>& events);
// Where "all" was named: says which nodes that are there are not among them. An exit code.
int complain_unreached(const NetSession& session, const std::vector<std::string>& named);

Verdict net_list(NetSession& session);
Verdict net_describe(NetSession& session, const std::vector<std::string>& nodes);
// run, pause, reset, step, save: all nodes are asked, then all are waited for.
Verdict net_control(NetSession& session, debug::Control::Kind act,
                    const std::vector<std::string>& nodes);

// ---- variables.cpp ----
Verdict net_get(NetSession& session, const std::string& node,
                const std::vector<std::string>& variables);
// A variable that drives the node (docs/formats.md, "Safe stop") is set as long as this runs: until
// Ctrl-C or the end of --wait. With `leave` it returns at once all the same.
Verdict net_set(NetSession& session, const std::string& node, const std::string& variable,
                const std::vector<int16_t>& values, bool leave);
Verdict net_emit(NetSession& session, const std::string& event,
                 const std::vector<int16_t>& arguments);
Verdict net_watch(NetSession& session, const std::string& node,
                  const std::vector<std::string>& variables);
// All that happens, or what happens on these nodes.
Verdict net_log(NetSession& session, const std::vector<std::string>& nodes);

// ---- record.cpp ----
// All that goes over the bus, into a file, until Ctrl-C or the end of --wait. `files` is what was
// read so far.
Verdict net_record(NetSession& session, const std::string& file, const FilesRead& files);

// ---- rest.cpp ----
// Stops scripts, makes nodes safe, reads back. The exit code tells whether all are at rest.
Verdict net_stop(NetSession& session, const std::vector<std::string>& nodes);
// Where these nodes do not run, the others of their robot that move are paused and made safe, and
// so is what moves of these nodes. Says so in a line. Gives those that were paused; a node that
// does not answer is complained of.
Result<std::vector<debug::NodeId>> brake_others(NetSession& session,
                                                const std::vector<debug::NodeId>& causes);
// Whether these values of the variable are other than those of the node's safe stop.
Result<bool> is_driving(const NetSession& session, debug::NodeId id,
                        const debug::VariableRange& range, const std::vector<int16_t>& values);
// Then the node is made safe again.
Verdict drive_until_end(NetSession& session, debug::NodeId id);

// ---- load.cpp ----
// To every node that the project has a script for, or to `node` if it is not empty.
Verdict net_load(NetSession& session, const session::ScriptFile& scripts, const std::string& node);

// ---- break.cpp ----
struct BreakOptions {
    std::string node;
    std::string file;  // empty: only clear
    int line = 0;      // of the file
    std::string condition;
    bool clear = false;  // all that the node has
    bool keep = false;   // leave it set at the end
};
Verdict net_break(NetSession& session, const BreakOptions& options);

}  // namespace vagus::cli
