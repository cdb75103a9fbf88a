// Reads a plan file into the model. Each level has its own function; all complain with the same
// words through `Reader`.
#include "plan/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <span>

#include "base/file_format.hpp"
#include "base/json.hpp"
#include "base/nearest.hpp"
#include "base/text.hpp"
#include "plan/keys.hpp"

namespace vagus::plan {

namespace {

constexpr std::string_view kFormat = "vagus-plan/1";

std::string_view article(std::string_view what) {
    return what == "actor" ? "an" : "a";
}

class Reader {
public:
    explicit Reader(PlanFile& file) : file_(file) {}

    void complain(std::string_view rule, std::string_view element, Place at, std::string message,
                  std::optional<Meant> meant = std::nullopt) {
        file_.findings.push_back({Severity::Error, std::string(rule), file_.plan.file, "",
                                  std::string(element), at.line, std::move(message), at.column,
                                  std::move(meant)});
    }

    // Complains of a value that is not of the kind; gives whether it is.
    bool is(const JsonMember& member, JsonKind kind, std::string_view element) {
        const bool number = kind == JsonKind::Float && member.value.is_number();
        if (member.value.kind == kind || number) return true;
        complain("P0", element, member.at,
                 fmt::format("\"{}\" must be {}, but is {}", member.key,
                             kind == JsonKind::Float ? "a number" : name_of(kind),
                             name_of(member.value.kind)));
        return false;
    }

    std::string text(const JsonMember& member, std::string_view element) {
        return is(member, JsonKind::String, element) ? member.value.text : std::string();
    }

    // The members of an object that has these keys and no others, each once.
    std::vector<const JsonMember*> members(const JsonValue& object, Keys keys,
                                           std::string_view what, std::string_view element) {
        std::vector<const JsonMember*> kept;
        for (const JsonMember& member : once(object, element)) {
            if (std::find(keys.begin(), keys.end(), member.key) != keys.end()) {
                kept.push_back(&member);
                continue;
            }
            const std::vector<std::string_view> known(keys.begin(), keys.end());
            const std::string near = nearest(member.key, known);
            complain("P0", element, member.at,
                     fmt::format("{} has no key \"{}\"{}; its keys are {}", what, member.key,
                                 near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near),
                                 list_of(known)),
                     near.empty() ? std::nullopt : std::optional(Meant{member.key, near, true}));
        }
        return kept;
    }

    // Members whose keys are free names, each once.
    std::vector<std::reference_wrapper<const JsonMember>> once(const JsonValue& object,
                                                               std::string_view element) {
        std::vector<std::reference_wrapper<const JsonMember>> kept;
        std::set<std::string_view> seen;
        for (const JsonMember& member : object.members) {
            if (seen.insert(member.key).second) {
                kept.push_back(member);
                continue;
            }
            complain("P0", element, member.at,
                     fmt::format("the key \"{}\" is here twice; delete one of them", member.key));
        }
        return kept;
    }

    // Whether a name is well-formed; complains if not (P1).
    void check_name(std::string_view name, std::string_view what, Place line) {
        if (what == "variable" ? is_variable_name(name) : is_name(name)) return;
        const std::string_view element = what == "plan" ? std::string_view() : name;
        complain("P1", element, line,
                 fmt::format("\"{}\" cannot be the name of {} {}: use letters, digits and _, not "
                             "beginning with a digit{}",
                             name, article(what), what, what == "variable" ? kNotReserved : ""));
    }

    // Complains of the second of two equal names (P1); gives whether this is one.
    bool check_double(std::set<std::string, std::less<>>& seen, std::string_view name,
                      std::string_view what, Place line) {
        if (seen.insert(std::string(name)).second) return false;
        complain("P1", name, line,
                 fmt::format("there is {} {} named \"{}\" already; give this one another name",
                             article(what), what, name));
        return true;
    }

    Plan& plan() { return file_.plan; }

private:
    PlanFile& file_;
};

Value value_of(const JsonValue& json) {
    switch (json.kind) {
        case JsonKind::Bool:
            return Value(json.boolean);
        case JsonKind::Int:
            return Value(json.integer);
        case JsonKind::Float:
            return Value(json.number);
        case JsonKind::String:
            return Value(json.text);
        case JsonKind::Null:
        case JsonKind::Array:
        case JsonKind::Object:
            break;
    }
    assert(false);
    return Value();
}

bool is_constant(const JsonValue& json) {
    return json.kind == JsonKind::Bool || json.is_number() || json.kind == JsonKind::String;
}

// ---- the parts of an actor or supervisor ----

Entry read_entry(const JsonMember& member) {
    Entry entry{.name = member.key, .line = member.at, .text = {}, .formula = {}, .error = {}};
    if (member.value.kind != JsonKind::String) {
        entry.formula = Formula(value_of(member.value));
        entry.text = member.value.kind == JsonKind::Bool ? (member.value.boolean ? "true" : "false")
                                                         : member.value.text;
        return entry;
    }
    entry.text = member.value.text;
    Result<Formula> parsed = parse_formula(entry.text);
    if (parsed.ok()) {
        entry.formula = std::move(parsed.value());
    } else {
        entry.error = parsed.error().what;
    }
    return entry;
}

std::vector<Entry> read_entries(Reader& reader, const JsonMember& in, std::string_view element) {
    std::vector<Entry> entries;
    if (!reader.is(in, JsonKind::Object, element)) return entries;
    for (const JsonMember& member : reader.once(in.value, element)) {
        if (is_constant(member.value)) {
            entries.push_back(read_entry(member));
            continue;
        }
        reader.complain("P0", element, member.at,
                        fmt::format("the input \"{}\" must be a formula in quotes, a number, true "
                                    "or false, but is {}",
                                    member.key, name_of(member.value.kind)));
    }
    return entries;
}

// Names to texts: outputs, states, events.
template <typename Item>
std::vector<Item> read_texts(Reader& reader, const JsonMember& list, std::string_view element) {
    std::vector<Item> items;
    if (!reader.is(list, JsonKind::Object, element)) return items;
    for (const JsonMember& member : reader.once(list.value, element)) {
        if (!reader.is(member, JsonKind::String, element)) continue;
        items.push_back(Item{member.key, member.at, member.value.text});
    }
    return items;
}

// ---- elements ----

Supervisor read_supervisor(Reader& reader, const JsonMember& member) {
    Supervisor supervisor;
    supervisor.name = member.key;
    supervisor.line = member.at;
    if (!reader.is(member, JsonKind::Object, member.key)) return supervisor;
    const std::string_view name = member.key;
    for (const JsonMember* part :
         reader.members(member.value, kSupervisorKeys, "a supervisor", name)) {
        if (part->key == "template") {
            supervisor.template_name = reader.text(*part, name);
            supervisor.template_line = part->at;
        } else if (part->key == "period_ms") {
            if (reader.is(*part, JsonKind::Float, name)) {
                supervisor.period_ms = value_of(part->value);
            }
            supervisor.period_line = part->at;
        } else if (part->key == "in") {
            supervisor.in = read_entries(reader, *part, name);
        } else if (part->key == "out") {
            supervisor.out = read_texts<Output>(reader, *part, name);
        } else if (part->key == "events") {
            supervisor.events = read_texts<Rule>(reader, *part, name);
        } else if (part->key == "help") {
            supervisor.help = reader.text(*part, name);
        }
    }
    return supervisor;
}

std::vector<Supervisor> read_supervisors(Reader& reader, const JsonMember& list,
                                         std::string_view element) {
    std::vector<Supervisor> supervisors;
    if (!reader.is(list, JsonKind::Object, element)) return supervisors;
    for (const JsonMember& member : list.value.members) {
        supervisors.push_back(read_supervisor(reader, member));
    }
    return supervisors;
}

Actor read_actor(Reader& reader, const JsonMember& member) {
    Actor actor;
    actor.name = member.key;
    actor.line = member.at;
    if (!reader.is(member, JsonKind::Object, member.key)) return actor;
    const std::string_view name = member.key;
    for (const JsonMember* part : reader.members(member.value, kActorKeys, "an actor", name)) {
        if (part->key == "template") {
            actor.template_name = reader.text(*part, name);
            actor.template_line = part->at;
        } else if (part->key == "plan") {
            actor.plan = reader.text(*part, name);
            actor.plan_line = part->at;
        } else if (part->key == "in") {
            actor.in = read_entries(reader, *part, name);
        } else if (part->key == "out") {
            actor.out = read_texts<Output>(reader, *part, name);
        } else if (part->key == "states") {
            actor.states = read_texts<Rule>(reader, *part, name);
        } else if (part->key == "supervisors") {
            actor.supervisors = read_supervisors(reader, *part, name);
        } else if (part->key == "help") {
            actor.help = reader.text(*part, name);
        }
    }
    return actor;
}

std::optional<Access> access_named(std::string_view word) {
    if (word == "in") return Access::In;
    if (word == "out") return Access::Out;
    if (word == "inout") return Access::InOut;
    if (word == "shared") return Access::Shared;
    return std::nullopt;
}

void read_initial(Reader& reader, const JsonMember& part, Variable& variable) {
    variable.initial_line = part.at;
    if (is_constant(part.value)) {
        variable.initial = value_of(part.value);
        return;
    }
    reader.complain("P0", variable.name, part.at,
                    fmt::format("\"initial\" must be a number, a text, true or false, but is {}",
                                name_of(part.value.kind)));
}

Variable read_variable(Reader& reader, const JsonMember& member) {
    Variable variable;
    variable.name = member.key;
    variable.line = member.at;
    if (!reader.is(member, JsonKind::Object, member.key)) return variable;
    const std::string_view name = member.key;
    for (const JsonMember* part : reader.members(member.value, kVariableKeys, "a variable", name)) {
        if (part->key == "type") {
            variable.type_word = reader.text(*part, name);
            variable.type = type_named(variable.type_word);
            variable.type_line = part->at;
        } else if (part->key == "initial") {
            read_initial(reader, *part, variable);
        } else if (part->key == "unit") {
            variable.unit = reader.text(*part, name);
        } else if (part->key == "help") {
            variable.help = reader.text(*part, name);
        } else if (part->key == "access") {
            variable.access_word = reader.text(*part, name);
            variable.access = access_named(variable.access_word);
            variable.access_line = part->at;
        }
    }
    return variable;
}

// ---- the plan ----

void read_start(Reader& reader, const JsonMember& member) {
    Plan& plan = reader.plan();
    plan.start_line = member.at;
    if (!reader.is(member, JsonKind::Object, "")) return;
    for (const JsonMember* part : reader.members(member.value, kStartKeys, "\"start\"", "")) {
        if (part->key == "actor") {
            plan.start_actor = reader.text(*part, "");
            plan.start_actor_line = part->at;
        } else if (part->key == "supervisors") {
            plan.globals = read_supervisors(reader, *part, "");
        }
    }
}

void read_toolboxes(Reader& reader, const JsonMember& member) {
    if (!reader.is(member, JsonKind::Array, "")) return;
    for (const JsonValue& item : member.value.items) {
        if (item.kind == JsonKind::String) {
            reader.plan().toolboxes.push_back({item.text, item.at});
            continue;
        }
        reader.complain(
            "P0", "", item.at,
            fmt::format("a toolbox is named by a text in quotes, not by {}", name_of(item.kind)));
    }
}

void read_layout(Reader& reader, const JsonMember& member) {
    if (!reader.is(member, JsonKind::Object, "")) return;
    for (const JsonMember& spot : reader.once(member.value, "")) {
        const std::vector<JsonValue>& items = spot.value.items;
        if (spot.value.kind == JsonKind::Array && items.size() == 2 && items[0].is_number() &&
            items[1].is_number()) {
            reader.plan().layout.push_back({spot.key, items[0].number, items[1].number});
            continue;
        }
        reader.complain(
            "P0", "", spot.at,
            fmt::format("the place of \"{}\" must be two numbers, as [120, 80]", spot.key));
    }
}

void read_part(Reader& reader, const JsonMember& part) {
    Plan& plan = reader.plan();
    if (part.key == "format") {
        const std::string format = reader.text(part, "");
        if (part.value.kind == JsonKind::String && format != kFormat) {
            reader.complain(
                "P0", "", part.at,
                fmt::format("the format must be \"{}\", but is \"{}\"", kFormat, format));
        }
    } else if (part.key == "name") {
        plan.name = reader.text(part, "");
    } else if (part.key == "help") {
        plan.help = reader.text(part, "");
    } else if (part.key == "toolboxes") {
        read_toolboxes(reader, part);
    } else if (part.key == "configuration") {
        if (!reader.is(part, JsonKind::Object, "")) return;
        for (const JsonMember& member : part.value.members) {
            plan.configuration.push_back(read_variable(reader, member));
        }
    } else if (part.key == "start") {
        read_start(reader, part);
    } else if (part.key == "actors") {
        if (!reader.is(part, JsonKind::Object, "")) return;
        for (const JsonMember& member : part.value.members) {
            plan.actors.push_back(read_actor(reader, member));
        }
    } else if (part.key == "layout") {
        read_layout(reader, part);
    }
}

void read_plan(Reader& reader, const JsonValue& json) {
    if (json.kind != JsonKind::Object) {
        reader.complain("P0", "", json.at,
                        fmt::format("a plan file holds one object, not {}", name_of(json.kind)));
        return;
    }
    for (const JsonMember* part : reader.members(json, kPlanKeys, "a plan", "")) {
        read_part(reader, *part);
    }
    for (const std::string_view needed : {"format", "name", "actors"}) {
        if (json.find(needed)) continue;
        reader.complain("P0", "", {1, 1},
                        fmt::format("the plan lacks the key \"{}\"; add it", needed));
    }
}

// ---- names (P1) ----

void check_supervisor_names(Reader& reader, std::vector<Supervisor>& supervisors,
                            std::set<std::string, std::less<>>& seen) {
    for (Supervisor& supervisor : supervisors) {
        reader.check_name(supervisor.name, "supervisor", supervisor.line);
        supervisor.doubled =
            reader.check_double(seen, supervisor.name, "supervisor", supervisor.line);
    }
}

void check_names(Reader& reader, const JsonValue& json) {
    Plan& plan = reader.plan();
    for (const JsonMember& part : json.members) {
        if (part.key == "name") reader.check_name(plan.name, "plan", part.at);
    }
    std::set<std::string, std::less<>> variables, actors, supervisors;
    std::vector<Variable> kept;
    for (Variable& variable : plan.configuration) {
        reader.check_name(variable.name, "variable", variable.line);
        if (!reader.check_double(variables, variable.name, "variable", variable.line)) {
            kept.push_back(std::move(variable));
        }
    }
    plan.configuration = std::move(kept);
    check_supervisor_names(reader, plan.globals, supervisors);
    for (Actor& actor : plan.actors) {
        reader.check_name(actor.name, "actor", actor.line);
        actor.doubled = reader.check_double(actors, actor.name, "actor", actor.line);
        if (!actor.doubled) check_supervisor_names(reader, actor.supervisors, supervisors);
    }
}

}  // namespace

namespace {

const JsonMember* find_member(const JsonValue& json, std::string_view key) {
    for (const JsonMember& member : json.members) {
        if (member.key == key) return &member;
    }
    return nullptr;
}

}  // namespace

PlanFile parse_plan(std::string_view text, std::string_view path) {
    PlanFile file;
    file.plan.file = std::string(path);
    file.plan.text = std::string(text);
    Reader reader(file);
    const std::variant<JsonValue, JsonError> parsed = read_json(text);
    if (const JsonError* error = std::get_if<JsonError>(&parsed)) {
        const auto other = other_format(text, FileFormat::Plan);
        reader.complain("P0", "", error->at, other.value_or(error->what));
        return file;
    }
    const JsonValue& json = std::get<JsonValue>(parsed);
    if (const auto other = other_format(json, FileFormat::Plan)) {
        const JsonMember* const format = find_member(json, "format");
        reader.complain("P0", "", format == nullptr ? json.at : format->at, *other);
        return file;
    }
    read_plan(reader, json);
    file.readable = file.findings.empty();
    if (file.readable) check_names(reader, json);
    for (Finding& finding : file.findings) finding.plan = file.plan.name;
    return file;
}

}  // namespace vagus::plan
