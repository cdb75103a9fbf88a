// One run of `vagus net`: a connection to a network of nodes, the nodes on it, the project that
// gives names and lines. Every wait has an end: a deadline, an answer, Ctrl-C, or a peer that has
// gone.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "debug/roll_call.hpp"
#include "session/script_file.hpp"

namespace vagus::cli {

// What is on the command line before the verb.
struct NetOptions {
    std::string target;
    std::string project_file;  // empty: none
    std::optional<double> wait_s;
    bool json = false;
};

// Reads an .aesl project or a plain script; the Error names file and place.
Result<session::ScriptFile> read_scripts(const std::string& file);

// The line of the script as a line of the project's file; 0 stays 0.
int file_line(const aesl::Script& script, int script_line);

class NetSession {
public:
    // Connects.
    static Result<std::unique_ptr<NetSession>> open(const NetOptions& options);
    ~NetSession();

    debug::Network& network() { return network_; }
    const debug::Network& network() const { return network_; }
    const NetOptions& options() const { return options_; }
    const std::optional<session::ScriptFile>& project() const { return project_; }
    // Gives names of events and constants; scripts are matched with nodes from now on.
    void use_project(session::ScriptFile project);
    // The script of the project for this node; nullptr if there is none.
    const aesl::Script* script_of(debug::NodeId id) const;
    // That script, which there must be, for this node: compiled once for all nodes that are alike.
    // Borrowed until the next use_project().
    struct Compiled {
        const aesl::Script* script = nullptr;
        aesl::Target target;
        aesl::Compilation done;
        bool told = false;  // its mistakes have been said
    };
    Compiled& compiled(debug::NodeId id);

    // ---- waiting ----
    // User events are thrown away as they come, unless somebody wants them: a flood costs little.
    void hear_user_events() { hears_user_events_ = true; }
    // Is told of each frame, as it comes or goes, in the order of the bus.
    void on_frame(std::function<void(const wire::Frame&)> told) {
        told_of_frame_ = std::move(told);
    }
    Time now() const;
    // Sends what waits, takes what came, at the latest until the deadline. What happened is added
    // to events.
    Status turn(Time deadline);
    std::vector<debug::Event> take_events();
    // What was taken on the way is for somebody else: take_events() gives it again.
    void put_back(std::vector<debug::Event> events);
    bool interrupted() const;  // by Ctrl-C
    // Until `ready` says so. Code::Timeout if the deadline passes or the user interrupts.
    Status wait_for(const std::function<bool()>& ready, Time deadline);
    // Until every request is done, adding all events to `events`. Fails only if the connection
    // does.
    Status wait_done(const std::vector<debug::RequestId>& requests,
                     std::vector<debug::Event>& events);
    // Writes what still waits and lets the peer know that it was all: before the process ends.
    // Without that, what the peer sends meanwhile could make its system throw away our last frames;
    // and a simulator of Aseba's dies if the next command comes before it saw this one leave.
    void farewell();

    // ---- nodes ----
    // Asks who is there, as long as answers may come.
    Status discover(const debug::RollCallOptions& options = {});
    // Discovers, then finds each by number or name, if need be for --wait seconds; "all" stands for
    // every connected node. Where the project has a script for a node, its names and lines are
    // known from then on.
    // With Everybody, those that were not named are known as well then.
    enum class Until { Named, Everybody };
    Result<std::vector<debug::NodeId>> nodes(const std::vector<std::string>& named,
                                             Until until = Until::Named);
    Result<debug::NodeId> node(const std::string& named, Until until = Until::Named);
    // The node as it is known now. Nodes may leave at any time; one that said good-bye is a view
    // without a name, neither connected nor described. Borrowed until the next wait.
    const debug::NodeView& view(debug::NodeId id) const;
    // --wait, or that many seconds.
    Duration wait_or(double seconds) const;
    std::vector<debug::NodeId> connected() const;
    // Nodes that are there but would not say what they are: nothing can be asked of them.
    std::vector<debug::NodeId> undescribed() const;
    // Tells the network the programs of the project as if they were loaded. Says what does not
    // compile: its names and lines are not known then.
    void adopt_scripts();

private:
    struct Bus;  // sockets stay in the .cpp

    explicit NetSession(NetOptions options);
    Status connect();
    Error no_answer(debug::NodeId id) const;
    Result<std::vector<debug::NodeId>> find_all(const std::vector<std::string>& named) const;
    void match_scripts();

    NetOptions options_;
    std::optional<session::ScriptFile> project_;
    std::unique_ptr<Bus> bus_;
    debug::Network network_;
    debug::NodeView gone_;
    std::vector<debug::Event> events_;
    std::map<debug::NodeId, int> scripts_;  // index into the project's scripts
    std::deque<Compiled> compiled_;         // their places stay
    bool hears_user_events_ = false;
    std::function<void(const wire::Frame&)> told_of_frame_;
};

// How it ended; nothing if it worked.
std::optional<Error> error_of(const std::vector<debug::Event>& events, debug::RequestId request);

}  // namespace vagus::cli
