#include "keeper/keeper.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vagus::keeper {
namespace {

using testing::HasSubstr;

// A keeper beside a broker that acknowledges at once, unless it is told to wait.
class Desk {
public:
    explicit Desk(Options options = {"a", 10s, 1}) : keeper(std::move(options)) {}

    void tell(const Input& input) { perform(keeper.take(input, now)); }

    // Time passes in steps of a tenth of a second; beats come back at once.
    void pass(Duration time) {
        for (const Time end = now + time; now < end;) {
            now += 100ms;
            perform(keeper.tick(now));
        }
    }

    void serve() {
        tell(Connected{});
        pass(kListen + 10s + 200ms);
    }

    std::optional<Reply> ask(const std::string& robot, const Request& request,
                             uint64_t number = 0) {
        last = std::nullopt;
        tell(Asked{{robot, 1, number ? number : ++numbers}, request});
        return last;
    }

    Keeper keeper;
    Time now{};
    uint64_t numbers = 100;
    bool acknowledges = true;
    bool beats_return = true;
    std::optional<Reply> last;
    std::vector<Publish> published;
    int beats = 0;
    std::string left;

private:
    void perform(const Actions& actions) {
        for (const Action& action : actions) {
            if (const auto* beat = std::get_if<Beat>(&action)) {
                ++beats;
                if (beats_return) perform(keeper.take(*beat, now));
            } else if (const auto* publish = std::get_if<Publish>(&action)) {
                published.push_back(*publish);
                if (acknowledges) perform(keeper.take(Acknowledged{publish->publication}, now));
            } else if (const auto* answer = std::get_if<Answer>(&action)) {
                last = answer->reply;
            } else {
                left = std::get<Leave>(action).why;
            }
        }
    }
};

Task task_in(const std::optional<Reply>& reply) {
    return std::get<Task>(reply.value().record.value());
}

Term term_in(const std::optional<Reply>& reply) {
    const Record& record = reply.value().record.value();
    if (const auto* claim = std::get_if<Claim>(&record)) return claim->lease.term;
    return std::get<Task>(record).lease.term;
}

TEST(Keeper, ListensThenRestsForTheLongestLeaseThenServes) {
    Desk desk;
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Away);
    desk.tell(Connected{});
    desk.pass(2900ms);
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Listening);
    EXPECT_EQ(desk.beats, 0);
    desk.pass(100ms);
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Resting);
    EXPECT_EQ(desk.beats, 1);
    desk.pass(10'100ms);  // 10 s, and 2 % for clocks that drift apart
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Resting);
    EXPECT_FALSE(desk.ask("r", Take{"pick", 5s}));
    EXPECT_EQ(desk.keeper.ignored(), 1u);
    desk.pass(100ms);
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Serving);
    EXPECT_EQ(desk.beats, 11);  // at 3, 4, … 13 s
}

TEST(Keeper, GivesATaskToOneRobotAndKeepsWhatItFinished) {
    Desk desk;
    desk.serve();
    desk.ask("boss", Give{"pick", "t1", "{}"});
    const auto first = desk.ask("r1", Take{"pick", 5s});
    EXPECT_EQ(task_in(first).lease, (Lease{"r1", {1, 2}, 5s}));
    EXPECT_EQ(desk.ask("r2", Take{"pick", 5s})->outcome, Outcome::Nothing);
    EXPECT_EQ(desk.ask("r2", Finish{term_in(first), "1"})->outcome, Outcome::Refused);
    const auto done = desk.ask("r1", Finish{term_in(first), "1"});
    EXPECT_EQ(done->outcome, Outcome::Done);
    EXPECT_EQ(task_in(done).work, Work::Done);
    EXPECT_EQ(task_in(done).result, "1");
    EXPECT_EQ(desk.ask("r1", Finish{term_in(first), "1"})->outcome, Outcome::Refused);
    // A minute later it is forgotten.
    desk.published.clear();
    desk.pass(kDoneKept);
    ASSERT_EQ(desk.published.size(), 1u);
    EXPECT_TRUE(desk.published[0].gone);
}

TEST(Keeper, HandsOutTasksInTheOrderInWhichTheyWereGiven) {
    Desk desk;
    desk.serve();
    for (const char* id : {"z", "a", "m"}) desk.ask("boss", Give{"pick", id, "1"});
    desk.ask("boss", Give{"other", "0", "1"});
    EXPECT_EQ(task_in(desk.ask("r1", Take{"pick", 5s})).id, "z");
    EXPECT_EQ(task_in(desk.ask("r2", Take{"pick", 5s})).id, "a");
    EXPECT_EQ(task_in(desk.ask("r3", Take{"pick", 5s})).id, "m");
}

TEST(Keeper, GivesATaskAgainWhoseLeaseHasEndedAndRefusesTheOldTerm) {
    Desk desk;
    desk.serve();
    desk.ask("boss", Give{"pick", "t1", "1"});
    const Term old = term_in(desk.ask("r1", Take{"pick", 5s}));
    desk.pass(5s);
    EXPECT_EQ(desk.ask("r2", Take{"pick", 5s})->outcome, Outcome::Nothing);
    desk.pass(100ms);
    EXPECT_EQ(task_in(desk.ask("r2", Take{"pick", 5s})).id, "t1");
    EXPECT_THAT(desk.ask("r1", Finish{old, "1"})->why, HasSubstr("is over"));
    EXPECT_EQ(desk.ask("r1", Renew{old})->outcome, Outcome::Refused);
}

TEST(Keeper, ALeaseThatIsRenewedGoesOn) {
    Desk desk;
    desk.serve();
    desk.ask("boss", Give{"pick", "t1", "1"});
    const Term term = term_in(desk.ask("r1", Take{"pick", 5s}));
    for (int i = 0; i < 4; ++i) {
        desk.pass(4s);
        EXPECT_EQ(desk.ask("r1", Renew{term})->outcome, Outcome::Done);
    }
    EXPECT_EQ(desk.ask("r2", Take{"pick", 5s})->outcome, Outcome::Nothing);
}

TEST(Keeper, ALongerLeaseIsCutToTheLongest) {
    Desk desk;
    desk.serve();
    EXPECT_EQ(std::get<Claim>(*desk.ask("r1", ClaimName{"aisle", 60s})->record).lease.length, 10s);
    EXPECT_EQ(std::get<Claim>(*desk.ask("r1", ClaimName{"b", 1us})->record).lease.length,
              kLeaseMin);
}

TEST(Keeper, AnswersAGrantWhenTheBrokerHasIt) {
    Desk desk;
    desk.serve();
    desk.ask("boss", Give{"pick", "t1", "1"});
    desk.acknowledges = false;
    EXPECT_FALSE(desk.ask("r1", Take{"pick", 5s}, 7));
    // Asked again, it is not granted twice.
    EXPECT_FALSE(desk.ask("r1", Take{"pick", 5s}, 7));
    EXPECT_EQ(desk.ask("r2", Take{"pick", 5s})->outcome, Outcome::Nothing);
    desk.last.reset();
    desk.tell(Acknowledged{desk.published.back().publication});
    EXPECT_EQ(task_in(desk.last).lease.robot, "r1");
    const auto again = desk.ask("r1", Take{"pick", 5s}, 7);
    EXPECT_EQ(task_in(again).lease, task_in(desk.last).lease);
}

TEST(Keeper, AfterTheBrokerWasGoneItPublishesAllAgainAndAnswersWhatWaited) {
    Desk desk;
    desk.serve();
    desk.ask("boss", Give{"pick", "t1", "1"});
    desk.acknowledges = false;
    EXPECT_FALSE(desk.ask("r1", Take{"pick", 10s}));
    desk.tell(Lost{});
    desk.acknowledges = true;
    desk.published.clear();
    desk.tell(Connected{});
    // The broker has kept a task that was forgotten here since.
    desk.tell(Retained{Task{"pick", "old", {1, 1}, "1", Work::Done, {}, ""}});
    desk.pass(kListen);
    ASSERT_EQ(desk.published.size(), 2u);
    EXPECT_TRUE(desk.published[0].gone);
    EXPECT_EQ(std::get<Task>(desk.published[1].record).work, Work::Leased);
    EXPECT_EQ(task_in(desk.last).lease.robot, "r1");
}

TEST(Keeper, ASecondOneFindsTheFirstAndStaysOut) {
    Desk desk({"b", 10s, 1});
    desk.tell(Connected{});
    desk.pass(1s);
    desk.tell(Beat{3, "a", 17});
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Out);
    EXPECT_THAT(desk.left, HasSubstr("another keeper, a"));
    EXPECT_TRUE(desk.published.empty());
}

TEST(Keeper, OneThatWasSupersededLeavesAndPublishesNothing) {
    Desk desk;
    desk.serve();
    desk.ask("boss", Give{"pick", "t1", "1"});
    desk.acknowledges = false;
    desk.ask("r1", Take{"pick", 5s});
    desk.tell(Beat{2, "b", 1});
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Out);
    desk.published.clear();
    desk.pass(60s);
    EXPECT_TRUE(desk.published.empty());
    desk.tell(Acknowledged{2});
    EXPECT_FALSE(desk.last);
}

TEST(Keeper, ItsEpochIsLaterThanThatOfAKeeperThatDecidedNothing) {
    Desk desk;
    desk.tell(Connected{});
    desk.tell(LastBeat{7});
    desk.pass(kListen);
    EXPECT_EQ(desk.keeper.epoch(), 8u);
}

TEST(Keeper, OneThatComesBackAndHearsAnotherOfTheSameEpochLeaves) {
    Desk desk({"k9", 10s, 2});
    desk.serve();
    desk.tell(Lost{});
    desk.tell(Connected{});
    desk.tell(Beat{2, "k12", 1});  // "k9" is behind "k12" as a text
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Out);
}

TEST(Keeper, OneThatComesBackBehindALaterOneLeaves) {
    Desk desk;
    desk.serve();
    desk.tell(Lost{});
    desk.tell(Connected{});
    desk.tell(LastBeat{2});
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Out);
}

TEST(Keeper, OneThatComesBackTakesLeasesAsRenewed) {
    Desk desk;
    desk.serve();
    desk.ask("r1", ClaimName{"aisle", 4s});
    desk.tell(Lost{});
    desk.pass(20s);
    desk.tell(Connected{});
    desk.pass(kListen + 10'100ms);
    EXPECT_EQ(desk.ask("r2", ClaimName{"aisle", 4s})->outcome, Outcome::Nothing);
    desk.pass(100ms);
    EXPECT_EQ(desk.ask("r2", ClaimName{"aisle", 4s})->outcome, Outcome::Done);
}

TEST(Keeper, AnEarlierOneIsToldAtOnceThatThereIsALaterOne) {
    Desk desk({"b", 10s, 5});
    desk.serve();
    const int before = desk.beats;
    desk.tell(Beat{4, "a", 99});
    EXPECT_EQ(desk.beats, before + 1);
    EXPECT_EQ(desk.keeper.state(), Keeper::State::Serving);
}

TEST(Keeper, WhoseOwnBeatsDoNotComeBackDoesNothing) {
    Desk desk;
    desk.serve();
    desk.beats_return = false;
    desk.pass(kListen);
    desk.published.clear();
    EXPECT_FALSE(desk.ask("boss", Give{"pick", "t1", "1"}));
    EXPECT_EQ(desk.keeper.ignored(), 1u);
    EXPECT_TRUE(desk.published.empty());
}

TEST(Keeper, StartedAgainItGoesOnWithWhatTheBrokerHasKept) {
    Desk desk({"b", 10s, 1});
    desk.tell(Connected{});
    desk.tell(Retained{Task{"pick", "t1", {4, 1}, "1", Work::Leased, {"r1", {4, 3}, 5s}, ""}});
    desk.tell(Retained{Task{"pick", "t2", {4, 2}, "1", Work::Waiting, {}, ""}});
    desk.tell(Retained{Shared{"speed", {4, 4}, "7"}});
    desk.pass(kListen);
    EXPECT_EQ(desk.keeper.epoch(), 5u);
    // The robot that works may go on, and finish.
    EXPECT_EQ(desk.ask("r1", Renew{{4, 3}})->outcome, Outcome::Done);
    desk.pass(4s);
    EXPECT_EQ(task_in(desk.ask("r1", Finish{{4, 3}, "ok"})).work, Work::Done);
    desk.pass(7s);
    EXPECT_EQ(task_in(desk.ask("r2", Take{"pick", 5s})).id, "t2");
    EXPECT_EQ(desk.ask("r2", Write{"speed", {4, 4}, "8"})->outcome, Outcome::Done);
}

TEST(Keeper, PutsRightWhatAnEarlierKeeperHasOverwritten) {
    Desk desk({"b", 10s, 2});
    desk.serve();
    const auto written = desk.ask("r1", Write{"speed", {}, "8"});
    desk.published.clear();
    desk.tell(Retained{Shared{"speed", {1, 9}, "7"}});
    ASSERT_EQ(desk.published.size(), 1u);
    EXPECT_EQ(desk.published[0].record, *written->record);
    desk.tell(Retained{Shared{"strange", {1, 10}, "7"}});
    ASSERT_EQ(desk.published.size(), 2u);
    EXPECT_TRUE(desk.published[1].gone);
}

TEST(Keeper, OfTwoWritesOfOneVersionTheSecondIsToldTheValue) {
    Desk desk;
    desk.serve();
    const auto first = desk.ask("r1", Write{"speed", {}, "1"});
    EXPECT_EQ(first->outcome, Outcome::Done);
    const auto second = desk.ask("r2", Write{"speed", {}, "2"});
    EXPECT_EQ(second->outcome, Outcome::Nothing);
    EXPECT_EQ(std::get<Shared>(*second->record).value, "1");
    const Term version = std::get<Shared>(*second->record).version;
    EXPECT_EQ(std::get<Shared>(*desk.ask("r2", Write{"speed", version, "2"})->record).value, "2");
    EXPECT_THAT(desk.ask("r2", Write{"none", version, "2"})->why, HasSubstr("no value none"));
}

TEST(Keeper, ANameIsOneRobotsUntilItIsReleased) {
    Desk desk;
    desk.serve();
    const Term term = term_in(desk.ask("r1", ClaimName{"aisle", 5s}));
    EXPECT_EQ(desk.ask("r2", ClaimName{"aisle", 5s})->why, "r1 has aisle");
    EXPECT_THAT(desk.ask("r1", Finish{term, ""})->why, HasSubstr("release it"));
    EXPECT_EQ(desk.ask("r1", Release{term})->outcome, Outcome::Done);
    EXPECT_EQ(desk.ask("r2", ClaimName{"aisle", 5s})->outcome, Outcome::Done);
    EXPECT_EQ(desk.ask("r2", Write{"aisle", {}, "1"})->outcome, Outcome::Refused);
    desk.ask("r2", Write{"speed", {}, "1"});
    EXPECT_EQ(desk.ask("r2", ClaimName{"speed", 5s})->outcome, Outcome::Refused);
}

TEST(Keeper, RefusesOneMoreThanItsLimits) {
    Desk desk;
    desk.serve();
    EXPECT_EQ(desk.ask("b", Give{"q", "t", std::string(kTextMax, 'x')})->outcome, Outcome::Done);
    EXPECT_THAT(desk.ask("b", Give{"q", "u", std::string(kTextMax + 1, 'x')})->why,
                HasSubstr("at most 4096 bytes of a task, and these are 4097"));
    EXPECT_EQ(desk.ask("b", Give{"q", std::string(kNameMax + 1, 'x'), ""})->outcome,
              Outcome::Refused);
    for (size_t i = 1; i < kTasksMax; ++i)
        ASSERT_EQ(desk.ask("b", Give{"q", "t" + std::to_string(i), ""})->outcome, Outcome::Done);
    EXPECT_THAT(desk.ask("b", Give{"q", "more", ""})->why, HasSubstr("at most 10000 tasks"));
    for (size_t i = 0; i < kKeysMax; ++i)
        ASSERT_EQ(desk.ask("b", Write{"k" + std::to_string(i), {}, ""})->outcome, Outcome::Done);
    EXPECT_EQ(desk.ask("b", ClaimName{"more", 5s})->outcome, Outcome::Refused);
    EXPECT_EQ(desk.ask("b", Write{"more", {}, ""})->outcome, Outcome::Refused);
}

// Epochs of robots are random numbers: a robot that was started again must be heard whatever its
// new one is, and its questions are counted from 1 again.
TEST(Keeper, ARobotThatWasStartedAgainIsHeard) {
    Desk desk;
    desk.serve();
    for (const uint64_t epoch : {9u, 4u, 7u}) {
        desk.last.reset();
        desk.tell(Asked{{"r1", epoch, 1}, Write{"k" + std::to_string(epoch), {}, "1"}});
        ASSERT_TRUE(desk.last) << epoch;
        EXPECT_EQ(desk.last->outcome, Outcome::Done);
    }
}

// Else one robot that is started again and again would make the keeper forget all others.
TEST(Keeper, OneRobotHasFewLivesAmongThoseThatAreRemembered) {
    Desk desk;
    desk.serve();
    desk.tell(Asked{{"r2", 1, 1}, Write{"k", {}, "1"}});
    for (uint64_t life = 1; life <= kAskersMax; ++life)
        desk.tell(Asked{{"r1", life, 1}, Write{"a" + std::to_string(life % 7), {}, "1"}});
    desk.last.reset();
    desk.tell(Asked{{"r2", 1, 1}, Write{"k", {}, "1"}});
    EXPECT_EQ(desk.last->outcome, Outcome::Done);
    desk.tell(Asked{{"r1", kAskersMax - kLivesMax + 1, 1}, Write{"b", {}, "1"}});
    EXPECT_NE(desk.last->outcome, Outcome::Done);  // remembered, and refused as before
    desk.tell(Asked{{"r1", kAskersMax - kLivesMax, 1}, Write{"b", {}, "1"}});
    EXPECT_EQ(desk.last->outcome, Outcome::Done);  // one more than are remembered
}

TEST(Keeper, ForgetsTheOldestReplyOfARobotThatAsksMuch) {
    Desk desk;
    desk.serve();
    for (uint64_t i = 1; i <= kRepliesKept + 1; ++i)
        desk.tell(Asked{{"r1", 1, i}, Write{"k" + std::to_string(i), {}, "1"}});
    desk.last.reset();
    desk.tell(Asked{{"r1", 1, 1}, Write{"k1", {}, "1"}});
    EXPECT_FALSE(desk.last);  // not done again either
    desk.tell(Asked{{"r1", 1, 2}, Write{"k2", {}, "1"}});
    EXPECT_EQ(desk.last->outcome, Outcome::Done);
}

}  // namespace
}  // namespace vagus::keeper
