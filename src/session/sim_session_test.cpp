#include "session/sim_session.hpp"

#include <gmock/gmock.h>

#include "session/software_node.hpp"
#include "session/standard_target.hpp"

namespace vagus::session {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

sim::RobotDefinition robot(const std::string& name, uint16_t node, double x) {
    sim::RobotDefinition definition;
    definition.name = name;
    definition.node = node;
    definition.at = {x, 0.5};
    return definition;
}

// Two Thymios, nodes 3 and 7, both called "thymio-II" on the bus.
SimSession two_robots(bool traced = false) {
    sim::WorldDefinition world;
    world.width = 2;
    world.robots = {robot("left", 3, 0.5), robot("right", 7, 1.5)};
    SimOptions options;
    options.traced = traced;
    return SimSession(std::move(sim::World::create(world).value()), options);
}

std::string project(const std::string& events, const std::string& nodes) {
    return "<network>" + events + nodes + "</network>";
}

std::string node(const std::string& name, int id, const std::string& source) {
    return "<node name=\"" + name + "\" nodeId=\"" + std::to_string(id) + "\">" + source +
           "</node>";
}

std::vector<std::string> texts(const std::vector<Diagnostic>& list) {
    std::vector<std::string> lines;
    for (const Diagnostic& one : list) {
        lines.push_back(text_of(one));
        lines.insert(lines.end(), one.source.begin(), one.source.end());
    }
    return lines;
}

// Passes simulated time until all scripts are placed and run or have mistakes.
void settle(SimSession& session) {
    while (!session.settled() && session.now() < 10s) session.step(1ms);
    ASSERT_TRUE(session.settled());
}

std::vector<std::string> texts(SimSession& session, NoteKind kind) {
    std::vector<std::string> list;
    for (const Note& note : session.take_notes()) {
        if (note.kind == kind) list.push_back(note.text);
    }
    return list;
}

int16_t value(const SimSession& session, size_t index, const std::string& name) {
    for (const auto& [known, values] : session.script_variables(session.nodes().at(index).id)) {
        if (known == name) return values.front();
    }
    ADD_FAILURE() << "no variable " << name;
    return 0;
}

TEST(SimSession, EachScriptGoesToTheNodeOfItsNameAndNumber) {
    SimSession session = two_robots();
    // The second robot's script comes first: the number decides, not the order.
    session.load("a.aesl", project("", node("thymio-II", 7, "var x = 70") +
                                           node("thymio-II", 3, "var x = 30")));
    settle(session);
    EXPECT_EQ(value(session, 0, "x"), 30);
    EXPECT_EQ(value(session, 1, "x"), 70);
    EXPECT_THAT(texts(session, NoteKind::Loaded), testing::SizeIs(2));
    EXPECT_TRUE(session.mistakes().empty());
}

SimSession many_robots(size_t count) {
    sim::WorldDefinition world;
    world.width = world.height = 20;
    for (size_t i = 0; i < count; i++) {
        sim::RobotDefinition& made = world.robots.emplace_back(
            robot("t" + std::to_string(i), static_cast<uint16_t>(i + 1), 0));
        made.at = {0.3 + 0.3 * static_cast<double>(i % 60),
                   0.3 + 0.3 * static_cast<double>(i / 60)};
    }
    return SimSession(std::move(sim::World::create(world).value()), {});
}

// From 48 robots on, what all of them told hosts filled the queues of the nodes, and the first
// programs were lost there.
TEST(SimSession, AProjectIsForEveryRobotOfItsNameHoweverMany) {
    constexpr size_t kMany = 200;
    SimSession session = many_robots(kMany);
    session.load("a.aesl", project("", node("thymio-II", 1, "var x = 1000 + _id")));
    settle(session);
    for (size_t i = 0; i < kMany; i++) {
        ASSERT_EQ(value(session, i, "x"), 1001 + static_cast<int>(i));
    }
    EXPECT_THAT(session.without_script(), IsEmpty());
    EXPECT_TRUE(session.mistakes().empty());
}

TEST(SimSession, AMistakeInAScriptForManyIsToldOnce) {
    SimSession session = two_robots();
    session.load("a.aesl", project("", node("thymio-II", 1, "x = 1")));
    settle(session);
    EXPECT_THAT(texts(session, NoteKind::Mistakes), testing::SizeIs(1));
    EXPECT_EQ(session.mistakes().size(), 1u);
    EXPECT_THAT(session.without_script(), ElementsAre("left", "right"));
}

// A host that calls itself as a robot does.
TEST(SimSession, ANodeFromOutsideWithTheIdOfARobotIsToldWithBothLinks) {
    SimSession session = two_robots();
    settle(session);
    session.step(5ms);
    const hub::LinkId guest = session.world().bus().add({.name = "tcp:guest"}).value();
    wire::Frame present{};
    present.source = 7;
    present.type = 0x900c;
    present.size = 2;
    session.world().bus().receive(guest, present);
    session.step(5ms);
    EXPECT_THAT(texts(session, NoteKind::Trouble),
                ElementsAre(HasSubstr("node 7 is heard on two links, right and tcp:guest")));
}

// A real Thymio that somebody brought to the bus of a world, as node 5.
struct Guest {
    explicit Guest(SimSession& its_session) : session(its_session) {
        aesl::Target target = standard_target("thymio-II");
        target.variables.push_back({"motor.left.target", 1});
        target.variables.push_back({"motor.right.target", 1});
        const auto transmit = [this](const wire::Frame& frame) { bus.receive(link, frame); };
        node = std::move(SoftwareNode::make(target, {.id = 5, .transmit = transmit}).value());
    }
    void step(int instants) {
        wire::Frame frame;
        for (int i = 0; i < instants; i++) {
            session.step(1ms);
            while (bus.take(link, frame)) node->receive(frame);
        }
    }
    int16_t& left_target() {
        return node->variables()[node->find_variable("motor.left.target")->address];
    }

    SimSession& session;
    hub::Hub& bus = session.world().bus();
    hub::LinkId link = bus.add({.name = "tcp:guest"}).value();
    std::unique_ptr<SoftwareNode> node;
};

// The world goes, and must not leave it driving.
TEST(SimSession, NodesThatOthersBroughtAreStoppedAndReadBack) {
    SimSession session = two_robots();
    EXPECT_FALSE(session.stop_guests());
    Guest guest(session);
    guest.step(1500);
    guest.left_target() = 200;
    ASSERT_TRUE(session.stop_guests());
    EXPECT_FALSE(session.guests_rest());
    guest.step(10);
    EXPECT_TRUE(session.guests_rest());
    EXPECT_EQ(guest.left_target(), 0);
    EXPECT_EQ(describe(session.guests()), "at rest: thymio-II (5)");
}

// What a project says of a node overrides what ships with the program.
TEST(SimSession, NodesThatOthersBroughtAreStoppedAsTheProjectSays) {
    SimOptions options;
    options.guests["thymio-II"] = {{{"motor.left.target", {7}}}, {}};
    Result<sim::World> world = sim::World::create(sim::WorldDefinition());
    ASSERT_TRUE(world.ok()) << world.error().what;
    SimSession session(std::move(world.value()), options);
    Guest guest(session);
    guest.step(1500);
    ASSERT_TRUE(session.stop_guests());
    guest.step(10);
    EXPECT_TRUE(session.guests_rest());
    EXPECT_EQ(guest.left_target(), 7);
}

// A Carbot with the nodes 2 to 5 and a Thymio with node 9.
SimSession carbot_and_thymio() {
    sim::WorldDefinition world;
    world.width = 3;
    world.robots = {robot("carbot", 2, 0.5), robot("thymio", 9, 2)};
    world.robots[0].type = sim::RobotType::Carbot;
    return SimSession(std::move(sim::World::create(world).value()), {});
}

TEST(SimSession, TheNodesOfOneRobotGetTheirScriptsByName) {
    SimSession session = carbot_and_thymio();
    session.load_for(
        session.nodes().at(0).robot, "a.aesl",
        project("<event name=\"hello\" size=\"1\"/>",
                node("bumper", 2, "emit hello [_id]") + node("drive", 1, "emit hello [_id]")));
    settle(session);
    EXPECT_THAT(texts(session, NoteKind::Event),
                testing::UnorderedElementsAre("carbot drive: hello 2", "carbot bumper: hello 3"));
    EXPECT_TRUE(session.nodes().at(0).has_script);
    EXPECT_TRUE(session.nodes().at(1).has_script);
    EXPECT_FALSE(session.nodes().at(2).has_script);
    EXPECT_FALSE(session.nodes().at(4).has_script);
}

TEST(SimSession, APlainScriptIsForTheFirstNodeOfARobot) {
    SimSession session = carbot_and_thymio();
    session.load("a.txt", "emit hello [_id]");
    settle(session);
    EXPECT_THAT(texts(session, NoteKind::Event),
                testing::UnorderedElementsAre("carbot drive: hello 2", "thymio: hello 9"));
}

TEST(SimSession, VariablesOfARobotAreFoundOnWhicheverNodeHasThem) {
    SimSession session = carbot_and_thymio();
    settle(session);
    while (session.target(5) == nullptr && session.now() < 10s) session.step(1ms);
    const auto carbot = session.nodes().at(0).robot;
    EXPECT_EQ(session.node_variable(carbot, "touch.sectors").size(), 12u);
    EXPECT_EQ(session.node_variable(carbot, "odometry.x").size(), 2u);
    EXPECT_TRUE(session.node_variable(carbot, "prox.horizontal").empty());
}

TEST(SimSession, APlainScriptIsForEveryRobotAndMayEmitWhatItLikes) {
    SimSession session = two_robots();
    session.load("a.txt", "var x = _id\nemit hello [x, 5]");
    settle(session);
    EXPECT_THAT(texts(session, NoteKind::Event),
                ElementsAre("left: hello 3 5", "right: hello 7 5"));
    EXPECT_EQ(session.events().at(0).count, 2u);
}

TEST(SimSession, AScriptForOneRobotIsForNoOther) {
    SimSession session = two_robots();
    session.load_for(session.nodes().at(1).robot, "a.aesl",
                     project("", node("somebody", 1, "var x = 4")));
    settle(session);
    EXPECT_FALSE(session.nodes().at(0).has_script);
    EXPECT_EQ(value(session, 1, "x"), 4);
}

TEST(SimSession, WithMistakesTheOldProgramRunsOnUntilABetterTextComes) {
    SimSession session = two_robots();
    session.load("a.txt", "var n = 1");
    settle(session);
    session.reload("a.txt", "var n = 1\nnn = 2");
    settle(session);
    EXPECT_THAT(texts(session.mistakes()), Contains(HasSubstr("a.txt:2:1: error: ")));
    EXPECT_EQ(value(session, 0, "n"), 1);
    session.reload("a.txt", "var n = 5");
    settle(session);
    EXPECT_TRUE(session.mistakes().empty());
    EXPECT_EQ(value(session, 0, "n"), 5);
}

TEST(SimSession, AFileThatIsNoProjectIsAMistakeThatCanBeMended) {
    SimSession session = two_robots();
    session.load("a.aesl", "<network><node>");
    EXPECT_THAT(texts(session.mistakes()), Contains(HasSubstr("a.aesl:1:")));
    session.reload("a.aesl", project("", node("thymio-II", 3, "var x = 1")));
    settle(session);
    EXPECT_TRUE(session.mistakes().empty());
    EXPECT_EQ(value(session, 0, "x"), 1);
}

TEST(SimSession, AProjectForNobodyHereNamesWhoIsHere) {
    SimSession session = two_robots();
    session.load("a.aesl", project("", node("rover", 9, "var x")));
    settle(session);
    EXPECT_THAT(texts(session.mistakes()),
                ElementsAre(testing::AllOf(HasSubstr("\"rover\" (node 9)"),
                                           HasSubstr("\"thymio-II\" (node 3)"))));
}

// On a bus an event is only a number: two lists that disagree would make one robot hear another's
// words.
TEST(SimSession, ProjectsThatNumberEventsDifferentlyAreRefused) {
    SimSession session = two_robots();
    session.load_for(session.nodes().at(0).robot, "a.aesl",
                     project("<event name=\"go\" size=\"0\"/>", node("thymio-II", 3, "var x")));
    session.load_for(session.nodes().at(1).robot, "b.aesl",
                     project("<event name=\"halt\" size=\"0\"/>", node("thymio-II", 7, "var x")));
    settle(session);
    EXPECT_THAT(
        texts(session.mistakes()),
        ElementsAre(HasSubstr("b.aesl: error: event 0 is \"halt\" here and \"go\" in a.aesl")));
}

TEST(SimSession, AFaultNamesFileAndLine) {
    SimSession session = two_robots();
    session.load_for(session.nodes().at(0).robot, "a.aesl",
                     "<network>\n" + node("thymio-II", 3, "var x = 0\nx = 1 / x") + "</network>");
    settle(session);
    session.step(10ms);
    EXPECT_THAT(session.nodes().at(0).fault, HasSubstr("a.aesl:3: "));
    EXPECT_THAT(texts(session, NoteKind::Fault), testing::SizeIs(1));
}

TEST(SimSession, ResetBeginsAgainWithTheSameScripts) {
    SimSession session = two_robots();
    session.load("a.txt", "var n = 0\ntimer.period[0] = 100\nonevent timer0\nn++\nemit tick n");
    settle(session);
    session.step(1s);
    EXPECT_GE(value(session, 0, "n"), 9);
    session.reset();
    EXPECT_EQ(session.now(), 0s);
    EXPECT_THAT(session.events(), IsEmpty());
    settle(session);
    session.step(250ms);
    EXPECT_EQ(value(session, 0, "n"), 2);
}

TEST(SimSession, TheTraceOfARunIsTheSameEachTime) {
    std::string first;
    for (int round = 0; round < 2; round++) {
        SimSession session = two_robots(true);
        session.load("a.txt",
                     "motor.left.target = 200\nonevent prox\nemit seen prox.ground.delta[0]");
        session.step(3s);
        const std::string trace = session.take_trace();
        EXPECT_THAT(trace, HasSubstr("\"kind\":\"event\",\"node\":3,\"name\":\"seen\""));
        if (round == 0) first = trace;
        EXPECT_EQ(trace, first);
    }
}

// `side` times `side` robots; the script knows on which of them it runs.
SimSession square_of_robots(uint16_t side, sim::BusModel bus) {
    sim::WorldDefinition world;
    world.width = world.height = 0.35 * (side + 1);
    for (uint16_t i = 0; i < side * side; i++) {
        world.robots.push_back(robot("r" + std::to_string(i), static_cast<uint16_t>(i + 1), 0));
        world.robots.back().at = {0.35 * (i % side + 1), 0.35 * (i / side + 1)};
    }
    SimOptions options;
    options.world.bus = bus;
    SimSession session(std::move(sim::World::create(world).value()), options);
    session.load("a.txt", "var x = _id");
    return session;
}

void expect_all_loaded(SimSession& session) {
    EXPECT_THAT(texts(session, NoteKind::Trouble), IsEmpty());
    for (size_t i = 0; i < session.nodes().size(); i++)
        EXPECT_EQ(value(session, i, "x"), static_cast<int16_t>(i + 1));
    const hub::Hub& bus = session.world().bus();
    for (const hub::LinkId link : bus.links())
        EXPECT_EQ(bus.stats(link).dropped, hub::Dropped{}) << bus.name(link);
}

// What is sent at the end of one millisecond arrives in the next, and the answer in the one after.
// 3 ms: the question who is there, and the answers. Then 32 robots at a time describe themselves in
// 2 ms: 32 rounds for 1,024. Then 32 at a time are loaded in 4 ms: the program and the state that
// answers it, `run` and its state. With fewer on their way at a time it would be later, and with
// more than the queues of the bus can hold some would be lost and sent again, a second later.
TEST(SimSession, AThousandRobotsHaveTheirProgramsWithinAFifthOfASecond) {
    SimSession session = square_of_robots(32, sim::BusModel::Ideal);
    settle(session);
    EXPECT_EQ(session.now(), 3ms + 32 * 2ms + 32 * 4ms);
    expect_all_loaded(session);
}

// All programs share the wire there.
TEST(SimSession, AHundredRobotsGetTheirProgramsOverACan) {
    SimSession session = square_of_robots(10, sim::BusModel::Can);
    settle(session);
    expect_all_loaded(session);
}

TEST(SimSession, MoreFilesThanTheLimitAreRefused) {
    SimSession session = two_robots();
    for (size_t i = 0; i < kScriptFilesMax; i++) session.load("f" + std::to_string(i), "var x");
    EXPECT_TRUE(session.mistakes().empty());
    EXPECT_EQ(session.script_paths().size(), kScriptFilesMax);
    session.load("one more", "var x");
    EXPECT_THAT(texts(session.mistakes()), ElementsAre(HasSubstr("more than 10001 script files")));
    EXPECT_EQ(session.script_paths().size(), kScriptFilesMax);
}

TEST(SimSession, MoreNamesOfEventsThanTheLimitOnlyPass) {
    SimSession session = two_robots();
    std::string source;
    for (size_t i = 0; i <= kEventNamesMax; i++) source += "emit e" + std::to_string(i) + "\n";
    session.load_for(session.nodes().at(0).robot, "a.txt", source);
    settle(session);
    session.step(100ms);
    EXPECT_EQ(session.events().size(), kEventNamesMax);
}

TEST(SimSession, NotesThatNobodyTakesEndAtTheLimit) {
    SimSession session = two_robots();
    session.load("a.txt",
                 "var i\ntimer.period[0] = 20\nonevent timer0\nfor i in 1:50 do\nemit e\nend");
    settle(session);
    // Two robots, 50 events each, 50 times a second: 10000 in two seconds.
    session.step(4s);
    EXPECT_EQ(session.take_notes().size(), kNotesMax);
}

TEST(SimSession, OfMoreThanTheLimitThatIsHeardAtOnceTheNewestIsDropped) {
    sim::WorldDefinition world;
    world.robots = {robot("one", 3, 0.5)};
    SimOptions options;
    options.heard = true;
    SimSession session(std::move(sim::World::create(world).value()), options);
    session.step(100ms);
    (void)session.take_heard();
    const hub::LinkId host = session.world().bus().add({.name = "host"}).value();
    wire::Frame frame{};
    for (size_t i = 0; i <= kHeardMax; ++i) session.world().bus().receive(host, frame);
    session.step(1ms);
    EXPECT_EQ(session.take_heard().size(), kHeardMax);
    session.step(1ms);
    EXPECT_THAT(session.take_heard(), IsEmpty());
}

}  // namespace
}  // namespace vagus::session
