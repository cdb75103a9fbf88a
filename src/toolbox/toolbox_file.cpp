// Each kind of object in the file has its own reader; all leave their complaints in one list, of
// which the first in the file is told.
#include "toolbox/toolbox_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/file_format.hpp"
#include "base/json.hpp"
#include "base/json_object.hpp"
#include "base/nearest.hpp"
#include "base/project_border.hpp"
#include "plan/formula.hpp"
#include "plan/icon.hpp"
#include "toolbox/toolbox_events.hpp"

namespace vagus::toolbox {

namespace {

using plan::Kind;
using plan::Type;
using plan::Value;

constexpr double kScaleMin = 1e-6;
constexpr double kScaleMax = 1e6;

// What all readers need.
struct Reading {
    Complaints complaints;
    EventChecks events;  // where the file names events of its project

    void complain(Place at, std::string what) {
        if (complaints.size() < kComplaintsMax) complaints.push_back({at, std::move(what)});
    }
};

// ---- names ----

bool is_event_name(std::string_view text) {
    if (text.empty() || text.back() == '.') return false;
    size_t begin = 0;
    for (size_t dot = text.find('.'); begin < text.size(); dot = text.find('.', begin)) {
        const std::string_view part = text.substr(begin, dot - begin);
        if (part.empty()) return false;
        const bool first = begin == 0;
        if (!plan::is_name(first ? std::string(part) : "_" + std::string(part))) return false;
        begin = dot == std::string_view::npos ? text.size() : dot + 1;
    }
    return true;
}

void check_name(Reading& reading, Place at, std::string_view name, std::string_view what) {
    if (name.size() > kNameBytesMax) {
        reading.complain(at, fmt::format("the name of {} has {} bytes; {} are enough", what,
                                         name.size(), kNameBytesMax));
    } else if (!plan::is_name(name)) {
        reading.complain(at, fmt::format("{} cannot be the name of {}: use letters, digits and _, "
                                         "not beginning with a digit",
                                         json_quote(name), what));
    }
}

// The members of an object whose keys are free names, each once and well-formed; at most `max`.
std::vector<const JsonMember*> named_members(Reading& reading, const JsonValue* object,
                                             std::string_view what, size_t max) {
    std::vector<const JsonMember*> kept;
    if (!object) return kept;
    std::set<std::string_view> seen;
    for (const JsonMember& member : object->members) {
        check_name(reading, member.at, member.key, what);
        if (!seen.insert(member.key).second) {
            reading.complain(member.at, fmt::format("there is {} named {} already; give this one "
                                                    "another name",
                                                    what, json_quote(member.key)));
        } else if (kept.size() == max) {
            reading.complain(member.at, fmt::format("this is {} more than the {} there can be; "
                                                    "remove some",
                                                    what, max));
            break;
        } else {
            kept.push_back(&member);
        }
    }
    return kept;
}

// ---- inputs and outputs ----

constexpr std::string_view kTypes[] = {"bool", "int", "float"};

// One entry of `in` or `out`: what is declared to plans, and how it travels.
struct Field {
    plan::Input declared;
    BusValue as;
};

void read_range(Reading& reading, JsonObject& in, const std::string& name, Field& field) {
    const JsonValue* range = in.find("range", JsonKind::Array, Need::Optional);
    if (!range) return;
    const auto& items = range->items;
    const bool numbers = items.size() == 2 && items[0].is_number() && items[1].is_number();
    if (!numbers || items[0].number > items[1].number) {
        reading.complain(range->at,
                         fmt::format("\"range\" of {} must be two numbers, the lower one "
                                     "first, as [0, 31]",
                                     name));
        return;
    }
    field.declared.low = items[0].number;
    field.declared.high = items[1].number;
}

Value constant_of(const JsonValue& json, Type type) {
    if (type == Type::Bool) return Value(json.boolean);
    return type == Type::Int ? Value(json.integer) : Value(json.number);
}

void read_default(Reading& reading, JsonObject& in, const std::string& name, Field& field) {
    const Type type = *field.declared.type;
    const JsonKind kind = type == Type::Bool  ? JsonKind::Bool
                          : type == Type::Int ? JsonKind::Int
                                              : JsonKind::Float;
    const JsonValue* json = in.find("default", kind, Need::Optional);
    if (!json) return;
    const Value value = constant_of(*json, type);
    std::vector<int16_t> words;
    const Status fits = encode(field.declared, field.as, value, words);
    if (!fits.ok()) {
        reading.complain(json->at, fmt::format("\"default\" of {}: {}", name, fits.error().what));
    }
    field.declared.fallback = value;
}

// What makes no sense for this type or direction is complained of where it is.
void refuse(Reading& reading, JsonObject& in, const std::string& name, std::string_view key,
            std::string_view why) {
    if (const JsonValue* json = in.find(key, Need::Optional)) {
        reading.complain(json->at,
                         fmt::format("{} has a \"{}\", but {}; remove it", name, key, why));
    }
}

Field read_field(Reading& reading, const JsonMember& member, bool is_input,
                 const std::string& owner) {
    const std::string name =
        fmt::format("{} \"{}\" of {}", is_input ? "input" : "output", member.key, owner);
    JsonObject in(member.value, name, reading.complaints);
    Field field;
    field.declared.name = member.key;
    const std::string type =
        in.word("type", {std::begin(kTypes), std::end(kTypes)}, Need::Required, "float");
    field.declared.type = plan::type_named(type);
    field.declared.unit = in.text("unit", Need::Optional);
    field.declared.help = in.text("help", Need::Optional);
    field.as.words = static_cast<int>(in.integer("words", {.low = 1, .high = 2, .fallback = 1}));
    if (type == "bool") {
        refuse(reading, in, name, "scale", "a bool is 0 or 1 on the bus");
        refuse(reading, in, name, "range", "a bool is 0 or 1");
    } else {
        field.as.scale = in.number("scale", {.low = kScaleMin, .high = kScaleMax, .fallback = 1});
        read_range(reading, in, name, field);
    }
    if (is_input) {
        read_default(reading, in, name, field);
    } else {
        refuse(reading, in, name, "default", "an output has what its event brings");
    }
    in.finish();
    return field;
}

void read_inputs(Reading& reading, JsonObject& in, BusTemplate& made) {
    const JsonValue* list = in.find("in", JsonKind::Object, Need::Optional);
    int words = 1;  // the token
    for (const JsonMember* member :
         named_members(reading, list, "an input", run::kEventArgumentsMax)) {
        Field field = read_field(reading, *member, true, in.name());
        words += field.as.words;
        if (words > static_cast<int>(run::kEventArgumentsMax)) {
            reading.complain(member->at,
                             fmt::format("the token and the inputs of {} up to this one need {} "
                                         "words, but an event carries {}; remove inputs",
                                         in.name(), words, run::kEventArgumentsMax));
            return;
        }
        made.declared.inputs.push_back(std::move(field.declared));
        made.inputs.push_back(field.as);
    }
}

void read_outputs(Reading& reading, JsonObject& in, BusTemplate& made) {
    const JsonValue* list = in.find("out", JsonKind::Object, Need::Optional);
    for (const JsonMember* member : named_members(reading, list, "an output", kOutputsMax)) {
        Field field = read_field(reading, *member, false, in.name());
        made.declared.outputs.push_back({.name = field.declared.name,
                                         .type = field.declared.type,
                                         .unit = field.declared.unit,
                                         .help = field.declared.help});
        made.outputs.push_back(field.as);
    }
}

// ---- events ----

// The event that `key` names; empty if there is none or it cannot be one.
std::string read_event(Reading& reading, JsonObject& in, std::string_view key, Need need) {
    const JsonValue* json = in.find(key, JsonKind::String, need);
    if (!json) return {};
    if (json->text.size() <= kNameBytesMax && is_event_name(json->text)) return json->text;
    reading.complain(json->at,
                     fmt::format("\"{}\" of {} is {}, which cannot be the name of an event: use "
                                 "letters, digits, _ and single dots, at most {}",
                                 key, in.name(), json_quote(json->text.substr(0, kNameBytesMax)),
                                 kNameBytesMax));
    return {};
}

// The outputs that an event brings, as indices; `words` counts with its token.
std::vector<size_t> read_brought(Reading& reading, JsonObject& in, const BusTemplate& made,
                                 size_t& words) {
    std::vector<size_t> brought;
    std::vector<std::string> known;
    for (const auto& output : made.declared.outputs) known.push_back(output.name);
    for (const JsonValue& item : in.items("out", Need::Optional)) {
        const int found =
            item.kind == JsonKind::String ? plan::find_output(made.declared, item.text) : -1;
        const auto index = static_cast<size_t>(found);
        if (found < 0) {
            const std::string near = nearest(item.text, known);
            reading.complain(item.at,
                             fmt::format("{} is in \"out\" of {}, but no output of that name is "
                                         "declared; {}",
                                         item.kind == JsonKind::String ? json_quote(item.text)
                                                                       : name_of(item.kind),
                                         in.name(),
                                         near.empty() ? "declare it in \"out\" of the template"
                                                      : fmt::format("did you mean \"{}\"?", near)));
        } else if (std::find(brought.begin(), brought.end(), index) != brought.end()) {
            reading.complain(item.at, fmt::format("\"{}\" is twice in \"out\" of {}; keep one",
                                                  item.text, in.name()));
        } else {
            words += static_cast<size_t>(made.outputs[index].words);
            brought.push_back(index);
        }
    }
    return brought;
}

void check_unlike(Reading& reading, Place at, const std::string& event, const BusTemplate& made,
                  const std::string& name) {
    const std::pair<std::string_view, const std::string*> taken[] = {{"start", &made.start},
                                                                     {"stop", &made.stop},
                                                                     {"stopped", &made.stopped},
                                                                     {"alive", &made.alive},
                                                                     {"ended", &made.ended}};
    for (const auto& [key, other] : taken) {
        if (event != *other) continue;
        reading.complain(at, fmt::format("\"{}\", the event of {}, is its template's \"{}\" too; "
                                         "give it an event of its own",
                                         event, name, key));
    }
    for (const BusOutcome& outcome : made.outcomes) {
        if (event != outcome.event) continue;
        reading.complain(at, fmt::format("\"{}\", the event of {}, brings another of them already; "
                                         "give it an event of its own",
                                         event, name));
    }
}

void read_outcome(Reading& reading, const JsonMember& member, std::string_view what,
                  BusTemplate& made) {
    const std::string name =
        fmt::format("{} \"{}\" of template \"{}\"", what, member.key, made.declared.name);
    JsonObject in(member.value, name, reading.complaints);
    BusOutcome outcome;
    outcome.event = read_event(reading, in, "event", Need::Required);
    size_t words = 1;
    outcome.outputs = read_brought(reading, in, made, words);
    const JsonValue* event = in.find("event", Need::Optional);
    const JsonValue* out = in.find("out", Need::Optional);
    if (words > run::kEventArgumentsMax) {
        reading.complain(out->at, fmt::format("the token and \"out\" of {} need {} words, but an "
                                              "event carries {}; bring fewer outputs",
                                              name, words, run::kEventArgumentsMax));
    }
    if (!outcome.event.empty()) {
        check_unlike(reading, event->at, outcome.event, made, name);
        reading.events.push_back({event->at, outcome.event, words, false, name});
    }
    made.declared.outcomes.push_back({member.key, in.text("help", Need::Optional)});
    made.outcomes.push_back(std::move(outcome));
    in.finish();
}

// ---- templates ----

void read_nodes(Reading& reading, JsonObject& in, BusTemplate& made) {
    const JsonValue* node = in.find("node", Need::Required);
    if (!node) return;
    std::vector<const JsonValue*> items;
    if (node->kind != JsonKind::Array) items.push_back(node);
    for (const JsonValue& item : node->items) items.push_back(&item);
    if (items.empty() || items.size() > kNodeNamesMax) {
        reading.complain(node->at, fmt::format("\"node\" of {} must be the name of a node, or a "
                                               "list of 1 to {} names, of which the first on the "
                                               "bus does the work; it has {}",
                                               in.name(), kNodeNamesMax, items.size()));
        return;
    }
    for (const JsonValue* item : items) {
        if (item->kind != JsonKind::String || item->text.empty() ||
            item->text.size() > kNameBytesMax) {
            reading.complain(item->at, fmt::format("\"node\" of {} must be the name of a node, of "
                                                   "1 to {} bytes, in quotes",
                                                   in.name(), kNameBytesMax));
        } else if (std::find(made.nodes.begin(), made.nodes.end(), item->text) !=
                   made.nodes.end()) {
            reading.complain(item->at, fmt::format("the node {} is twice in {}; keep one",
                                                   json_quote(item->text), in.name()));
        } else {
            made.nodes.push_back(item->text);
        }
    }
}

// `start`, `stop`, `stopped`, `alive` and `ended`, by the rules of the template's kind.
void read_commands(Reading& reading, JsonObject& in, BusTemplate& made) {
    const bool actor = made.declared.kind != Kind::Supervisor;
    made.start = read_event(reading, in, "start", Need::Required);
    made.stop = read_event(reading, in, "stop", Need::Optional);
    if (actor) {
        made.stopped = read_event(reading, in, "stopped", Need::Optional);
        made.alive = read_event(reading, in, "alive", Need::Optional);
        made.ended = read_event(reading, in, "ended", Need::Optional);
    } else {
        const std::string_view why = "nobody waits until a supervisor has stopped";
        refuse(reading, in, in.name(), "stopped", why);
        refuse(reading, in, in.name(), "alive", "only an actor is kept alive");
        refuse(reading, in, in.name(), "ended", "only the work of an actor ends");
    }
    const JsonValue* stop = in.find("stop", Need::Optional);
    const JsonValue* stopped = in.find("stopped", Need::Optional);
    if (actor && (stop == nullptr) != (stopped == nullptr)) {
        reading.complain(
            (stop ? stop : stopped)->at,
            fmt::format("{} has \"{}\" but no \"{}\"; an actor has both, or neither if "
                        "its node need not stop",
                        in.name(), stop ? "stop" : "stopped", stop ? "stopped" : "stop"));
    }
    size_t words = 1;
    for (const BusValue& input : made.inputs) words += static_cast<size_t>(input.words);
    std::set<std::string> seen;
    for (const std::string_view key : {"start", "stop", "stopped", "alive", "ended"}) {
        const JsonValue* json = in.find(key, Need::Optional);
        if (!json || json->kind != JsonKind::String) continue;
        if (!seen.insert(json->text).second) {
            reading.complain(json->at, fmt::format("\"{}\" of {} is an event that another key of "
                                                   "it names already; give it one of its own",
                                                   key, in.name()));
        }
        reading.events.push_back({json->at, json->text, key == "start" ? words : 1,
                                  key != "stopped" && key != "ended",
                                  fmt::format("\"{}\" of {}", key, in.name())});
    }
}

void read_icon(Reading& reading, JsonObject& in, plan::Template& declared) {
    const JsonValue* icon = in.find("icon", JsonKind::String, Need::Optional);
    if (!icon) return;
    declared.icon = icon->text;
    if (plan::is_path_data(icon->text)) return;
    reading.complain(icon->at,
                     fmt::format("\"icon\" of {} must be SVG path data on a field of 24 x 24, {} "
                                 "bytes at most, as \"M4 12h16M12 4v16\"",
                                 in.name(), plan::kIconBytesMax));
}

BusTemplate read_template(Reading& reading, const JsonMember& member) {
    JsonObject in(member.value, fmt::format("template \"{}\"", member.key), reading.complaints);
    BusTemplate made;
    made.declared.name = member.key;
    made.declared.line = member.at.line;
    const std::string kind = in.word("kind", {"actor", "supervisor"}, Need::Required, "actor");
    const bool actor = kind == "actor";
    made.declared.kind = actor ? Kind::Actor : Kind::Supervisor;
    if (!actor) made.declared.period_ms = 0;
    made.declared.help = in.text("help", Need::Optional);
    read_icon(reading, in, made.declared);
    read_nodes(reading, in, made);
    read_inputs(reading, in, made);
    read_outputs(reading, in, made);
    read_commands(reading, in, made);
    const std::string_view list = actor ? "states" : "events";
    const std::string_view one = actor ? "state" : "event";
    if (in.find("kind", Need::Optional)) {  // else it is not known which of the two is right
        refuse(reading, in, in.name(), actor ? "events" : "states",
               actor ? "an actor has \"states\"" : "a supervisor has \"events\"");
    }
    const JsonValue* outcomes = in.find(list, JsonKind::Object, Need::Required);
    for (const JsonMember* outcome :
         named_members(reading, outcomes, actor ? "a state" : "an event", kOutcomesMax)) {
        read_outcome(reading, *outcome, one, made);
    }
    in.finish();
    return made;
}

void check_toolbox_name(Reading& reading, JsonObject& in, const std::string& name) {
    const JsonValue* json = in.find("name", Need::Optional);
    if (!json || json->kind != JsonKind::String) return;
    check_name(reading, json->at, name, "a toolbox");
    if (name == plan::kCoreToolbox) {
        reading.complain(json->at,
                         "\"core\" is the toolbox that is always there; give this one "
                         "another name");
    }
}

ToolboxFile read_all(Reading& reading, const JsonValue& json, const std::string& path,
                     const ReadProject& read_project) {
    JsonObject in(json, "the toolbox", reading.complaints);
    ToolboxFile file;
    check_format(in, FileFormat::Toolbox);
    file.name = in.text("name", Need::Required);
    check_toolbox_name(reading, in, file.name);
    file.help = in.text("help", Need::Optional);
    file.project = in.text("project", Need::Required);
    const JsonValue* templates = in.find("templates", JsonKind::Object, Need::Required);
    for (const JsonMember* member :
         named_members(reading, templates, "a template", kTemplatesMax)) {
        file.templates.push_back(read_template(reading, *member));
    }
    file.safe_stop = read_safe_stop(in, reading.complaints);
    in.finish();
    const JsonValue* project = in.find("project", Need::Optional);
    if (!read_project || !project || project->kind != JsonKind::String) return file;
    const Result<std::string> beside = path_beside(path, file.project);
    if (!beside.ok()) {
        in.complain(project->at, beside.error().what);
        return file;
    }
    check_events(reading.events, beside.value(), project->at, read_project, reading.complaints);
    return file;
}

Result<JsonValue> parse(std::string_view text, const std::string& file) {
    if (text.size() > kToolboxBytesMax) {
        return Error{Code::Limit, fmt::format("{} has {} bytes; a toolbox file has at most {}",
                                              file, text.size(), kToolboxBytesMax)};
    }
    return parse_format(text, file, FileFormat::Toolbox);
}

}  // namespace

Result<ToolboxFile> read_toolbox(std::string_view text, const std::string& file,
                                 const ReadProject& read_project) {
    const JsonValue json = TRY(parse(text, file));
    Reading reading;
    ToolboxFile read = read_all(reading, json, file, read_project);
    if (!reading.complaints.empty()) return first_complaint(reading.complaints, file);
    return read;
}

std::vector<Error> mistakes_of_toolbox(std::string_view text, const std::string& file,
                                       const ReadProject& read_project) {
    const Result<JsonValue> json = parse(text, file);
    if (!json.ok()) return {json.error()};
    Reading reading;
    read_all(reading, json.value(), file, read_project);
    return errors_of(std::move(reading.complaints), file);
}

}  // namespace vagus::toolbox
