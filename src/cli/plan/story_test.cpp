#include "cli/plan/story.hpp"

#include <gmock/gmock.h>

#include "cli/screen/screen.hpp"
#include "plan/check.hpp"
#include "plan/test_files.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/core.hpp"

namespace vagus::cli {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

// After 1 s `alarm` interrupts for ever and leads to the computation `note` and on to `calm`, while
// which it rests; then `last`.
constexpr std::string_view kPlan = R"({
  "format": "vagus-plan/1",
  "name": "Watchful",
  "configuration": {
    "n": { "type": "int", "initial": 0, "unit": "cm" },
    "text": { "type": "string", "initial": "x" }
  },
  "start": { "actor": "forever", "supervisors": {
    "alarm": { "template": "Timeout", "in": { "seconds": 1 }, "events": { "Timeout": "note" } } } },
  "actors": {
    "forever": { "template": "WaitForever", "supervisors": {
      "tick": { "template": "Every", "in": { "seconds": 100 }, "out": { "count": "n" },
                "events": { "Tick": "@ignore" } } } },
    "note": { "template": "Assign", "in": { "value": "'y'" }, "out": { "result": "text" },
              "states": { "Done": "calm" } },
    "calm": { "template": "Wait", "in": { "seconds": 2 }, "states": { "Done": "count" } },
    "count": { "template": "Assign", "in": { "value": "n + 7" }, "out": { "result": "n" },
               "states": { "Done": "last" } },
    "last": { "template": "Wait", "in": { "seconds": 0.5 }, "states": { "Done": "@terminate" } }
  }
})";

class PlanStoryTest : public ::testing::Test {
protected:
    PlanStoryTest() {
        toolbox::add_core(library_);
        checked_ = plan::check("p.plan.json", plan::OneText(kPlan), library_.templates());
        graph_ = plan::make_graph(checked_);
        run::RunOptions options;
        options.on_trace = [this](const plan::TraceEvent& event) { trace_.push_back(event); };
        (void)run::VirtualTime(graph_, library_, options).run();
    }

    // The story up to and with that time.
    PlanStory until(Time time) {
        PlanStory story(graph_, checked_.plans.front());
        for (const plan::TraceEvent& event : trace_) {
            if (event.at <= time) story.see(event);
        }
        return story;
    }

    run::CodeLibrary library_;
    plan::Checked checked_;
    plan::Graph graph_;
    std::vector<plan::TraceEvent> trace_;
};

std::vector<std::string> names(const std::vector<WatchView>& watching) {
    std::vector<std::string> list;
    for (const WatchView& one : watching) list.push_back(one.name + " " + one.events);
    return list;
}

TEST_F(PlanStoryTest, TellsWhoIsActiveSinceWhen) {
    const PlanPanelView panel = until(500ms).panel(600ms);
    EXPECT_EQ(panel.name, "Watchful");
    EXPECT_EQ(panel.state, "running");
    EXPECT_FALSE(panel.over);
    ASSERT_EQ(panel.actors.size(), 5u);
    EXPECT_TRUE(panel.actors[0].active);
    EXPECT_EQ(panel.actors[0].for_so_long, 600ms);
    EXPECT_FALSE(panel.actors[1].active);
    EXPECT_THAT(names(panel.watching), ElementsAre("alarm Timeout", "tick Tick"));
}

// P23: it rests through computations and while its remedy is active, and watches with the
// activation after that.
TEST_F(PlanStoryTest, AGlobalSupervisorThatRestsDoesNotWatch) {
    EXPECT_THAT(until(2s).panel(2s).watching, testing::IsEmpty());
    EXPECT_THAT(names(until(3200ms).panel(3200ms).watching), ElementsAre("alarm Timeout"));
}

TEST_F(PlanStoryTest, ShowsVariablesAndMarksThoseThatChangedAMomentAgo) {
    const auto before = until(2900ms).panel(2900ms).variables;
    EXPECT_EQ(before[0].value, "0");
    EXPECT_FALSE(before[0].fresh);
    const auto after = until(3100ms).panel(3100ms).variables;
    EXPECT_EQ(after[0].value, "7");
    EXPECT_EQ(after[0].unit, "cm");
    EXPECT_TRUE(after[0].fresh);
    EXPECT_FALSE(after[1].fresh);
}

TEST_F(PlanStoryTest, TellsWhatHappenedTheLatestFirst) {
    const PlanPanelView panel = until(10s).panel(10s);
    EXPECT_EQ(panel.state, "OK");
    EXPECT_TRUE(panel.over);
    std::vector<std::string> told;
    for (const HappeningView& one : panel.happenings) told.push_back(one.text);
    EXPECT_THAT(told, ElementsAre("the plan is over: OK", "last: Done → the plan ends",
                                  "count: Done → last", "calm: Done → count", "note: Done → calm",
                                  "alarm: Timeout → note"));
    // What the variables held at the end stays.
    EXPECT_EQ(panel.variables[0].value, "7");
}

TEST_F(PlanStoryTest, CountsWhatItForgetsOfALongRun) {
    PlanStory story = until(0s);
    EXPECT_EQ(story.panel(0s).forgotten, 0u);
    for (size_t i = 0; i < kHappeningsKept + 1; ++i) {
        story.see({0s, "Watchful", plan::ErrorFound{"e", "wrong"}});
    }
    EXPECT_EQ(story.panel(0s).happenings.size(), kHappeningsKept);
    EXPECT_EQ(story.panel(0s).forgotten, 1u);
}

TEST_F(PlanStoryTest, StandsBesideTheWorldOnThePage) {
    View view;
    view.title = "Hall";
    view.keys = {{"space", "pause"}, {"q", "quit"}, {"e", "escape button"}};
    view.plan = until(1500ms).panel(1500ms);
    view.plan->loads = {{"main", 0.005}, {"drive", 0.0025}};
    view.plan->load = 0.0075;
    const Grid page = draw(view, {100, 30}, {Charset::Ascii, ColourDepth::None});
    std::string text;
    for (int row = 0; row < page.size().rows; ++row) text += page.row_text(row) + "\n";
    EXPECT_THAT(text, HasSubstr("Watchful"));
    EXPECT_THAT(text, HasSubstr("> calm"));
    EXPECT_THAT(text, HasSubstr("0.5 s"));
    EXPECT_THAT(text, HasSubstr("bus 0.75 %"));
    EXPECT_THAT(text, HasSubstr("1.0 alarm: Timeout -> note"));
    EXPECT_THAT(text, HasSubstr("e escape button"));
    EXPECT_THAT(text, testing::Not(HasSubstr("reset")));
}

}  // namespace
}  // namespace vagus::cli
