#include "serve/field/wanted.hpp"

#include <gmock/gmock.h>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "fleet/limits.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

// A robot whose runs start at once; the disk is real, what is at an address is in `served`.
class WantedTest : public testing::Test {
protected:
    WantedTest() {
        EXPECT_TRUE(write_file((project / "vagus.json").string(), "0").ok());
        EXPECT_TRUE(deployments.boot(true, 0s).ok());
        turn();
    }

    Wanted::Callbacks callbacks() {
        return {.file = (fs::path(project) / ".vagus" / "want" / "r1.json").string(),
                .fetch = [this](const std::string& address) -> Result<std::string> {
                    ++fetches;
                    if (while_fetched) while_fetched();
                    if (address == "https://desk/x") return served;
                    return Error{Code::Unavailable, address + ": cannot be fetched"};
                },
                .tell =
                    [this](const fleet::Version& version) {
                        told.push_back(version.result + version.healthy);
                        why = version.why;
                    },
                .log = [](auto&, auto&) {},
                .healthy = [this] { return healthy; },
                .read = [this](const plan::WordFormula::Name&) -> Result<plan::Value> {
                    return plan::Value(battery);
                }};
    }

    // What comes of it; the robot takes what time it needs.
    void wants(const fleet::Want& want) {
        wanted.want(want);
        for (int i = 0; i < 8; ++i) turn();
    }
    void turn() {
        now += kProvesWithin;
        deployments.tick(now);
        starter.tick(now);
        wanted.tick(now);
    }
    // In steps of a look at its condition.
    void pass(Duration time) {
        for (const Time end = now + time; now < end;) wanted.tick(now += fleet::kConditionEvery);
    }
    fleet::Want serve(int64_t number, const std::string& content) {
        const Bundle bundle{.name = "Rover",
                            .project = "",
                            .files = {{"vagus.json", content.size(), sha256_of(content)}}};
        served = to_json(bundle).dump() + "\n" + content;
        return {number, sha256_of(served), "https://desk/x", false};
    }

    test::Folder project;
    std::string served, opened, why;
    std::vector<std::string> told;
    std::vector<DocFinding> findings;
    int fetches = 0;
    std::function<void()> while_fetched;
    std::optional<fleet::Healthy> healthy;
    int64_t battery = 0;
    Time now{};
    Versions versions{project};
    Starter starter{{.missing = [] { return std::vector<std::string>(); },
                     .start = [](auto done) { done(""); },
                     .log = [](auto&, auto&) {}}};
    Deployments deployments{
        versions,
        starter,
        {.check = [this] { return [this](const fs::path&) { return findings; }; },
         .stop = [](auto done) { done(); },
         .open =
             [this](const fs::path& folder) {
                 opened = read_file((folder / "vagus.json").string()).value();
                 return Status::done();
             },
         .log = [](auto&, auto&) {},
         .wall_ms = [] { return 0.0; }}};
    Wanted wanted{deployments, callbacks()};
};

TEST_F(WantedTest, ItIsFetchedAndStartedAndToldOnce) {
    const fleet::Want want = serve(7, "one");
    wants(want);
    EXPECT_EQ(opened, "one");
    EXPECT_THAT(told, ElementsAre("taken", "started"));
    wants(want);  // the broker tells it again at each connection
    EXPECT_EQ(fetches, 1);
    EXPECT_THAT(told, ElementsAre("taken", "started", "started"));
    Wanted again(deployments, callbacks());  // the robot was started again
    again.want(want);
    EXPECT_EQ(fetches, 1);
    EXPECT_EQ(told.back(), "started");
}

TEST_F(WantedTest, WhatIsNotWhatWasWantedIsRefused) {
    fleet::Want want = serve(7, "one");
    served += "x";
    wants(want);
    EXPECT_THAT(told, ElementsAre("taken", "refused"));
    EXPECT_THAT(why, HasSubstr("another SHA-256"));
    want.number = 8;
    want.sha256 = sha256_of(served);
    wants(want);
    EXPECT_THAT(why, HasSubstr("1 bytes behind the last file"));
    want = {9, "", "https://desk/gone", false};
    wants(want);
    EXPECT_THAT(why, HasSubstr("cannot be fetched"));
    EXPECT_EQ(opened, "0");
}

TEST_F(WantedTest, AStopWhileItIsFetchedCountsMore) {
    while_fetched = [this] { deployments.stopped(); };
    wants(serve(7, "one"));
    EXPECT_THAT(told, ElementsAre("taken", "refused"));
    EXPECT_THAT(why, HasSubstr("somebody pressed Stop while it was fetched"));
    EXPECT_EQ(versions.current(), 0u);
    while_fetched = {};
    wants(serve(8, "one"));  // asked for after the Stop
    EXPECT_EQ(told.back(), "started");
}

TEST_F(WantedTest, WhatHasMistakesIsRefusedWithTheFirstOfThem) {
    DocFinding mistake;
    mistake.doc = "a.aesl";
    mistake.at.line = 3;
    mistake.what = "unknown name";
    findings = {mistake};
    wants(serve(7, "one"));
    EXPECT_EQ(told.back(), "refused");
    EXPECT_THAT(why, HasSubstr("a.aesl:3: unknown name"));
    EXPECT_EQ(opened, "0");
}

TEST_F(WantedTest, BackIsTheVersionBefore) {
    wants(serve(7, "one"));
    wants(serve(8, "two"));
    EXPECT_EQ(opened, "two");
    wants({9, "", "", true});
    EXPECT_EQ(opened, "one");
    EXPECT_EQ(told.back(), "started");
}

TEST_F(WantedTest, BackChangesNothingWhereTheLastVersionWasRefused) {
    wants(serve(7, "one"));
    wants(serve(8, "two"));
    fleet::Want bad = serve(9, "three");
    bad.sha256 = sha256_of("else");
    wants(bad);
    EXPECT_EQ(told.back(), "refused");
    wants({10, "", "", true});
    EXPECT_EQ(opened, "two");
    EXPECT_EQ(told.back(), "started");
    EXPECT_EQ(why, "the version before is in force already");
}

TEST_F(WantedTest, BackIsRefusedAgainWhereNothingIsBefore) {
    for (const int64_t number : {7, 8}) {
        wants({number, "", "", true});
        EXPECT_EQ(told.back(), "refused");
        EXPECT_THAT(why, HasSubstr("nothing is before it"));
    }
}

// One file for both let the refusal of one stand for the outcome of the other.
TEST_F(WantedTest, EachRobotOfAFolderRemembersItsOwn) {
    wants(serve(7, "one"));
    Wanted::Callbacks of_another = callbacks();
    of_another.file = (fs::path(project) / ".vagus" / "want" / "r2.json").string();
    Wanted another(deployments, of_another);
    EXPECT_FALSE(another.last());
    another.want({8, "", "", true});
    EXPECT_EQ(told.back(), "taken");
    Wanted again(deployments, callbacks());
    ASSERT_TRUE(again.last());
    EXPECT_EQ(again.last()->number, 7);
    EXPECT_EQ(again.last()->result, "started");
}

TEST_F(WantedTest, WhatAnEarlierVersionRememberedIsThatOfTheFirst) {
    const fs::path before = fs::path(project) / ".vagus" / "want.json";
    const auto write = [&](int64_t number) {
        fs::create_directories(before.parent_path());
        const fleet::Version version{number, "", "refused", "a reason"};
        EXPECT_TRUE(write_file(before.string(), fleet::payload_of(version)).ok());
    };
    write(7);
    wanted.adopt(before.string());
    ASSERT_TRUE(wanted.last());
    EXPECT_EQ(wanted.last()->number, 7);
    EXPECT_FALSE(fs::exists(before));
    Wanted again(deployments, callbacks());
    ASSERT_TRUE(again.last());
    EXPECT_EQ(again.last()->why, "a reason");
    write(6);
    again.adopt(before.string());
    EXPECT_EQ(again.last()->number, 7);
    EXPECT_FALSE(fs::exists(before));
}

// It went back to version 0, and once more when it was started again.
TEST_F(WantedTest, BackIsNotDoneWhereItCannotBeRemembered) {
    wants(serve(7, "one"));
    wants(serve(8, "two"));
    const fs::path file = fs::path(project) / ".vagus" / "want" / "r1.json";
    fs::remove(file);
    fs::create_directories(file);  // what stands for a full disk
    wants({9, "", "", true});
    EXPECT_EQ(opened, "two");
    EXPECT_EQ(told.back(), "refused");
    EXPECT_THAT(why, HasSubstr("nothing was changed"));
    fs::remove(file);
    wants({10, "", "", true});
    EXPECT_EQ(opened, "one");
    Wanted again(deployments, callbacks());
    again.want({10, "", "", true});
    EXPECT_EQ(opened, "one");
}

TEST_F(WantedTest, BackThatARestartInterruptedIsNotDoneOnceMore) {
    wants(serve(7, "one"));
    wants(serve(8, "two"));
    wanted.want({9, "", "", true});  // begun; then the power is cut
    EXPECT_EQ(told.back(), "taken");
    Wanted again(deployments, callbacks());
    for (int i = 0; i < 8; ++i) turn();
    EXPECT_EQ(opened, "one");
    again.want({9, "", "", true});
    again.tick(now);
    EXPECT_EQ(opened, "one");
    EXPECT_EQ(told.back(), "refused");
    EXPECT_THAT(why, HasSubstr("started again while it went back"));
    again.want({9, "", "", true});
    EXPECT_EQ(told.back(), "refused");
}

TEST_F(WantedTest, ItsConditionIsToldUntilItWasTrueForLongEnough) {
    healthy = fleet::Healthy{"battery > 20", 5s};
    wants(serve(7, "one"));
    EXPECT_THAT(told, ElementsAre("taken", "startednot_yet", "startednot_yet"));
    EXPECT_EQ(why, "its condition battery > 20 is not true: battery = 0");
    EXPECT_TRUE(wanted.lacks_health());
    told.clear();
    battery = 25;
    pass(5s);  // true since 0.1 s
    EXPECT_THAT(told, ElementsAre("startednot_yet"));
    EXPECT_EQ(why, "its condition battery > 20 is true, but not yet for 5 s: battery = 25");
    pass(100ms);
    EXPECT_THAT(told, ElementsAre("startednot_yet", "startedwell"));
    pass(1min);
    EXPECT_EQ(told.size(), 2u);
    EXPECT_FALSE(wanted.lacks_health());
    Wanted again(deployments, callbacks());  // the robot was started again
    again.want({7, "", "", false});
    EXPECT_EQ(told.back(), "startedwell");
}

TEST_F(WantedTest, WhatItsConditionLacksIsToldOnceASecondAtMost) {
    healthy = fleet::Healthy{"battery > 20", 5s};
    wants(serve(7, "one"));
    pass(1s);
    told.clear();
    for (int i = 0; i < 20; ++i) {
        battery = i % 2;
        pass(100ms);
    }
    EXPECT_GE(told.size(), 1u);
    EXPECT_LE(told.size(), 2u);
}

TEST_F(WantedTest, ARobotThatWasStartedAgainGoesOnLooking) {
    healthy = fleet::Healthy{"battery > 20", 5s};
    wants(serve(7, "one"));
    Wanted again(deployments, callbacks());
    EXPECT_TRUE(again.lacks_health());
    battery = 25;
    again.tick(now);
    again.tick(now + 5s);
    EXPECT_EQ(told.back(), "startedwell");
}

TEST_F(WantedTest, TheNextVersionEndsTheLook) {
    healthy = fleet::Healthy{"battery > 20", 5s};
    wants(serve(7, "one"));
    healthy.reset();
    wants(serve(8, "two"));
    EXPECT_EQ(told.back(), "started");
    EXPECT_FALSE(wanted.lacks_health());
}

TEST_F(WantedTest, TheLastOfTwoThatComeAtOnceStays) {
    wanted.want(serve(7, "one"));
    const fleet::Want second = serve(8, "two");
    wanted.want(second);
    EXPECT_THAT(told, ElementsAre("taken")) << "the first is being started";
    for (int i = 0; i < 8; ++i) turn();
    EXPECT_EQ(opened, "two");
    EXPECT_THAT(told, ElementsAre("taken", "started", "taken", "started"));
}

}  // namespace
}  // namespace vagus::serve
