#include "serve/field/deployments.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include "base/file.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A robot whose runs start, or do not, when the test says so; the disk is real.
class DeploymentsTest : public testing::Test {
protected:
    DeploymentsTest() { EXPECT_TRUE(write_file((project / "vagus.json").string(), "0").ok()); }

    Deployments::Callbacks callbacks() {
        return {.check = [this] { return [this](const fs::path&) { return findings; }; },
                .stop = [this](auto done) { stops.push_back(std::move(done)); },
                .open =
                    [this](const fs::path& folder) {
                        opened = read_file((folder / "vagus.json").string()).value();
                        return Status::done();
                    },
                .log = [this](auto& kind, auto& text) { log.push_back(kind + ": " + text); },
                .wall_ms = [] { return 0.0; },
                .plan = [] { return "its plan runs"; }};
    }
    static Bundle bundle(const std::string& content) {
        return {.name = "Rover",
                .project = "",
                .files = {{"vagus.json", content.size(), sha256_of(content)}}};
    }
    void send(const std::string& content) {
        ASSERT_TRUE(deployments.begin(bundle(content)).ok());
        ASSERT_TRUE(part("vagus.json", 0, content).ok());
    }
    Status part(const std::string& path, size_t from, const std::string& bytes) {
        Status status = Error{Code::Unavailable, "no answer"};
        deployments.part(path, from, bytes, [&](const Status& taken) { status = taken; });
        return status;
    }
    void commit() {
        deployments.commit([this](DeployOutcome ended) { outcome = std::move(ended); });
    }
    // What the loop of the server does.
    void turn(Time now) {
        deployments.tick(now);
        starter.tick(now);
        deployments.tick(now);
    }
    // Sent, and in force: it is being started.
    void try_out(const std::string& content, Time now) {
        turn(now);
        send(content);
        commit();
        ASSERT_EQ(stops.size(), 1u);
        stops.back()();
        stops.clear();
        turn(now);
    }
    void runs(Time now) {
        starts.back()("");
        turn(now);
        turn(now + kProvesWithin);
    }

    test::Folder project;
    std::vector<std::string> missing, log;
    std::vector<std::function<void(const std::string&)>> starts;
    std::vector<std::function<void()>> stops;
    std::vector<DocFinding> findings;
    std::string opened;
    std::optional<DeployOutcome> outcome;
    Versions versions{project};
    Starter starter{{.missing = [this] { return missing; },
                     .start = [this](auto done) { starts.push_back(std::move(done)); },
                     .log = [](auto&, auto&) {}}};
    Deployments deployments{versions, starter, callbacks()};
};

TEST_F(DeploymentsTest, WhatStartsStays) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    EXPECT_EQ(opened, "0");
    try_out("one", 5s);
    EXPECT_EQ(opened, "one");
    EXPECT_FALSE(outcome.has_value()) << "it has not started yet";
    runs(6s);
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Started);
    EXPECT_EQ(outcome->version, 1u);
    EXPECT_EQ(versions.current(), 1u);
    EXPECT_FALSE(versions.trial().has_value());
    turn(100s);
    EXPECT_EQ(versions.current(), 1u);
}

TEST_F(DeploymentsTest, WhatDoesNotStartWithinTenSecondsIsTakenBack) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    try_out("one", 5s);
    for (Time now = 5s; now < 15s; now += 1s) {
        turn(now);
        if (starter.state() == Starter::State::Starting) starts.back()("the plan has no start");
        EXPECT_FALSE(outcome.has_value());
    }
    const size_t before = starts.size();
    turn(15s);
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->result, DeployOutcome::Result::RolledBack);
    EXPECT_EQ(outcome->version, 0u);
    EXPECT_THAT(outcome->why, HasSubstr("within 10 s: it does not start: the plan has no start"));
    EXPECT_EQ(opened, "0");
    EXPECT_EQ(versions.all(), std::vector<uint32_t>{});
    EXPECT_EQ(starts.size(), before + 1) << "the version before is started";
    EXPECT_EQ(deployments.counts().rolled_back, 1u);
}

TEST_F(DeploymentsTest, WhoDeploysIsToldHowThePlanIsThreeSecondsLater) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    try_out("one", 5s);
    starts.back()("");
    turn(6s);
    EXPECT_EQ(deployments.next_tick(), Time(6s + kProvesWithin));
    turn(6s + kProvesWithin - 1us);
    EXPECT_FALSE(outcome.has_value());
    turn(6s + kProvesWithin);
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Started);
    EXPECT_EQ(outcome->why, "its plan runs");
}

TEST_F(DeploymentsTest, APlanThatFailsAtOnceHasNotStarted) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    try_out("one", 5s);
    starts.back()("");
    turn(6s);
    starter.failed("go: it is broken");
    const size_t before = starts.size();
    turn(6s + kProvesWithin - 1us);
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->result, DeployOutcome::Result::RolledBack);
    EXPECT_EQ(outcome->why, "it does not start: its plan ended in an error: go: it is broken");
    EXPECT_EQ(opened, "0");
    EXPECT_EQ(starts.size(), before + 1) << "the version before is started";
}

// A run that dies and starts again has to prove itself again.
TEST_F(DeploymentsTest, ARunThatDiesWhileItProvesItselfBeginsAnew) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    try_out("one", 5s);
    starts.back()("");
    turn(6s);
    starter.died(7s);
    turn(7s);
    turn(8s);
    starts.back()("");
    turn(8s);
    turn(6s + kProvesWithin);
    EXPECT_FALSE(outcome.has_value());
    turn(8s + kProvesWithin);
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Started);
}

TEST_F(DeploymentsTest, MistakesAreToldAndNothingChanges) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    findings = {{.doc = "vagus.json",
                 .code = "x",
                 .element = "",
                 .at = {1, 1},
                 .end = {1, 1},
                 .what = "wrong",
                 .fixes = {}}};
    send("one");
    commit();
    ASSERT_TRUE(outcome.has_value());
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Refused);
    EXPECT_EQ(outcome->findings.size(), 1u);
    EXPECT_TRUE(stops.empty());
    EXPECT_EQ(versions.all(), std::vector<uint32_t>{});
    EXPECT_FALSE(fs::exists(project / ".vagus/versions/incoming"));
}

TEST_F(DeploymentsTest, RemarksDoNotRefuse) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    findings = {{.doc = "vagus.json",
                 .severity = Severity::Warning,
                 .code = "x",
                 .element = "",
                 .at = {1, 1},
                 .end = {1, 1},
                 .what = "odd",
                 .fixes = {}}};
    try_out("one", 1s);
    runs(1s);
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Started);
}

TEST_F(DeploymentsTest, PartsComeInTheirOrderAndAsAnnounced) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    EXPECT_FALSE(part("vagus.json", 0, "one").ok()) << "nothing was begun";
    ASSERT_TRUE(deployments.begin(bundle("one")).ok());
    EXPECT_FALSE(part("other", 0, "one").ok());
    EXPECT_FALSE(part("vagus.json", 1, "ne").ok());
    EXPECT_FALSE(part("vagus.json", 0, "more").ok());
    EXPECT_TRUE(part("vagus.json", 0, "on").ok());
    commit();
    EXPECT_EQ(outcome->why, "vagus.json: it was not fully received");
    ASSERT_TRUE(deployments.begin(bundle("one")).ok());
    EXPECT_FALSE(part("vagus.json", 0, "two").ok()) << "another hash";
}

TEST_F(DeploymentsTest, AVersionThatIsTriedOutLetsNoOtherIn) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    try_out("one", 1s);
    EXPECT_FALSE(deployments.begin(bundle("two")).ok());
    std::optional<DeployOutcome> second;
    deployments.back([&](DeployOutcome ended) { second = std::move(ended); });
    EXPECT_EQ(second->result, DeployOutcome::Result::Refused);
}

TEST_F(DeploymentsTest, BackIsByHand) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    try_out("one", 1s);
    runs(1s);
    try_out("two", 2s);
    runs(2s);
    outcome.reset();
    deployments.back([this](DeployOutcome ended) { outcome = std::move(ended); });
    stops.back()();
    turn(3s);
    EXPECT_EQ(opened, "one");
    runs(3s);
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Started);
    EXPECT_EQ(outcome->version, 1u);
    EXPECT_EQ(versions.all(), (std::vector<uint32_t>{1, 2}));
}

// What it went back to has run before: nobody is sent to and fro.
TEST_F(DeploymentsTest, BackWaitsForWhatDoesNotStart) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    try_out("one", 1s);
    runs(1s);
    missing = {"rover"};
    deployments.back([this](DeployOutcome ended) { outcome = std::move(ended); });
    stops.back()();
    turn(2s);
    turn(13s);
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Waiting);
    EXPECT_EQ(versions.current(), 0u);
    EXPECT_EQ(starter.state(), Starter::State::Waiting);
}

TEST_F(DeploymentsTest, NothingStartsAfterAStopByHand) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    turn(0s);
    send("one");
    commit();
    starter.give_up();
    deployments.stopped();
    stops.back()();
    const size_t before = starts.size();
    turn(1s);
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Stopped);
    turn(100s);
    EXPECT_EQ(starts.size(), before);
    EXPECT_EQ(versions.current(), 1u);
}

TEST_F(DeploymentsTest, AStopBeforeItsCommitCountsAndOneBeforeItWasBegunDoesNot) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    turn(0s);
    deployments.stopped();
    send("one");
    starter.give_up();
    deployments.stopped();
    commit();
    stops.back()();
    turn(1s);
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Stopped);
    stops.clear();
    try_out("two", 2s);
    EXPECT_EQ(starter.state(), Starter::State::Starting);
}

// A version that takes the whole program with it each time it starts.
TEST_F(DeploymentsTest, AVersionThatNeverStartedIsGivenUpAfterThreeBoots) {
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    try_out("one", 1s);
    for (uint32_t boot = 1; boot <= kTrialBootsMax; ++boot) {
        Deployments after(versions, starter, callbacks());
        ASSERT_TRUE(after.boot(true, 0s).ok());
        EXPECT_EQ(opened, "one");
    }
    Deployments after(versions, starter, callbacks());
    ASSERT_TRUE(after.boot(true, 0s).ok());
    EXPECT_EQ(opened, "0");
    EXPECT_EQ(versions.current(), 0u);
    EXPECT_THAT(log, testing::Contains(HasSubstr("did not start at 3 boots")));
}

TEST_F(DeploymentsTest, AnEmptyFolderWaitsForItsFirstProject) {
    fs::remove(project / "vagus.json");
    ASSERT_TRUE(deployments.boot(true, 0s).ok());
    EXPECT_EQ(opened, "");
    try_out("one", 1s);
    runs(1s);
    EXPECT_EQ(outcome->result, DeployOutcome::Result::Started);
}

}  // namespace
}  // namespace vagus::serve
