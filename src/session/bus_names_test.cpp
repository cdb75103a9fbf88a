#include "session/bus_names.hpp"

#include <gmock/gmock.h>

#include "plan/check.hpp"
#include "plan/test_files.hpp"
#include "toolbox/core.hpp"

namespace vagus::session {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const BusNames kNames({.events = {{"turning", 1}, {"clear", 0}, {"any", std::nullopt}},
                       .constants = {}},
                      "the scripts of arena.world.json");

std::string refusal(const run::BusEvent& event) {
    const Status status = kNames.may_emit(event);
    return status.ok() ? "" : status.error().what;
}

TEST(BusNames, AnEventNeedsANumberAndItsArguments) {
    EXPECT_EQ(refusal({"turning", {1}}), "");
    EXPECT_EQ(refusal({"any", {1, 2, 3}}), "");
    EXPECT_EQ(refusal({"turnin", {1}}),
              "the event \"turnin\" has no number: it is not declared by the scripts of "
              "arena.world.json; did you mean \"turning\"?");
    EXPECT_EQ(refusal({"jump", {}}),
              "the event \"jump\" has no number: it is not declared by the scripts of "
              "arena.world.json; add <event name=\"jump\" size=\"…\"/> to the project");
    EXPECT_EQ(refusal({"clear", {1, 2}}),
              "the event \"clear\" takes 0 arguments, found 2; give it as many as the project "
              "declares");
}

TEST(BusNames, WithoutEventsTheSentenceSaysSo) {
    const BusNames none({}, "the scripts of arena.world.json");
    const Status status = none.may_emit({"go", {}});
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().what,
                HasSubstr("no events are declared by the scripts of arena.world.json"));
}

TEST(BusNames, FindsWhatAPlanNamesOutrightAndNobodyDeclares) {
    constexpr std::string_view kPlan = R"({
  "format": "vagus-plan/1",
  "name": "P",
  "configuration": { "which": { "type": "string", "initial": "jump" } },
  "start": { "actor": "a", "supervisors": {
    "s": { "template": "OnEvent",
           "in": { "event": "'jum' & 'p'" }, "events": { "Received": "@terminate" } } } },
  "actors": {
    "a": { "template": "Send", "in": { "event": "'clear'" }, "states": { "Sent": "b" } },
    "b": { "template": "Send", "in": { "event": "which" }, "states": { "Sent": "c" } },
    "c": { "template": "Receive",
           "in": { "event": "'claer'" }, "states": { "Received": "@terminate" } }
  }
})";
    run::CodeLibrary library;
    toolbox::add_core(library);
    const plan::Checked checked =
        plan::check("p.plan.json", plan::OneText(kPlan), library.templates());
    ASSERT_TRUE(checked.ok());
    std::vector<std::string> found;
    for (const plan::Finding& finding : kNames.check(checked.plans, library.templates())) {
        found.push_back(finding.file + ":" + std::to_string(finding.line) + " " + finding.element);
    }
    EXPECT_THAT(found, ElementsAre("p.plan.json:7 s", "p.plan.json:12 c"));
    EXPECT_TRUE(uses_bus(checked.plans, library.templates()));
}

// At the line of the template, once for an element, however many events it misses.
TEST(BusNames, FindsTemplatesWhoseEventsNobodyDeclares) {
    constexpr std::string_view kPlan = R"({
  "format": "vagus-plan/1", "name": "P", "toolboxes": ["arm"], "start": { "actor": "a" },
  "actors": {
    "a": {
      "template": "Turn", "states": { "Done": "b" } },
    "b": {
      "template": "Grip", "states": { "Done": "@terminate" } } } })";
    run::CodeLibrary library;
    toolbox::add_core(library);
    const auto make = [] { return std::unique_ptr<run::Actor>(); };  // never run here
    library.add("arm", "",
                {{.declared = {.name = "Turn",
                               .outcomes = {{.name = "Done"}},
                               .bus = {.events = {"turning", "turnin"}}},
                  .actor = make},
                 {.declared = {.name = "Grip",
                               .outcomes = {{.name = "Done"}},
                               .bus = {.events = {"grip", "clear", "gripped"}}},
                  .actor = make}});
    const plan::Checked checked =
        plan::check("p.plan.json", plan::OneText(kPlan), library.templates());
    ASSERT_TRUE(checked.ok());
    const plan::Findings findings = kNames.check(checked.plans, library.templates());
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_EQ(findings[0].element, "a");
    EXPECT_EQ(findings[0].line, 5);
    EXPECT_EQ(
        findings[0].message,
        "the template Turn works by events, and the event \"turnin\" has no number: it is not "
        "declared by the scripts of arena.world.json; did you mean \"turning\"?");
    EXPECT_EQ(findings[1].line, 7);
    EXPECT_THAT(findings[1].message,
                HasSubstr("\"grip\" and \"gripped\" are not declared by the scripts of arena"));
}

TEST(BusNames, APlanOfWaitsUsesNoBus) {
    constexpr std::string_view kPlan = R"({
  "format": "vagus-plan/1", "name": "P", "start": { "actor": "a" },
  "actors": { "a": { "template": "Wait", "in": { "seconds": 1 },
                     "states": { "Done": "@terminate" } } } })";
    run::CodeLibrary library;
    toolbox::add_core(library);
    const plan::Checked checked =
        plan::check("p.plan.json", plan::OneText(kPlan), library.templates());
    ASSERT_TRUE(checked.ok());
    EXPECT_FALSE(uses_bus(checked.plans, library.templates()));
    EXPECT_THAT(kNames.check(checked.plans, library.templates()), IsEmpty());
}

}  // namespace
}  // namespace vagus::session
