#include "record/keyframes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "base/rng.hpp"
#include "base/test_folder.hpp"
#include "base/test_places.hpp"
#include "embed/robots_run.hpp"
#include "record/causes.hpp"
#include "record/run_file.hpp"
#include "record/sim_recording.hpp"

namespace vagus::record {
namespace {

using namespace std::chrono_literals;

// A Thymio that explores, and that a person moves now and then.
std::string explored(Time until, const std::string& file) {
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
    while (session.now() < until) {
        session.step(7500ms);
        const double x = 0.3 + 0.1 * static_cast<double>(session.now() / 7500ms % 5);
        EXPECT_TRUE(session.world().move(sim::RobotId{1}, {{x, 0.5}, 1}).ok());
    }
    EXPECT_TRUE(recording.value()->end().ok());
    return read_file(file).value();
}

// Recorded once: all of these tests look at the same run of ten minutes.
const std::string& ten_minutes() {
    static const std::string bytes = [] {
        test::Folder folder;
        return explored(600s, (folder / "run.mcap").string());
    }();
    return bytes;
}

std::string state_of(Rerun& run, Time at) {
    return state_hash(run.check_at(at));
}

// What there is at each of these instants, in one straight run.
std::map<Time, std::string> straight(const mcap::Reader& reader, std::vector<Time> instants) {
    std::ranges::sort(instants);
    auto rerun = Rerun::open(reader, {});
    EXPECT_TRUE(rerun.ok());
    std::map<Time, std::string> states;
    size_t next = 0;
    rerun.value()->each_instant([&](Time at) {
        while (next < instants.size() && instants[next] <= at) {
            states[instants[next++]] = state_of(*rerun.value(), at);
        }
    });
    NullTape tape;
    EXPECT_TRUE(rerun.value()->run(tape).ok());
    return states;
}

class Looking : public testing::Test {
protected:
    void SetUp() override {
        reader_.emplace(mcap::Reader::open(ten_minutes(), "run.mcap").value());
        auto opened = Keyframes::open(*reader_, state_of);
        ASSERT_TRUE(opened.ok());
        keyframes_ = std::move(opened.value());
        ASSERT_EQ(keyframes_->why_none(), "");
    }

    Keyframes::Look look(Time at) {
        auto found = keyframes_->look(at);
        EXPECT_TRUE(found.ok()) << found.error().what;
        return found.ok() ? found.value() : Keyframes::Look{};
    }
    std::string straight_at(Time at) { return keyframes_->look_straight(at).value().text; }

    std::optional<mcap::Reader> reader_;
    std::unique_ptr<Keyframes> keyframes_;
};

TEST_F(Looking, RandomInstantsAreAsInAStraightRun) {
    const uint64_t seed = 20;
    const size_t count = std::getenv("VAGUS_LONG") != nullptr ? 1000 : 100;
    SplitMix64 random(seed);
    std::vector<Time> instants;
    for (size_t i = 0; i < count; ++i) {
        instants.emplace_back(static_cast<int64_t>(random.next() % 600'000'000));
    }
    const auto expected = straight(*reader_, instants);
    size_t from_keyframes = 0;
    for (const Time at : instants) {
        const Keyframes::Look found = look(at);
        ASSERT_EQ(found.text, expected.at(at)) << "seed " << seed << ", " << at.count() << " us";
        EXPECT_EQ(found.at, std::max(instant_of(at), Time(1ms)));
        if (found.from) ++from_keyframes;
    }
    EXPECT_GT(from_keyframes, count / 2);
    EXPECT_LE(keyframes_->waiting().size(), kKeyframesMax + 1);
}

TEST_F(Looking, ThereIsACopyWhereOneIsWanted) {
    EXPECT_EQ(look(165s).from, std::nullopt);
    std::vector<Time> there;
    for (const auto& [at, process] : keyframes_->waiting()) there.push_back(at);
    EXPECT_EQ(there, keyframe_instants(165s));
    EXPECT_EQ(look(100s).from, Time(90s));
    EXPECT_EQ(look(101s).from, Time(100s));  // what was looked at last is kept
    EXPECT_EQ(look(90s).from, Time(90s));
    // Of a later instant some are too many.
    (void)look(600s);
    there.clear();
    for (const auto& [at, process] : keyframes_->waiting()) there.push_back(at);
    EXPECT_EQ(there, keyframe_instants(600s));
}

TEST_F(Looking, BeginningAndEndAreInstantsAndNothingElseIs) {
    EXPECT_EQ(look(0s).at, Time(1ms));
    EXPECT_EQ(look(1us).at, Time(1ms));
    EXPECT_EQ(look(600s).text, straight_at(600s));
    EXPECT_EQ(look(600s).at, Time(600s));
    const std::string expected = "601.000000 s: run.mcap has instants from 0 to 600.000000 s";
    EXPECT_EQ(keyframes_->look(601s).error().what, expected);
    EXPECT_EQ(keyframes_->look_straight(601s).error().what, expected);
    EXPECT_FALSE(keyframes_->look(-1us).ok());
}

TEST_F(Looking, AKeyframeThatWasKilledIsDoneWithout) {
    (void)look(165s);
    const std::string expected = straight_at(100s);
    for (const auto& [at, process] : keyframes_->waiting()) {
        if (at == 90s) (void)kill(static_cast<pid_t>(process), SIGKILL);
    }
    EXPECT_EQ(look(100s).from, Time(75s));
    EXPECT_EQ(look(100s).text, expected);
    for (const auto& [at, process] : keyframes_->waiting()) {
        (void)kill(static_cast<pid_t>(process), SIGKILL);
    }
    while (true) {
        const auto found = keyframes_->look(100s);
        if (!found.ok()) continue;  // three of them were killed
        EXPECT_EQ(found.value().text, expected);
        break;
    }
}

TEST(Keyframes, APlanWithTemplatesInASharedLibraryHasNone) {
    EXPECT_EQ(why_not_copied({.toolboxes = {"a/b.toolbox.json", "light.so"}}),
              "templates of the plan are in the shared library light.so, which may have threads of "
              "its own");
    EXPECT_EQ(why_not_copied({.toolboxes = {"a/b.toolbox.json"}}), "");
}

}  // namespace
}  // namespace vagus::record
