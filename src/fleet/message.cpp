#include "fleet/message.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/json_part.hpp"
#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

using Words = std::vector<int16_t>;
using Names = std::vector<std::string>;

// ---- in: members whose kinds were checked ----

std::string text(const JsonValue& json, std::string_view key) {
    const JsonValue* value = json.find(key);
    return value == nullptr ? "" : value->text;
}

int64_t whole(const JsonValue& json, std::string_view key) {
    const JsonValue* value = json.find(key);
    return value == nullptr ? 0 : value->integer;
}

std::optional<int64_t> may_be_whole(const JsonValue& json, std::string_view key) {
    const JsonValue* value = json.find(key);
    return value == nullptr ? std::nullopt : std::optional(value->integer);
}

Names names(const JsonValue& json, std::string_view key) {
    Names list;
    const JsonValue* value = json.find(key);
    if (value == nullptr) return list;
    for (const JsonValue& item : value->items) list.push_back(item.text);
    return list;
}

Words words(const JsonValue& json, std::string_view key) {
    Words list;
    const JsonValue* value = json.find(key);
    if (value == nullptr) return list;
    for (const JsonValue& item : value->items) list.push_back(static_cast<int16_t>(item.integer));
    return list;
}

Command read_command(const JsonValue& json, const std::string& verb) {
    Command command{.verb = verb,
                    .id = text(json, "id"),
                    .reply = text(json, "reply"),
                    .epoch = may_be_whole(json, "epoch"),
                    .deadline = may_be_whole(json, "deadline"),
                    .node = text(json, "node"),
                    .name = text(json, "name"),
                    .supervisor = text(json, "supervisor"),
                    .event = text(json, "event")};
    command.values = words(json, verb == "emit" ? "args" : "values");
    return command;
}

Message read_message(const JsonValue& json, const Topic& topic) {
    switch (topic.kind) {
        case Kind::Connection:
            return Connection{text(json, "state"), text(json, "instance"), whole(json, "epoch")};
        case Kind::Description:
            return Description{text(json, "project"), text(json, "vagus"),   text(json, "plan"),
                               text(json, "studio"),  names(json, "groups"), names(json, "nodes"),
                               names(json, "send"),   names(json, "hear")};
        case Kind::State:
            return State{whole(json, "number"),   whole(json, "epoch"),   whole(json, "clock"),
                         text(json, "state"),     whole(json, "since"),   text(json, "actor"),
                         names(json, "problems"), whole(json, "left_out")};
        case Kind::Variable:
            return Variable{whole(json, "clock"), whole(json, "epoch"), words(json, "values")};
        case Kind::Event:
            return Event{whole(json, "number"), whole(json, "epoch"), names(json, "groups"),
                         words(json, "args")};
        case Kind::Ask:
            return Ask{text(json, "instance")};
        case Kind::Answer:
            return Answer{text(json, "id"), json.find("done")->boolean, text(json, "what"),
                          text(json, "instance"), names(json, "silent")};
        case Kind::Command:
            break;
    }
    return read_command(json, topic.name);
}

// ---- out ----

JsonMember member(std::string_view key, int64_t value) {
    return json_member(key, json_integer(value));
}

JsonMember member(std::string_view key, const Names& list) {
    std::vector<JsonValue> items;
    for (const std::string& one : list) items.push_back(json_string(one));
    return json_member(key, json_array(std::move(items)));
}

JsonMember member(std::string_view key, const Words& list) {
    std::vector<JsonValue> items;
    for (const int16_t one : list) items.push_back(json_integer(one));
    return json_member(key, json_array(std::move(items)));
}

JsonMember member(std::string_view key, bool value) {
    JsonValue json;
    json.kind = JsonKind::Bool;
    json.boolean = value;
    return json_member(key, std::move(json));
}

using Members = std::vector<JsonMember>;

// What may be left out is, if it is empty.
void add(Members& members, std::string_view key, const std::string& value) {
    if (!value.empty()) members.push_back(json_member(key, std::string_view(value)));
}

JsonMember member(std::string_view key, const std::string& value) {
    return json_member(key, std::string_view(value));
}

Members members_of(const Connection& said) {
    return {member("state", said.state), member("instance", said.instance),
            member("epoch", said.epoch)};
}

Members members_of(const Description& said) {
    Members members = {member("project", said.project), member("vagus", said.vagus)};
    add(members, "plan", said.plan);
    add(members, "studio", said.studio);
    members.push_back(member("groups", said.groups));
    members.push_back(member("nodes", said.nodes));
    members.push_back(member("send", said.send));
    members.push_back(member("hear", said.hear));
    return members;
}

Members members_of(const State& said) {
    Members members = {member("number", said.number), member("epoch", said.epoch),
                       member("clock", said.clock), member("state", said.state),
                       member("since", said.since)};
    add(members, "actor", said.actor);
    members.push_back(member("problems", said.problems));
    members.push_back(member("left_out", said.left_out));
    return members;
}

Members members_of(const Variable& said) {
    return {member("clock", said.clock), member("epoch", said.epoch),
            member("values", said.values)};
}

Members members_of(const Event& said) {
    return {member("number", said.number), member("epoch", said.epoch),
            member("groups", said.groups), member("args", said.args)};
}

Members members_of(const Ask& said) {
    return {member("instance", said.instance)};
}

Members members_of(const Answer& said) {
    Members members = {member("id", said.id), member("done", said.done)};
    add(members, "what", said.what);
    add(members, "instance", said.instance);
    if (!said.silent.empty()) members.push_back(member("silent", said.silent));
    return members;
}

Members members_of(const Command& said) {
    Members members = {member("id", said.id), member("reply", said.reply)};
    if (said.epoch) members.push_back(member("epoch", *said.epoch));
    if (said.deadline) members.push_back(member("deadline", *said.deadline));
    add(members, "node", said.node);
    add(members, "name", said.name);
    add(members, "supervisor", said.supervisor);
    add(members, "event", said.event);
    if (said.verb == "emit") members.push_back(member("args", said.values));
    if (said.verb == "set") members.push_back(member("values", said.values));
    return members;
}

std::optional<std::string> fault_in(const JsonValue& json, const Topic& topic) {
    if (auto fault = fault_of(json, info_of(topic.kind).fields)) return fault;
    if (topic.kind != Kind::Command) return std::nullopt;
    return fault_of(json, verb_of(topic.name)->fields);
}

}  // namespace

Result<Heard> read(std::string_view fleet, std::string_view topic, std::string_view payload) {
    const auto refuse = [&](Code code, const std::string& why) {
        return Error{code, fmt::format("{}: {}", topic, why)};
    };
    const auto known = parse_topic(fleet, topic);
    const bool verb = !known || known->kind != Kind::Command || verb_of(known->name) != nullptr;
    if (!known || !verb) return refuse(Code::NotFound, "no such topic is known here");
    if (payload.size() > kPayloadBytesMax) {
        return refuse(Code::Limit, fmt::format("has {} bytes; {} are the most that is read",
                                               payload.size(), kPayloadBytesMax));
    }
    const auto json = read_json(payload);
    if (const auto* broken = std::get_if<JsonError>(&json)) {
        return refuse(Code::BadInput, broken->what);
    }
    const JsonValue& value = std::get<JsonValue>(json);
    if (const auto fault = fault_in(value, *known)) return refuse(Code::BadInput, *fault);
    return Heard{*known, read_message(value, *known)};
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string payload_of(const Message& message) {
    return std::visit(
        [](const auto& said) { return format_json_line(json_object(members_of(said))); }, message);
}

}  // namespace vagus::fleet
