// The actors of a plan when the node that drives for them does not run its script any more: they
// end with an error, and nothing waits forever (docs/carbot.md). All times are simulated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "base/test_places.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/virtual_time.hpp"
#include "session/plan_world.hpp"
#include "sim/test_host.hpp"
#include "toolbox/builtin.hpp"

namespace vagus::session {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr uint16_t kDrive = 1;

// What is done to the drive node, and how its script comes to run again.
struct Case {
    const char* name;
    const char* actor;
    void (*stop)(SimSession& session, sim::Host& host);
    void (*run)(SimSession& session, sim::Host& host);
};

void stop(SimSession&, sim::Host& host) {
    host.command<wire::Stop>(kDrive);
}
void reset(SimSession&, sim::Host& host) {
    host.command<wire::Reset>(kDrive);
}
void pause(SimSession&, sim::Host& host) {
    host.command<wire::Pause>(kDrive);
}
void erase(SimSession&, sim::Host& host) {
    host.load(kDrive, {0});
}
void run(SimSession&, sim::Host& host) {
    host.command<wire::Run>(kDrive);
}
// With a change, for what runs is not sent again.
void load(SimSession& session, sim::Host&) {
    const std::string path = test::examples("carbot/carbot.aesl");
    std::string text = read_file(path).value();
    text.insert(text.find("var i\n"), "var more\n");
    session.reload(session.script_paths().front(), text);
}

// With signs of life, and one that commands again and again.
constexpr const char* kForward =
    R"("template": "Forward", "in": { "distance": "1500" }, "states": { "ForwardSuccessful")";
constexpr const char* kWall =
    R"("template": "WallForward", "in": { "length": "500" }, "states": {
       "ForwardSuccessful": "@terminate", "LaneNotFree": "@terminate", "WallLost")";

const Case kCases[] = {{"StopForward", kForward, stop, run},    {"StopWall", kWall, stop, run},
                       {"ResetForward", kForward, reset, run},  {"ResetWall", kWall, reset, run},
                       {"PauseForward", kForward, pause, run},  {"PauseWall", kWall, pause, run},
                       {"EraseForward", kForward, erase, load}, {"EraseWall", kWall, erase, load},
                       {"LoadForward", kForward, load, run},    {"LoadWall", kWall, load, run}};

class PlanSafeState : public testing::TestWithParam<Case> {};

std::string name_of(const testing::TestParamInfo<Case>& info) {
    return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Cases, PlanSafeState, testing::ValuesIn(kCases), name_of);

TEST_P(PlanSafeState, AnActorWhoseCommandTheNodeEndedEndsWithAnError) {
    toolbox::BusNodes nodes;
    const toolbox::Parts parts{.bus = &nodes};
    run::CodeLibrary library;
    toolbox::add_builtin(library, parts);
    PlanWorldOptions how;
    how.path = test::examples("carbot/arena.world.json");
    auto opened = PlanWorld::open(how, nodes);
    ASSERT_TRUE(opened.ok()) << opened.error().what;
    PlanWorld& beside = *opened.value();
    const std::string text = R"({ "format": "vagus-plan/1", "name": "P",
        "toolboxes": ["drive", "carbot"], "start": { "actor": "a" }, "actors": { "a": {)" +
                             std::string(GetParam().actor) + R"(: "@terminate" } } } })";
    const plan::Checked checked =
        plan::check("p.plan.json", plan::OneText(text), library.templates());
    ASSERT_TRUE(checked.ok()) << plan::format_findings_json(checked.findings);
    const plan::Graph graph = plan::make_graph(checked);
    sim::Host host(beside.session().world().bus());
    beside.before_each([&](Time at) {
        if (at == 1s) GetParam().stop(beside.session(), host);
        if (at == 2s) GetParam().run(beside.session(), host);
    });
    run::RunOptions options;
    options.max_time = 20s;
    beside.join(options);
    const run::Ended ended = run::VirtualTime(graph, library, options).run();
    EXPECT_FALSE(ended.timed_out);
    EXPECT_EQ(ended.result, plan::PlanResult::Error);
    EXPECT_THAT(ended.message, HasSubstr("has ended the work by itself"));
    EXPECT_LT(beside.session().now(), 3500ms);
    beside.session().step(1s);
    const auto speed = beside.session().node_variable({1}, "wheel.front.speed");
    ASSERT_FALSE(speed.empty());
    EXPECT_EQ(speed.front(), 0);
}

}  // namespace
}  // namespace vagus::session
