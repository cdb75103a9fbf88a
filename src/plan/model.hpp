// A plan as values: what a plan file says, each thing with its line (docs/plans.md,
// section 2). Reading is in file.hpp, checking in check.hpp; nothing here runs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "plan/formula.hpp"
#include "plan/value.hpp"

namespace vagus::plan {

enum class Access : uint8_t { Local, In, Out, InOut, Shared };  // P5

inline bool is_input(Access access) {
    return access == Access::In || access == Access::InOut;
}
inline bool is_output(Access access) {
    return access == Access::Out || access == Access::InOut;
}

struct Variable {
    std::string name;
    Place line;
    std::optional<Type> type;  // empty: missing or unknown (P7)
    std::string type_word;     // as written; empty if missing
    Place type_line;
    std::optional<Value> initial;  // as written: not yet of the variable's type (P6)
    bool initial_is_text = false;
    Place initial_line;
    std::optional<Access> access = Access::Local;  // empty: an unknown word (P5)
    std::string access_word;
    Place access_line;
    std::string unit;
    std::string help;
};

// What feeds one input: a formula (P3).
struct Entry {
    std::string name;
    Place line;
    std::string text;                // the formula as written; a JSON constant as its text
    std::optional<Formula> formula;  // empty: `error` says why
    std::string error;
};

// What an output writes to (P4, P13).
struct Output {
    std::string name;
    Place line;
    std::string variable;
};

// Where a state or event leads: an actor's name, kTerminate or kIgnore.
inline constexpr std::string_view kTerminate = "@terminate";
inline constexpr std::string_view kIgnore = "@ignore";

struct Rule {
    std::string name;  // of the state or event
    Place line;
    std::string target;
};

struct Supervisor {
    std::string name;
    Place line;
    bool doubled = false;  // its name was there before: not checked further (P1)
    std::optional<std::string> template_name;
    Place template_line;
    std::optional<Value> period_ms;  // any JSON number (P22a)
    Place period_line;
    std::vector<Entry> in;
    std::vector<Output> out;
    std::vector<Rule> events;
    std::string help;
};

struct Actor {
    std::string name;
    Place line;
    bool doubled = false;
    std::optional<std::string> template_name;
    Place template_line;
    std::optional<std::string> plan;  // path as written, relative to the file
    Place plan_line;
    std::vector<Entry> in;
    std::vector<Output> out;
    std::vector<Rule> states;
    std::vector<Supervisor> supervisors;
    std::string help;
};

struct ToolboxName {
    std::string name;
    Place line;
};

struct Spot {  // where the editor draws an element
    std::string name;
    double x = 0;
    double y = 0;
};

struct Plan {
    std::string file;  // path as it was opened
    std::string text;  // that it was read from; empty: it was written in C++
    std::string name;
    std::string help;
    std::vector<ToolboxName> toolboxes;
    std::vector<Variable> configuration;
    std::optional<std::string> start_actor;
    Place start_line;        // of the key `start`; 0 if it is missing
    Place start_actor_line;  // of its key `actor`
    std::vector<Supervisor> globals;
    std::vector<Actor> actors;
    std::vector<Spot> layout;
};

// Indices; -1 if there is none of that name. The first of several.
int find_variable(const Plan& plan, std::string_view name);
int find_actor(const Plan& plan, std::string_view name);

// find_actor() for each target of a plan: in a large one a search each time takes
// minutes. The plan must outlive this, and its actors must stay as they are.
class ActorNames {
public:
    explicit ActorNames(const Plan& plan);
    int find(std::string_view name) const;

private:
    std::map<std::string_view, int> index_;
};

}  // namespace vagus::plan
