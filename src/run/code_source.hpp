// Code in place of that of the toolboxes, in virtual time: for actors that answer by themselves
// (answers.hpp), for a path that is played (played_path.hpp).
//
//     options.code_source = &source;                   // RunOptions; borrowed for the run
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/time.hpp"
#include "plan/graph.hpp"
#include "run/code.hpp"

namespace vagus::run {

class CodeSource {
public:
    virtual ~CodeSource() = default;
    // Nothing: that of the toolbox. `path` is the plan's ("Main/call"); `now` since the start of
    // the run. Called on the deciding thread, at each activation whose code starts, and each start
    // of a watching.
    virtual std::unique_ptr<Actor> make_actor(const plan::GraphActor& of, const std::string& path,
                                              Time now) = 0;
    virtual std::unique_ptr<Supervisor> make_supervisor(const plan::GraphSupervisor& of,
                                                        const std::string& path, Time now) = 0;
};

struct RunOptions;
// Where code is to be made.
struct CodePlace {
    std::string path;
    Time now;
};
// Of the source if there is one and it gives some, else of the library.
std::unique_ptr<Actor> make_actor(const RunOptions& options, const CodeLibrary& library,
                                  const plan::GraphActor& of, const CodePlace& place);
std::unique_ptr<Supervisor> make_supervisor(const RunOptions& options, const CodeLibrary& library,
                                            const plan::GraphSupervisor& of,
                                            const CodePlace& place);

// Supervisors of period 0 are checked at events only. In this copy those that are asked for have
// the default period, so that code of a source can raise by itself.
plan::Graph with_checks_in_time(plan::Graph graph,
                                const std::function<bool(const plan::GraphSupervisor&)>& which);

}  // namespace vagus::run
