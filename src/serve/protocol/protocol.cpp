#include "serve/protocol/protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/nearest.hpp"
#include "serve/json.hpp"
#include "serve/protocol/depth.hpp"

namespace vagus::serve {

extern const std::string_view kProtocolText;  // protocol_text.cpp, made from protocol.json

namespace {

using Ordered = nlohmann::ordered_json;

template <typename T>
const T* find(const std::vector<std::pair<std::string, T>>& list, std::string_view name) {
    for (const auto& [key, value] : list) {
        if (key == name) return &value;
    }
    return nullptr;
}

template <typename T>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, T>>& list) {
    std::vector<std::string> names;
    for (const auto& [key, value] : list) names.push_back(key);
    return names;
}

Refusal refuse(uint64_t id, std::string code, std::string what, std::string place = {}) {
    return {id, {std::move(code), std::move(what), std::move(place)}};
}

// "in.from: expected a text" as a place and the sentence.
Refusal refuse_fault(uint64_t id, const std::string& fault) {
    return refuse(id, "bad_message", fault, fault.substr(0, fault.find_first_of(": ")));
}

// A message with one member that is known, { "pong": 7 }.
std::optional<Pong> pong_in(const Json& message) {
    const auto found = message.find("pong");
    if (message.size() != 1 || found == message.end() || !found->is_number_unsigned()) {
        return std::nullopt;
    }
    return Pong{found->get<uint64_t>()};
}

std::string did_you_mean(const std::string& near) {
    return near.empty() ? "" : "; did you mean “" + near + "”?";
}

}  // namespace

// Reads protocol.json; every mistake in it ends the reading.
struct Protocol::Reader {
    Protocol protocol;

    static Result<std::vector<Field>> fields(const Ordered& list) {
        std::vector<Field> fields;
        for (const auto& [name, text] : list.items()) {
            fields.push_back(TRY(parse_field(name, text.get<std::string>())));
        }
        return fields;
    }

    Status types(const Ordered& list) {
        for (const auto& [name, entry] : list.items()) {
            Type type;
            if (entry.contains("is")) {
                type = TRY(parse_type(entry["is"].get<std::string>()));
            } else {
                type.kind = Type::Kind::Fields;
                type.fields = TRY(fields(entry["fields"]));
            }
            protocol.types_.emplace(name, std::move(type));
            protocol.type_helps_.emplace_back(name, entry.value("help", ""));
        }
        return Status::done();
    }

    Status commands(const Ordered& list) {
        static const std::map<std::string, May> kMay = {
            {"any", May::Any}, {"look", May::Look}, {"drive", May::Drive}, {"driver", May::Driver}};
        static const std::map<std::string, CommandKind> kKinds = {{"look", CommandKind::Look},
                                                                  {"edit", CommandKind::Edit},
                                                                  {"act", CommandKind::Act},
                                                                  {"stop", CommandKind::Stop}};
        for (const auto& [name, entry] : list.items()) {
            CommandType command;
            command.may = kMay.at(entry["may"].get<std::string>());
            command.kind = kKinds.at(entry.at("kind").get<std::string>());
            command.on_robot = entry.value("on_robot", false);
            command.help = entry["help"];
            command.in = TRY(fields(entry["in"]));
            command.out = TRY(fields(entry["out"]));
            protocol.commands_.emplace_back(name, std::move(command));
        }
        return Status::done();
    }

    Status topics(const Ordered& list) {
        for (const auto& [name, entry] : list.items()) {
            TopicType topic;
            const std::string kind = entry["kind"];
            topic.kind = kind == "document" ? TopicType::Kind::Document
                         : kind == "stream" ? TopicType::Kind::Stream
                                            : TopicType::Kind::Binary;
            topic.number = entry.value("number", uint8_t{0});
            topic.help = entry["help"];
            if (entry.contains("of")) topic.of = TRY(fields(entry["of"]));
            if (entry.contains("is")) topic.is = TRY(fields(entry["is"]));
            topic.item = entry.value("item", "");
            protocol.topics_.emplace_back(name, std::move(topic));
        }
        return Status::done();
    }

    void limits(const Ordered& list) {
        for (const auto& [name, entry] : list.items()) {
            protocol.limits_.emplace_back(
                name, LimitType{entry["value"].get<double>(), entry["help"].get<std::string>()});
        }
    }

    // Every type that is named is there.
    Status names(const Type& type) const {
        if (type.kind == Type::Kind::Named && !protocol.types_.contains(type.name)) {
            return Error{Code::NotFound, "protocol.json: the type " + type.name + " is missing"};
        }
        if (type.item) TRY(names(*type.item));
        for (const Field& field : type.fields) TRY(names(field.type));
        return Status::done();
    }
    Status names() const {
        for (const auto& [name, type] : protocol.types_) TRY(names(type));
        for (const auto& [name, command] : protocol.commands_) {
            for (const Field& field : command.in) TRY(names(field.type));
            for (const Field& field : command.out) TRY(names(field.type));
        }
        for (const auto& [name, topic] : protocol.topics_) {
            for (const Field& field : topic.of) TRY(names(field.type));
            for (const Field& field : topic.is) TRY(names(field.type));
        }
        return Status::done();
    }
};

Result<Protocol> Protocol::parse(std::string_view text) {
    const Ordered list = Ordered::parse(text, nullptr, false);
    if (list.is_discarded()) return Error{Code::BadInput, "protocol.json: not JSON"};
    Reader reader;
    try {
        for (const auto& line : list["help"]) reader.protocol.help_.push_back(line);
        reader.limits(list["limits"]);
        TRY(reader.types(list["types"]));
        TRY(reader.commands(list["commands"]));
        TRY(reader.topics(list["topics"]));
    } catch (const std::exception& wrong) {
        return Error{Code::BadInput, std::string("protocol.json: ") + wrong.what()};
    }
    TRY(reader.names());
    return std::move(reader.protocol);
}

const Protocol& Protocol::get() {
    static const Protocol protocol = [] {
        Result<Protocol> parsed = parse(kProtocolText);
        assert(parsed.ok());
        return std::move(parsed.value());
    }();
    return protocol;
}

Message Protocol::read(std::string_view message) const {
    if (message.size() > limit("message_bytes")) {
        return refuse(0, "limit",
                      fmt::format("a message of {} bytes; at most {} are allowed", message.size(),
                                  limit("message_bytes")));
    }
    if (depth_of(message) > limit("message_depth")) {
        return refuse(0, "limit",
                      fmt::format("the message nests deeper than {}", limit("message_depth")));
    }
    Json json = Json::parse(message, nullptr, false);
    if (!json.is_object()) {
        return refuse(0, "bad_message", "expected a JSON object with id, do and in");
    }
    if (const auto pong = pong_in(json)) return *pong;
    const auto id_found = json.find("id");
    if (id_found == json.end() || !id_found->is_number_unsigned()) {
        return refuse(0, "bad_message", "id: expected a whole number above 0", "id");
    }
    Request request;
    request.id = id_found->get<uint64_t>();
    if (auto refusal = read_members(json, request)) return std::move(*refusal);
    request.in = json.contains("in") ? std::move(json["in"]) : Json::object();
    if (const auto fault = fault_of_fields(request.in, request.type->in, types_, "in")) {
        return refuse_fault(request.id, *fault);
    }
    return request;
}

// What is beside `in`.
std::optional<Refusal> Protocol::read_members(const Json& json, Request& request) const {
    for (const auto& [key, value] : json.items()) {
        if (key != "id" && key != "do" && key != "in" && key != "until" && key != "stops") {
            return refuse(
                request.id, "bad_message",
                fmt::format("{:.64}: not known; a command has id, do, in, until and stops", key),
                "message");
        }
    }
    const auto until = json.find("until");
    if (until != json.end() && !until->is_number()) {
        return refuse(request.id, "bad_message",
                      "until: expected a time of the server in milliseconds", "until");
    }
    if (until != json.end()) request.until = until->get<double>();
    const auto stops = json.find("stops");
    if (stops != json.end() && !stops->is_number_unsigned()) {
        return refuse(request.id, "bad_message", "stops: expected how many Stops were heard of",
                      "stops");
    }
    if (stops != json.end()) request.stops = stops->get<uint64_t>();
    const auto name = json.find("do");
    if (name == json.end() || !name->is_string()) {
        return refuse(request.id, "bad_message", "do: expected the name of a command", "do");
    }
    request.name = name->get<std::string>();
    request.type = command(request.name);
    if (request.type) return std::nullopt;
    return refuse(request.id, "unknown_command",
                  fmt::format("there is no command “{:.64}”{}", request.name,
                              did_you_mean(nearest(request.name, names_of(commands_)))),
                  "do");
}

std::vector<std::string> Protocol::command_names() const {
    return names_of(commands_);
}

std::vector<std::string> Protocol::topic_names() const {
    return names_of(topics_);
}

const CommandType* Protocol::command(std::string_view name) const {
    return find(commands_, name);
}

const TopicType* Protocol::topic(std::string_view name) const {
    return find(topics_, name);
}

std::optional<std::string> Protocol::fault_of_subject(const TopicType& topic,
                                                      const Json& of) const {
    return fault_of_fields(of, topic.of, types_, "in.of");
}

std::optional<std::string> Protocol::fault_of_answer(std::string_view name, const Json& out) const {
    return fault_of_fields(out, command(name)->out, types_, "ok");
}

std::optional<std::string> Protocol::fault_of_document(std::string_view name,
                                                       const Json& document) const {
    return fault_of_fields(document, topic(name)->is, types_, std::string(name));
}

size_t Protocol::limit(std::string_view name) const {
    const LimitType* found = find(limits_, name);
    assert(found);
    return static_cast<size_t>(found->value);
}

}  // namespace vagus::serve
