#include "serve/edit/template_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "serve/edit/test_page.hpp"
#include "serve/edit/text_places.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::string_view kProject =
    "{\n  \"format\": \"vagus-project/1\",\n  \"name\": \"T\",\n  \"scripts\": [\"a.aesl\"]\n}\n";
constexpr std::string_view kScript =
    "<!DOCTYPE aesl-source>\n<network>\n<event size=\"1\" name=\"ping\"/>\n"
    "<node nodeId=\"1\" name=\"thymio-II\"># Counts.\nvar n = 0\nonevent ping\n\tn += 1\n</node>\n"
    "</network>\n";

class OwnTemplateTest : public EditTest {
protected:
    OwnTemplateTest() {
        write("vagus.json", kProject);
        write("a.aesl", kScript);
        enter({.project_file = "vagus.json"});
    }
    static Json wanted(const std::string& name, const std::string& kind = "actor") {
        return {{"name", name}, {"kind", kind}, {"script", "a.aesl#1"}, {"help", "Mine."}};
    }
};

TEST_F(OwnTemplateTest, AnActorGetsItsToolboxItsEventsAndItsHandlers) {
    const Json made = ask("template.new", wanted("Blink"));
    EXPECT_EQ(made["toolbox"], "own");
    EXPECT_EQ(on_disk("own.toolbox.json"), R"({
  "format": "vagus-toolbox/1",
  "name": "own",
  "help": "Templates of this project.",
  "project": "a.aesl",
  "templates": {
    "Blink": {
      "kind": "actor",
      "help": "Mine.",
      "node": "thymio-II",
      "start": "blink.start",
      "stop": "blink.stop",
      "stopped": "blink.stopped",
      "alive": "blink.alive",
      "states": { "Done": { "event": "blink.done" } }
    }
  }
}
)");
    EXPECT_THAT(on_disk("vagus.json"), HasSubstr("\"toolboxes\": [\"own.toolbox.json\"]"));
    const std::string script = text("a.aesl#1");
    // What there was stays; the variables are where variables may be.
    EXPECT_THAT(script,
                StartsWith("# Counts.\nvar blink_token = 0\nvar blink_signs = 0\nvar n = 0\n"
                           "onevent ping\n\tn += 1\n"));
    const int line = made["at"]["line"];
    EXPECT_EQ(std::string(line_at(script, static_cast<size_t>(line))),
              "    # The work begins here: switch something on, start a motor.");
    EXPECT_THAT(findings(), IsEmpty());
}

TEST_F(OwnTemplateTest, ASecondOneExtendsTheToolbox) {
    ask("template.new", wanted("Blink"));
    enter({.project_file = "vagus.json", .toolboxes = {"own.toolbox.json"}});
    EXPECT_EQ(ask("template.new", wanted("See", "supervisor"))["toolbox"], "own");
    const std::string toolbox = on_disk("own.toolbox.json");
    EXPECT_THAT(toolbox, HasSubstr("\"Blink\""));
    EXPECT_THAT(toolbox, HasSubstr("\"events\": { \"Raised\": { \"event\": \"see.raised\" } }"));
    EXPECT_THAT(findings(), IsEmpty());
    EXPECT_THAT(refusal("template.new", wanted("Blink")),
                HasSubstr("the toolbox own has a template “Blink” already"));
}

// Half a template would be a plan that does not start and a toolbox that cannot be read.
TEST_F(OwnTemplateTest, WhatCannotBeMadeWholeChangesNothing) {
    const auto is_untouched = [&] {
        return on_disk("a.aesl") == kScript && on_disk("vagus.json") == kProject &&
               !files.exists("own.toolbox.json");
    };
    EXPECT_THAT(refusal("template.new", wanted("Not a name")), StartsWith("bad_input: "));
    EXPECT_THAT(refusal("template.new", wanted("Wait")),
                HasSubstr("the toolbox core has a template “Wait” already"));
    EXPECT_TRUE(is_untouched());
    put("a.aesl", "name=\"ping\"/>", "name=\"ping\"/>\n<event size=\"1\" name=\"blink.stop\"/>");
    EXPECT_THAT(refusal("template.new", wanted("Blink")), HasSubstr("“blink.stop” already"));
    ask("doc.revert", {{"doc", "a.aesl"}});
    // The last file to be written cannot be: those before it are as they were.
    put("vagus.json", "\"scripts\": [\"a.aesl\"]", "\"scripts\": [\"a.aesl\"");
    EXPECT_THAT(refusal("template.new", wanted("Blink")), HasSubstr("vagus.json is not JSON"));
    ask("doc.revert", {{"doc", "vagus.json"}});
    EXPECT_TRUE(is_untouched());
    put("a.aesl#1", "n += 1", "n += ");
    EXPECT_THAT(refusal("template.new", wanted("Blink")),
                HasSubstr("the script of thymio-II has an error; fix it first: line"));
}

TEST_F(OwnTemplateTest, AFileThatWasOpenedAloneHasNoToolboxes) {
    enter({});
    EXPECT_THAT(refusal("template.new", wanted("Blink")), HasSubstr("was opened alone"));
}

}  // namespace
}  // namespace vagus::serve
