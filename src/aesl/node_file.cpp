// Node files: reading with every complaint placed, writing through base/json.
#include "aesl/node_file.hpp"

#include <fmt/format.h>

#include <set>

#include "base/file_format.hpp"
#include "base/json_object.hpp"

namespace vagus::aesl {
namespace {

constexpr int64_t kWordMax = UINT16_MAX;

// The `name` of one entry of a list; `others` are the names before it.
std::string read_name(JsonObject& entry, Complaints& complaints, std::set<std::string>& others) {
    const JsonValue* json = entry.find("name", JsonKind::String, Need::Required);
    if (json == nullptr) return "";
    if (json->text.empty())
        complaints.push_back(
            {json->at, fmt::format("\"name\" of {} is empty; give it a name", entry.name())});
    if (json->text.size() > kNameBytesMax)
        complaints.push_back(
            {json->at, fmt::format("\"name\" of {} has {} bytes; use at most {}", entry.name(),
                                   json->text.size(), kNameBytesMax)});
    if (!others.insert(json->text).second)
        complaints.push_back({json->at, fmt::format("{} has the name of an earlier one, {}; "
                                                    "rename one of them",
                                                    entry.name(), json_quote(json->text))});
    return json->text;
}

uint16_t read_word(JsonObject& object, std::string_view key, int64_t low, Need need,
                   int64_t fallback) {
    return static_cast<uint16_t>(
        object.integer(key, {.low = low, .high = kWordMax, .fallback = fallback, .need = need}));
}

// Reads the list under `key`: `read` makes one entry of each object, called "`what` N" in
// sentences.
template <typename Entry, typename Read>
std::vector<Entry> read_list(JsonObject& object, std::string_view key, Need need,
                             std::string_view what, Complaints& complaints, const Read& read) {
    std::vector<Entry> entries;
    std::set<std::string> names;
    for (const JsonValue& item : object.items(key, need)) {
        JsonObject entry(item, fmt::format("{} {}", what, entries.size() + 1), complaints);
        entries.push_back(read(entry, read_name(entry, complaints, names)));
        entry.finish();
    }
    return entries;
}

NamedVariable read_variable(JsonObject& entry, std::string name) {
    return {std::move(name), read_word(entry, "size", 1, Need::Required, 1)};
}

LocalEvent read_local_event(JsonObject& entry, std::string name) {
    return {std::move(name), entry.text("doc", Need::Optional)};
}

GlobalEvent read_event(JsonObject& entry, std::string name) {
    GlobalEvent event{std::move(name), std::nullopt};
    const int64_t size = entry.integer("size", {.low = 0, .high = kEventWordsMax, .fallback = -1});
    if (size >= 0) event.size = static_cast<uint16_t>(size);
    return event;
}

Constant read_constant(JsonObject& entry, std::string name) {
    const int64_t value =
        entry.integer("value", {.low = INT32_MIN, .high = INT32_MAX, .need = Need::Required});
    return {std::move(name), static_cast<int32_t>(value)};
}

NativeParameter read_parameter(JsonObject& entry, std::string name) {
    const int64_t size = entry.integer(
        "size", {.low = INT16_MIN, .high = INT16_MAX, .fallback = 1, .need = Need::Required});
    return {std::move(name), static_cast<int16_t>(size)};
}

NativeFunction read_native(JsonObject& entry, std::string name, Complaints& complaints) {
    NativeFunction native{std::move(name), entry.text("doc", Need::Optional), {}};
    native.parameters = read_list<NativeParameter>(
        entry, "params", Need::Optional, entry.name() + ", parameter", complaints, read_parameter);
    return native;
}

void check_count(JsonObject& object, std::string_view key, size_t count, size_t most) {
    if (count <= most) return;
    object.complain(object.find(key, Need::Optional)->at,
                    fmt::format("\"{}\" of {} has {} entries; a node has at most {}", key,
                                object.name(), count, most));
}

void read_lists(JsonObject& object, NodeFile& node, Complaints& complaints) {
    Target& target = node.target;
    target.variables = read_list<NamedVariable>(object, "variables", Need::Required, "variable",
                                                complaints, read_variable);
    target.local_events = read_list<LocalEvent>(object, "localEvents", Need::Optional,
                                                "local event", complaints, read_local_event);
    node.common.events =
        read_list<GlobalEvent>(object, "events", Need::Optional, "event", complaints, read_event);
    node.common.constants = read_list<Constant>(object, "constants", Need::Optional, "constant",
                                                complaints, read_constant);
    target.natives =
        read_list<NativeFunction>(object, "natives", Need::Optional, "native function", complaints,
                                  [&complaints](JsonObject& entry, std::string name) {
                                      return read_native(entry, std::move(name), complaints);
                                  });
    check_count(object, "variables", target.variables.size(), kWordMax);
    check_count(object, "localEvents", target.local_events.size(), kLocalEventsMax);
    check_count(object, "natives", target.natives.size(), kNativesMax);
}

NodeFile read_node(const JsonValue& json, Complaints& complaints) {
    NodeFile node;
    JsonObject object(json, "the node", complaints);
    std::set<std::string> no_others;
    node.target.name = read_name(object, complaints, no_others);
    node.target.protocol_version = read_word(object, "protocolVersion", 0, Need::Optional, 5);
    node.target.bytecode_size = read_word(object, "bytecodeSize", 1, Need::Required, 1);
    node.target.variables_size = read_word(object, "variablesSize", 1, Need::Required, 1);
    node.target.stack_size = read_word(object, "stackSize", 1, Need::Required, 1);
    read_lists(object, node, complaints);
    object.finish();
    return node;
}

// An array of what `write` makes of each entry.
template <typename Entry, typename Write>
JsonValue write_list(const std::vector<Entry>& entries, const Write& write) {
    std::vector<JsonValue> items;
    for (const Entry& entry : entries) items.push_back(write(entry));
    return json_array(std::move(items));
}

JsonValue with_number(const std::string& name, std::string_view key, int64_t number) {
    return json_object({json_member("name", name), json_member(key, json_integer(number))});
}

void add_doc(JsonValue& object, const std::string& doc) {
    if (!doc.empty()) object.members.push_back(json_member("doc", doc));
}

JsonValue write_local_event(const LocalEvent& event) {
    JsonValue json = json_object({json_member("name", event.name)});
    add_doc(json, event.doc);
    return json;
}

JsonValue write_event(const GlobalEvent& event) {
    if (event.size) return with_number(event.name, "size", *event.size);
    return json_object({json_member("name", event.name)});
}

JsonValue write_native(const NativeFunction& native) {
    JsonValue json = json_object({json_member("name", native.name)});
    add_doc(json, native.doc);
    json.members.push_back(
        json_member("params", write_list(native.parameters, [](const NativeParameter& parameter) {
                        return with_number(parameter.name, "size", parameter.size);
                    })));
    return json;
}

}  // namespace

Result<NodeFile> parse_node_file(std::string_view text, std::string_view file) {
    const JsonValue json = TRY(parse_format(text, file, FileFormat::Node));
    Complaints complaints;
    NodeFile node = read_node(json, complaints);
    if (!complaints.empty()) return first_complaint(complaints, file);
    return node;
}

std::string format_node_file(const NodeFile& node) {
    const Target& target = node.target;
    const auto variables = write_list(target.variables, [](const NamedVariable& variable) {
        return with_number(variable.name, "size", variable.size);
    });
    const auto constants = write_list(node.common.constants, [](const Constant& constant) {
        return with_number(constant.name, "value", constant.value);
    });
    return format_json(json_object({
        json_member("name", target.name),
        json_member("protocolVersion", json_integer(target.protocol_version)),
        json_member("bytecodeSize", json_integer(target.bytecode_size)),
        json_member("variablesSize", json_integer(target.variables_size)),
        json_member("stackSize", json_integer(target.stack_size)),
        json_member("variables", variables),
        json_member("localEvents", write_list(target.local_events, write_local_event)),
        json_member("events", write_list(node.common.events, write_event)),
        json_member("constants", constants),
        json_member("natives", write_list(target.natives, write_native)),
    }));
}

}  // namespace vagus::aesl
