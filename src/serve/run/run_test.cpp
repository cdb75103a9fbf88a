// The server's end of a run, with a process that says what the test says.
#include "serve/run/run.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>

#include "serve/json.hpp"
#include "serve/talk/codec.hpp"

namespace vagus::serve {
namespace {

using testing::HasSubstr;

// Without a process behind it: the test holds the other end of its pipe.
struct Scripted final : RunProcess {
    Scripted(int descriptor, bool& its_killed, std::optional<ChildEnd>& its_end, size_t& count)
        : own(descriptor), killed(its_killed), end(its_end), alive(count) {
        ++alive;
    }
    ~Scripted() override { --alive; }
    Pipe& pipe() override { return own; }
    std::optional<ChildEnd> ended() override { return end; }
    void kill() override { killed = true; }
    Pipe own;
    bool& killed;
    std::optional<ChildEnd>& end;
    size_t& alive;
};

class RunTest : public testing::Test {
protected:
    RunTest() {
        run.on_say([this](auto& kind, auto& text) { lines.push_back(kind + ": " + text); });
        run.on_opened([this] { ++opened; });
        run.on_failed([this](const std::string& why) { failures.push_back(why); });
        run.on_death([this](const std::string& why) { deaths.push_back(why); });
        run.on_plan_ended([this](const serve::Run::PlanEnd& one) { ends.push_back(one.result); });
    }
    Result<std::unique_ptr<RunProcess>> start() {
        int pair[2];
        EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
        runner.emplace(pair[1]);
        end.reset();
        return std::unique_ptr<RunProcess>(std::make_unique<Scripted>(pair[0], killed, end, alive));
    }
    // Orders of a kind that the process got.
    template <typename Order>
    std::vector<Order> orders() {
        std::vector<Order> found;
        for (const Packet& packet : runner->receive()) {
            const auto order = talk::decode_order(packet);
            EXPECT_TRUE(order.ok()) << (order.ok() ? "" : order.error().what);
            const auto* one = order.ok() ? std::get_if<Order>(&order.value()) : nullptr;
            if (one) found.push_back(*one);
        }
        return found;
    }
    void say(const talk::News& news) { say(talk::encode(news)); }
    void say(const Packet& packet) {
        ASSERT_TRUE(runner->send(packet));
        run.tick(now += 1ms);
    }
    void open() {
        RunOrder order;
        order.world = "hall.world.json";
        order.plan = "Go.plan.json";
        ASSERT_TRUE(run.open(order, now).ok());
        run.tick(now);
        number = orders<talk::Open>().at(0).order;
    }
    static talk::Opened opened_answer(uint64_t order) {
        return {.order = order,
                .scene = talk::Scene{},
                .programs = {{3, "var n"}},
                .hears = {"told"},
                .stops = {}};
    }
    static talk::Clock clock(double t) { return {.t = t, .paused = false, .real = 1, .load = {}}; }

    // What pages that watch are sent.
    void flush(int times = 10) {
        frames.clear();
        for (int i = 0; i < times; ++i) {
            desk.topics().flush(
                now += 100ms, [](ClientId) { return true; },
                [this](ClientId, bool, const std::string& bytes) { frames.push_back(bytes); });
        }
    }

    Time now = 1s;
    double wall = 1e12;
    size_t alive = 0;  // processes
    Desk desk{Access("0123456789abcdef", "fedcba9876543210"),
              {.send = [this](ClientId, bool binary,
                              std::string bytes) { (binary ? frames : texts).push_back(bytes); },
               .close = [](ClientId, auto) {},
               .log = [](auto&) {},
               .wall_ms = [this] { return wall; }}};
    serve::Run run{desk, [this] { return start(); }};
    std::optional<Pipe> runner;
    bool killed = false;
    std::optional<ChildEnd> end;
    uint64_t number = 0;
    int opened = 0;
    std::vector<std::string> lines, failures, deaths, ends, texts, frames;
};

TEST_F(RunTest, OnlyWhatIsSaidOfTheLatestOrderCounts) {
    open();
    const uint64_t first = number;
    open();
    say(opened_answer(first));
    EXPECT_EQ(opened, 0);
    EXPECT_FALSE(run.has_world());
    say(opened_answer(number));
    EXPECT_EQ(opened, 1);
    EXPECT_TRUE(run.has_world());
    EXPECT_EQ(run.programs().at(3), "var n");
}

// What still comes of the order before is of another world.
TEST_F(RunTest, WhatComesBeforeTheAnswerToAnOrderIsOfTheOneBefore) {
    open();
    say(clock(5));
    EXPECT_EQ(run.time(), 0);
    say(opened_answer(number));
    say(clock(5));
    EXPECT_EQ(run.time(), 5);
    EXPECT_EQ(run.state(), serve::Run::State::Running);
}

TEST_F(RunTest, WhyItCannotBeOpenedIsTold) {
    open();
    say(talk::OpenFailed{number, "there is no start"});
    EXPECT_EQ(failures, std::vector<std::string>{"there is no start"});
    EXPECT_EQ(run.state(), serve::Run::State::None);
}

TEST_F(RunTest, APlanThatIsOverAtOnceHasEndedToo) {
    open();
    say(opened_answer(number));
    talk::PlanNow plan;
    plan.state = talk::PlanState::Ended;
    plan.result = "Error";
    say(plan);
    say(plan);
    EXPECT_EQ(ends, std::vector<std::string>{"Error"});
}

TEST_F(RunTest, TheEndOfAPlanIsToldOnce) {
    open();
    say(opened_answer(number));
    talk::PlanNow plan;
    say(plan);
    EXPECT_TRUE(run.plan_runs());
    plan.state = talk::PlanState::Ended;
    plan.result = "OK";
    say(plan);
    say(plan);
    EXPECT_EQ(ends, std::vector<std::string>{"OK"});
    EXPECT_FALSE(run.plan_runs());
}

// What a person puts beside a robot after Stop is for the run that follows.
TEST_F(RunTest, WhatAHandDidToObjectsIsDoneAgainWhereTheyStay) {
    open();
    say(opened_answer(number));
    const auto lend = [this](const HandOrder& order, const std::string& why) {
        run.lend_hand(order, [](auto, auto&) {});
        run.tick(now);
        uint64_t asked = 0;
        for (const auto& put : orders<talk::PutObject>()) asked = put.request;
        say(talk::Answer{.request = asked, .why = why});
    };
    lend(talk::PutObject{.kind = talk::ObjectKind::Box, .at = {1, 2}}, "");
    lend(talk::PutObject{.kind = talk::ObjectKind::Box, .at = {9, 9}}, "it lies outside");
    const auto put_again = [this](bool stays) {
        RunOrder order;
        order.world = "hall.world.json";
        order.keep_objects = stays;
        EXPECT_TRUE(run.open(order, now).ok());
        run.tick(now);
        say(opened_answer(orders<talk::Open>().at(0).order));
        return orders<talk::PutObject>();
    };
    const auto again = put_again(true);
    ASSERT_EQ(again.size(), 1u);
    EXPECT_EQ(again[0].at, (talk::Point{1, 2}));
    say(talk::Answer{.request = again[0].request});
    EXPECT_EQ(put_again(true).size(), 1u);
    EXPECT_EQ(put_again(false).size(), 0u);
    EXPECT_EQ(put_again(true).size(), 0u);
}

TEST_F(RunTest, ADeathAnswersWhatWasAskedAndSaysWhereItWas) {
    open();
    say(opened_answer(number));
    say(talk::Traced{.line = R"({"kind":"actor-start","actor":"go"})", .actor = "go"});
    std::vector<std::string> answers;
    run.set_variable(0, "n", 1, [&](const std::string& why) { answers.push_back(why); });
    end = ChildEnd{false, 9, "was ended by signal 9 (Killed)"};
    run.tick(now += 1ms);
    ASSERT_EQ(deaths.size(), 1u);
    EXPECT_THAT(
        deaths[0],
        HasSubstr("the run was ended by signal 9 (Killed) after 0.0 s; the active actor was go."));
    EXPECT_EQ(answers, deaths);
    EXPECT_EQ(run.state(), serve::Run::State::Dead);
    EXPECT_EQ(run.deaths(), 1u);
}

// It completes its recording then. Whoever closed it waits for no process that does not end.
TEST_F(RunTest, AProcessThatIsClosedEndsByItselfOrAtItsLimit) {
    open();
    run.close();
    EXPECT_FALSE(run.is_open());
    (void)runner->receive();
    EXPECT_TRUE(runner->closed());
    run.tick(now += 1h);  // the limit counts from here
    EXPECT_TRUE(run.closed_are_ending());
    end = ChildEnd{.good = true, .what = "exited with status 0"};
    run.tick(now += 1ms);
    EXPECT_FALSE(run.closed_are_ending());
    open();
    run.close();
    run.tick(now += 1ms);
    run.tick(now += kClosedEndsWithin - 1ms);
    EXPECT_TRUE(run.closed_are_ending());
    run.tick(now += 1ms);
    EXPECT_FALSE(run.closed_are_ending());
}

TEST_F(RunTest, TheOldestOfTooManyThatAreClosedIsKilled) {
    for (size_t i = 0; i <= kClosedMax; ++i) {
        open();
        run.close();
        EXPECT_EQ(alive, std::min(i + 1, kClosedMax));
    }
}

// The server lives, the process does not, and everybody is told what it sent.
TEST_F(RunTest, AProcessThatSpeaksNonsenseIsEnded) {
    const Packet clock_of_another = talk::encode(talk::News(clock(1)));
    const std::pair<Packet, const char*> nonsense[] = {
        {{'J', R"({"say": "clock"})"}, "sent a message: expected one of the numbers 1 to 22"},
        {{'\0', ""}, "sent a message: expected one of the numbers 1 to 22, found 0"},
        {{clock_of_another.kind, ""}, "sent clock.t: expected this field, found its end"},
        {{clock_of_another.kind, clock_of_another.bytes + "x"},
         "sent clock: expected its end, found 1 bytes more"},
        {talk::encode(talk::News(talk::Records{{"no records"}})),
         "sent records.bytes: expected whole records, found 10 bytes that are none"},
    };
    for (const auto& [packet, sentence] : nonsense) {
        killed = false;
        deaths.clear();
        run.close();
        open();
        say(opened_answer(number));
        std::string why;
        run.set_variable(0, "n", 1, [&](const std::string& said) { why = said; });
        ASSERT_FALSE(killed);
        say(packet);
        EXPECT_TRUE(killed) << sentence;
        EXPECT_EQ(run.state(), serve::Run::State::Dead);
        EXPECT_FALSE(run.is_open());
        ASSERT_EQ(deaths.size(), 1u);
        EXPECT_THAT(deaths[0], HasSubstr("the run's process " + std::string(sentence)));
        EXPECT_EQ(lines.back(), "error: " + deaths[0]);
        EXPECT_EQ(why, deaths[0]);
    }
}

// Whatever the server does with what it hears: an exception ends the run, not the server.
TEST_F(RunTest, WhatCannotBeFollowedEndsTheRun) {
    run.on_told({.records = [](auto&) { throw std::runtime_error("no room"); }});
    open();
    say(opened_answer(number));
    say(talk::Records{});
    EXPECT_TRUE(killed);
    ASSERT_EQ(deaths.size(), 1u);
    EXPECT_THAT(deaths[0], HasSubstr("no room"));
}

// ---- two orders, one behind the other ----

TEST_F(RunTest, WhatIsToldCountsFromTheAnswerOnWhicheverItIs) {
    const std::function<talk::News()> answers[] = {
        [this] { return talk::Opening{number}; },
        [this] { return opened_answer(number); },
        [this] {
            return talk::OpenFailed{number, "no"};
        },
    };
    for (const auto& answer : answers) {
        run.close();
        open();
        say(clock(3));
        EXPECT_EQ(run.time(), 0);
        say(answer());
        say(clock(5));
        EXPECT_EQ(run.time(), 5) << answer().index();
    }
}

// Its bus and its clock would be shown for the next project.
TEST_F(RunTest, WhatWasClosedLeavesNeitherTimeNorLoad) {
    open();
    say(opened_answer(number));
    talk::Clock told = clock(5);
    told.load = 0.5;
    say(told);
    EXPECT_EQ(run.load(), 0.5);
    run.close();
    EXPECT_EQ(run.load(), std::nullopt);
    EXPECT_EQ(run.time(), 0);
}

TEST_F(RunTest, AnOrderBehindAnotherStartsNoProcessAndForgetsWhatWasAsked) {
    open();
    say(opened_answer(number));
    const uint64_t process = run.generation();
    std::vector<std::string> answers;
    run.set_variable(0, "n", 1, [&](const std::string& why) { answers.push_back(why); });
    const uint64_t asked = orders<talk::SetVariable>().at(0).request;
    RunOrder order;
    order.paused = false;
    ASSERT_TRUE(run.open(order, now).ok());
    ASSERT_TRUE(run.open(order, now).ok());
    EXPECT_EQ(run.generation(), process);
    EXPECT_EQ(answers, std::vector<std::string>{"the run was started again"});
    say(talk::Answer{.request = asked, .why = "late"});  // nobody waits for it any more
    EXPECT_EQ(answers.size(), 1u);
    const auto told = orders<talk::Open>();
    ASSERT_EQ(told.size(), 2u);
    EXPECT_EQ(told[1].order, told[0].order + 1);
    // All of the first comes before anything of the second.
    say(talk::Opening{told[0].order});
    say(opened_answer(told[0].order));
    say(clock(7));
    EXPECT_EQ(opened, 1);
    EXPECT_EQ(run.time(), 0);
    say(talk::Opening{told[1].order});
    say(opened_answer(told[1].order));
    say(clock(8));
    EXPECT_EQ(opened, 2);
    EXPECT_EQ(run.time(), 8);
}

// ---- the plan ----

TEST_F(RunTest, AVersionOfThePlanIsPassedOnWithItsNumber) {
    std::vector<std::string> told;
    run.on_told({.plan =
                     [&](const talk::PlanVersion& one) {
                         told.push_back(std::to_string(one.number) + one.plans.front().name);
                     },
                 .trace = [&](const std::string& line) { told.push_back(line); }});
    open();
    PlanOutline plan;
    plan.name = "Walk";
    say(talk::PlanVersion{1, {plan}});  // of the order before
    say(opened_answer(number));
    say(talk::PlanVersion{1, {plan}});
    say(talk::Traced{.line = "change"});
    say(talk::PlanVersion{2, {plan}});
    EXPECT_EQ(told, (std::vector<std::string>{"1Walk", "change", "2Walk"}));
}

TEST_F(RunTest, LateChecksAreCountedFromTheirMarkNotFromText) {
    open();
    say(opened_answer(number));
    say(talk::Traced{.line = R"({"kind":"log","text":"\"kind\":\"late\""})"});
    say(talk::Traced{.line = "late", .late = true});
    EXPECT_EQ(run.late_checks(), 1u);
}

TEST_F(RunTest, ThePlanOfPagesHasTheirDocuments) {
    run.set_doc_of([](const std::string& file) { return "doc of " + file; });
    open();
    say(opened_answer(number));
    talk::PlanNow plan;
    plan.t = 2;
    plan.file = "a";
    plan.levels = {{"b", {{{"path", "A/b"}, {"doc", "b"}}}}};
    plan.stands_at = {4};
    say(plan);
    ASSERT_FALSE(desk.topics().watch(ClientId{1}, {{"watch", 1}, {"topic", "plan"}}, now));
    flush();
    ASSERT_FALSE(frames.empty());
    const Json shown = Json::parse(frames.back())["whole"];
    EXPECT_EQ(shown["doc"], "doc of a");
    EXPECT_EQ(shown["levels"][0], Json({{"path", "A/b"}, {"doc", "doc of b"}}));
    EXPECT_EQ(shown["stands_at"], Json::array({4}));
    EXPECT_EQ(shown["state"], "running");
}

// A paused run tells its clock ten times a second: the time of the wall alone is nothing new.
TEST_F(RunTest, AClockThatSaysNothingNewIsNotSentAgain) {
    open();
    say(opened_answer(number));
    const Json watch = {{"watch", 1}, {"topic", "clock"}};
    ASSERT_FALSE(desk.topics().watch(ClientId{1}, watch, now).has_value());
    talk::Clock told = clock(3);
    told.paused = true;
    const auto tell = [&] {
        wall += 100;
        say(told);
        flush(1);
        return frames.size();
    };
    EXPECT_EQ(tell(), 1u);
    EXPECT_EQ(tell(), 0u);
    told.t = 4;
    EXPECT_EQ(tell(), 1u);
    EXPECT_EQ(tell(), 0u);
    now += kClockAgainAfter;
    EXPECT_EQ(tell(), 1u);
}

// A camera costs time: the picture that a page has is not sent to it again.
TEST_F(RunTest, APictureIsSentOnceToEachWhoWatches) {
    open();
    say(opened_answer(number));
    const ClientId page{1};
    const Json watch = {{"watch", 1}, {"topic", "picture"}, {"of", {{"robot", "alice"}}}};
    ASSERT_FALSE(desk.topics().watch(page, watch, now).has_value());
    const auto look = [this] {
        flush();
        return frames.size();
    };
    EXPECT_EQ(look(), 0u);
    say(talk::Picture{2, "alice", {"pixels"}});
    EXPECT_EQ(look(), 1u);
    say(talk::Picture{2, "bob", {"pixels"}});
    EXPECT_EQ(look(), 0u);
    say(talk::Picture{2, "alice", {"pixels"}});
    EXPECT_EQ(look(), 0u);
    say(talk::Picture{3, "alice", {"pixels"}});
    EXPECT_EQ(look(), 1u);
    say(talk::Picture{2, "alice", {"others"}});
    EXPECT_EQ(look(), 1u);
    EXPECT_THAT(frames[0], HasSubstr("others"));
}

// A paused run tells 30 times a second where everything still is.
TEST_F(RunTest, WhereThingsStillAreIsNotSentAgain) {
    open();
    say(opened_answer(number));
    const Json watch = {{"watch", 1}, {"topic", "poses"}};
    ASSERT_FALSE(desk.topics().watch(ClientId{1}, watch, now).has_value());
    const auto tell = [this](double t, const char* poses) {
        say(talk::Poses{t, {poses}});
        flush();
        return frames.size();
    };
    EXPECT_EQ(tell(2, "here"), 1u);
    EXPECT_EQ(tell(2, "here"), 0u);
    EXPECT_EQ(tell(2, "moved by hand"), 1u);
    EXPECT_EQ(tell(3, "moved by hand"), 1u);
}

}  // namespace
}  // namespace vagus::serve
