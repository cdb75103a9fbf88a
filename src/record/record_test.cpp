// Recordings in memory: what is told of a run, what is kept of it, and where a rerun differs.
#include <gtest/gtest.h>

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "base/rng.hpp"
#include "base/test_folder.hpp"
#include "base/test_places.hpp"
#include "embed/robots_run.hpp"
#include "mcap/reader.hpp"
#include "record/compare_tape.hpp"
#include "record/file_tape.hpp"
#include "record/inputs.hpp"
#include "record/replay.hpp"
#include "record/run_file.hpp"
#include "record/sim_recording.hpp"
#include "record/studio_recording.hpp"

namespace vagus::record {
namespace {

using namespace std::chrono_literals;

// ---- the description of a run ----

TEST(RunFile, IsReadAsItWasWritten) {
    RunFile run;
    run.verb = "plan run";
    run.plan = "a \"quoted\"/x.plan.json";
    run.set = {"n=1", "s=\"\\n\""};
    run.seed = "18446744073709551615";
    const Result<RunFile> read = read_run(format_run(run), "a.mcap");
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read.value().verb, "plan run");
    EXPECT_EQ(read.value().plan, run.plan);
    EXPECT_EQ(read.value().set, run.set);
    EXPECT_EQ(read.value().seed, run.seed);
}

TEST(RunFile, AnotherFormatIsRefused) {
    const Result<RunFile> read = read_run(R"({"format":"vagus-recording/2"})", "a.mcap");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().what,
              "a.mcap: is no recording that can be run again: expected the format "
              "\"vagus-recording/1\", found \"vagus-recording/2\"; record with `vagus plan run … "
              "--record FILE` or `vagus sim … --record FILE`");
    EXPECT_FALSE(read_run("", "a.mcap").ok());
}

TEST(RunFile, NamesAreThePathsFromTheSharedFolder) {
    const PackedFiles packed =
        pack({{"/a/b/x.plan.json", "1"}, {"/a/c/../c/y.aesl", "2"}, {"/a/b/d/z.png", "3"}});
    EXPECT_EQ(packed.root, "/a");
    EXPECT_EQ(packed.files.at("b/x.plan.json"), "1");
    EXPECT_EQ(packed.files.at("c/y.aesl"), "2");
    EXPECT_EQ(packed.files.at("b/d/z.png"), "3");
    EXPECT_EQ(packed.name_of("/a/b/./x.plan.json"), "b/x.plan.json");
}

TEST(RunFile, ANameThatLeadsOutIsNotWritten) {
    const auto folder = UnpackedFolder::make();
    ASSERT_TRUE(folder.ok());
    for (const std::string name : {"../x", "a/../../x", "/etc/x", ""}) {
        EXPECT_FALSE(folder.value().add(name, "1").ok()) << name;
    }
    EXPECT_TRUE(folder.value().add("a/../b/x", "1").ok());
}

// ---- inputs ----

// As it is written it is read, and written again as it was.
void is_read_again(const InputWhat& what, const std::string& expected) {
    const std::string text = format_input({.at = 1500ms, .turn = 3, .what = what});
    EXPECT_EQ(text, expected);
    const Result<Input> read = read_input(text, 1500ms, "a.mcap");
    ASSERT_TRUE(read.ok()) << read.error().what;
    EXPECT_EQ(read.value().turn, 3u);
    EXPECT_EQ(format_input(read.value()), text);
}

TEST(Inputs, AreReadAsTheyWereWritten) {
    const std::string begin = R"({"t":1.500000,"turn":3,"do":)";
    wire::Frame frame{.size = 2, .source = 1, .type = 0xA00A, .payload = {5, 0}};
    is_read_again(frame, begin + R"("frame","bytes":"020001000aa00500"})");
    is_read_again(HeldMoment{}, begin + R"("hold"})");
    is_read_again(HeardAhead{}, begin + R"("look"})");
    is_read_again(Aborted{"a \"page\""}, begin + R"("abort","by":"a \"page\""})");
    is_read_again(ValueGiven{"n=1"}, begin + R"("set","value":"n=1"})");
    is_read_again(FileTookOver{"a.aesl", "var x"},
                  begin + R"("load","file":"a.aesl","value":"var x"})");
    is_read_again(Reseeded{kReseedMax}, begin + R"("reseed","seed":9223372036854775807})");
    is_read_again(RecordingEnds{}, begin + R"("end"})");
    is_read_again(RecordingEnds{"full"}, begin + R"("end","why":"full"})");
    is_read_again(ScriptLoaded{3, "a.aesl", "var x\n"},
                  begin + R"("script","node":3,"file":"a.aesl","text":"var x\n"})");
    is_read_again(PlanFiles{{"p"}, {{"p", "{}"}}},
                  begin + R"("plan-files","saved":["p"],"texts":{"p":"{}"}})");
    sim::Act put{.kind = sim::Act::Kind::Put};
    put.put = {.id = "x", .kind = sim::ObjectKind::Box, .at = {0.1, 2}, .width = 0.5};
    is_read_again(put, begin + R"("put","id":"x","kind":"box","x":0.10000000000000001,"y":2,)"
                               R"("angle":0,"width":0.5,"length":0,"radius":0,)"
                               R"("height":0.10000000000000001,"mass":0,"r":0.90000000000000002,)"
                               R"("g":0.90000000000000002,"b":0.90000000000000002})");
}

TEST(Inputs, RequestsToTheDebuggerAreReadAsTheyWereWritten) {
    const std::string begin = R"({"t":1.500000,"turn":3,"do":)";
    const auto request = [&](run::Request asked, const std::string& rest) {
        EXPECT_TRUE(does_something(asked)) << rest;
        is_read_again(std::move(asked), begin + rest);
    };
    // A float that is whole stays one.
    request(run::SetVariable{1, "n", plan::Value(2.0)},
            R"("set-variable","level":1,"name":"n","value":2.0})");
    request(run::SetVariable{0, "n", plan::Value(int64_t{2})},
            R"("set-variable","level":0,"name":"n","value":2})");
    request(run::RaiseEvent{"s", "e", {{"o", plan::Value(true)}}},
            R"("raise","supervisor":"s","event":"e","outputs":{"o":true}})");
    request(run::AddBreakpoint{{.kind = run::Breakpoint::Kind::Event, .element = "s"}},
            R"("stop-at","kind":"event","plan":"","element":"s","outcome":"","condition":"",)"
            R"("stop_at":1,"enabled":true})");
    request(run::RemoveBreakpoint{4}, R"("stop-no-more","id":4})");
    request(run::EnableBreakpoint{4, false}, R"("stop-enabled","id":4,"enabled":false})");
    request(run::Pause{}, R"("pause"})");
    request(run::Continue{.from_met = false}, R"("continue","from_met":false})");
    request(run::Step{}, R"("step"})");
    request(run::Abort{}, R"("end-plan"})");
    request(run::LetGo{7}, R"("let-go","number":7})");
    request(run::DropHeld{}, R"("drop-held"})");
    request(run::StepEvent{}, R"("step-event"})");
    for (const run::Request& looks :
         {run::Request(run::ListBreakpoints{}), run::Request(run::AskWhere{}),
          run::Request(run::Evaluate{}), run::Request(run::ListHeld{})}) {
        EXPECT_FALSE(does_something(looks));
    }
}

TEST(Inputs, WhatIsNoneIsRefused) {
    for (const char* text :
         {"", "[]", R"({"do":"frame","bytes":"0200"})", R"({"do":"frame","bytes":"zz"})",
          R"({"do":"stop-at","kind":"wish"})", R"({"do":"TAP"})"}) {
        EXPECT_FALSE(read_input(text, 0s, "a.mcap").ok()) << text;
    }
    EXPECT_EQ(read_input(R"({"do":"fly"})", 2s, "a.mcap").error().what,
              "a.mcap: the input at 2.000000 s cannot be done again: expected one that this "
              "version of Vagus knows, found {\"do\":\"fly\"}");
}

// ---- differences ----

TEST(FirstDifference, IsThePlaceInBothMessages) {
    const Difference found = first_difference(R"({"t":1.5,"set":{"a":1,"b":[1,2]}})",
                                              R"({"t":1.5,"set":{"a":1,"b":[1,3]}})");
    EXPECT_EQ(found.place, "set.b");
    EXPECT_EQ(found.then, "[1,2]");
    EXPECT_EQ(found.now, "[1,3]");
    const Difference added = first_difference(R"({"a":1})", R"({"a":1,"b":true})");
    EXPECT_EQ(added.place, "b");
    EXPECT_EQ(added.then, "");
    EXPECT_EQ(added.now, "true");
}

// ---- a tape on the disk ----

// A disk that is as slow as the test wants.
struct SlowDisk {
    std::mutex mutex;
    std::condition_variable changed;
    bool works = true;
    bool waits = false;
    std::string bytes;

    Status write(std::string_view more) {
        std::unique_lock lock(mutex);
        waits = !works;
        changed.notify_all();
        changed.wait(lock, [this] { return works; });
        waits = false;
        bytes += more;
        return Status::done();
    }
    void let(bool work) {
        const std::lock_guard lock(mutex);
        works = work;
        changed.notify_all();
    }
    void wait_until_it_waits() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return waits; });
    }
};

// Messages of a megabyte that do not get smaller.
std::string noise(SplitMix64& random) {
    std::string data;
    while (data.size() < 1u << 20) data += static_cast<char>(random.next());
    return data;
}

TEST(FileTape, OnASlowDiskSamplesAreDroppedAndThenItEnds) {
    SlowDisk disk;
    FileTape tape([&disk](std::string_view bytes) { return disk.write(bytes); }, Pace::NeverWaits);
    const uint16_t inputs = tape.declare({.name = "/in"});
    const uint16_t samples = tape.declare({.name = "/samples", .may_be_dropped = true});
    disk.let(false);
    SplitMix64 random(1);
    const std::string big = noise(random);
    tape.put(inputs, 0s, big);
    disk.wait_until_it_waits();
    for (int i = 0; i < 80; ++i) tape.put(samples, 1s, big);
    EXPECT_GT(tape.dropped(), 0u);
    EXPECT_TRUE(tape.state().ok());
    for (int i = 0; i < 200; ++i) tape.put(inputs, 2s, big);
    ASSERT_FALSE(tape.state().ok());
    EXPECT_EQ(tape.state().error().what,
              "the recording ends here: the disk is too slow, 256 MB wait to be written; record "
              "to a faster disk");
    disk.let(true);
    EXPECT_FALSE(tape.end().ok());
    EXPECT_TRUE(mcap::Reader::open(disk.bytes, "slow.mcap").ok());
}

// Messages of one second, some of them longer than a piece of the text in which they wait.
TEST(FileTape, MessagesKeepTheirOrderAndTheirLengths) {
    std::string bytes;
    const size_t lengths[] = {1, kPieceBytes - 1, 0, kPieceBytes + 1, 7, 3 * kPieceBytes, 2};
    {
        FileTape tape(
            [&bytes](std::string_view more) {
                bytes += more;
                return Status::done();
            },
            Pace::Waits);
        const uint16_t topic = tape.declare({.name = "/in"});
        for (const size_t length : lengths) {
            tape.put(topic, 1s, std::string(length, 'a'));
            tape.put_later(topic, 1s, 1, [length] { return std::to_string(length); });
        }
    }
    const auto reader = mcap::Reader::open(bytes, "a.mcap");
    ASSERT_TRUE(reader.ok());
    mcap::Cursor cursor(reader.value());
    for (const size_t length : lengths) {
        EXPECT_EQ(cursor.next()->data, std::string(length, 'a'));
        EXPECT_EQ(cursor.next()->data, std::to_string(length));
    }
    EXPECT_FALSE(cursor.next());
}

TEST(FileTape, WhatIsThereIsWrittenWhenItIsAskedFor) {
    SlowDisk disk;
    FileTape tape([&disk](std::string_view bytes) { return disk.write(bytes); }, Pace::NeverWaits);
    const uint16_t inputs = tape.declare({.name = "/in"});
    disk.let(false);
    tape.put(inputs, 0s, "1");
    const uint64_t number = tape.flush();
    disk.wait_until_it_waits();
    EXPECT_FALSE(tape.flushed(number));
    disk.let(true);
    while (!tape.flushed(number)) std::this_thread::yield();
    EXPECT_GT(tape.bytes(), 0u);
    EXPECT_TRUE(tape.end().ok());
}

TEST(FileTape, ARunInVirtualTimeWaitsForTheDisk) {
    std::string bytes;
    uint64_t count = 0;
    {
        FileTape tape(
            [&bytes](std::string_view more) {
                bytes += more;
                return Status::done();
            },
            Pace::Waits);
        const uint16_t samples = tape.declare({.name = "/samples", .may_be_dropped = true});
        SplitMix64 random(2);
        const std::string big = noise(random);
        for (int i = 0; i < 150; ++i) tape.put(samples, 1s, big);
        EXPECT_TRUE(tape.end().ok());
        EXPECT_EQ(tape.dropped(), 0u);
    }
    const auto reader = mcap::Reader::open(bytes, "a.mcap");
    ASSERT_TRUE(reader.ok());
    mcap::Cursor cursor(reader.value());
    while (cursor.next()) ++count;
    EXPECT_EQ(count, 150u);
}

// ---- what has not come again ----

// A recording of these messages: instant, topic, data.
struct Told {
    Time at;
    std::string_view topic;
    std::string data;
};
std::optional<Difference> missing(const std::vector<Told>& recorded, Time until) {
    std::string bytes;
    mcap::Writer writer([&bytes](std::string_view more) {
        bytes += more;
        return Status::done();
    });
    std::map<std::string_view, uint16_t> channels;
    for (const Told& one : recorded) {
        auto [channel, is_new] = channels.try_emplace(one.topic);
        if (is_new) {
            channel->second =
                writer.add_channel({.topic = std::string(one.topic), .encoding = "json"});
        }
        writer.write(channel->second, static_cast<uint64_t>(one.at.count()) * 1000, one.data);
    }
    EXPECT_TRUE(writer.end().ok());
    const auto reader = mcap::Reader::open(bytes, "a.mcap");
    EXPECT_TRUE(reader.ok());
    CompareTape tape(reader.value(), {}, until);
    EXPECT_TRUE(tape.end().ok());
    return tape.difference();
}

TEST(CompareTape, AnInputBehindTheLastInstantIsNotMissed) {
    const std::vector<Told> recorded = {{1s, kInputTopic, "{}"}, {1s, kTraceTopic, "{}"}};
    EXPECT_FALSE(missing(recorded, 1s));
    ASSERT_TRUE(missing(recorded, 1001ms));
    EXPECT_EQ(missing(recorded, 1001ms)->at, 1s);
    EXPECT_TRUE(missing(recorded, Time::max()));
}

TEST(CompareTape, WithoutAnInputAllOfTheLastInstantMustComeAgain) {
    const std::vector<Told> recorded = {{1s, kTraceTopic, "{}"}};
    ASSERT_TRUE(missing(recorded, 1s));
    EXPECT_EQ(missing(recorded, 1s)->topic, kTraceTopic);
    EXPECT_TRUE(missing({{500ms, kInputTopic, "{}"}, {1s, kInputTopic, "{}"}}, 1s));
}

// What the rest of it was nobody knows.
TEST(CompareTape, WhatIsCutOffWhileItIsReadIsNoDifference) {
    std::string bytes;
    mcap::Writer writer([&bytes](std::string_view more) {
        bytes += more;
        return Status::done();
    });
    const uint16_t channel =
        writer.add_channel({.topic = std::string(kTraceTopic), .encoding = "json"});
    writer.write(channel, 1'000'000'000, "{}");
    EXPECT_TRUE(writer.flush().ok());
    const size_t second_chunk = bytes.size();
    writer.write(channel, 2'000'000'000, "{}");
    EXPECT_TRUE(writer.end().ok());
    const auto reader = mcap::Reader::open(bytes, "a.mcap");
    ASSERT_TRUE(reader.value().is_complete());
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(second_chunk), bytes.end(), '\0');
    CompareTape tape(reader.value());
    const uint16_t trace = tape.declare({.name = std::string(kTraceTopic)});
    for (const Time at : {1s, 2s}) tape.put(trace, at, "{}");
    const Status read = tape.end();
    EXPECT_FALSE(tape.difference());
    ASSERT_FALSE(read.ok());
    EXPECT_TRUE(read.error().what.starts_with("a.mcap: the chunk at byte ")) << read.error().what;
}

// ---- worlds that are run again ----

struct Recorded {
    std::string bytes;
    int acts = 0;
};

// Thirty seconds of a Thymio that explores, in which a person taps it, presses its buttons and
// moves it at random instants.
Recorded explore(uint64_t seed, const std::string& file) {
    const std::string examples = test::examples("thymio/");
    FilesRead files;
    auto robots = embed::RobotsRun::open({.world = examples + "arena.world.json"});
    EXPECT_TRUE(robots.ok());
    session::SimSession& session = robots.value()->buses().common();
    session.load(examples + "explore.aesl", read_file(examples + "explore.aesl").value());
    RunFile about;
    about.verb = "sim";
    about.world = examples + "arena.world.json";
    about.loads = {examples + "explore.aesl"};
    auto recording = SimRecording::begin(file, about, files, *robots.value(), Pace::Waits);
    EXPECT_TRUE(recording.ok());
    SplitMix64 random(seed);
    Recorded recorded;
    const sim::RobotId thymio{1};
    while (session.now() < 30s) {
        session.step(Duration(1000 * (1 + static_cast<int64_t>(random.next() % 3000))));
        sim::World& world = session.world();
        const auto kind = random.next() % 4;
        const Status done = kind == 0   ? world.tap(thymio)
                            : kind == 1 ? world.press(thymio, "forward")
                            : kind == 2
                                ? world.release(thymio, "forward")
                                : world.move(thymio, {{0.4 + 0.01 * recorded.acts, 0.5}, 1});
        EXPECT_TRUE(done.ok());
        ++recorded.acts;
    }
    EXPECT_TRUE(recording.value()->end().ok());
    recorded.bytes = read_file(file).value();
    return recorded;
}

std::optional<Difference> run_again(const std::string& bytes) {
    const auto reader = mcap::Reader::open(bytes, "a.mcap");
    EXPECT_TRUE(reader.ok());
    auto rerun = Rerun::open(reader.value(), {});
    EXPECT_TRUE(rerun.ok());
    CompareTape tape(reader.value());
    EXPECT_TRUE(rerun.value()->run(tape).ok());
    EXPECT_TRUE(tape.end().ok());
    EXPECT_GT(tape.compared(), 100u);
    return tape.difference();
}

TEST(Replay, WhatAPersonDidIsDoneAgain) {
    test::Folder folder;
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Recorded recorded = explore(seed, (folder / "run.mcap").string());
        EXPECT_GT(recorded.acts, 5) << "seed " << seed;
        const auto found = run_again(recorded.bytes);
        EXPECT_FALSE(found) << "seed " << seed << ": " << found->topic << " " << found->place;
    }
}

// The recording with the input at its place changed to another.
std::string with_input(const std::string& bytes, int index, const std::string& from,
                       const std::string& to, Time& at) {
    const auto reader = mcap::Reader::open(bytes, "a.mcap");
    std::string changed;
    mcap::Writer writer([&changed](std::string_view more) {
        changed += more;
        return Status::done();
    });
    for (const auto& one : reader.value().attachments()) writer.attach(one);
    for (const auto& one : reader.value().channels()) (void)writer.add_channel(one);
    const uint16_t inputs = reader.value().find(kInputTopic)->id;
    mcap::Cursor cursor(reader.value());
    while (const auto message = cursor.next()) {
        std::string data(message->data);
        if (message->channel == inputs && data.find(from) != std::string::npos && index-- == 0) {
            data.replace(data.find(from), from.size(), to);
            at = time_of(message->log_time);
        }
        writer.write(message->channel, message->log_time, data);
    }
    EXPECT_TRUE(writer.end().ok());
    return changed;
}

TEST(Replay, OneFlippedInputIsFoundAtItsInstant) {
    test::Folder folder;
    const Recorded recorded = explore(1, (folder / "run.mcap").string());
    Time at{};
    const std::string changed = with_input(recorded.bytes, 0, R"("do":"move-robot","robot":1)",
                                           R"("do":"tap","robot":1)", at);
    ASSERT_GT(at, 0s);
    const auto found = run_again(changed);
    ASSERT_TRUE(found);
    // Its pose is another from the next picture of the world on, its sensors a little later.
    EXPECT_GE(found->at, at);
    EXPECT_LE(found->at, at + 100ms);
    EXPECT_TRUE(found->topic == kPosesTopic || found->topic.starts_with("/node/")) << found->topic;
}

TEST(Replay, AnInputThatIsNotKnownIsRefused) {
    test::Folder folder;
    const Recorded recorded = explore(1, (folder / "run.mcap").string());
    Time at{};
    const std::string changed =
        with_input(recorded.bytes, 0, R"("do":"tap")", R"("do":"paint")", at);
    const auto reader = mcap::Reader::open(changed, "a.mcap");
    const auto rerun = Rerun::open(reader.value(), {});
    ASSERT_FALSE(rerun.ok());
    EXPECT_NE(rerun.error().what.find("cannot be done again"), std::string::npos);
}

// ---- runs of the studio ----

// A recording that has become too large ends, says so, and can be run again up to there.
TEST(StudioRecording, OneThatIsTooLargeEndsAndTheRunGoesOn) {
    test::Folder folder;
    const std::string file = (folder / "run.mcap").string();
    const std::string world = test::examples("thymio/arena.world.json");
    FilesRead files;
    auto session = session::open_sim(world, {});
    ASSERT_TRUE(session.ok());
    (void)session.value().settle();
    RunFile about;
    about.world = world;
    auto recording = StudioRecording::begin(file, about, files.all(), session.value(), nullptr);
    ASSERT_TRUE(recording.ok());
    recording.value()->keep_at_most(20000);
    session.value().world().stops_with_nodes();
    std::optional<std::string> trouble;
    while (!trouble && session.value().now() < 600s) {
        recording.value()->begin_turn();
        session.value().step(1ms);
        if (session.value().now() % 1s == 0s) {
            const uint64_t number = recording.value()->flush();
            while (!recording.value()->flushed(number)) std::this_thread::yield();
        }
        trouble = recording.value()->take_trouble();
    }
    ASSERT_TRUE(trouble);
    EXPECT_NE(trouble->find("the recording of this run ends at "), std::string::npos);
    EXPECT_NE(trouble->find("more are not kept of one run"), std::string::npos);
    session.value().step(1s);
    EXPECT_TRUE(recording.value()->end().ok());
    const auto found = run_again(read_file(file).value());
    EXPECT_FALSE(found) << found->topic << " " << found->place << " " << found->now;
}

}  // namespace
}  // namespace vagus::record
