// Templates: what an actor or supervisor is an instance of (docs/plans.md, sections 1, 7, 8). Here
// is what they declare; the code behind them belongs to the toolboxes.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plan/value.hpp"

namespace vagus::plan {

enum class Kind : uint8_t { Actor, Computation, Supervisor };
std::string_view name_of(Kind kind);

struct Input {
    std::string name;
    std::optional<Type> type;            // empty: any
    std::optional<Value> fallback = {};  // of `type`; empty: needs a value
    std::string unit = {};
    std::string help = {};
    std::optional<double> low = {};
    std::optional<double> high = {};
};

struct OutputDeclaration {
    std::string name;
    std::optional<Type> type;  // empty: that of the input `value`
    std::string unit = {};
    std::string help = {};
};

// A state of an actor, an event of a supervisor.
struct Outcome {
    std::string name;
    std::string help = {};
};

constexpr int64_t kPeriodDefaultMs = 10;  // P22
constexpr int64_t kPeriodMaxMs = 1'000'000;
constexpr int64_t kGraceDefaultMs = 2000;  // P27

// What a template's code does on the bus: with any events, it needs one. (What the templates of
// `core` send is named by their inputs, and heard without a bus too.)
struct BusUse {
    std::vector<std::string> events = {};              // sent or waited for
    std::vector<std::string> starts = {};              // those of them that begin work on a node
    std::vector<std::vector<std::string>> nodes = {};  // that do it: one of each list, by name
    std::vector<std::string> stops = {};               // those that end it there
};

struct Template {
    std::string name;
    Kind kind = Kind::Actor;
    std::string help = {};
    std::string icon = {};  // SVG path data on a 24 x 24 field
    std::vector<Input> inputs = {};
    std::vector<OutputDeclaration> outputs = {};
    std::vector<Outcome> outcomes = {};
    int64_t period_ms = kPeriodDefaultMs;  // supervisors; 0: it waits for events itself (P22b)
    int64_t grace_ms = kGraceDefaultMs;    // actors
    BusUse bus = {};
    bool needs_fleet = false;  // it asks the other robots, or their keeper
    bool only_fails = false;   // its code does nothing but throw: an error is meant (explore.hpp)
    int line = 0;              // in the file of its toolbox; 0: declared in C++
};

struct Toolbox {
    std::string name;
    std::string help = {};
    std::vector<Template> templates = {};
    std::string file = {};  // that it was read from; empty: built in
};

// All toolboxes that a program has. Templates keep their addresses as long as the library lives.
class Library {
public:
    void add(Toolbox toolbox) { toolboxes_.push_back(std::move(toolbox)); }
    const Toolbox* find(std::string_view toolbox) const;
    const std::deque<Toolbox>& toolboxes() const { return toolboxes_; }

private:
    std::deque<Toolbox> toolboxes_;
};

inline constexpr std::string_view kCoreToolbox = "core";

// Whether the number is in the range that the input declares, and the range in words: "from 0 to
// 10", "at least 0", "at most 10".
bool is_within(const Input& input, double number);
std::string range_of(const Input& input);

// Indices into a template's lists; -1 if there is none of that name.
int find_input(const Template& of, std::string_view name);
int find_output(const Template& of, std::string_view name);
int find_outcome(const Template& of, std::string_view name);

}  // namespace vagus::plan
