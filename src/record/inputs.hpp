// What came to a run from outside, as a message of /vagus/input: written as it comes, and read
// again to be done again at the same place of the run.
//
//     const std::string text = format_input({.at = now, .what = act});
//     const Input input = TRY(read_input(text, at, "run.mcap"));
//     if (const auto* frame = std::get_if<wire::Frame>(&input.what)) bus.receive(link, *frame);
//
// An instant of the world has places at which something can come: before the run begins (turn 0),
// between two instants, and while the debugger of the plan holds it in the middle of one. Where
// that matters, what comes at one place together has one number, its turn.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "run/debug_values.hpp"
#include "sim/world.hpp"
#include "toolbox/bus.hpp"
#include "wire/frame.hpp"

namespace vagus::record {

constexpr uint64_t kReseedMax = INT64_MAX;  // as numbers of JSON are read

// A moment in which time is stopped and the nodes answer (sim::World::hold_instant()).
struct HeldMoment {};
// Then the debugger of the plan looked for what had arrived (SimSession::hear_ahead()).
struct HeardAhead {};
// Plan files that were saved while the plan ran; `texts` are all that the version is made of.
struct PlanFiles {
    std::vector<std::string> saved = {};  // names of files of the recording
    std::map<std::string, std::string> texts = {};
};
// A host has loaded a program that is made of this file: for the names of its variables and lines.
struct ScriptLoaded {
    uint16_t node = 0;
    std::string file = {};
    std::string text = {};
};
// Of a run that went another way (RerunOptions::from): a variable of the plan got a value, as
// "NAME=VALUE"; a script or plan took over, by its name in the recording.
struct ValueGiven {
    std::string text = {};
};
struct FileTookOver {
    std::string file = {};
    std::string text = {};
};
// Of such a run, too: all that is random in it is drawn from another seed from here on.
struct Reseeded {
    uint64_t seed = 0;  // at most kReseedMax
};
// Somebody ended the run.
struct Aborted {
    std::string by = {};
};
// Of a plan on a real bus: what it heard, in the order in which it decided on it. An event is that
// of a recorded frame; what it is told of its nodes is a name (toolbox/bus.hpp).
struct Heard {
    uint32_t frame = 0;
    std::string name = {};  // where there is no frame
    uint16_t from = 0;
};
// The same: a node came, left, was stopped, or runs again (toolbox::BusNodes).
struct NodeChanged {
    std::string name = {};
    toolbox::BusNodes::Change change = toolbox::BusNodes::Change::Appeared;
};
// The same: its tokens count from this one (run::Numbers).
struct TokensMoved {
    uint16_t token = 0;
};
// The same: it could not go on.
struct RunFailed {
    std::string why = {};
};
// Nothing is recorded from here on.
struct RecordingEnds {
    std::string why = {};  // empty: the run was over
};

// Of requests to the debugger: those of does_something().
using InputWhat = std::variant<sim::Act, wire::Frame, HeldMoment, HeardAhead, run::Request,
                               PlanFiles, ScriptLoaded, ValueGiven, FileTookOver, Reseeded, Heard,
                               NodeChanged, TokensMoved, RunFailed, Aborted, RecordingEnds>;

struct Input {
    Time at{};
    uint32_t turn = 0;
    InputWhat what = HeldMoment{};
};

// Whether the run may go on in another way after it. TakeVersion counts as nothing here: it is
// recorded by its files.
bool does_something(const run::Request& request);

std::string format_input(const Input& input);
// The Error says what it is that cannot be done again; `name` is the recording.
Result<Input> read_input(std::string_view text, Time at, const std::string& name);

}  // namespace vagus::record
