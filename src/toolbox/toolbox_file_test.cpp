#include "toolbox/toolbox_file.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include <algorithm>

#include "toolbox/builtin.hpp"

namespace vagus::toolbox {
namespace {

using plan::Kind;
using plan::Type;

// Lines are counted by the tests below.
constexpr std::string_view kLamp = R"({
  "format": "vagus-toolbox/1",
  "name": "lamp",
  "project": "lamp.aesl",
  "templates": {
    "Shine": { "kind": "actor", "node": ["lamp", "torch"], "help": "Shines.",
      "in": {
        "colour": { "type": "int", "default": 3, "range": [0, 7] },
        "length": { "type": "float", "unit": "s", "scale": 1000, "words": 2 } },
      "out": { "warmth": { "type": "float", "scale": 10 } },
      "start": "lamp.on", "stop": "lamp.off", "stopped": "lamp.is.off", "alive": "lamp.go.on",
      "states": {
        "Done": { "event": "lamp.done", "out": ["warmth"] },
        "Broken": { "event": "lamp.broken" } } },
    "CheckDark": { "kind": "supervisor", "node": "eye",
      "in": { "still": { "type": "bool", "default": false } },
      "start": "eye.watch", "stop": "eye.leave",
      "events": { "Dark": { "event": "eye.dark" } } }
  }
})";

ProjectEvents lamp_events() {
    return {{"lamp.on", 4},    {"lamp.off", 1},  {"lamp.is.off", 1},
            {"lamp.go.on", 1}, {"lamp.done", 2}, {"lamp.broken", 1},
            {"eye.watch", 2},  {"eye.leave", 1}, {"eye.dark", 1}};
}

ReadProject project_of(ProjectEvents events) {
    return [events](const std::string&) { return Result<ProjectEvents>(events); };
}

// kLamp with the first `from` in it replaced.
std::string lamp_with(std::string_view from, std::string_view to) {
    std::string text(kLamp);
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text, const ReadProject& read_project = {}) {
    const Result<ToolboxFile> read = read_toolbox(text, "box/lamp.toolbox.json", read_project);
    return read.ok() ? "no error" : read.error().what;
}

TEST(ToolboxFile, GivesWhatItSays) {
    std::string asked;
    const auto read = read_toolbox(kLamp, "box/lamp.toolbox.json", [&](const std::string& path) {
        asked = path;
        return Result<ProjectEvents>(lamp_events());
    });
    ASSERT_TRUE(read.ok()) << read.error().what;
    EXPECT_EQ(asked, "box/lamp.aesl");
    const ToolboxFile& file = read.value();
    EXPECT_EQ(file.name, "lamp");
    ASSERT_EQ(file.templates.size(), 2u);
    const BusTemplate& shine = file.templates[0];
    EXPECT_EQ(shine.declared.kind, Kind::Actor);
    EXPECT_EQ(shine.declared.help, "Shines.");
    EXPECT_EQ(shine.nodes, (NodeNames{"lamp", "torch"}));
    ASSERT_EQ(shine.declared.inputs.size(), 2u);
    EXPECT_EQ(shine.declared.inputs[0].fallback, plan::Value(int64_t{3}));
    EXPECT_EQ(shine.declared.inputs[0].high, 7.0);
    EXPECT_EQ(shine.declared.inputs[1].unit, "s");
    EXPECT_EQ(shine.declared.inputs[1].fallback, std::nullopt);
    EXPECT_EQ(shine.inputs[1].words, 2);
    EXPECT_EQ(shine.inputs[1].scale, 1000);
    EXPECT_EQ(shine.declared.outputs[0].type, Type::Float);
    EXPECT_EQ(shine.outcomes[0].outputs, std::vector<size_t>{0});
    EXPECT_EQ(shine.declared.outcomes[1].name, "Broken");
    EXPECT_EQ(shine.alive, "lamp.go.on");
    EXPECT_EQ(events_of(shine),
              (std::vector<std::string>{"lamp.on", "lamp.off", "lamp.go.on", "lamp.is.off",
                                        "lamp.done", "lamp.broken"}));
    const BusTemplate& dark = file.templates[1];
    EXPECT_EQ(dark.declared.kind, Kind::Supervisor);
    EXPECT_EQ(dark.declared.period_ms, 0);
    EXPECT_EQ(dark.nodes, NodeNames{"eye"});
}

TEST(ToolboxFile, ForeignKeysUnderXAreNotLookedAt) {
    EXPECT_EQ(error_of(lamp_with("\"name\"", "\"x\": { \"a\": [1] }, \"name\"")), "no error");
}

TEST(ToolboxFile, TheBuiltInOnesHaveNoErrors) {
    for (const std::string_view text : {kDriveText, kCarbotText}) {
        EXPECT_EQ(error_of(std::string(text)), "no error");
    }
}

struct Mistake {
    const char* from;
    const char* to;
    const char* place;     // LINE:COL
    const char* sentence;  // a part of it
};

// Names of tests are the same in every run.
void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << mistake.place << " " << mistake.sentence;
}

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreToldWithTheirPlaceAndFix) {
    const Mistake& mistake = GetParam();
    const std::string error = error_of(lamp_with(mistake.from, mistake.to));
    EXPECT_TRUE(error.starts_with("box/lamp.toolbox.json:" + std::string(mistake.place) + ": "))
        << error;
    EXPECT_NE(error.find(mistake.sentence), std::string::npos) << error;
}

constexpr Mistake kMistakes[] = {
    {"{\n", "[\n", "2:11", "belong in an object, { … }, not in an array"},
    {"vagus-toolbox/1", "vagus-toolbox/2", "2:13",
     "\"format\" is \"vagus-toolbox/2\"; write \"vagus-toolbox/1\""},
    {"\"lamp\",\n  \"project\"", "\"la mp\",\n  \"project\"", "3:11",
     "\"la mp\" cannot be the name of a toolbox"},
    {"\"lamp\",\n  \"project\"", "\"core\",\n  \"project\"", "3:11", "always there"},
    {"\"lamp\",\n  \"project\"", "7,\n  \"project\"", "3:11", "write a string"},
    {"  \"project\": \"lamp.aesl\",\n", "", "1:1", "has no \"project\""},
    {"\"project\"", "\"projekt\"", "4:3", "unknown key \"projekt\"; did you mean \"project\"?"},
    {"\"name\"", "\"nome\": 1, \"name\"", "3:3", "unknown key \"nome\"; did you mean \"name\"?"},
    {"\"name\"", "\"name\": \"a\", \"name\"", "3:16", "has the key \"name\" a second time"},
    {"\"templates\": {", "\"templates\": [], \"x\": {", "5:16", "write an object"},
    {"\"Shine\"", "\"Sh ine\"", "6:5", "\"Sh ine\" cannot be the name of a template"},
    {"\"CheckDark\"", "\"Shine\"", "15:5", "there is a template named \"Shine\" already"},
    {"\"kind\": \"actor\", ", "", "6:14", "template \"Shine\" has no \"kind\""},
    {"\"actor\"", "\"actro\"", "6:24", "did you mean \"actor\"?"},
    {"\"node\": [\"lamp\", \"torch\"], ", "", "6:14", "has no \"node\""},
    {"[\"lamp\", \"torch\"]", "[]", "6:41", "a list of 1 to 8 names"},
    {"[\"lamp\", \"torch\"]", "7", "6:41", "must be the name of a node"},
    {"[\"lamp\", \"torch\"]", "[\"lamp\", true]", "6:50", "must be the name of a node"},
    {"[\"lamp\", \"torch\"]", "[\"lamp\", \"lamp\"]", "6:50", "is twice in"},
    {"\"help\": \"Shines.\"", "\"help\": 3", "6:68", "write a string"},
    {"\"in\": {\n", "\"in\": 3, \"x\": {\n", "7:13", "write an object"},
    {"\"colour\"", "\"col-our\"", "8:9", "cannot be the name of an input"},
    {"\"length\"", "\"colour\"", "9:9", "an input named \"colour\" already"},
    {"\"type\": \"int\", ", "", "8:19", "has no \"type\""},
    {"\"type\": \"int\"", "\"type\": \"string\"", "8:29", "write one of bool, int and float"},
    {"\"default\": 3", "\"default\": 3.5", "8:47", "write a whole number"},
    {"\"default\": 3", "\"default\": 9", "8:47",
     "the input \"colour\" is 9, but must be from 0 to 7"},
    {"\"range\": [0, 7]", "\"range\": [7, 0]", "8:59", "the lower one first"},
    {"\"range\": [0, 7]", "\"range\": [0]", "8:59", "two numbers"},
    {"\"range\": [0, 7]", "\"range\": [0, \"7\"]", "8:59", "two numbers"},
    {"\"range\": [0, 7]", "\"rage\": [0, 7]", "8:50", "did you mean \"range\"?"},
    {"\"words\": 2", "\"words\": 3", "9:75", "from 1 to 2"},
    {"\"words\": 2", "\"words\": 1.5", "9:75", "write a whole number"},
    {"\"scale\": 1000", "\"scale\": 0", "9:60", "write a number from"},
    {"\"scale\": 1000", "\"scale\": -5", "9:60", "write a number from"},
    {"\"scale\": 1000", "\"scale\": \"10\"", "9:60", "write a number"},
    {"\"scale\": 1000, \"words\": 2", "\"default\": 40000", "9:62", "does not fit one word"},
    {"\"scale\": 10 }", "\"default\": 1 }", "10:56", "has what its event brings"},
    {"\"start\": \"lamp.on\", ", "", "6:14", "has no \"start\""},
    {"\"start\": \"lamp.on\"", "\"strat\": \"lamp.on\"", "11:7",
     "unknown key \"strat\"; did you mean \"start\"?"},
    {"\"lamp.on\"", "\"lamp..on\"", "11:16", "which cannot be the name of an event"},
    {"\"lamp.on\"", "\"lamp on\"", "11:16", "which cannot be the name of an event"},
    {"\"lamp.on\"", "\"\"", "11:16", "which cannot be the name of an event"},
    {"\"stopped\": \"lamp.is.off\", ", "", "11:35", "has \"stop\" but no \"stopped\""},
    {"\"stop\": \"lamp.off\", ", "", "11:38", "has \"stopped\" but no \"stop\""},
    {"\"stop\": \"lamp.off\"", "\"stop\": \"lamp.on\"", "11:35", "another key of it names already"},
    {"\"states\"", "\"events\"", "6:14", "has no \"states\""},
    {"\"states\": {", "\"events\": {}, \"states\": {", "12:17", "an actor has \"states\""},
    {"\"Done\"", "\"1\"", "13:9", "cannot be the name of a state"},
    {"\"Broken\"", "\"Done\"", "14:9", "a state named \"Done\" already"},
    {"\"event\": \"lamp.done\", ", "", "13:17", "has no \"event\""},
    {"\"lamp.broken\"", "\"lamp.done\"", "14:30", "brings another of them already"},
    {"\"lamp.broken\"", "\"lamp.is.off\"", "14:30", "is its template's \"stopped\" too"},
    {"\"lamp.broken\"", "\"lamp.on\"", "14:30", "is its template's \"start\" too"},
    {"\"out\": [\"warmth\"]", "\"out\": [\"warm\"]", "13:49", "did you mean \"warmth\"?"},
    {"\"out\": [\"warmth\"]", "\"out\": [3]", "13:49", "no output of that name"},
    {"\"out\": [\"warmth\"]", "\"out\": [\"warmth\", \"warmth\"]", "13:59", "is twice in"},
    {"\"out\": [\"warmth\"]", "\"out\": \"warmth\"", "13:48", "write an array"},
    {"\"stop\": \"eye.leave\"", "\"stopped\": \"eye.left\"", "17:40",
     "nobody waits until a supervisor"},
    {"\"stop\": \"eye.leave\"", "\"alive\": \"eye.on\"", "17:38", "only an actor is kept alive"},
    {"\"stop\": \"eye.leave\"", "\"ended\": \"eye.over\"", "17:38", "only the work of an actor"},
    {"\"alive\": \"lamp.go.on\"", "\"ended\": \"lamp.is.off\"", "11:82", "another key of"},
    {"\"events\": { \"Dark\"", "\"states\": { \"Dark\"", "15:18", "has no \"events\""},
    {"\"type\": \"bool\",", "\"type\": \"bool\", \"scale\": 2,", "16:51", "0 or 1 on the bus"},
    {"\"type\": \"bool\",", "\"type\": \"bool\", \"range\": [0, 1],", "16:51", "a bool is 0 or 1"},
};

INSTANTIATE_TEST_SUITE_P(ToolboxFile, Mistakes, testing::ValuesIn(kMistakes));

// ---- the project ----

TEST(ToolboxFile, AnEventThatTheProjectLacksIsTold) {
    ProjectEvents events = lamp_events();
    events.erase("lamp.broken");
    const std::string error = error_of(std::string(kLamp), project_of(events));
    EXPECT_EQ(
        error,
        "box/lamp.toolbox.json:14:30: the event \"lamp.broken\", state \"Broken\" of template "
        "\"Shine\", is not in the project box/lamp.aesl; declare it there");
}

TEST(ToolboxFile, AnEventThatCarriesTooLittleIsTold) {
    ProjectEvents events = lamp_events();
    events["lamp.on"] = 3;  // its token, one word for the colour, two for the length
    const std::string error = error_of(std::string(kLamp), project_of(events));
    EXPECT_EQ(
        error,
        "box/lamp.toolbox.json:11:16: the event \"lamp.on\", \"start\" of template \"Shine\", "
        "carries 4 words with its token, but the project box/lamp.aesl declares 3; let it "
        "declare 4");
}

// What is sent has as many arguments as the project declares; an answer may have more.
TEST(ToolboxFile, AnEventThatIsSentCarriesWhatTheProjectDeclares) {
    ProjectEvents events = lamp_events();
    events["lamp.off"] = 2;
    EXPECT_NE(error_of(std::string(kLamp), project_of(events)).find("carries 1 words"),
              std::string::npos);
    events["lamp.off"] = std::nullopt;
    events["lamp.done"] = 3;
    EXPECT_EQ(error_of(std::string(kLamp), project_of(events)), "no error");
}

TEST(ToolboxFile, AProjectThatCannotBeReadIsTold) {
    const auto missing = [](const std::string& path) {
        return Result<ProjectEvents>(Error{Code::NotFound, path + " does not exist"});
    };
    EXPECT_EQ(
        error_of(std::string(kLamp), missing),
        "box/lamp.toolbox.json:4:14: \"project\" cannot be used: box/lamp.aesl does not exist");
}

// ---- limits, each at its value and one beyond ----

std::string many(size_t count, const std::function<std::string(size_t)>& item) {
    std::string text;
    for (size_t i = 0; i < count; ++i) text += (i ? ", " : "") + item(i);
    return text;
}

std::string file_with(const std::string& templates) {
    return R"({ "format": "vagus-toolbox/1", "name": "n", "project": "p", "templates": {)" +
           templates + "} }";
}

std::string template_with(const std::string& name, const std::string& members) {
    return "\"" + name + R"(": { "kind": "actor", "node": "n", "start": "s", )" + members + "}";
}

TEST(ToolboxFileLimits, Templates) {
    const auto one = [](size_t i) {
        return template_with("T" + std::to_string(i), "\"states\": {}");
    };
    EXPECT_EQ(error_of(file_with(many(kTemplatesMax, one))), "no error");
    EXPECT_NE(error_of(file_with(many(kTemplatesMax + 1, one))).find("more than the 256"),
              std::string::npos);
}

TEST(ToolboxFileLimits, States) {
    const auto state = [](size_t i) {
        const std::string n = std::to_string(i);
        return "\"S" + n + "\": { \"event\": \"e" + n + "\" }";
    };
    const auto file = [&](size_t count) {
        return file_with(template_with("T", "\"states\": {" + many(count, state) + "}"));
    };
    EXPECT_EQ(error_of(file(kOutcomesMax)), "no error");
    EXPECT_NE(error_of(file(kOutcomesMax + 1)).find("more than the 64"), std::string::npos);
}

TEST(ToolboxFileLimits, Outputs) {
    const auto output = [](size_t i) {
        return "\"o" + std::to_string(i) + "\": { \"type\": \"int\" }";
    };
    const auto file = [&](size_t count) {
        return file_with(
            template_with("T", "\"states\": {}, \"out\": {" + many(count, output) + "}"));
    };
    EXPECT_EQ(error_of(file(kOutputsMax)), "no error");
    EXPECT_NE(error_of(file(kOutputsMax + 1)).find("more than the 64"), std::string::npos);
}

// 8 words an event: the token and 7 more.
TEST(ToolboxFileLimits, WordsOfInputs) {
    const auto input = [](size_t i) {
        return "\"i" + std::to_string(i) + "\": { \"type\": \"int\" }";
    };
    const auto file = [&](const std::string& in) {
        return file_with(template_with("T", "\"states\": {}, \"in\": {" + in + "}"));
    };
    EXPECT_EQ(error_of(file(many(7, input))), "no error");
    EXPECT_NE(error_of(file(many(8, input))).find("need 9 words, but an event carries 8"),
              std::string::npos);
    const std::string wide = ", \"wide\": { \"type\": \"int\", \"words\": 2 }";
    EXPECT_EQ(error_of(file(many(5, input) + wide)), "no error");
    EXPECT_NE(error_of(file(many(6, input) + wide)).find("need 9 words"), std::string::npos);
}

TEST(ToolboxFileLimits, WordsOfOutputs) {
    const auto file = [](size_t count) {
        const auto declared = [](size_t i) {
            return "\"o" + std::to_string(i) + "\": { \"type\": \"int\" }";
        };
        const auto name = [](size_t i) { return "\"o" + std::to_string(i) + "\""; };
        return file_with(template_with("T", "\"out\": {" + many(count, declared) +
                                                "}, \"states\": { \"S\": { \"event\": \"e\", "
                                                "\"out\": [" +
                                                many(count, name) + "] } }"));
    };
    EXPECT_EQ(error_of(file(7)), "no error");
    EXPECT_NE(error_of(file(8)).find("need 9 words, but an event carries 8"), std::string::npos);
}

TEST(ToolboxFileLimits, NodeNames) {
    const auto node = [](size_t i) { return "\"n" + std::to_string(i) + "\""; };
    const auto file = [&](size_t count) {
        return lamp_with("[\"lamp\", \"torch\"]", "[" + many(count, node) + "]");
    };
    EXPECT_EQ(error_of(file(kNodeNamesMax)), "no error");
    EXPECT_NE(error_of(file(kNodeNamesMax + 1)).find("it has 9"), std::string::npos);
}

TEST(ToolboxFileLimits, Names) {
    const std::string name(kNameBytesMax, 'a');
    EXPECT_EQ(error_of(lamp_with("\"colour\"", "\"" + name + "\"")), "no error");
    EXPECT_NE(error_of(lamp_with("\"colour\"", "\"" + name + "a\"")).find("has 101 bytes"),
              std::string::npos);
    EXPECT_EQ(error_of(lamp_with("\"eye.dark\"", "\"" + name + "\"")), "no error");
    EXPECT_NE(error_of(lamp_with("\"eye.dark\"", "\"" + name + "a\"")).find("at most 100"),
              std::string::npos);
    EXPECT_EQ(error_of(lamp_with("\"eye\"", "\"" + name + "\"")), "no error");
    EXPECT_NE(error_of(lamp_with("\"eye\"", "\"" + name + "a\"")).find("of 1 to 100 bytes"),
              std::string::npos);
}

TEST(ToolboxFileLimits, Bytes) {
    std::string text(kLamp);
    text.resize(kToolboxBytesMax, ' ');
    EXPECT_EQ(error_of(text), "no error");
    EXPECT_NE(error_of(text + " ").find("has 1048577 bytes; a toolbox file has at most 1048576"),
              std::string::npos);
}

}  // namespace
}  // namespace vagus::toolbox
