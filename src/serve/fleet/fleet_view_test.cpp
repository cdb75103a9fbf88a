#include "serve/fleet/fleet_view.hpp"

#include <gtest/gtest.h>

#include "fleet/limits.hpp"
#include "serve/protocol/protocol.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;
using fleet::Kind;

// A view that is told messages at a time; the wall clock is 1,000,000 ms ahead of it.
struct Case {
    void hear(const fleet::LinkEvent& event) {
        view.hear(event, now, wall());
        (void)view.desk().take();
    }
    void hear(const fleet::Topic& topic, const fleet::Message& message, bool retained = false) {
        hear(fleet::Received{{topic, message}, retained});
    }
    void state(const std::string& robot, fleet::State state, bool retained = false) {
        hear({.kind = Kind::State, .robot = robot}, state, retained);
    }
    void connection(const std::string& robot, const std::string& word, bool retained = false) {
        hear({.kind = Kind::Connection, .robot = robot}, fleet::Connection{word, "i", 7}, retained);
    }
    void connect() {
        hear(fleet::Connected{});
        hear({.kind = Kind::Command, .robot = "desk", .name = "stop"},
             fleet::Command{.verb = "stop", .id = "echo", .reply = "desk"});
    }
    double wall() const { return 1e6 + static_cast<double>(now / 1ms); }
    Json robot(const std::string& name) {
        view.age(now);
        const Json document = view.document();
        EXPECT_EQ(Protocol::get().fault_of_document("fleet", document), std::nullopt);
        return document["robots"].value(name, Json());
    }

    Time now = 1s;
    FleetView view{{.target = "mqtt://broker:1883/lab", .fleet = "lab", .name = "desk"}};
};

fleet::State running(int64_t number, int64_t clock, int64_t since) {
    return {.number = number, .epoch = 7, .clock = clock, .state = "running", .since = since};
}

TEST(FleetView, ARobotSaysWhatItDoesAndSinceWhen) {
    Case c;
    c.connect();
    c.connection("r1", "online", true);
    fleet::State state = running(1, 60'000, 20'000);
    state.actor = "followWall";
    c.state("r1", state);
    const Json robot = c.robot("r1");
    EXPECT_EQ(robot["connection"], "online");
    EXPECT_EQ(robot["age"], "fresh");
    EXPECT_EQ(robot["state"], "running");
    EXPECT_EQ(robot["actor"], "followWall");
    EXPECT_EQ(robot["since_wall"], 1e6 + 1000 - 40'000);
    // A message that took longer does not move the instant.
    c.now = 2s;
    c.state("r1", running(2, 60'900, 20'000));
    EXPECT_EQ(c.robot("r1")["since_wall"], 1e6 + 1000 - 40'000);
}

TEST(FleetView, AStateIsStaleOnceItIsTooOld) {
    Case c;
    c.connect();
    c.connection("r1", "online", true);
    c.state("r1", running(1, 0, 0), true);
    EXPECT_EQ(c.robot("r1")["age"], "waiting") << "retained: nobody knows how old it is";
    EXPECT_FALSE(c.robot("r1").contains("since_wall"));
    c.state("r1", running(2, 0, 0));
    EXPECT_EQ(c.robot("r1")["age"], "fresh");
    c.now += fleet::kStale;
    EXPECT_FALSE(c.view.age(c.now));
    c.now += 1us;
    EXPECT_TRUE(c.view.age(c.now));
    EXPECT_EQ(c.robot("r1")["age"], "stale");
    EXPECT_EQ(c.robot("r1")["told_wall"], 1e6 + 1000);
    EXPECT_FALSE(c.view.age(c.now)) << "told once";
}

TEST(FleetView, WhoNeverTellsIsNotWaitedForLonger) {
    Case c;
    c.connect();
    c.connection("r1", "online", true);
    c.now += fleet::kStale + 1us;
    EXPECT_EQ(c.robot("r1")["age"], "stale");
}

TEST(FleetView, WithoutABrokerEverythingIsStale) {
    Case c;
    c.connect();
    c.connection("r1", "online", true);
    c.state("r1", running(1, 0, 0));
    c.hear(fleet::Lost{"no connection to broker: Connection refused"});
    EXPECT_EQ(c.robot("r1")["age"], "stale");
    EXPECT_EQ(c.view.document()["state"], "lost");
    EXPECT_EQ(c.view.document()["why"], "no connection to broker: Connection refused");
    c.connect();
    EXPECT_EQ(c.view.document()["state"], "connected");
    EXPECT_FALSE(c.view.document().contains("why"));
    EXPECT_EQ(c.robot("r1")["age"], "waiting");
}

TEST(FleetView, ALoginThatIsRefusedIsSaid) {
    Case c;
    c.hear(fleet::Lost{"refused: Not authorized"});
    EXPECT_EQ(c.view.document()["state"], "connecting");
    EXPECT_EQ(c.view.document()["why"], "refused: Not authorized");
}

TEST(FleetView, ARobotThatIsForgottenGoes) {
    Case c;
    c.connect();
    c.connection("r1", "offline", true);
    c.hear(fleet::TakenBack{{.kind = Kind::Connection, .robot = "r1"}});
    EXPECT_EQ(c.robot("r1"), Json());
}

// A robot must not be able to run a script in an observer's page.
TEST(FleetView, OnlyPagesAreLinkedTo) {
    Case c;
    c.connect();
    fleet::Description about;
    for (const char* address : {"javascript:alert(1)", "file:///etc/passwd", "data:text/html,x"}) {
        about.studio = address;
        c.hear({.kind = Kind::Description, .robot = "r1"}, about);
        EXPECT_FALSE(c.robot("r1").contains("studio")) << address;
    }
    about.vagus = "1.0.0";
    about.studio = "https://r1.local:7357/";
    c.hear({.kind = Kind::Description, .robot = "r1"}, about);
    EXPECT_EQ(c.robot("r1")["studio"], "https://r1.local:7357/");
    EXPECT_EQ(c.robot("r1")["vagus"], "1.0.0");
}

TEST(FleetView, EventsAreToldOnceAndWhoComesAndGoes) {
    Case c;
    c.connect();
    c.connection("r1", "online", true);
    const fleet::Topic alarm{.kind = Kind::Event, .robot = "r1", .name = "alarm"};
    c.hear(alarm, fleet::Event{.number = 5, .epoch = 7, .groups = {}, .args = {1, -2}});
    c.hear(alarm, fleet::Event{.number = 5, .epoch = 7, .groups = {}, .args = {1, -2}});
    c.connection("r1", "lost");
    c.connection("r1", "lost");
    const std::vector<Json> events = c.view.take_events();
    ASSERT_EQ(events.size(), 2u) << "QoS 1 may come twice; what was retained was so before";
    EXPECT_EQ(events[0], Json({{"wall", 1e6 + 1000},
                               {"kind", "event"},
                               {"robot", "r1"},
                               {"name", "alarm"},
                               {"args", {1, -2}},
                               {"text", ""}}));
    EXPECT_EQ(events[1]["kind"], "connection");
    EXPECT_EQ(events[1]["name"], "lost");
}

}  // namespace
}  // namespace vagus::serve
