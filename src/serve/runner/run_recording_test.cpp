// Runs of the studio are recorded by their process: run again they are the same, and can be asked.
#include "serve/runner/run_recording.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "base/seconds.hpp"
#include "base/test_places.hpp"
#include "mcap/reader.hpp"
#include "record/compare_runs.hpp"
#include "record/compare_tape.hpp"
#include "record/replay.hpp"
#include "record/topics.hpp"
#include "record/why.hpp"
#include "serve/runner/test_recording.hpp"
#include "serve/runner/test_run_host.hpp"
#include "trial/continuation.hpp"
#include "wire/messages.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class RunRecordingTest : public RunnerTest {
protected:
    std::string file = (folder / "run.mcap").string();

    talk::Open recorded(const std::string& world_file, const std::string& plan = "") {
        talk::Open open = order(1, world_file, plan);
        open.recording = file;
        return open;
    }
    // A request that every node answers.
    static talk::SendFrame ask_all() {
        wire::ListNodes list{};
        list.version = wire::kProtocolVersion;
        wire::Frame frame{};
        EXPECT_EQ(wire::encode_message(list, wire::kHostId, frame), wire::Error::None);
        return {{frame}};
    }
    static talk::SendFrame stop(uint16_t node) {
        wire::Stop stop{};
        stop.dest = node;
        wire::Frame frame{};
        EXPECT_EQ(wire::encode_message(stop, wire::kHostId, frame), wire::Error::None);
        return {{frame}};
    }
    void done(uint64_t request) {
        const auto answer = wait<talk::Answer>(
            [request](const talk::Answer& one) { return one.request == request; });
        EXPECT_EQ(answer.why, "") << "request " << request;
    }
    double clock_from(double t) {
        return wait<talk::Clock>([t](const talk::Clock& clock) { return clock.t > t; }).t;
    }
    // Runs it again; gives how many messages were compared.
    uint64_t same_again() { return same_again(file); }
    static uint64_t same_again(const std::string& recording) {
        const std::string bytes = read_file(recording).value();
        const auto reader = mcap::Reader::open(bytes, "run.mcap");
        if (!reader.ok()) return ADD_FAILURE() << reader.error().what, 0;
        EXPECT_TRUE(reader.value().is_complete());
        auto rerun = record::Rerun::open(reader.value(), {});
        if (!rerun.ok()) return ADD_FAILURE() << rerun.error().what, 0;
        record::CompareTape tape(reader.value());
        EXPECT_TRUE(rerun.value()->run(tape).ok());
        EXPECT_TRUE(tape.end().ok());
        if (const auto& found = tape.difference()) {
            ADD_FAILURE() << seconds_of(found->at) << " s " << found->topic << " " << found->place
                          << "\n then " << found->then << "\n now  " << found->now;
        }
        return tape.compared();
    }
    // A run that continues from an instant of the recorded one, so long; its recording.
    std::string continued(uint64_t number, talk::Open open, double t, double until) {
        open.order = number;
        open.past = talk::PastOf{file, t};
        open.recording = (folder / ("run-" + std::to_string(number) + ".mcap")).string();
        say(talk::SetPace{true, 1});
        say(open);
        (void)wait<talk::Opened>([number](const talk::Opened& one) { return one.order == number; });
        EXPECT_NEAR(wait<talk::Clock>().t, t, 0.0011);
        say(talk::SetPace{false, 0});
        (void)clock_from(until);
        return open.recording;
    }
    // Where it differs first from the recorded run.
    static std::optional<Time> parts_at(const std::string& one, const std::string& other) {
        const std::string a = read_file(one).value();
        const std::string b = read_file(other).value();
        const auto found = record::compare_runs(mcap::Reader::open(a, "a").value(),
                                                mcap::Reader::open(b, "b").value(), {});
        if (!found.ok()) return ADD_FAILURE() << found.error().what, std::nullopt;
        if (!found.value().differs()) return std::nullopt;
        return found.value().lanes.front().difference->at;
    }
    // The first link of an answer.
    record::Chain why(const std::vector<std::string>& words, std::optional<Time> at) {
        const std::string bytes = read_file(file).value();
        const auto reader = mcap::Reader::open(bytes, "run.mcap");
        if (!reader.ok()) return ADD_FAILURE() << reader.error().what, record::Chain();
        const auto question = record::read_question(words);
        const auto chain = record::why(reader.value(), question.value(), at);
        if (!chain.ok()) return ADD_FAILURE() << chain.error().what, record::Chain();
        return chain.value();
    }
};

// Frames and a hand come while time is stopped, while it passes, and while it is stopped again.
TEST_F(RunRecordingTest, AWorldWithFramesAndHandsIsTheSameAgain) {
    say(talk::SetPace{true, 1});
    say(recorded(test::examples("thymio/arena.world.json")));
    (void)wait<talk::Opened>();
    say(ask_all());
    (void)wait<talk::FrameSeen>();
    say(talk::PutObject{.request = 1, .kind = talk::ObjectKind::Cylinder, .at = {0.5, 0.5}});
    done(1);
    say(talk::SetPace{false, 0});
    double t = clock_from(2);
    say(talk::PressButton{2, "thymio", "forward", true});
    done(2);
    t = clock_from(t + 1);
    say(talk::MoveRobot{3, "thymio", {0.6, 0.6}, 1.25});
    say(ask_all());
    done(3);
    t = clock_from(t + 1);
    say(talk::SetPace{true, 1});
    say(ask_all());
    say(talk::TapRobot{4, "thymio"});
    done(4);
    say(talk::SetPace{false, 0});
    (void)clock_from(t + 1);
    EXPECT_EQ(leave(), 0);
    EXPECT_GT(same_again(), 200u);
}

TEST_F(RunRecordingTest, APlanWithABreakpointSettingsAndANewVersionIsTheSameAgain) {
    const std::string text = read_file(test::examples("follow-wall/WallFollow.plan.json")).value();
    const std::string plan = write("WallFollow.plan.json", text);
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"), plan);
    open.set["walldist"] = "30";
    open.breakpoints = {{.number = 7, .plan = plan, .element = "parallelToWall"}};
    say(talk::SetPace{true, 1});
    say(open);
    (void)wait<talk::Opened>();
    say(ask_all());
    (void)wait<talk::FrameSeen>();
    say(talk::SetPace{false, 0});
    (void)wait<talk::PlanNow>([](const talk::PlanNow& now) { return !now.stands_at.empty(); });
    // Held in the middle of an instant.
    say(talk::SetVariable{1, 0, "walldist", plan::Value(int64_t{35})});
    done(1);
    say(ask_all());
    (void)wait<talk::FrameSeen>();
    say(talk::PutObject{.request = 2, .at = {1.5, 0.3}, .id = "put"});
    done(2);
    say(talk::SetBreakpoints{});
    (void)wait<talk::BreakpointsNow>(
        [](const talk::BreakpointsNow& now) { return now.list.empty(); });
    // As fast as it can, the plan would end before it has its new version.
    say(talk::SetPace{false, 20});
    double t = clock_from(20);
    // While it runs, and a new version.
    say(talk::SetVariable{3, 0, "walldist", plan::Value(int64_t{25})});
    done(3);
    std::string other = text;
    ASSERT_NE(other.find("\"help\""), std::string::npos);
    other.replace(other.find("\"help\": \"") + 9, 0, "Another one. ");
    write("WallFollow.plan.json", other);
    say(talk::ChangePlan{4, {plan}});
    done(4);
    t = clock_from(t + 20);
    say(talk::StopPlan{});
    (void)wait<talk::PlanNow>(
        [](const talk::PlanNow& now) { return now.state == talk::PlanState::Ended; });
    // The world lives on.
    say(talk::MoveRobot{5, "carbot", {1, 1}, 0});
    done(5);
    (void)clock_from(t + 2);
    EXPECT_EQ(leave(), 0);
    EXPECT_GT(same_again(), 5000u);
    const record::Chain chain = why({"variable", "walldist"}, from_seconds(t));
    ASSERT_FALSE(chain.empty());
    EXPECT_EQ(chain.front().what, "a person gave the variable walldist its value");
    EXPECT_EQ(chain.front().value, "25");
    EXPECT_THAT(why({"motor", "carbot"}, from_seconds(15)).front().place,
                HasSubstr("carbot/carbot.aesl:"));
}

// A run that is opened again stands in the middle of the instant at which it was paused. What nodes
// emitted at that instant is in its history, and is not heard again.
TEST_F(RunRecordingTest, NothingOfItsLastInstantIsHeardTwice) {
    const std::string plan = test::examples("follow-wall/WallFollow.plan.json");
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"), plan);
    open.breakpoints = {{.number = 7, .plan = plan, .element = "parallelToWall"}};
    say(talk::SetPace{false, 0});
    say(open);
    (void)wait<talk::PlanNow>([](const talk::PlanNow& now) { return !now.stands_at.empty(); });
    say(talk::FlushRecording{1});
    done(1);
    open.order = 2;
    open.past = talk::PastOf{.recording = file};
    open.recording.clear();
    open.breakpoints.clear();
    say(open);
    (void)wait<talk::Opened>([](const talk::Opened& one) { return one.order == 2; });
    say(ask_all());
    // The answers come behind what waited.
    EXPECT_FALSE(wire::is_user_event(wait<talk::FrameSeen>().frame.frame.type));
}

// Whoever looks at the events that a paused plan holds takes what waits from the bus, and Stop does
// not pass that any more: the same again, also of a run that continues behind it.
TEST_F(RunRecordingTest, APausedPlanThatIsLookedAtAndStoppedIsTheSameAgain) {
    const std::string plan = test::examples("follow-wall/WallFollow.plan.json");
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"), plan);
    open.breakpoints = {{.number = 7, .plan = plan, .element = "parallelToWall"}};
    say(talk::SetPace{false, 0});
    say(open);
    const auto paused =
        wait<talk::PlanNow>([](const talk::PlanNow& now) { return !now.stands_at.empty(); });
    for (uint64_t request = 1; request <= 5; ++request) {
        say(ask_all());
        (void)wait<talk::FrameSeen>();
        say(talk::SetVariable{request, 0, "walldist", plan::Value(int64_t{35})});
        done(request);
    }
    say(talk::StopPlan{});
    for (uint16_t node = 1; node <= 4; ++node) say(stop(node));
    (void)clock_from(paused.t + 2);
    open.order = 2;
    open.past = talk::PastOf{file, paused.t + 1};
    open.recording = (folder / "run-2.mcap").string();
    open.breakpoints.clear();
    say(open);
    (void)wait<talk::Opened>([](const talk::Opened& one) { return one.order == 2; });
    EXPECT_GT(same_again(), 1000u);
    say(talk::SetPace{false, 0});
    (void)clock_from(paused.t + 2);
    EXPECT_EQ(leave(), 0);
    EXPECT_GT(same_again(open.recording), 1000u);
    EXPECT_GE(seconds_of(parts_at(file, open.recording).value_or(Time::max())), paused.t + 1);
}

// From before the run, in the middle of a step of the plan, behind settings, a new version and a
// hand, and behind the end of the plan: up to there it is the same run.
TEST_F(RunRecordingTest, ARunContinuesFromAnyInstantOfTheOneBefore) {
    const std::string text = read_file(test::examples("follow-wall/WallFollow.plan.json")).value();
    const std::string plan = write("WallFollow.plan.json", text);
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"), plan);
    open.set["walldist"] = "30";
    open.breakpoints = {{.number = 7, .plan = plan, .element = "parallelToWall"}};
    say(talk::SetPace{false, 0});
    say(open);
    (void)wait<talk::PlanNow>([](const talk::PlanNow& now) { return !now.stands_at.empty(); });
    say(talk::SetVariable{1, 0, "walldist", plan::Value(int64_t{35})});
    done(1);
    say(talk::SetBreakpoints{});
    say(talk::SetPace{false, 0});
    (void)clock_from(20);
    std::string other = text;
    other.replace(other.find("\"help\": \"") + 9, 0, "Another one. ");
    write("WallFollow.plan.json", other);
    say(talk::ChangePlan{2, {plan}});
    done(2);
    (void)clock_from(30);
    say(talk::StopPlan{});
    (void)wait<talk::PlanNow>(
        [](const talk::PlanNow& now) { return now.state == talk::PlanState::Ended; });
    say(talk::MoveRobot{3, "carbot", {1, 1}, 0});
    done(3);
    const double end = clock_from(32);
    open.breakpoints.clear();
    uint64_t number = 1;
    for (const double t : {0.0, 3.25, 15.0, 25.003, end}) {
        SCOPED_TRACE(t);
        const std::string recording = continued(++number, open, t, t + 3);
        if (number == 2) {  // the first has its end by now
            EXPECT_GT(same_again(), 3000u);
        }
        say(order(++number, world()));
        (void)wait<talk::Opened>([&](const talk::Opened& one) { return one.order == number; });
        EXPECT_GT(same_again(recording), 100u);
        const auto apart = parts_at(file, recording);
        EXPECT_GE(seconds_of(apart.value_or(from_seconds(t))), t);
    }
    EXPECT_EQ(leave(), 0);
}

// A node that counts each second, paused and let run by a person.
class CountingTest : public RunRecordingTest {
protected:
    std::string counting() {
        write("count.aesl", counting_script(1000));
        return write("count.world.json", room_with("count.aesl"));
    }
    talk::SendFrame to_node(auto message) {
        message.dest = 1;
        wire::Frame frame{};
        EXPECT_EQ(wire::encode_message(message, wire::kHostId, frame), wire::Error::None);
        return {{frame}};
    }
    static std::function<bool(const talk::News&)> opened_is(uint64_t number) {
        return [number](const talk::News& news) {
            const auto* opened = std::get_if<talk::Opened>(&news);
            return opened && opened->order == number;
        };
    }
    // When events of the bus are in the recording.
    std::vector<double> recorded_events() {
        const std::string bytes = read_file(file).value();
        const auto reader = mcap::Reader::open(bytes, "run.mcap");
        EXPECT_TRUE(reader.ok());
        std::vector<double> instants;
        mcap::Cursor cursor(reader.value());
        while (const auto message = cursor.next()) {
            const auto* channel = reader.value().channel(message->channel);
            if (channel->topic != record::kEventsTopic) continue;
            instants.push_back(seconds_of(record::time_of(message->log_time)));
        }
        return instants;
    }
    // All that is told for the history until then, in its order.
    std::vector<Happened> happened_until(const std::function<bool(const talk::News&)>& is_it) {
        std::vector<Happened> all;
        EXPECT_TRUE(wait_all([&](const talk::News& news) {
            if (const auto* now = std::get_if<talk::HappenedNow>(&news)) {
                for (const talk::HappenedOne& one : now->list) all.push_back(one.what);
            }
            return is_it(news);
        }));
        return all;
    }
};

// A run that is run again to its end tells the history what happened then, at the same instants:
// also that a node was paused by a person, and let run.
TEST_F(CountingTest, WhatHappenedOnTheBusIsToldAgainWithItsInstants) {
    talk::Open open = recorded(counting());
    say(talk::SetPace{true, 1});
    say(open);
    (void)wait<talk::Opened>();
    const auto pass = [this](uint32_t milliseconds, double t) {
        say(talk::LetTimePass{milliseconds});
        (void)clock_from(t);
    };
    pass(2500, 2.49);
    say(to_node(wire::Pause{}));
    pass(1000, 3.49);
    say(to_node(wire::Run{}));
    pass(2000, 5.49);
    say(talk::FlushRecording{1});
    done(1);
    open.order = 2;
    open.past = talk::PastOf{.recording = file};
    open.recording.clear();
    say(open);
    const std::vector<Happened> told = happened_until(opened_is(2));
    std::vector<std::string> lines;
    for (const Happened& one : told) {
        EXPECT_EQ(one.node, 1);
        EXPECT_EQ(one.source, "thymio-II");
        EXPECT_EQ(one.wall, 0);
        std::string text = one.kind + " " + one.name;
        for (const int16_t word : one.args) text += " " + std::to_string(word);
        lines.push_back(text);
    }
    // Told to pause between two beats, it is stopped (wire spec, 3.2); the timer begins the next,
    // in which it is paused until it is let run.
    ASSERT_EQ(lines, (std::vector<std::string>{"appeared thymio-II", "state running",
                                               "event beat 1", "event beat 2", "state stopped",
                                               "state paused", "state running", "event beat 3",
                                               "event beat 4", "event beat 5"}));
    const double instants_then[] = {0, 0, 1, 2, 2.5, 3, 3.5, 3.5, 4, 5};
    for (size_t i = 0; i < told.size(); ++i) EXPECT_NEAR(told[i].t, instants_then[i], 0.02) << i;
    // At the instants at which they were recorded.
    std::vector<double> instants;
    for (const Happened& one : told) {
        if (one.kind == "event") instants.push_back(one.t);
    }
    EXPECT_EQ(instants, recorded_events());
}

// The history has what was before that instant already, and hears the bus itself from there on.
TEST_F(CountingTest, ARunFromAnInstantOnTellsNothingOfWhatWasBefore) {
    talk::Open open = recorded(counting());
    say(talk::SetPace{false, 0});
    say(open);
    (void)clock_from(3);
    say(talk::FlushRecording{1});
    done(1);
    open.order = 2;
    open.past = talk::PastOf{file, 2.3};
    open.recording.clear();
    say(open);
    EXPECT_TRUE(happened_until(opened_is(2)).empty());
    say(talk::SetPace{false, 0});
    EXPECT_TRUE(happened_until([](const talk::News& news) {
                    const auto* clock = std::get_if<talk::Clock>(&news);
                    return clock && clock->t > 4;
                }).empty());
}

// A continuation with other chance is opened as any recording: it draws again where that one did.
TEST_F(RunRecordingTest, ARunWhoseChanceWasDrawnAgainIsLivedAgain) {
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"),
                               test::examples("follow-wall/WallFollow.plan.json"));
    say(talk::SetPace{false, 0});
    say(open);
    (void)clock_from(8);
    say(talk::FlushRecording{1});
    done(1);
    const std::string other = (folder / "other.mcap").string();
    {
        const std::string bytes = read_file(file).value();
        const auto reader = mcap::Reader::open(bytes, "run.mcap");
        ASSERT_TRUE(reader.ok());
        auto continued = trial::Continued::open(reader.value(), "x > 100", Time(6s));
        ASSERT_TRUE(continued.ok()) << continued.error().what;
        const Status written = continued.value()->record({.at = Time(3s), .seed = 5}, other);
        ASSERT_TRUE(written.ok()) << written.error().what;
    }
    EXPECT_EQ(parts_at(file, other), Time(3s));
    open.order = 2;
    open.past = talk::PastOf{.recording = other};
    open.recording = (folder / "again.mcap").string();
    say(talk::SetPace{true, 1});
    say(open);
    (void)wait<talk::Opened>([](const talk::Opened& one) { return one.order == 2; });
    say(talk::SetPace{false, 0});
    (void)clock_from(6.5);
    EXPECT_EQ(leave(), 0);
    EXPECT_GT(same_again(open.recording), 1000u);
    // The same draws at the same instant, up to where the first of them ends. Inputs are told apart
    // by the turn in which they came, which a run without a person has none of.
    const std::string first = read_file(other).value();
    const std::string second = read_file(open.recording).value();
    const auto found = record::compare_runs(mcap::Reader::open(first, "a").value(),
                                            mcap::Reader::open(second, "b").value(), {});
    ASSERT_TRUE(found.ok());
    EXPECT_GT(found.value().lanes.size(), 3u);
    for (const auto& lane : found.value().lanes) {
        if (lane.name == record::kInputTopic || !lane.difference) continue;
        EXPECT_GE(seconds_of(lane.difference->at), 6) << lane.name;
    }
}

// In another run a breakpoint is come to elsewhere, and nobody is there who lets it go.
TEST_F(RunRecordingTest, WhatWasStoppedAtABreakpointIsNotContinuedWithOtherChance) {
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"),
                               test::examples("follow-wall/WallFollow.plan.json"));
    open.breakpoints = {{.number = 7,
                         .plan = test::examples("follow-wall/WallFollow.plan.json"),
                         .element = "parallelToWall"}};
    say(talk::SetPace{false, 0});
    say(open);
    (void)wait<talk::PlanNow>([](const talk::PlanNow& now) { return !now.stands_at.empty(); });
    EXPECT_EQ(leave(), 0);
    const std::string bytes = read_file(file).value();
    const auto reader = mcap::Reader::open(bytes, "run.mcap");
    ASSERT_TRUE(reader.ok());
    const auto continued = trial::Continued::open(reader.value(), "x > 1", std::nullopt);
    ASSERT_FALSE(continued.ok());
    EXPECT_THAT(
        continued.error().what,
        HasSubstr("run.mcap: is of a run that somebody stepped or stopped at a breakpoint"));
}

TEST_F(RunRecordingTest, AnotherWayFromAnInstantIsThatOfItsFiles) {
    const std::string text = read_file(test::examples("follow-wall/WallFollow.plan.json")).value();
    const std::string plan = write("WallFollow.plan.json", text);
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"), plan);
    say(talk::SetPace{false, 0});
    say(open);
    (void)clock_from(12);
    // While it is lived again the file is what it was; then it is said that it is another.
    write("WallFollow.plan.json", "not a plan");
    open.order = 2;
    open.past = talk::PastOf{file, 9};
    open.recording.clear();
    say(talk::SetPace{true, 1});
    say(talk::FlushRecording{1});
    done(1);
    say(open);
    const auto opened = wait<talk::Opened>([](const talk::Opened& one) { return one.order == 2; });
    EXPECT_EQ(opened.others, std::vector{plan});
    say(talk::ChangePlan{3, opened.others});
    const auto answer =
        wait<talk::Answer>([](const talk::Answer& one) { return one.request == 3; });
    ASSERT_TRUE(answer.reasons);
    EXPECT_FALSE(answer.reasons->empty());
    EXPECT_EQ(leave(), 0);
}

TEST_F(RunRecordingTest, WhatCannotBeLivedAgainSaysWhy) {
    talk::Open open = order(1, world());
    open.past = talk::PastOf{(folder / "none.mcap").string(), 1};
    say(open);
    EXPECT_THAT(wait<talk::OpenFailed>().why, HasSubstr("none.mcap: cannot be read"));
    talk::Open first = recorded(world());
    first.order = 2;
    say(talk::SetPace{false, 0});
    say(first);
    (void)clock_from(1);
    say(talk::FlushRecording{1});
    done(1);
    open.order = 3;
    open.past = talk::PastOf{file, 1e6};
    say(open);
    EXPECT_THAT(wait<talk::OpenFailed>().why,
                HasSubstr("1000000.000000 s: the recording of this run ends at"));
    EXPECT_EQ(leave(), 0);
}

// An event that somebody raises by hand is told as what it is.
TEST_F(RunRecordingTest, AnEventThatAPersonRaisedIsTheRoot) {
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"),
                               test::examples("follow-wall/WallFollow.plan.json"));
    say(talk::SetPace{true, 1});
    say(open);
    (void)wait<talk::Opened>();
    say(talk::LetTimePass{2000});
    (void)clock_from(1.99);
    say(talk::RaiseEvent{1, "touch", "TouchSensorPressed", {}});
    done(1);
    say(talk::SetPace{false, 0});
    (void)clock_from(3);
    EXPECT_EQ(leave(), 0);
    EXPECT_GT(same_again(), 500u);
    const record::Chain chain = why({"actor", "backupCollision"}, 2500ms);
    ASSERT_EQ(chain.size(), 3u);
    EXPECT_EQ(chain[0].what, "the actor backupCollision began");
    EXPECT_EQ(chain[1].what, "the supervisor touch raised TouchSensorPressed");
    EXPECT_EQ(chain[2].what, "a person raised it in the debugger of the plan");
}

// What can be asked of a run that goes on is what is in the file by then.
TEST_F(RunRecordingTest, ARunThatGoesOnCanBeAsked) {
    talk::Open open = recorded(test::examples("follow-wall/hall.world.json"),
                               test::examples("follow-wall/WallFollow.plan.json"));
    open.set["walldist"] = "30";
    say(talk::SetPace{false, 0});
    say(open);
    (void)clock_from(15);
    say(talk::FlushRecording{1});
    done(1);
    const record::Chain chain = why({"motor", "carbot"}, 12s);
    ASSERT_FALSE(chain.empty());
    EXPECT_LE(chain.front().at, 12s);
    EXPECT_TRUE(chain.back().root);
    EXPECT_EQ(leave(), 0);
    EXPECT_GT(same_again(), 500u);
}

TEST_F(RunRecordingTest, AWorldInWhichNoTimePassedLeavesNoFile) {
    say(talk::SetPace{true, 1});
    say(recorded(world()));
    (void)wait<talk::Opened>();
    say(talk::FlushRecording{1});
    done(1);
    EXPECT_TRUE(std::filesystem::exists(file));
    EXPECT_EQ(leave(), 0);
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(RunRecordingTest, ARunThatCannotBeRecordedSaysSoAndGoes) {
    talk::Open open = recorded(world());
    open.recording = (folder / "nowhere" / "run.mcap").string();
    say(talk::SetPace{false, 0});
    say(open);
    EXPECT_THAT(wait<talk::Line>().text, HasSubstr("this run is not recorded: "));
    (void)clock_from(1);
    say(talk::FlushRecording{1});
    done(1);
    EXPECT_EQ(leave(), 0);
}

}  // namespace
}  // namespace vagus::serve
