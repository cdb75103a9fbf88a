// A network of nodes as a host sees it: who is there, what they are, what they do; programs,
// breakpoints, variables and events on them (wire spec, sections 2.6 to 2.9). No sockets and no
// clock: it is handed frames and the time, and gives frames to send and events to read. One thread.
//
//     Network network;
//     network.set_common(project.common);
//     for (;;) {  // the caller's loop, around a link
//         for (const wire::Frame& frame : arrived) network.receive(now, frame);
//         network.tick(now);  // at the latest at network.next_tick()
//         for (const wire::Frame& frame : network.take_frames()) send(frame);
//         for (const Event& event : network.take_events()) show(event);
//     }
//
//     const Result<NodeId> robot = network.find("thymio-II");       // after its NodeDescribed
//     const aesl::Compilation done = network.compile(robot.value(), source, {});
//     const Result<RequestId> load = network.load(robot.value(), done.program);
//     // … until RequestDone{load} comes: the program is there and runs, breakpoints set.
//
// What is asked is sent with the next take_frames(). A request fails after kAnswerWithin without an
// answer, and when its node disconnects; what does no harm twice is asked again meanwhile. Only
// kTurnsAtOnce nodes are talked to at a time. Everything that a hostile bus can make grow has a
// limit below.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "aesl/compile.hpp"
#include "aesl/target.hpp"
#include "base/result.hpp"
#include "base/shared_value.hpp"
#include "base/time.hpp"
#include "debug/event.hpp"
#include "wire/frame.hpp"

namespace vagus::debug {

constexpr Duration kListEvery = std::chrono::milliseconds(1000);   // ListNodes (2.6, 1)
constexpr Duration kSilenceMax = std::chrono::milliseconds(3000);  // then disconnected (2.6, 5)
constexpr Duration kDescriptionRetry =
    std::chrono::milliseconds(1000);  // no progress for so long: ask again
constexpr int kDescriptionTriesMax =
    5;  // in a row without progress; fork fragments: then the whole
constexpr Duration kAnswerWithin = std::chrono::milliseconds(3000);  // for requests
constexpr Duration kAskAgain = std::chrono::milliseconds(1000);      // what may be repeated
constexpr Duration kWatchEveryMin = std::chrono::milliseconds(10);
constexpr Duration kWatchEvery = std::chrono::milliseconds(100);  // polling while someone watches

constexpr size_t kNodesMax = 16384;
constexpr size_t kDescriptionItemsMax = 4096;  // of each list: more than 12-bit addresses can reach
constexpr size_t kDescriptionBytesMax = 256 * 1024;      // names and texts of one node
constexpr size_t kDescriptionBytesTotalMax = 64u << 20;  // of all nodes
constexpr size_t kRequestsMax = 64;                      // waiting for one node
constexpr size_t kWatchesMax = 256;                      // on one node
constexpr size_t kBreakpointsMax = 16;                   // the table of a node (2.3)
constexpr size_t kEventsMax = 65536;       // not taken yet; then the newest are dropped and counted
constexpr size_t kFramesMax = 16384;       // not taken yet; the same
constexpr uint32_t kLineStepsMax = 10000;  // instructions of one step by line

// Kept by the host and set again on the node after each load and reconnection.
struct LineBreakpoint {
    int line = 0;
    std::string condition;  // empty: always
    uint16_t pc = 0;
    bool on_node = false;  // the node said so
    uint32_t hits = 0;     // stops here with a true condition
};

// One node, for reading.
struct NodeView {
    NodeId id = 0;
    std::string name;  // empty until described
    uint16_t protocol = 0;
    bool connected = false;
    bool described = false;
    bool id_shared = false;  // another node has the same id: what is told here is of either
    std::string other_name;  // of the other one, if it has another
    ProgramState state = ProgramState::Unknown;
    CodePlace at;                        // as the node told last
    bool in_event = false;               // the same: it works on an event
    Time part_at{};                      // when a part of its description came last
    SharedValue<aesl::Target> target;    // empty until described; equal nodes have one
    SharedValue<aesl::Program> program;  // what this host loaded or was told that the node has
    // Of a node with `_program`, as it told last: mark_of() what it runs (debug/program_mark.hpp).
    // None: not told yet since it was described, came back, or got words of a program.
    std::optional<uint32_t> told_program;
    std::vector<LineBreakpoint> breakpoints;
};

enum class AfterLoad { Run, Stay };

// Words of a variable, `first` counted from its beginning.
struct VariableRange {
    std::string name;
    uint16_t address = 0;  // of the first word that is meant
    uint16_t first = 0;
    uint16_t count = 1;
};

// Everyday bad input.
struct Counts {
    uint64_t dropped = 0;    // frames and events thrown away because nobody took them
    uint64_t malformed = 0;  // frames that are not what their type says
};

class Peer;  // one node, inside

class Network {
public:
    Network();
    ~Network();
    Network(Network&&) noexcept;
    Network& operator=(Network&&) noexcept;

    // ---- the bus ----
    void receive(Time now, const wire::Frame& frame);
    void tick(Time now);
    // When tick() has something to do again, at the latest.
    Time next_tick() const;
    std::vector<wire::Frame> take_frames();
    std::vector<Event> take_events();
    Counts counts() const;

    // ---- nodes ----
    // Ascending; disconnected ones too, but not those that said good-bye.
    std::vector<NodeId> nodes() const;
    // Borrowed until the next call that is not const; nullptr if there is no such node.
    const NodeView* node(NodeId id) const;
    // Those that said good-bye and have not come back, by number; the name of one that has not told
    // it is empty. Nobody knows what they do.
    std::vector<std::pair<NodeId, std::string>> left() const;
    // A person knows of these: they are told no more.
    void acknowledge_left();
    // A described node by its number or name. The Error names the nodes there are, near names
    // first.
    Result<NodeId> find(std::string_view name_or_id) const;
    // Asks all nodes who is there now, not only at the next second.
    void list_nodes();
    // The link to the bus is lost: everybody counts as disconnected until heard again, and is asked
    // then what is left of its program.
    void link_lost();
    // Asks one node what it is, if nothing was heard of it: one that is slow, or hears badly.
    void call(NodeId id);
    // A node answered twice where once was expected: with another list_nodes() it is asked whether
    // two nodes share its id (NodeIdShared) …
    bool doubts_an_id() const;
    // … and its answers are still to come.
    bool examines_ids() const;

    // ---- names ----
    // Names and numbers of events and constants that all nodes share; for compile(), emit() and
    // UserEvent.
    void set_common(aesl::CommonDefinitions common);
    const aesl::CommonDefinitions& common() const;

    // ---- programs ----
    // For the node's own description. An empty program with errors if it does not compile.
    aesl::Compilation compile(NodeId id, std::string_view source,
                              const aesl::Options& options) const;
    // Sends the program in fragments, waits for the node's word after each, sets breakpoints again,
    // and runs it unless it is to stay as SetBytecode leaves it: paused before its first line.
    Result<RequestId> load(NodeId id, SharedValue<aesl::Program> program,
                           AfterLoad then = AfterLoad::Run);
    // What is being loaded there, or waits for that, is not let run then, as somebody has to brake.
    // False: nothing is, or it was told to run already and counts as loaded.
    bool stay_after_load(NodeId id);
    // The node has this program already, as another host or its flash loaded it: gives names,
    // lines, breakpoints.
    Status adopt(NodeId id, const aesl::Program& program);
    // Nobody knows what the node has now: no names, no lines. Its breakpoints wait for adopt() or
    // load().
    void forget_program(NodeId id);
    // Continues; leaves a breakpoint at which the node is paused (Step, then Run: 2.8).
    Result<RequestId> run(NodeId id);
    Result<RequestId> pause(NodeId id);
    Result<RequestId> stop(NodeId id);
    // Now, before what waits for the node or is under way there, which is cancelled. Also for a
    // node that is away, that has not told what it is, or that nobody has heard of: what it may
    // answer is then nobody's (nothing returned).
    std::optional<RequestId> stop_now(NodeId id);
    std::optional<RequestId> pause_now(NodeId id);
    Result<RequestId> reset(NodeId id);
    // To another line or the end of the event; one instruction if the program is not known.
    Result<RequestId> step(NodeId id);
    // Asks for the state and the place.
    Result<RequestId> query(NodeId id);
    // Asks a node with `_program` which program it runs: ProgramTold, then RequestDone. An Error if
    // it lacks that variable. Asked by itself when a node was described or came back; if the answer
    // is not `program` of its view, ProgramReplaced follows, and if there is none, ProgramUntold.
    Result<RequestId> ask_program(NodeId id);
    // The node keeps its program for its next start. Nodes need not answer; the note says what the
    // node told.
    Result<RequestId> save(NodeId id);

    // ---- breakpoints ----
    // At a line with code. `condition`: an expression over the node's variables and the constants
    // in the grammar of AESL (debug/condition.hpp), evaluated here when the node stops; false lets
    // it go on. Empty: always.
    Result<RequestId> set_breakpoint(NodeId id, int line, std::string_view condition);
    Status clear_breakpoint(NodeId id, int line);
    Status clear_breakpoints(NodeId id);

    // ---- variables ----
    // "NAME", "NAME[3]" or "NAME[2:5]" (first and last). The Error suggests near names.
    Result<VariableRange> variable(NodeId id, std::string_view text) const;
    // Answered by VariablesArrived before RequestDone.
    Result<RequestId> get(NodeId id, const VariableRange& range);
    // Writes and waits for the node's sign of life behind it. At most range.count values.
    Result<RequestId> set(NodeId id, const VariableRange& range, std::span<const int16_t> values);
    // Writes behind whatever was sent to the node before, and asks nothing: it is no request, so
    // none can be in front of it.
    Status write(NodeId id, const VariableRange& range, std::span<const int16_t> values);
    // VariableChanged now and whenever it differs, polled every `every`, at least
    // kWatchEveryMin.
    Status watch(NodeId id, const VariableRange& range, Duration every = kWatchEvery);
    void unwatch(NodeId id, std::string_view name);

    // ---- events ----
    // By name, or by number if there is no such name. The count of arguments is checked where it is
    // known.
    Status emit(std::string_view event, std::span<const int16_t> arguments);

private:
    Result<Peer*> usable(NodeId id) const;

    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vagus::debug
