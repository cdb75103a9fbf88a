// Runs of the studio on a bus are recorded by their process: the plan decides the same again, and
// can be asked why.
#include <gmock/gmock.h>

#include <atomic>
#include <filesystem>

#include "embed/prepared_run.hpp"
#include "mcap/reader.hpp"
#include "net/links.hpp"
#include "record/compare_tape.hpp"
#include "record/past_run.hpp"
#include "record/plan_recording.hpp"
#include "record/replay.hpp"
#include "record/topics.hpp"
#include "record/why.hpp"
#include "serve/runner/test_recording.hpp"
#include "serve/runner/test_run_host.hpp"
#include "session/sim_session.hpp"
#include "session/toolboxes.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

// A simulated robot behind a port, as `vagus sim --listen` makes one.
class RobotAtPort {
public:
    explicit RobotAtPort(const std::string& world)
        : session_(session::open_sim(world, {})),
          listening_(links_.listen(session_.value().world().bus(),
                                   net::parse_target("tcp:127.0.0.1:0").value())) {
        (void)session_.value().settle();
        thread_ = std::thread([this] {
            while (!over_) {
                (void)links_.poll(links_.now() + 1ms);
                session_.value().step(1ms);
            }
        });
    }
    ~RobotAtPort() {
        over_ = true;
        thread_.join();
    }
    std::string target() const { return net::to_string(listening_.value().target); }

private:
    Result<session::SimSession> session_;
    net::Links links_;  // after the bus: it goes first
    Result<net::Listening> listening_;
    std::atomic<bool> over_ = false;
    std::thread thread_;
};

class BusRecordingTest : public RunnerTest {
protected:
    // Counts what it hears, so many a beat.
    std::string counting_plan(int step = 1) {
        return write("Count.plan.json", R"({"format": "vagus-plan/1", "name": "Count",
            "configuration": {"heard": {"type": "int", "initial": 0}},
            "start": {"actor": "hear"}, "actors": {
            "hear": {"template": "Receive", "in": {"event": "'beat'"},
                     "states": {"Received": "count"}},
            "count": {"template": "Assign", "in": {"value": "heard + )" +
                                            std::to_string(step) + R"("},
                      "out": {"result": "heard"}, "states": {"Done": "hear"}}}})");
    }
    talk::Open on_bus(uint64_t number, const std::string& recording) {
        talk::Open open = order(number, "", counting_plan());
        open.bus = robot.target();
        open.project = project;
        open.target = "tcp:robot:33333";
        open.recording = recording;
        return open;
    }
    void begin(const talk::Open& open) {
        say(talk::SetPace{false, 1});
        say(open);
        (void)wait<talk::Opened>([&](const talk::Opened& one) { return one.order == open.order; });
    }
    // Until the plan writes at least that number.
    void wait_heard(int64_t least) {
        (void)wait<talk::Traced>([least](const talk::Traced& one) {
            const size_t at = one.line.find("\"value\":");
            if (one.line.find("\"kind\":\"write\"") == std::string::npos) return false;
            return at != std::string::npos && std::stoll(one.line.substr(at + 8)) >= least;
        });
    }
    void done(uint64_t request) {
        const auto answer = wait<talk::Answer>(
            [request](const talk::Answer& one) { return one.request == request; });
        EXPECT_EQ(answer.why, "") << "request " << request;
    }
    // The plan is over, and all of it is in the file.
    void stop(uint64_t request) {
        say(talk::StopPlan{});
        (void)wait<talk::PlanOver>();
        say(talk::FlushRecording{request});
        done(request);
    }
    // What was done to the run, by the words of /vagus/input.
    static std::vector<std::string> asked(const std::string& recording) {
        const std::string bytes = read_file(recording).value();
        const auto reader = mcap::Reader::open(bytes, recording);
        std::vector<std::string> asked;
        mcap::Cursor cursor(reader.value());
        while (const auto message = cursor.next()) {
            if (reader.value().channel(message->channel)->topic != record::kInputTopic) continue;
            const std::string text(message->data);
            const size_t from = text.find("\"do\":\"") + 6;
            const std::string word = text.substr(from, text.find('"', from) - from);
            if (word != "hear" && word != "node" && word != "tokens") asked.push_back(word);
        }
        return asked;
    }
    // Decides again; gives how many lines of the trace were compared.
    static uint64_t same_again(const std::string& recording) {
        const std::string bytes = read_file(recording).value();
        const auto reader = mcap::Reader::open(bytes, recording);
        if (!reader.ok()) return ADD_FAILURE() << reader.error().what, 0;
        EXPECT_TRUE(reader.value().is_complete());
        auto rerun = record::Rerun::open(reader.value(), {});
        if (!rerun.ok()) return ADD_FAILURE() << rerun.error().what, 0;
        EXPECT_TRUE(rerun.value()->about().is_of_bus());
        record::CompareTape tape(reader.value(), {std::string(record::kTraceTopic)});
        EXPECT_TRUE(rerun.value()->run(tape).ok());
        EXPECT_TRUE(tape.end().ok());
        if (const auto& found = tape.difference()) {
            ADD_FAILURE() << found->place << "\n then " << found->then << "\n now  " << found->now;
        }
        return tape.compared();
    }
    static record::Chain why(const std::string& recording, const std::vector<std::string>& words) {
        const std::string bytes = read_file(recording).value();
        const auto reader = mcap::Reader::open(bytes, recording);
        const auto question = record::read_question(words);
        const auto chain = record::why(reader.value(), question.value(), std::nullopt);
        if (!chain.ok()) return ADD_FAILURE() << chain.error().what, record::Chain();
        return chain.value();
    }

    std::string project = write("beats.aesl", counting_script(20));
    std::string file = (folder / "run.mcap").string();
    RobotAtPort robot{write("room.world.json", room_with("beats.aesl"))};
};

TEST_F(BusRecordingTest, APlanDecidesAgainWhatItDecidedAndWhatAPersonSet) {
    begin(on_bus(1, file));
    wait_heard(5);
    say(talk::SetVariable{1, 0, "heard", plan::Value(int64_t{1000})});
    done(1);
    wait_heard(1003);
    stop(2);
    EXPECT_GT(same_again(file), 10u);
    const auto bytes = read_file(file).value();
    const auto reader = mcap::Reader::open(bytes, file);
    const record::RunFile about = record::read_recorded(reader.value()).value().about;
    EXPECT_EQ(about.verb, record::kStudioVerb);
    EXPECT_EQ(about.bus, "tcp:robot:33333");
    EXPECT_EQ(about.project, "beats.aesl");
    EXPECT_NE(reader.value().attachment("Count.plan.json"), nullptr);
    EXPECT_NE(reader.value().attachment("nodes/thymio-II.json"), nullptr);
    EXPECT_THAT(asked(file), ElementsAre("pause", "set-variable", "continue", "end-plan", "end"));
    EXPECT_THAT(why(file, {"end"}).back().what, HasSubstr("somebody ended the run"));
}

TEST_F(BusRecordingTest, TwoRunsAreTwoRecordingsAndAnEndOfTheStudioLeavesTheLastWhole) {
    begin(on_bus(1, file));
    wait_heard(2);
    const std::string second = (folder / "second.mcap").string();
    begin(on_bus(2, second));
    wait_heard(2);
    EXPECT_EQ(leave(), 0);
    EXPECT_GT(same_again(file), 2u);
    EXPECT_GT(same_again(second), 2u);
}

TEST_F(BusRecordingTest, ANewVersionOfThePlanTakesOverAgain) {
    begin(on_bus(1, file));
    wait_heard(3);
    const std::string plan = counting_plan(1000);
    say(talk::ChangePlan{1, {plan}});
    done(1);
    wait_heard(3000);
    write("Count.plan.json", "not a plan");
    say(talk::ChangePlan{2, {plan}});
    EXPECT_FALSE(wait<talk::Answer>().reasons.value_or(std::vector<std::string>()).empty());
    wait_heard(5000);
    stop(3);
    EXPECT_THAT(asked(file), ElementsAre("plan-files", "end-plan", "end"));
    EXPECT_GT(same_again(file), 10u);
}

// A breakpoint holds the plan. What it hears meanwhile waits, and comes at once when it goes on:
// each actor hears one of them.
TEST_F(BusRecordingTest, ABreakpointIsRecordedAndNotWaitedForAgain) {
    talk::Open open = on_bus(1, file);
    open.breakpoints = {{.number = 7, .plan = open.plan, .element = "count", .stop_at = 3}};
    begin(open);
    (void)wait<talk::PlanNow>([](const talk::PlanNow& now) { return !now.stands_at.empty(); });
    (void)wait<talk::HeldNow>(
        [](const talk::HeldNow& held) { return held.document.json["events"].size() >= 3; });
    say(talk::SetBreakpoints{});
    (void)wait<talk::BreakpointsNow>(
        [](const talk::BreakpointsNow& now) { return now.list.empty(); });
    say(talk::SetPace{false, 1});
    wait_heard(6);
    stop(1);
    EXPECT_GT(same_again(file), 10u);
}

// One that becomes too large ends, and says so; the robot goes on. It can be replayed up to there.
TEST_F(BusRecordingTest, OneThatIsTooLargeEndsBeforeItsRun) {
    FilesRead files;
    toolbox::Parts parts;
    run::CodeLibrary library;
    ASSERT_TRUE(session::add_toolboxes(library, parts, {}).ok());
    const auto plan = embed::LoadedPlan::from_file(counting_plan(), library);
    embed::RunWords words;
    words.bus = robot.target();
    words.project = project;
    const auto run = embed::PreparedRun::prepare(plan, words, parts);
    ASSERT_TRUE(run.ok());
    run.value()->tell([](const std::string&) {});
    record::RunFile about;
    about.kind = record::kBusKind;
    about.plan = (folder / "Count.plan.json").string();
    about.project = project;
    const auto recording = record::PlanRecording::begin(file, about, files.all(), *run.value(),
                                                        record::Pace::NeverWaits);
    ASSERT_TRUE(recording.ok());
    std::atomic<int> lines = 0;
    run.value()->listen([&lines](const plan::TraceEvent&) { ++lines; });
    std::thread runs([&] { EXPECT_TRUE(run.value()->run().ok()); });
    const auto wait_lines = [&lines](int more) {
        for (const int from = lines; lines < from + more;) std::this_thread::yield();
    };
    wait_lines(20);
    const uint64_t number = recording.value()->flush();
    while (!recording.value()->flushed(number)) std::this_thread::yield();
    recording.value()->keep_at_most(1);
    recording.value()->tend();
    const auto trouble = recording.value()->take_trouble();
    wait_lines(20);
    run.value()->abort();
    runs.join();
    EXPECT_TRUE(recording.value()->end().ok());
    EXPECT_THAT(trouble.value_or(""), HasSubstr("more are not kept of one run"));
    EXPECT_LT(same_again(file), static_cast<uint64_t>(lines));
}

// The robot goes on where its recording cannot.
TEST_F(BusRecordingTest, AFullDiskEndsTheRecordingAndNotTheRun) {
    begin(on_bus(1, "/dev/full"));
    EXPECT_THAT(wait<talk::Line>().text, HasSubstr("the recording of this run ends at "));
    wait_heard(3);
    stop(1);
}

TEST_F(BusRecordingTest, WhereNoFileCanBeTheRunGoesUnrecorded) {
    say(talk::SetPace{false, 1});
    say(on_bus(1, (folder / "nowhere" / "run.mcap").string()));
    EXPECT_THAT(wait<talk::Line>().text, HasSubstr("this run is not recorded: "));
    wait_heard(3);
    stop(1);
}

}  // namespace
}  // namespace vagus::serve
