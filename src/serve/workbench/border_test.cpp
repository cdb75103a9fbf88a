// What protocol.json says of each field of each command and topic holds at the border: null,
// absence and other kinds are refused with a sentence, and the server lives. Made from the list.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include "base/test_folder.hpp"
#include "net/links.hpp"
#include "serve/json.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDrive = "0123456789abcdef";
constexpr const char* kLook = "fedcba9876543210";
constexpr const char* kScript =
    "<!DOCTYPE aesl-source>\n<network>\n<node nodeId=\"1\" name=\"left\">var x = 1\n"
    "onevent tick\n  x = 2\n</node>\n</network>\n";

// A value that the type allows.
Json good(const Type& type, const std::string& name) {
    switch (type.kind) {
        case Type::Kind::Bool:
            return true;
        case Type::Kind::Int:
        case Type::Kind::Number:
            return static_cast<int64_t>(std::clamp(1.0, type.low, type.high));
        case Type::Kind::Line:
        case Type::Kind::Text:
            return name == "doc" || name == "script"  ? "robot.aesl#1"
                   : name == "file" || name == "path" ? "robot.aesl"
                                                      : "x";
        case Type::Kind::Word:
            return type.words.front();
        case Type::Kind::Any:
            return 1;
        case Type::Kind::List:
            return Json::array({good(*type.item, name)});
        case Type::Kind::Map:
            return {{"x", good(*type.item, name)}};
        case Type::Kind::Fields: {
            Json json = Json::object();
            for (const Field& field : type.fields) json[field.name] = good(field.type, field.name);
            return json;
        }
        case Type::Kind::Named:
            return good(Protocol::get().types().find(type.name)->second, name);
    }
    return nullptr;
}

Json good(const std::vector<Field>& fields, bool all) {
    Json json = Json::object();
    for (const Field& field : fields) {
        if (all || !field.optional) json[field.name] = good(field.type, field.name);
    }
    return json;
}

const Type& real(const Type& type) {
    return type.kind == Type::Kind::Named ? real(Protocol::get().types().find(type.name)->second)
                                          : type;
}

// Values that it does not allow. For json, which allows all, what nobody expects.
std::vector<Json> bad(const Type& named) {
    const Type& type = real(named);
    std::vector<Json> values = {nullptr};
    const std::vector<Json> others = {
        true, 1.5, Json::array(), Json::array({nullptr}), Json::object(), {{"x", nullptr}}, "text"};
    for (const Json& other : others) {
        const bool fits = (type.kind == Type::Kind::Bool && other.is_boolean()) ||
                          (type.kind == Type::Kind::Number && other.is_number()) ||
                          ((type.kind == Type::Kind::Line || type.kind == Type::Kind::Text) &&
                           other.is_string()) ||
                          (type.kind == Type::Kind::Word && other.is_string()) ||
                          (type.kind == Type::Kind::List && other == Json::array()) ||
                          (type.kind == Type::Kind::Map && other == Json::object()) ||
                          (real(type.item ? *type.item : type).kind == Type::Kind::Any &&
                           other.is_array() == (type.kind == Type::Kind::List) &&
                           other.is_object() == (type.kind == Type::Kind::Map));
        if (type.kind == Type::Kind::Any || !fits) values.push_back(other);
    }
    switch (type.kind) {
        case Type::Kind::Int:
        case Type::Kind::Number:
            if (type.low > -1e300) values.push_back(type.low - 1);
            if (type.high < 1e300) values.push_back(type.high + 1);
            break;
        case Type::Kind::Line:
            values.push_back("two\nlines");
            values.push_back(std::string(type.size_max + 1, 'a'));
            break;
        case Type::Kind::Text:
            values.push_back(std::string(std::min<size_t>(type.size_max + 1, 1u << 20), 'a'));
            if (type.size_max >= 1u << 20) values.pop_back();  // the message's own limit
            break;
        case Type::Kind::Word:
            values.push_back("no such word");
            break;
        default:
            break;
    }
    return values;
}

// A value with one mistake somewhere inside it: a member that is missing, null or of another kind.
struct Flawed {
    std::string where;
    Json value;
    bool refused = true;  // json allows all
};

// All of them, of a value that the type allows.
std::vector<Flawed> flawed(const Type& named, const Json& from) {
    const Type& type = real(named);
    std::vector<Flawed> found;
    const auto add = [&](const std::string& where, const Type& inner, const Json& value,
                         const std::function<Json(const Json&)>& put) {
        const bool any = real(inner).kind == Type::Kind::Any;
        for (const Json& one : bad(inner)) {
            found.push_back({where + " " + one.dump().substr(0, 60), put(one), !any});
        }
        for (const Flawed& one : flawed(inner, value)) {
            found.push_back({where + one.where, put(one.value), one.refused});
        }
    };
    if (type.kind == Type::Kind::List) {
        add("[0]", *type.item, from[0], [](const Json& one) { return Json::array({one}); });
    } else if (type.kind == Type::Kind::Map) {
        add(".x", *type.item, from["x"], [](const Json& one) { return Json{{"x", one}}; });
    } else if (type.kind == Type::Kind::Fields) {
        for (const Field& field : type.fields) {
            const auto put = [&](const Json& one) {
                Json whole = from;
                whole[field.name] = one;
                return whole;
            };
            add("." + field.name, field.type, from[field.name], put);
            if (field.optional) continue;
            Json without = from;
            without.erase(field.name);
            found.push_back({"." + field.name + " missing", without});
        }
        Json more = from;
        more["no_such_field"] = 1;
        found.push_back({".no_such_field", more});
    }
    return found;
}

class Border : public testing::Test {
protected:
    Border()
        : desk(Access(kDrive, kLook), {.send =
                                           [this](ClientId, bool binary, std::string bytes) {
                                               if (!binary) got.push_back(Json::parse(bytes));
                                               unread += bytes.size();
                                           },
                                       .close = [this](ClientId, const std::string&) { ++closed; },
                                       .log = [](const std::string&) {},
                                       .wall_ms = [] { return 1e12; }}),
          bench(links, desk,
                {.library = {root / "data", root / "examples"},
                 .settings = (root / "settings.json").string(),
                 .program = "/bin/false",
                 .home = root.string()}) {
        fs::create_directories(root / "project");
        std::ofstream(root / "project" / "vagus.json")
            << R"({"format":"vagus-project/1","name":"p","scripts":["robot.aesl"]})";
        std::ofstream(root / "project" / "robot.aesl") << kScript;
        come(1, kDrive);
        come(2, kLook);
    }

    void come(uint32_t client, const char* token) {
        desk.hear(ClientOpened{{client}, "127.0.0.1"}, now);
        say(client, "hello", {{"token", token}, {"client", std::to_string(client)}});
    }
    void open() {
        if (bench.project()) return;
        ASSERT_TRUE(bench.open((root / "project").string(), now).ok());
    }

    // "ok", "pending", or the code of the problem.
    std::string say(uint32_t client, const std::string& command, const Json& in) {
        now += std::chrono::milliseconds(10);
        got.clear();
        const Json message = {{"id", ++id},
                              {"do", command},
                              {"in", in},
                              {"until", static_cast<double>(now.count()) / 1000 + 3000}};
        desk.hear(ClientText{{client}, message.dump()}, now);
        desk.hear(ClientTook{{client}, std::exchange(unread, 0)}, now);
        for (const Json& answer : got) {
            if (answer.value("id", uint64_t{0}) != id) continue;
            return answer.contains("ok") ? "ok" : answer["error"]["code"].get<std::string>();
        }
        return "pending";
    }
    void turn() {
        now += std::chrono::milliseconds(10);
        bench.tick(now);
        desk.tick(now);
        for (const uint32_t client : {1u, 2u}) desk.hear(ClientTook{{client}, unread}, now);
        unread = 0;
    }

    const test::Folder root;
    Time now = std::chrono::seconds(10);
    uint64_t id = 0;
    size_t unread = 0;
    int closed = 0;
    std::vector<Json> got;
    net::Links links;
    Desk desk;
    Workbench bench;
};

TEST_F(Border, EveryFieldOfEveryCommandIsChecked) {
    const Protocol& protocol = Protocol::get();
    size_t sent = 0;
    for (const std::string& name : protocol.command_names()) {
        const CommandType& type = *protocol.command(name);
        for (const Field& field : type.in) {
            const bool any = real(field.type).kind == Type::Kind::Any;
            for (const uint32_t client : {1u, 2u}) {
                open();
                Json in = good(type.in, true);
                in.erase(field.name);
                const std::string absent = say(client, name, in);
                if (!field.optional) {
                    EXPECT_EQ(absent, "bad_message") << name << " " << field.name;
                }
                for (const Json& value : bad(field.type)) {
                    open();
                    in = good(type.in, true);
                    in[field.name] = value;
                    const std::string answer = say(client, name, in);
                    if (!any) {
                        EXPECT_EQ(answer, "bad_message")
                            << name << " " << field.name << " " << value.dump().substr(0, 100);
                    }
                    ++sent;
                }
                turn();
            }
        }
        Json in = good(type.in, true);
        in["no_such_field"] = 1;
        EXPECT_EQ(say(1, name, in), "bad_message") << name;
    }
    EXPECT_GT(sent, 2000u);
    EXPECT_EQ(closed, 0);
}

// Change, JsonStep, DocVersion, DeployFile and what else is nested in a command.
TEST_F(Border, EveryMemberOfWhatIsNestedIsChecked) {
    const Protocol& protocol = Protocol::get();
    std::set<std::string> nested;  // names of types that were tried
    for (const std::string& name : protocol.command_names()) {
        const CommandType& type = *protocol.command(name);
        for (const Field& field : type.in) {
            for (const Flawed& one : flawed(field.type, good(field.type, field.name))) {
                open();
                Json in = good(type.in, true);
                in[field.name] = one.value;
                const std::string answer = say(1, name, in);
                if (one.refused) {
                    EXPECT_EQ(answer, "bad_message") << name << " " << field.name << one.where;
                }
            }
            const Type& item = field.type.item ? *field.type.item : field.type;
            if (item.kind == Type::Kind::Named) nested.insert(item.name);
            turn();
        }
    }
    for (const char* type : {"Change", "JsonStep", "DocVersion", "DeployFile"}) {
        EXPECT_TRUE(nested.contains(type)) << type;
    }
    EXPECT_EQ(closed, 0);
}

TEST_F(Border, EveryFieldOfEveryTopicIsChecked) {
    const Protocol& protocol = Protocol::get();
    open();
    const auto watch = [&](const std::string& topic, const Json& of) {
        const std::string answer = say(1, "watch", {{"watch", 1}, {"topic", topic}, {"of", of}});
        turn();
        say(1, "unwatch", {{"watch", 1}});
        return answer;
    };
    for (const std::string& name : protocol.topic_names()) {
        const TopicType& type = *protocol.topic(name);
        for (const Json& of :
             {Json(nullptr), Json(1), Json("x"), Json::array({1}), Json{{"no_such_field", 1}}}) {
            EXPECT_EQ(watch(name, of), "bad_message") << name << " " << of.dump();
        }
        for (const Field& field : type.of) {
            Json of = good(type.of, true);
            of.erase(field.name);
            if (!field.optional) {
                EXPECT_EQ(watch(name, of), "bad_message") << name;
            }
            for (const Json& value : bad(field.type)) {
                of = good(type.of, true);
                of[field.name] = value;
                EXPECT_EQ(watch(name, of), "bad_message") << name << " " << value.dump();
            }
        }
    }
}

// What fits the types need not make sense: lists of json with anything in them.
TEST_F(Border, WhatProtocolJsonCallsJsonMayBeAnything) {
    open();
    const std::vector<Json> odd = {nullptr,
                                   true,
                                   -1,
                                   1e300,
                                   uint64_t{1} << 63,
                                   "x",
                                   Json::array(),
                                   Json::array({nullptr, nullptr}),
                                   Json::array({1, 65535}),
                                   Json::array({65535, 65535, 65535}),
                                   Json::object(),
                                   {{"a", {{"b", nullptr}}}}};
    for (const Json& one : odd) {
        turn();
        say(1, "history.at", {{"t", 0}, {"ranges", Json::array({one})}});
        say(1, "history.lanes",
            {{"from", 0}, {"to", 1}, {"width", 1}, {"words", Json::array({one})}});
        say(1, "state.put", {{"key", "k"}, {"value", one}});
        say(1, "settings.put", {{"key", "k"}, {"value", one}});
        say(1, "run.start", {{"set", {{"x", one}}}});
        say(1, "plan.start", {{"set", {{"x", one}}}});
        say(1, "plan.set", {{"level", 0}, {"name", "x"}, {"value", one}});
        say(1, "plan.raise", {{"supervisor", "a"}, {"event", "b"}, {"outputs", {{"x", one}}}});
        for (const char* step : {"set", "remove", "insert", "move"}) {
            const Json steps = Json::array(
                {{{"do", step}, {"at", Json::array({one})}, {"value", one}, {"to", 1}}});
            say(1, "doc.patch", {{"doc", "vagus.json"}, {"version", 1}, {"steps", steps}});
            say(1, "plan.check", {{"doc", "vagus.json"}, {"steps", steps}});
        }
        for (const auto& [topic, key] : {std::pair("variables", "ranges"), {"samples", "words"}}) {
            Json of = {{key, Json::array({one})}};
            if (std::string(topic) == "variables") of["node"] = 1;
            const std::string answer =
                say(1, "watch", {{"watch", 1}, {"topic", topic}, {"of", of}});
            // Of too many words, perhaps.
            EXPECT_TRUE(answer == "ok" || answer == "limit") << answer << of.dump();
            turn();
        }
    }
    EXPECT_EQ(say(1, "doc.open", {{"doc", "robot.aesl"}}), "ok");
    EXPECT_EQ(closed, 0);
}

}  // namespace
}  // namespace vagus::serve
