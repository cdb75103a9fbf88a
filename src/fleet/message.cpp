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

bool truth(const JsonValue& json, std::string_view key) {
    const JsonValue* value = json.find(key);
    return value != nullptr && value->boolean;
}

uint64_t count(const JsonValue& json, std::string_view key) {
    return static_cast<uint64_t>(whole(json, key));
}

keeper::Term term(const JsonValue& json, std::string_view key) {
    return keeper::read_term(text(json, key)).value_or(keeper::Term{});
}

Duration length(const JsonValue& json) {
    return std::chrono::milliseconds(whole(json, "length"));
}

// Any value, as its text; none: no text.
std::string value_text(const JsonValue& json, std::string_view key) {
    const JsonValue* value = json.find(key);
    return value == nullptr ? "" : format_json_line(*value);
}

keeper::Request read_request(const JsonValue& json, const std::string& verb) {
    if (verb == "give") {
        return keeper::Give{text(json, "queue"), text(json, "id"), value_text(json, "data")};
    }
    if (verb == "take") return keeper::Take{text(json, "queue"), length(json)};
    if (verb == "claim") return keeper::ClaimName{text(json, "name"), length(json)};
    if (verb == "renew") return keeper::Renew{term(json, "term")};
    if (verb == "finish") return keeper::Finish{term(json, "term"), value_text(json, "result")};
    if (verb == "release") return keeper::Release{term(json, "term")};
    return keeper::Write{text(json, "key"), term(json, "seen"), value_text(json, "value")};
}

constexpr std::pair<keeper::Work, const char*> kWorks[] = {{keeper::Work::Waiting, "waiting"},
                                                           {keeper::Work::Leased, "leased"},
                                                           {keeper::Work::Done, "done"}};
constexpr std::pair<keeper::Outcome, const char*> kOutcomes[] = {
    {keeper::Outcome::Done, "done"},
    {keeper::Outcome::Nothing, "nothing"},
    {keeper::Outcome::Refused, "refused"}};

template <typename Table>
auto value_of(const Table& table, const std::string& word) {
    for (const auto& [value, name] : table)
        if (name == word) return value;
    return table[0].first;
}

template <typename Table, typename Value>
std::string word_of(const Table& table, Value wanted) {
    for (const auto& [value, name] : table)
        if (value == wanted) return name;
    return "";
}

keeper::Lease read_lease(const JsonValue& json) {
    return {text(json, "robot"), term(json, "term"), length(json)};
}

keeper::Record read_record(const JsonValue& json, const Topic& topic) {
    if (topic.kind == Kind::Task) {
        return keeper::Task{topic.queue,
                            topic.name,
                            term(json, "given"),
                            value_text(json, "data"),
                            value_of(kWorks, text(json, "work")),
                            read_lease(json),
                            value_text(json, "result")};
    }
    if (text(json, "is") == "name") return keeper::Claim{topic.name, read_lease(json)};
    return keeper::Shared{topic.name, term(json, "version"), value_text(json, "value")};
}

// Whether it is one was checked: fault_in().
std::optional<Topic> topic_of_record(const JsonValue& reply, std::string_view fleet) {
    auto topic = parse_topic(fleet, text(reply, "topic"));
    const bool is_record = topic && (topic->kind == Kind::Task || topic->kind == Kind::Shared);
    return is_record ? topic : std::nullopt;
}

Reply read_reply(const JsonValue& json, std::string_view fleet) {
    keeper::Reply reply{
        value_of(kOutcomes, text(json, "outcome")), text(json, "why"), count(json, "keeper"), {}};
    const auto topic = topic_of_record(json, fleet);
    if (topic) reply.record = read_record(*json.find("record"), *topic);
    return {whole(json, "epoch"), count(json, "number"), std::move(reply)};
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

Message read_message(const JsonValue& json, const Topic& topic, std::string_view fleet) {
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
        case Kind::Want:
            return Want{whole(json, "number"), text(json, "sha256"), text(json, "address"),
                        truth(json, "back")};
        case Kind::Version:
            return Version{whole(json, "number"), text(json, "sha256"), text(json, "result"),
                           text(json, "why"), text(json, "healthy")};
        case Kind::Beat:
            return keeper::Beat{count(json, "epoch"), text(json, "instance"),
                                count(json, "number")};
        case Kind::Question:
            return Question{whole(json, "epoch"), count(json, "number"),
                            read_request(json, topic.name)};
        case Kind::Task:
        case Kind::Shared:
            return read_record(json, topic);
        case Kind::Reply:
            return read_reply(json, fleet);
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

// ---- out: of the keeper ----

JsonMember member(std::string_view key, keeper::Term term) {
    return member(key, text_of(term));
}

JsonMember member(std::string_view key, uint64_t value) {
    return member(key, static_cast<int64_t>(value));
}

// The text of a value that was read, or that a program of ours wrote.
void add_value(Members& members, std::string_view key, const std::string& value) {
    if (value.empty()) return;
    const auto json = read_json(value);
    const auto* const good = std::get_if<JsonValue>(&json);
    members.push_back(json_member(key, good ? *good : json_string(value)));
}

void add_length(Members& members, Duration length) {
    members.push_back(member("length", int64_t{length / 1ms}));
}

void add_lease(Members& members, const keeper::Lease& lease) {
    add(members, "robot", lease.robot);
    if (lease.term == keeper::Term{}) return;
    members.push_back(member("term", lease.term));
    add_length(members, lease.length);
}

Members members_of(const keeper::Give& give) {
    Members members = {member("queue", give.queue), member("id", give.id)};
    add_value(members, "data", give.data);
    return members;
}

Members members_of(const keeper::Take& take) {
    Members members = {member("queue", take.queue)};
    add_length(members, take.length);
    return members;
}

Members members_of(const keeper::ClaimName& claim) {
    Members members = {member("name", claim.name)};
    add_length(members, claim.length);
    return members;
}

Members members_of(const keeper::Renew& renew) {
    return {member("term", renew.term)};
}

Members members_of(const keeper::Finish& finish) {
    Members members = {member("term", finish.term)};
    add_value(members, "result", finish.result);
    return members;
}

Members members_of(const keeper::Release& release) {
    return {member("term", release.term)};
}

Members members_of(const keeper::Write& write) {
    Members members = {member("key", write.key)};
    if (write.seen != keeper::Term{}) members.push_back(member("seen", write.seen));
    add_value(members, "value", write.value);
    return members;
}

Members members_of(const keeper::Task& task) {
    Members members = {member("work", word_of(kWorks, task.work)), member("given", task.given)};
    add_value(members, "data", task.data);
    add_lease(members, task.lease);
    add_value(members, "result", task.result);
    return members;
}

Members members_of(const keeper::Shared& shared) {
    Members members = {member("is", std::string("value")), member("version", shared.version)};
    add_value(members, "value", shared.value);
    return members;
}

Members members_of(const keeper::Claim& claim) {
    Members members = {member("is", std::string("name"))};
    add_lease(members, claim.lease);
    return members;
}

Members members_of(const keeper::Record& record) {
    return std::visit([](const auto& one) { return members_of(one); }, record);
}

Members members_of(const keeper::Beat& beat) {
    return {member("epoch", beat.epoch), member("instance", beat.instance),
            member("number", beat.number)};
}

Members members_of(const Want& said) {
    Members members = {member("number", said.number), member("sha256", said.sha256),
                       member("address", said.address)};
    if (said.back) members.push_back(member("back", said.back));
    return members;
}

Members members_of(const Version& said) {
    Members members = {member("number", said.number), member("sha256", said.sha256),
                       member("result", said.result)};
    add(members, "healthy", said.healthy);
    add(members, "why", said.why);
    return members;
}

Members members_of(const Question& said) {
    Members members = {member("number", said.number), member("epoch", said.epoch)};
    Members asked = std::visit([](const auto& one) { return members_of(one); }, said.request);
    std::move(asked.begin(), asked.end(), std::back_inserter(members));
    return members;
}

Members members_of(const Reply& said, std::string_view fleet) {
    const keeper::Reply& reply = said.reply;
    Members members = {member("number", said.number), member("epoch", said.epoch),
                       member("outcome", word_of(kOutcomes, reply.outcome))};
    add(members, "why", reply.why);
    members.push_back(member("keeper", reply.epoch));
    if (!reply.record) return members;
    members.push_back(member("topic", text_of(fleet, topic_of(*reply.record))));
    members.push_back(json_member("record", members_of(*reply.record)));
    return members;
}

std::optional<std::string> fault_in(const JsonValue& json, const Topic& topic,
                                    std::string_view fleet) {
    if (auto fault = fault_of(json, info_of(topic.kind).fields)) return fault;
    if (topic.kind == Kind::Command) return fault_of(json, verb_of(topic.name)->fields);
    if (topic.kind == Kind::Question) return fault_of(json, question_of(topic.name)->fields);
    if (topic.kind != Kind::Reply || json.find("record") == nullptr) return std::nullopt;
    const auto record = topic_of_record(json, fleet);
    if (!record) return "\"topic\": expected that of a task or of a shared value";
    return fault_in(*json.find("record"), *record, fleet);
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
    if (const auto fault = fault_in(value, *known, fleet)) return refuse(Code::BadInput, *fault);
    return Heard{*known, read_message(value, *known, fleet)};
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string payload_of(const Message& message, std::string_view fleet) {
    const auto members = [fleet](const auto& said) {
        if constexpr (std::is_same_v<decltype(said), const Reply&>) {
            return members_of(said, fleet);
        } else {
            return members_of(said);
        }
    };
    return format_json_line(json_object(std::visit(members, message)));
}

Topic topic_of(const keeper::Record& record) {
    if (const auto* task = std::get_if<keeper::Task>(&record)) {
        return {.kind = Kind::Task, .name = task->id, .queue = task->queue};
    }
    const auto* shared = std::get_if<keeper::Shared>(&record);
    return {.kind = Kind::Shared,
            .name = shared ? shared->key : std::get<keeper::Claim>(record).name};
}

// questions() lists them in the order of keeper::Request.
Topic topic_of(const std::string& robot, const keeper::Request& request) {
    return {.kind = Kind::Question,
            .robot = robot,
            .name = std::string(questions()[request.index()].verb)};
}

}  // namespace vagus::fleet
