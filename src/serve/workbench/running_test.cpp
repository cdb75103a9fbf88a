// What people ask of a run, and what its process then is told; the process says what the test says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "base/test_folder.hpp"
#include "net/links.hpp"
#include "serve/json.hpp"
#include "serve/talk/codec.hpp"
#include "serve/workbench/test_runner.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kPageToken = "0123456789abcdef";
constexpr const char* kWorld =
    "{ \"format\": \"vagus-world/1\", \"size\": [2, 2], \"robots\": [] }\n";
constexpr const char* kPlan =
    "{ \"format\": \"vagus-plan/1\", \"name\": \"Go\", \"start\": { \"actor\": \"wait\" }, "
    "\"actors\": { \"wait\": { \"template\": \"Wait\", \"in\": { \"seconds\": 9 }, \"states\": { "
    "\"Done\": \"@terminate\" } } } }\n";

class RunningTest : public testing::Test {
protected:
    RunningTest() {
        desk.hear(ClientOpened{{1}, "127.0.0.1"}, now);
        say("hello", {{"token", kPageToken}, {"client", "test"}});
    }
    Result<std::unique_ptr<RunProcess>> start() { return start_scripted(runner); }
    void write(const std::string& path, const std::string& text) const {
        std::ofstream(root / path) << text;
    }
    std::string path(const std::string& name) const { return (root / name).string(); }
    // The project has what is named here: "world", "plan", "target".
    void open(const Json& members) {
        write("w.world.json", kWorld);
        write("Go.plan.json", kPlan);
        Json project = members;
        project["format"] = "vagus-project/1";
        write("vagus.json", project.dump());
        ASSERT_TRUE(bench.open(root.string(), now).ok());
        turn();
    }

    // The answer, or null if it comes later.
    Json say(const std::string& command, const Json& in = Json::object()) {
        now += 10ms;
        answers.clear();
        const double until = static_cast<double>(now.count()) / 1000 + 3000;
        const Json message = {{"id", ++id}, {"do", command}, {"in", in}, {"until", until}};
        desk.hear(ClientText{{1}, message.dump()}, now);
        for (const Json& answer : answers) {
            if (answer.value("id", uint64_t{0}) == id) return answer;
        }
        return nullptr;
    }
    std::string problem(const std::string& command) {
        const Json answer = say(command);
        return answer.is_object() && answer.contains("error") ? answer["error"]["what"] : Json("");
    }
    void turn() {
        for (int i = 0; i < 5; ++i) bench.tick(now += 10ms);
    }

    // The orders that the process got since the last time, by their names; the last of each kind.
    std::vector<std::string> orders() {
        std::vector<std::string> names;
        if (!runner) return names;
        for (const Packet& packet : runner->receive()) {
            const auto order = talk::decode_order(packet);
            EXPECT_TRUE(order.ok()) << (order.ok() ? "" : order.error().what);
            if (!order.ok()) continue;
            std::visit(
                [&](const auto& one) {
                    names.emplace_back(one.kName);
                    keep(one);
                },
                order.value());
        }
        // Frames, when and how fast: that is for others to test.
        const std::set<std::string> ours = {"open", "plan.change", "plan.stop", "step"};
        std::erase_if(names, [&](const std::string& name) { return !ours.contains(name); });
        return names;
    }
    void keep(const talk::Open& one) { opened = one; }
    void keep(const talk::ChangePlan& one) { changed = one.files; }
    template <typename Other>
    void keep(const Other&) {}

    void tell(const talk::News& news) { ASSERT_TRUE(runner->send(talk::encode(news))); }
    // What was ordered last is open.
    void is_open() {
        tell(talk::Opened{.order = opened.order, .scene = talk::Scene{}});
        turn();
        turn();
    }
    void plan_is(talk::PlanState state) {
        tell(talk::PlanNow{.state = state, .file = path("Go.plan.json")});
    }
    void edit_plan() {
        const Json in = {{"doc", "Go.plan.json"}};
        const Json text = say("doc.open", in)["ok"];
        const Json change = {{"from", 0}, {"to", 0}, {"text", " "}};
        const Json answer = say("doc.edit", {{"doc", "Go.plan.json"},
                                             {"epoch", text["epoch"]},
                                             {"version", text["version"]},
                                             {"by", "page"},
                                             {"changes", {change}}});
        EXPECT_TRUE(answer.contains("ok")) << answer.dump();
    }

    const test::Folder root;
    Time now = 10s;
    uint64_t id = 0;
    std::vector<Json> answers;
    std::optional<Pipe> runner;
    talk::Open opened;
    std::vector<std::string> changed;
    net::Links network;
    Desk desk{Access(kPageToken, std::nullopt),
              {.send =
                   [this](ClientId, bool binary, std::string bytes) {
                       if (!binary) answers.push_back(Json::parse(bytes));
                   },
               .close = [](ClientId, const std::string&) {},
               .log = [](const std::string&) {},
               .wall_ms = [] { return 1e12; }}};
    const test::Folder data;
    Workbench bench{network,
                    desk,
                    {.library = {data, data / "examples"},
                     .settings = (data / "settings.json").string(),
                     .program = "/bin/false",
                     .home = data.string(),
                     .runner = [this] { return start(); }}};
};

TEST_F(RunningTest, AWorldThatStandsThereIsNotOpenedAgain) {
    open({{"world", "w.world.json"}});
    ASSERT_THAT(orders(), ElementsAre("open"));
    EXPECT_EQ(opened.world, path("w.world.json"));
    EXPECT_EQ(opened.plan, "");
    is_open();
    say("run.start");
    turn();
    EXPECT_THAT(orders(), IsEmpty());  // it is open already
}

// Pause is for going on.
TEST_F(RunningTest, RunAfterStopBeginsAtTheStartOfTheWorld) {
    open({{"world", "w.world.json"}});
    orders();
    is_open();
    say("run.start");
    turn();
    say("world.move", {{"robot", "anna"}, {"at", {1, 1}}});
    say("stop");
    turn();
    say("run.start");
    turn();
    EXPECT_THAT(orders(), ElementsAre("open"));
    is_open();
    say("run.pause");
    say("run.start");
    turn();
    EXPECT_THAT(orders(), IsEmpty());
}

TEST_F(RunningTest, ARobotThatWasPlacedByHandAfterStopBeginsThere) {
    open({{"world", "w.world.json"}});
    orders();
    is_open();
    say("run.start");
    turn();
    say("stop");
    turn();
    say("world.move", {{"robot", "anna"}, {"at", {1, 1}}});
    say("run.start");
    turn();
    EXPECT_THAT(orders(), IsEmpty());
    // That run is over, too.
    say("stop");
    turn();
    say("run.start");
    turn();
    EXPECT_THAT(orders(), ElementsAre("open"));
}

// It is read on a thread of its own, and nobody expects a run of it any more.
TEST_F(RunningTest, ARecordingThatIsStillReadDoesNotRunBehindAStop) {
    write("run.mcap", "none");
    open({{"world", "w.world.json"}});
    EXPECT_EQ(say("recording.open", {{"path", "run.mcap"}}), nullptr);
    const uint64_t asked = id;
    say("stop");
    std::string why;
    while (why.empty()) {
        turn();
        for (const Json& answer : answers) {
            if (answer.value("id", uint64_t{0}) == asked) why = answer["error"]["what"];
        }
    }
    EXPECT_EQ(why, "it was stopped before it ran");
}

TEST_F(RunningTest, RunTakesTheSimulatorWhereNothingElseIsChosen) {
    open({{"world", "w.world.json"}});
    orders();
    say("target.choose", {{"target", "tcp:127.0.0.1:1"}});
    turn();
    EXPECT_EQ(bench.project()->target, "tcp:127.0.0.1:1");
    EXPECT_THAT(problem("run.start"), testing::Not(IsEmpty()));  // nobody is there
    EXPECT_EQ(bench.project()->target, "tcp:127.0.0.1:1");
    say("target.leave");
    turn();
    orders();
    say("run.start");
    turn();
    EXPECT_THAT(orders(), ElementsAre("open"));
    EXPECT_EQ(bench.project()->target, "sim");
}

TEST_F(RunningTest, WithoutAWorldAndARobotRunSaysWhatIsMissing) {
    open({{"name", "empty"}});
    for (const char* command : {"run.start", "run.reset"}) {
        EXPECT_THAT(problem(command), HasSubstr("no world to simulate")) << command;
    }
    EXPECT_THAT(problem("run.step"), HasSubstr("nothing runs"));
    EXPECT_THAT(problem("plan.start"), HasSubstr("the project has no plan"));
    EXPECT_THAT(problem("plan.pause"), HasSubstr("no plan runs"));
    EXPECT_FALSE(runner.has_value());
}

// What begins does so with what is saved: it is not told of that once more.
TEST_F(RunningTest, APlanThatBeginsIsNotToldOfItsOwnText) {
    open({{"world", "w.world.json"}, {"plan", "Go.plan.json"}});
    EXPECT_THAT(orders(), ElementsAre("open"));
    is_open();
    edit_plan();
    say("run.start");
    EXPECT_THAT(orders(), ElementsAre("open"));
    EXPECT_EQ(opened.plan, path("Go.plan.json"));
    EXPECT_FALSE(bench.project()->plan.empty());
    tell(talk::Opened{.order = opened.order, .scene = talk::Scene{}});
    plan_is(talk::PlanState::Running);
    turn();
    turn();
    EXPECT_THAT(orders(), IsEmpty());
    // Typed while it runs, and saved by Run: it takes over.
    edit_plan();
    say("run.start");
    turn();
    EXPECT_THAT(orders(), ElementsAre("plan.change"));
    EXPECT_THAT(changed, ElementsAre(path("Go.plan.json")));
    // One that begins again does so with it.
    edit_plan();
    say("plan.start");
    turn();
    EXPECT_THAT(orders(), testing::Not(testing::Contains("plan.change")));
}

TEST_F(RunningTest, AFromAndValuesAreForThePlanThatIsNamed) {
    open({{"world", "w.world.json"},
          {"plan", "Go.plan.json"},
          {"start", {{"set", {{"speed", "3"}}}}}});
    orders();
    is_open();
    write("Other.plan.json", kPlan);
    say("plan.start", {{"doc", "Other.plan.json"}, {"from", "wait"}, {"set", {{"far", 2}}}});
    turn();
    EXPECT_THAT(orders(), ElementsAre("open"));
    EXPECT_EQ(opened.plan, path("Other.plan.json"));
    EXPECT_EQ(opened.from, "wait");
    EXPECT_EQ(opened.set.size(), 1u);
    EXPECT_TRUE(opened.set.contains("far"));
}

TEST_F(RunningTest, NoCommandForARunIsObeyedBesideAnotherTarget) {
    open({{"world", "w.world.json"}});
    orders();
    is_open();
    EXPECT_EQ(problem("run.step"), "");  // it is paused there
    EXPECT_THAT(orders(), ElementsAre("step"));
    say("target.leave");
    turn();
    turn();
    EXPECT_THAT(problem("run.step"), HasSubstr("nothing runs"));
}

}  // namespace
}  // namespace vagus::serve
