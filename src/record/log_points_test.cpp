// Log points: against a run that was looked at from its beginning, and where they are refused.
#include "record/log_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "base/rng.hpp"
#include "base/test_folder.hpp"
#include "base/test_places.hpp"
#include "embed/prepared_run.hpp"
#include "embed/robots_run.hpp"
#include "mcap/reader.hpp"
#include "record/compare_tape.hpp"
#include "record/log_run.hpp"
#include "record/plan_recording.hpp"
#include "record/replay.hpp"
#include "record/sim_recording.hpp"
#include "session/plan_world.hpp"
#include "session/toolboxes.hpp"

namespace vagus::record {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

// ---- as text ----

TEST(LogHit, IsALineForPeopleAndOneOfJson) {
    const LogHit hit{20s + 1500us,
                     "drive:42",
                     {{"token", "18", "18"},
                      {"a", "[1, … 1 more]", "[1, 2]"},
                      {"1 / n", "none (why)", R"({"error":"why"})"}}};
    EXPECT_EQ(format_hit(hit),
              "     20.002 s  drive:42  token = 18, a = [1, … 1 more], 1 / n = none (why)");
    EXPECT_EQ(format_hit_json(hit),
              R"({"t":20.001500,"at":"drive:42","values":{"token":18,"a":[1, 2],)"
              R"("1 / n":{"error":"why"}}})");
}

// ---- a plan beside a world ----

const std::string kPlan = test::examples("follow-wall/WallFollow.plan.json");
const std::string kWorld = test::examples("follow-wall/hall.world.json");

// Thirty seconds of the wall follower, which has not begun.
struct Prepared {
    toolbox::Parts parts;  // before the library, whose code looks at them
    run::CodeLibrary library;
    std::optional<embed::LoadedPlan> plan;
    std::unique_ptr<embed::PreparedRun> run;

    Prepared() {
        embed::RunWords words;
        words.world = kWorld;
        words.set = {"walldist=30"};
        words.clock = "virtual";
        words.max_time = "30";
        EXPECT_TRUE(session::add_toolboxes(library, parts, {}).ok());
        plan = embed::LoadedPlan::from_file(kPlan, library);
        EXPECT_TRUE(plan->ok());
        auto prepared = embed::PreparedRun::prepare(*plan, words, parts);
        EXPECT_TRUE(prepared.ok());
        run = std::move(prepared.value());
    }
    session::SimSession& session() { return run->world()->session(); }
};

// A line of a node's program, and words of its memory.
struct Watched {
    std::string where;
    sim::WitnessedNode node;
    uint16_t pc = 0;
    std::vector<aesl::VariablePlace> variables;
};

// Looks at them from the beginning of the run, by addresses alone.
struct Looker final : sim::Witness {
    explicit Looker(session::SimSession& its_session) : session(its_session) {}

    void executes(const sim::WitnessedNode& node, uint16_t pc) override {
        for (const Watched& one : watched) {
            if (one.node.robot != node.robot || one.node.id != node.id || one.pc != pc) continue;
            const auto words = session.world().variables(sim::RobotId{node.robot}, node.id);
            std::string text = std::to_string(session.now().count()) + " " + one.where;
            for (const aesl::VariablePlace& place : one.variables) {
                for (int i = 0; i < place.size; ++i) {
                    text += " " + std::to_string(words[static_cast<size_t>(place.address + i)]);
                }
            }
            seen.push_back(text);
        }
    }

    session::SimSession& session;
    std::vector<Watched> watched;
    std::vector<std::string> seen;
};

// A line that has code, and up to three variables of the node.
Watched random_point(session::SimSession& session, SplitMix64& random, LogWish& wish) {
    const std::vector<session::NodeState> nodes = session.nodes();
    const session::NodeState& node = nodes[random.below(nodes.size())];
    const aesl::Program& program = *session.program(node.id);
    const size_t table = program.bytecode[0];
    const uint16_t line = program.lines[table + random.below(program.lines.size() - table)];
    size_t pc = table;  // of its first word
    while (program.lines[pc] != line) ++pc;
    const int in_file = session.place_of(node.id, line)->second;
    Watched made{.where = node.name + ":" + std::to_string(in_file),
                 .node = {node.robot.number, node.id},
                 .pc = static_cast<uint16_t>(pc),
                 .variables = {}};
    const size_t count = 1 + random.below(3);
    for (size_t i = 0; i < count; ++i) {
        made.variables.push_back(program.variables[random.below(program.variables.size())]);
        wish.values += (i > 0 ? ", " : "") + made.variables.back().name;
    }
    wish.where = made.where;
    return made;
}

std::string text_of(const LogHit& hit) {
    std::string text = std::to_string(hit.at.count()) + " " + hit.where;
    for (const LoggedValue& value : hit.values) {
        std::string numbers = value.json;
        std::erase_if(numbers, [](char c) { return c == '[' || c == ']' || c == ','; });
        text += " " + numbers;
    }
    return text;
}

// "values of 200 random log points equal those of the same run with the log point in it from the
// beginning", and the run is still the same.
TEST(LogPoints, RandomOnesTellWhatTheRunItselfHeld) {
    const size_t count = std::getenv("VAGUS_LONG") != nullptr ? 200 : 20;
    const uint64_t seed = 20261126;
    SCOPED_TRACE("seed " + std::to_string(seed));
    SplitMix64 random(seed);
    test::Folder folder;
    const std::string file = (folder / "run.mcap").string();
    std::vector<LogWish> wishes(count);
    std::vector<std::string> seen;
    {
        FilesRead files;
        Prepared live;
        RunFile about;
        about.verb = "plan run";
        about.plan = kPlan;
        about.world = kWorld;
        about.set = {"walldist=30"};
        about.max_time = "30";
        auto recording = PlanRecording::begin(file, about, files.all(), *live.run, Pace::Waits);
        ASSERT_TRUE(recording.ok());
        Looker looker(live.session());
        for (LogWish& wish : wishes) {
            looker.watched.push_back(random_point(live.session(), random, wish));
        }
        live.session().world().watch(&looker);
        ASSERT_TRUE(live.run->run().ok());
        ASSERT_TRUE(recording.value()->end().ok());
        live.session().world().watch(nullptr);
        seen = std::move(looker.seen);
    }
    ASSERT_GT(seen.size(), 1000u);
    const std::string bytes = read_file(file).value();
    const auto reader = mcap::Reader::open(bytes, "run.mcap");
    ASSERT_TRUE(reader.ok());
    std::vector<std::string> told;
    for (size_t first = 0; first < count; first += kLogPointsMax) {
        const size_t last = std::min(count, first + kLogPointsMax);
        auto rerun = Rerun::open(reader.value(), {});
        ASSERT_TRUE(rerun.ok());
        const std::vector<LogWish> some(wishes.begin() + static_cast<std::ptrdiff_t>(first),
                                        wishes.begin() + static_cast<std::ptrdiff_t>(last));
        const auto points =
            LogPoints::set(some, {{rerun.value()->session(), nullptr}},
                           [&told](const LogHit& hit) { told.push_back(text_of(hit)); });
        ASSERT_TRUE(points.ok()) << points.error().what;
        CompareTape tape(reader.value());
        ASSERT_TRUE(rerun.value()->run(tape).ok());
        EXPECT_TRUE(tape.end().ok());
        EXPECT_FALSE(tape.difference()) << tape.difference()->topic;
    }
    // Two points at one instruction may come in either order, and the reruns one after the other.
    std::sort(seen.begin(), seen.end());
    std::sort(told.begin(), told.end());
    EXPECT_EQ(told.size(), seen.size());
    EXPECT_TRUE(told == seen);
}

// ---- a fleet ----

std::vector<LogPoints::Bus> buses_of_run(embed::RobotsRun& run) {
    std::vector<LogPoints::Bus> all = {{&run.buses().common(), nullptr}};
    for (size_t i = 0; i < run.buses().robots().size(); ++i) {
        const session::RobotBus& robot = run.buses().robots()[i];
        const plan::Graph* const graph = run.plan(i) != nullptr ? &run.plan(i)->graph() : nullptr;
        all.push_back({robot.session.get(), graph, robot.name, robot.id.number});
    }
    return all;
}

// The same points are in the run from its beginning, and put into its recording afterwards.
void expect_told_again(const std::string& world, Time until, const std::vector<LogWish>& wishes) {
    const test::Folder folder;
    const std::string path = (folder / "run.mcap").string();
    std::vector<std::string> then, again;
    {
        FilesRead files;
        RunFile about;
        about.verb = "sim";
        about.world = world;
        auto run = embed::RobotsRun::open({.world = world});
        ASSERT_TRUE(run.ok()) << run.error().what;
        auto recording = SimRecording::begin(path, about, files, *run.value(), Pace::Waits);
        ASSERT_TRUE(recording.ok()) << recording.error().what;
        const auto points =
            LogPoints::set(wishes, buses_of_run(*run.value()),
                           [&then](const LogHit& hit) { then.push_back(format_hit(hit)); });
        ASSERT_TRUE(points.ok()) << points.error().what;
        run.value()->watch(points.value().get());
        ASSERT_TRUE(run.value()->start().ok());
        run.value()->step(until);
        points.value()->close();
        run.value()->watch(nullptr);
        ASSERT_TRUE(recording.value()->end().ok());
    }
    const std::string bytes = read_file(path).value();
    const auto reader = mcap::Reader::open(bytes, "run.mcap");
    const auto wanted = [&wishes](Rerun&) -> Wishes { return wishes; };
    const auto told =
        log_run(reader.value(), {.wishes = wanted, .told = [&again](const LogHit& hit) {
                                     again.push_back(format_hit(hit));
                                 }});
    ASSERT_TRUE(told.ok()) << told.error().what;
    EXPECT_GT(then.size(), 10u);
    EXPECT_EQ(then, again);
}

// Line 29 of the class: a Thymio looks at the ground. Line 39: it stops.
TEST(LogPoints, OfAFleetTellWhatTheyWouldHaveToldThen) {
    expect_told_again(test::examples("alarm/class.world.json"), 8s,
                      {{"thymio-II:39", "warned, motor.left.target"},
                       {"t11/thymio-II:29", "warned, prox.ground.delta[0]"}});
    expect_told_again(test::examples("warehouse/hall.world.json"), 15s,
                      {{"@meet.enter", "robots"}, {"r3/@whoAmI.enter", "place"}});
}

// ---- elements, by a trace made by hand ----

const plan::Graph& graph() {
    static const Prepared prepared;
    return prepared.plan->graph();
}

TEST(LogPoints, AnElementIsTakenWithWhatItWrites) {
    std::vector<std::string> told;
    const auto points = LogPoints::set(
        {{"@findWallAngle.enter", "wallangle"},
         {"@findWallAngle.leave", "wallangle, wallangle / 2, min(walldist, share)"},
         {"@touch.raise", "wallangle"}},
        {{nullptr, &graph()}}, [&told](const LogHit& hit) { told.push_back(format_hit(hit)); });
    ASSERT_TRUE(points.ok()) << points.error().what;
    const auto see = [&points](Time at, auto what) {
        points.value()->see(0, {.at = at, .plan = "WallFollow", .what = std::move(what)});
    };
    see(0s, plan::PlanStarted{});
    see(1s, plan::EventRaised{"touch", "TouchSensorPressed", "backupCollision", false, 1});
    see(2s, plan::ActorStarted{"findWallAngle", 1, {}});
    see(3s, plan::ActorEnded{"findWallAngle", 1, "WallFound", "parallelToWall"});
    see(3s, plan::VariableWritten{"wallangle", plan::Value(64.5), "findWallAngle"});
    see(3s, plan::ActorStarted{"parallelToWall", 2, {}});
    see(4s, plan::ActorStarted{"findWallAngle", 3, {}});
    see(5s, plan::ActorInterrupted{"findWallAngle", 3, true, 0s});
    see(6s, plan::PlanEnded{plan::PlanResult::Ok, ""});
    EXPECT_EQ(told,
              (std::vector<std::string>{
                  "      1.000 s  @touch.raise  wallangle = 0",
                  "      2.000 s  @findWallAngle.enter  wallangle = 0",
                  "      3.000 s  @findWallAngle.leave  wallangle = 64.5, wallangle / 2 = 32.25, "
                  "min(walldist, share) = 1",
                  "      4.000 s  @findWallAngle.enter  wallangle = 64.5",
                  "      5.000 s  @findWallAngle.leave  wallangle = 64.5, wallangle / 2 = 32.25, "
                  "min(walldist, share) = 1"}));
    EXPECT_EQ(points.value()->not_reached(), std::vector<std::string>());
}

// ---- refused ----

std::string refusal(const std::string& where, const std::string& values,
                    const std::string& file = "") {
    static Prepared prepared;
    const auto points = LogPoints::set({{where, values, file}},
                                       {{&prepared.session(), &prepared.plan->graph()}}, {});
    return points.ok() ? "" : points.error().what;
}

TEST(LogPoints, WhatIsNotThereIsRefused) {
    EXPECT_EQ(refusal("drive", "token"),
              "--log drive: expected NODE:LINE, as drive:42, or @ACTOR.enter, @ACTOR.leave or "
              "@SUPERVISOR.raise of the plan; found \"drive\"");
    EXPECT_THAT(refusal("drive:0", "token"), HasSubstr("expected NODE:LINE"));
    EXPECT_THAT(refusal("@followWall", "walldist"), HasSubstr("@ACTOR.enter"));
    EXPECT_EQ(refusal("driv:42", "token"),
              "--log driv:42: there is no node \"driv\"; did you mean drive?");
    EXPECT_EQ(refusal("@followwall.enter", "walldist"),
              "--log @followwall.enter: the plan has no actor \"followwall\"; did you mean "
              "followWall?");
    EXPECT_THAT(refusal("@followWall.raise", "walldist"), HasSubstr("the plan has no supervisor"));
    EXPECT_EQ(refusal("@Rooms/followWall.enter", "walldist"),
              "--log @Rooms/followWall.enter: there is no plan \"Rooms\"; there are: WallFollow");
    EXPECT_EQ(refusal("@followWall.enter", "wallist"),
              "--log @followWall.enter: the plan WallFollow has no variable \"wallist\"; did you "
              "mean walldist?");
    EXPECT_THAT(refusal("@followWall.enter", "walldist, "),
                HasSubstr("expected values with commas between them"));
    // Line 1 of the file is above the script of every node.
    EXPECT_THAT(refusal("drive:1", "token"),
                HasSubstr("drive has no code at line 1 of carbot.aesl; the nearest with code: "));
    EXPECT_THAT(refusal("drive:9000", "token"), HasSubstr("has no code at line 9000"));
}

// As an editor counts that shows the script of one node: drive's begins at line 61 of the file.
TEST(LogPoints, LinesOfAScriptAreToldAsItsEditorCounts) {
    EXPECT_EQ(refusal("drive:61", "token", "carbot.aesl"),
              "--log drive:61: drive has no code at line 1 of its script; the nearest with code: "
              "10");
    EXPECT_EQ(refusal("drive:70", "token", "other.aesl"),
              "--log drive:70: in the recorded run drive had the script of carbot.aesl, not of "
              "other.aesl");
}

TEST(LogPoints, ValuesOfAScriptAreChecked) {
    Prepared prepared;
    const session::NodeState node = prepared.session().nodes().front();
    const aesl::Program& program = *prepared.session().program(node.id);
    const int line =
        prepared.session().place_of(node.id, program.lines[program.bytecode[0]])->second;
    const std::string where = node.name + ":" + std::to_string(line);
    EXPECT_EQ(refusal(where, "token, patience / 2, watch.x, watch.left[i + 1]"), "");
    EXPECT_THAT(refusal(where, "tokn"), HasSubstr("has no variable \"tokn\"; did you mean token?"));
    EXPECT_THAT(refusal(where, "zzzzzzzz"), HasSubstr("there are: "));
    EXPECT_THAT(refusal(where, "watch.x > 1"), HasSubstr("because watch.x has 4 words"));
    std::string many = "token";
    for (size_t i = 1; i < kLogValuesMax; ++i) many += ", token";
    EXPECT_EQ(refusal(where, many), "");
    EXPECT_THAT(refusal(where, many + ", token"),
                HasSubstr("shows 17 values; at most 16 are possible"));
    const std::vector<LogWish> points(kLogPointsMax + 1, {where, "token"});
    const auto set = LogPoints::set(points, {{&prepared.session(), nullptr}}, {});
    ASSERT_FALSE(set.ok());
    EXPECT_EQ(set.error().what, "there are 101 log points; at most 100 are possible");
}

}  // namespace
}  // namespace vagus::record
