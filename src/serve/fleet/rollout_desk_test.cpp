#include "serve/fleet/rollout_desk.hpp"

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "fleet/limits.hpp"
#include "serve/studio/test_desk.hpp"
#include "serve/web/fetch.hpp"

namespace vagus::serve {
namespace {

using fleet::Kind;

// A desk with a page that looks, and robots that say what the test says for them.
class RolloutDeskTest : public testing::Test, protected test::Fixture {
protected:
    RolloutDeskTest() { hello(1, test::kDrive, "page"); }

    RolloutPlaces places() {
        const auto packed = []() -> Result<PackedVersion> {
            return PackedVersion{"the version", "ab"};
        };
        return {.version =
                    [this, packed] {
                        return is_open ? std::optional(OpenVersion{"Rover", unsaved, packed})
                                       : std::nullopt;
                    },
                .file = (std::filesystem::path(folder) / "rollout.json").string()};
    }
    RolloutDesk::Order order(std::vector<std::string> robots = {"r1", "r2", "r3"}) const {
        return {.fleet = "lab",
                .target = "mqtt://broker:1883/lab",
                .broker_is_here = true,
                .robots = std::move(robots),
                .steps = "1,100%",
                .by = "page"};
    }
    // Why it was not begun; empty: it was.
    std::string begin(RolloutDesk::Order wanted) {
        std::string why = "nothing was said";
        rollouts->begin(std::move(wanted), now, [&why](const Status& begun) {
            why = begun.ok() ? "" : begun.error().what;
        });
        return why;
    }
    // The studio was killed.
    void start_again() {
        rollouts.emplace(desk, places());
        rollouts->enter(order().target);
    }
    std::vector<std::string> wanted() {
        std::vector<std::string> robots;
        for (const fleet::Post& post : rollouts->take()) {
            const auto heard = fleet::read("lab", post.topic, post.payload);
            EXPECT_TRUE(heard.ok() && post.retained);
            want = std::get<fleet::Want>(heard.value().message);
            robots.push_back(heard.value().topic.robot);
        }
        return robots;
    }
    void pass(Duration time) { rollouts->tick(now += time); }
    void tells(const std::string& robot, const std::string& result, const std::string& why = "",
               const std::string& healthy = "") {
        rollouts->hear(fleet::Received{{{.kind = Kind::Version, .robot = robot},
                                        fleet::Version{want.number, "ab", result, why, healthy}},
                                       false},
                       now);
        pass(0s);
    }
    Json document() {
        pass(1s);
        desk.topics().touch("rollout");
        const uint32_t number = ++watches;
        say(1, {{"id", 10 + number},
                {"do", "watch"},
                {"in", {{"watch", number}, {"topic", "rollout"}, {"of", Json::object()}}}});
        desk.tick(now += 1s);
        for (const Json& message : got[ClientId{1}]) {
            if (message.value("watch", 0u) != number || !message.contains("whole")) continue;
            EXPECT_EQ(Protocol::get().fault_of_document("rollout", message["whole"]), std::nullopt);
            return message["whole"];
        }
        ADD_FAILURE() << "the topic was not told";
        return Json::object();
    }

    const vagus::test::Folder folder;
    bool is_open = true;
    std::vector<std::string> unsaved;
    uint32_t watches = 0;
    fleet::Want want;
    std::optional<RolloutDesk> rollouts{std::in_place, desk, places()};
};

using Names = std::vector<std::string>;

TEST_F(RolloutDeskTest, RobotsFetchItFromHereInSteps) {
    EXPECT_EQ(document()["state"], "none");
    EXPECT_EQ(begin(order()), "");
    EXPECT_EQ(wanted(), Names{"r1"});
    EXPECT_EQ(want.sha256, "ab");
    EXPECT_EQ(fetch(want.address, "", 100).value(), "the version");
    tells("r1", "started");
    const Json now_so = document();
    EXPECT_EQ(now_so["state"], "running");
    EXPECT_EQ(now_so["project"], "Rover");
    EXPECT_EQ(now_so["version"], "Rover");
    EXPECT_EQ(now_so["by"], "page");
    EXPECT_EQ(now_so["robots"]["r1"]["is"], "started");
    EXPECT_EQ(now_so["robots"]["r2"]["is"], "later");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(wanted(), (Names{"r2", "r3"}));
    tells("r2", "started"), tells("r3", "started");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(document()["state"], "well");
    EXPECT_EQ(fetch(want.address, "", 100).value(), "the version") << "for one that comes back";
}

TEST_F(RolloutDeskTest, TheFirstThatIsNotWellStopsItAndWhoHasItGoesBack) {
    EXPECT_EQ(begin(order()), "");
    (void)wanted();
    tells("r1", "started");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(wanted(), (Names{"r2", "r3"}));
    tells("r2", "refused", "it has mistakes"), tells("r3", "started");
    pass(fleet::kHealthyFor);
    const Json failed = document();
    EXPECT_EQ(failed["state"], "failed");
    EXPECT_EQ(failed["robots"]["r2"]["why"], "refused: it has mistakes");
    EXPECT_TRUE(rollouts->roll_back(order(), now).ok());
    EXPECT_EQ(wanted(), (Names{"r1", "r3"})) << "r2 has what it had before";
    EXPECT_TRUE(want.back);
    tells("r1", "started"), tells("r3", "started");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(document()["state"], "well");
    EXPECT_TRUE(document()["back"]);
    EXPECT_FALSE(rollouts->roll_back(order(), now).ok()) << "not once more";
}

TEST_F(RolloutDeskTest, OneThatIsStoppedIsServedNoLonger) {
    EXPECT_EQ(begin(order()), "");
    (void)wanted();
    EXPECT_EQ(begin(order()), "a roll-out is under way; stop it, or wait for its end");
    EXPECT_FALSE(rollouts->roll_back(order(), now).ok());
    EXPECT_TRUE(rollouts->stop("page").ok());
    EXPECT_FALSE(rollouts->stop("page").ok());
    EXPECT_FALSE(fetch(want.address, "", 100).ok());
    tells("r1", "started");  // it had fetched it already
    pass(fleet::kHealthyFor);
    const Json left = document();
    EXPECT_EQ(left["state"], "left");
    EXPECT_EQ(left["why"],
              "stopped by page; robots that have the version keep it, and no other robot gets it");
    EXPECT_EQ(left["robots"]["r1"]["is"], "well");
    EXPECT_EQ(wanted(), Names{});
}

TEST_F(RolloutDeskTest, AStudioThatIsStartedAgainSaysThatItWasLeft) {
    EXPECT_EQ(begin(order()), "");
    (void)wanted();
    tells("r1", "started");
    (void)document();
    start_again();
    const Json left = document();
    EXPECT_EQ(left["state"], "left");
    EXPECT_EQ(left["why"],
              "the studio that gave it ended before it was over: robots that have the version keep "
              "it, and no other robot gets it");
    EXPECT_FALSE(left["served"]);
    EXPECT_EQ(left["robots"]["r1"]["is"], "started");
    EXPECT_EQ(left["robots"]["r3"]["at"], 2);
    tells("r1", "started");  // it is retained: also what was not kept in time
    EXPECT_TRUE(document()["robots"]["r1"]["has"]);
    auto other = order();
    other.target = "mqtt://other:1883/lab";
    EXPECT_FALSE(rollouts->roll_back(other, now).ok()) << "robots of another fleet";
    EXPECT_TRUE(rollouts->roll_back(order(), now).ok());
    EXPECT_EQ(wanted(), Names{"r1"});
}

// Also one that was told of less when the file was written last; and nobody is given it again.
TEST_F(RolloutDeskTest, ARobotBecomesWellAfterTheStudioWasStartedAgain) {
    EXPECT_EQ(begin(order()), "");
    (void)wanted();
    tells("r1", "started", "battery = 12", "not_yet");
    (void)document();
    start_again();
    rollouts->hear(fleet::Connected{}, now);
    EXPECT_EQ(document()["robots"]["r1"]["why"], "battery = 12");
    tells("r1", "started", "battery = 15", "not_yet");
    pass(120s);  // nobody knows when it started: it does not fail by its time
    EXPECT_EQ(document()["robots"]["r1"]["is"], "started");
    EXPECT_EQ(document()["robots"]["r1"]["why"], "battery = 15");
    tells("r1", "started", "battery = 21", "well");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(document()["robots"]["r1"]["is"], "well");
    EXPECT_EQ(document()["robots"]["r1"]["why"], "");
    tells("r2", "started");  // a project without a condition
    EXPECT_EQ(document()["robots"]["r2"]["is"], "started");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(document()["robots"]["r2"]["is"], "well");
    EXPECT_EQ(document()["state"], "left");
    EXPECT_EQ(wanted(), Names{});
}

TEST_F(RolloutDeskTest, AFleetThatIsOpenedAgainIsHeardAndAnotherIsNot) {
    EXPECT_EQ(begin(order()), "");
    (void)wanted();
    rollouts->leave("the fleet was closed");
    rollouts->enter("mqtt://other:1883/lab");
    tells("r1", "started");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(document()["robots"]["r1"]["is"], "wanted");
    rollouts->enter(order().target);
    tells("r1", "started");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(document()["robots"]["r1"]["is"], "well");
}

TEST_F(RolloutDeskTest, WhatIsKeptAndCannotBeReadCountsAsNone) {
    for (const char* const text :
         {"", "{", "{}", R"({"number":7,"rollout":{"state":"running"}})"}) {
        ASSERT_TRUE(write_file(places().file, text).ok());
        rollouts.emplace(desk, places());
        EXPECT_EQ(document()["state"], "none") << text;
    }
}

TEST_F(RolloutDeskTest, WhatCannotBeBegunSaysWhatIsMissing) {
    EXPECT_EQ(begin(order({})), "no robot is there that this is for");
    auto wrong = order();
    wrong.steps = "1,0";
    EXPECT_EQ(begin(wrong).substr(0, 26), "steps 1,0: expected number");
    auto away = order();
    away.broker_is_here = false;
    EXPECT_NE(begin(away).find("start it again with --deploy-listen 0.0.0.0:8443 --deploy-cert "
                               "FILE --deploy-key FILE"),
              std::string::npos);
    is_open = false;
    EXPECT_EQ(begin(order()),
              "no project is open, whose version robots could get; open one beside the fleet");
    EXPECT_FALSE(document().contains("project"));
    EXPECT_EQ(wanted(), Names{});
}

// Of those that were changed since a person has looked nobody has decided.
TEST_F(RolloutDeskTest, UnsavedChangesAreLeftOutOnlyIfTheyAreNamed) {
    unsaved = {"a.aesl", "b.aesl"};
    auto some = order();
    some.without = {"a.aesl"};
    EXPECT_EQ(begin(some),
              "b.aesl has unsaved changes, which robots would not get; save it, or deploy without "
              "them");
    EXPECT_EQ(wanted(), Names{});
    some.without = {"b.aesl", "a.aesl", "c.aesl"};
    EXPECT_EQ(begin(some), "");
    EXPECT_EQ(wanted(), Names{"r1"});
}

TEST_F(RolloutDeskTest, ALoginThatMayNotWantAnythingIsTheReason) {
    EXPECT_EQ(begin(order()), "");
    (void)wanted();
    rollouts->hear(fleet::Acknowledged{kWantNumber, ""}, now);
    EXPECT_TRUE(rollouts->runs());
    rollouts->hear(fleet::Acknowledged{kWantNumber, "Not authorized"}, now);
    EXPECT_EQ(document()["state"], "left");
    EXPECT_EQ(document()["why"],
              "the broker does not pass it on (Not authorized); open the fleet with the login of "
              "an operator");
}

TEST_F(RolloutDeskTest, ARobotThatComesBackLaterIsInTheTable) {
    EXPECT_EQ(begin(order({"r1"})), "");
    (void)wanted();
    pass(60s);
    EXPECT_EQ(document()["state"], "failed");
    EXPECT_EQ(fetch(want.address, "", 100).value(), "the version");
    tells("r1", "started");
    pass(fleet::kHealthyFor);
    EXPECT_EQ(document()["robots"]["r1"]["is"], "well");
}

}  // namespace
}  // namespace vagus::serve
