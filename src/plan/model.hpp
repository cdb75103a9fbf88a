// A plan as values: what a plan file says, each thing with the line it stands on (docs/plans.md,
// section 2). Reading is in file.hpp, checking in check.hpp; nothing here runs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
    int line = 0;
    std::optional<Type> type;  // empty: missing or unknown (P7)
    std::string type_word;     // as written; empty if missing
    int type_line = 0;
    std::optional<Value> initial;  // as written: not yet of the variable's type (P6)
    bool initial_is_text = false;
    int initial_line = 0;
    std::optional<Access> access = Access::Local;  // empty: an unknown word (P5)
    std::string access_word;
    int access_line = 0;
    std::string unit;
    std::string help;
};

// What feeds one input: a formula (P3).
struct Entry {
    std::string name;
    int line = 0;
    std::string text;                // the formula as written; a JSON constant as its text
    std::optional<Formula> formula;  // empty: `error` says why
    std::string error;
};

// What an output writes to (P4, P13).
struct Output {
    std::string name;
    int line = 0;
    std::string variable;
};

// Where a state or event leads: an actor's name, kTerminate or kIgnore.
inline constexpr std::string_view kTerminate = "@terminate";
inline constexpr std::string_view kIgnore = "@ignore";

struct Rule {
    std::string name;  // of the state or event
    int line = 0;
    std::string target;
};

struct Supervisor {
    std::string name;
    int line = 0;
    bool doubled = false;  // its name stood before: not checked further (P1)
    std::optional<std::string> template_name;
    int template_line = 0;
    std::optional<Value> period_ms;  // any JSON number (P22a)
    int period_line = 0;
    std::vector<Entry> in;
    std::vector<Output> out;
    std::vector<Rule> events;
    std::string help;
};

struct Actor {
    std::string name;
    int line = 0;
    bool doubled = false;
    std::optional<std::string> template_name;
    int template_line = 0;
    std::optional<std::string> plan;  // path as written, relative to the file
    int plan_line = 0;
    std::vector<Entry> in;
    std::vector<Output> out;
    std::vector<Rule> states;
    std::vector<Supervisor> supervisors;
    std::string help;
};

struct ToolboxName {
    std::string name;
    int line = 0;
};

struct Spot {  // where the editor draws an element
    std::string name;
    double x = 0;
    double y = 0;
};

struct Plan {
    std::string file;  // path as it was opened
    std::string name;
    std::string help;
    std::vector<ToolboxName> toolboxes;
    std::vector<Variable> configuration;
    std::optional<std::string> start_actor;
    int start_line = 0;        // of the key `start`; 0 if it is missing
    int start_actor_line = 0;  // of its key `actor`
    std::vector<Supervisor> globals;
    std::vector<Actor> actors;
    std::vector<Spot> layout;
};

// Indices; -1 if there is none of that name. The first of several.
int find_variable(const Plan& plan, std::string_view name);
int find_actor(const Plan& plan, std::string_view name);

// find_actor() for whoever asks for every target of a plan: in a large one a search each time takes
// minutes. The plan must outlive this, and its actors must stay as they are.
class ActorNames {
public:
    explicit ActorNames(const Plan& plan);
    int find(std::string_view name) const;

private:
    std::map<std::string_view, int> index_;
};

}  // namespace vagus::plan
