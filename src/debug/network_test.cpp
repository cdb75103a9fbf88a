// Discovery and descriptions (wire spec, 2.6 and 2.9).
// Frames are dumps of section 2.10 or made by hand from 2.2.
#include "debug/network.hpp"

#include "debug/scripted_bus.hpp"

namespace vagus::debug {
namespace {

TEST(Discovery, AsksEachSecondWhoIsThereAndForOldNodesWhileNobodyIs) {
    ScriptedBus bus;
    const Dumps both = {"02 00 00 00 11 a0 05 00", "02 00 00 00 00 a0 05 00"};
    bus.pass(milliseconds(0));
    EXPECT_EQ(bus.sent_all(), both);
    bus.pass(milliseconds(999));
    EXPECT_EQ(bus.sent_all(), Dumps{});
    EXPECT_EQ(bus.network.next_tick(), milliseconds(1000));
    bus.pass(milliseconds(1));
    EXPECT_EQ(bus.sent_all(), both);
    bus.meet_robot(1);
    bus.pass(milliseconds(1000));
    EXPECT_EQ(bus.sent_all(), Dumps{"02 00 00 00 11 a0 05 00"});
}

// Of many nodes only those to which something has happened are asked when they are due.
TEST(Discovery, TheNextTickKeepsUpWithWhatHappensToOneNodeOfSeveral) {
    ScriptedBus bus;
    bus.pass(milliseconds(0));
    for (const NodeId id : {NodeId{1}, NodeId{2}, NodeId{3}}) bus.meet_robot(id);
    EXPECT_EQ(bus.network.next_tick(), milliseconds(1000));  // ListNodes
    const VariableRange source = bus.network.variable(2, "source").value();
    ASSERT_TRUE(bus.network.watch(2, source, milliseconds(100)).ok());
    EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 0b a0 02 00 01 00 01 00"});
    EXPECT_EQ(bus.network.next_tick(), milliseconds(1000));  // then it asks again
    wire::Variables reply{};
    reply.start = 1;
    reply.values.count = 1;
    bus.node_sends(2, reply);
    EXPECT_EQ(bus.network.next_tick(), milliseconds(100));
    bus.network.unwatch(2, "source");
    bus.pass(milliseconds(100));
    EXPECT_EQ(bus.network.next_tick(), milliseconds(1000));
    ASSERT_TRUE(bus.network.pause(3).ok());
    EXPECT_EQ(bus.network.next_tick(), milliseconds(1000));
    bus.pass(milliseconds(900));
    EXPECT_EQ(bus.network.next_tick(), milliseconds(1100));  // `pause` once more
}

TEST(Discovery, AnUnknownNodeIsAskedForItsDescription) {
    ScriptedBus bus;
    bus.node_says(kPresent1);
    EXPECT_EQ(bus.sent(), Dumps{"04 00 00 00 10 a0 01 00 05 00"});
    EXPECT_EQ(bus.told<NodeAppeared>().size(), 1u);
    EXPECT_FALSE(bus.network.node(1)->described);
    bus.node_says(kPresent1);
    EXPECT_EQ(bus.sent(), Dumps{});
}

TEST(Discovery, TheDescriptionBecomesATarget) {
    ScriptedBus bus;
    bus.node_says(kPresent1);
    bus.node_says(
        "18 00 01 00 00 90 09 74 68 79 6d 69 6f 2d 49 49 05 00 fe 05 20 00 4a 02 02 00 01 00 01 "
        "00");
    bus.node_says("06 00 01 00 01 90 01 00 03 5f 69 64");
    bus.node_says("0f 00 01 00 01 90 01 00 0c 65 76 65 6e 74 2e 73 6f 75 72 63 65");
    bus.node_says("06 00 01 00 02 90 03 74 61 70 01 3f");
    EXPECT_TRUE(bus.told<NodeDescribed>().empty());
    bus.sent();
    bus.node_says("14 00 01 00 03 90 03 61 2e 62 01 21 03 00 02 00 01 64 ff ff 01 76 00 00 01 61");

    ASSERT_EQ(bus.told<NodeDescribed>().size(), 1u);
    EXPECT_EQ(bus.told<NodeDescribed>()[0].name, "thymio-II");
    EXPECT_EQ(bus.sent(), Dumps{"02 00 00 00 07 a0 01 00"});  // what does it do?
    const aesl::Target expected = {
        .name = "thymio-II",
        .protocol_version = 5,
        .bytecode_size = 1534,
        .variables_size = 586,
        .stack_size = 32,
        .variables = {{"_id", 1}, {"event.source", 1}},
        .local_events = {{"tap", "?"}},
        .natives = {{"a.b", "!", {{"d", 2}, {"v", -1}, {"a", 0}}}},
    };
    EXPECT_EQ(*bus.network.node(1)->target, expected);
    bus.node_says("04 00 01 00 0a 90 05 00 03 00");
    EXPECT_EQ(bus.network.node(1)->state, ProgramState::Paused);
}

TEST(Discovery, EqualNodesHaveOneDescription) {
    ScriptedBus bus;
    bus.meet_robot(1);
    bus.meet_robot(2);
    EXPECT_TRUE(bus.network.node(1)->target.shares(bus.network.node(2)->target));
}

TEST(Discovery, WhatASecondHostMakesTheNodeRepeatIsIgnored) {
    ScriptedBus bus;
    bus.meet_robot(1);
    bus.describe_robot(1);
    bus.variable(1, "more", 1);
    EXPECT_EQ(bus.network.node(1)->target->variables.size(), 3u);
    EXPECT_TRUE(bus.told<NodeDescribed>().empty());
}

TEST(Discovery, AllElseFromUnknownSourcesIsIgnored) {
    ScriptedBus bus;
    bus.state(1, 5, 3);
    bus.variable(1, "id", 1);
    bus.node_says("00 00 01 00 04 90");  // Disconnected
    EXPECT_TRUE(bus.events.empty());
    EXPECT_TRUE(bus.network.nodes().empty());
    EXPECT_EQ(bus.sent(), Dumps{});
}

TEST(Discovery, AMissingPartIsAskedForAgainAndGivenUpAfterFiveTries) {
    ScriptedBus bus;
    bus.node_says(kPresent1);
    const Dumps ask = {"04 00 00 00 10 a0 01 00 05 00"};
    EXPECT_EQ(bus.sent(), ask);
    for (int tries = 2; tries <= kDescriptionTriesMax; tries++) {
        bus.pass(milliseconds(999));
        bus.node_says(kPresent1);
        EXPECT_EQ(bus.sent(), Dumps{});
        bus.pass(milliseconds(1));
        EXPECT_EQ(bus.sent(), ask) << tries;
    }
    bus.pass(kDescriptionRetry);
    EXPECT_EQ(bus.sent(), Dumps{});
    ASSERT_EQ(bus.told<DescriptionFailed>().size(), 1u);
    EXPECT_EQ(bus.told<DescriptionFailed>()[0].why,
              "it was asked 5 times and sent 0 parts, not all that it announced");
    bus.describe_robot(1);  // another host was luckier
    EXPECT_EQ(bus.told<NodeDescribed>().size(), 1u);
}

TEST(Discovery, ALostPartIsMendedByTheNextWholeDescription) {
    ScriptedBus bus;
    bus.node_says(kPresent1);
    bus.node_says(
        "18 00 01 00 00 90 09 74 68 79 6d 69 6f 2d 49 49 05 00 fe 05 20 00 4a 02 02 00 00 00 00 "
        "00");
    bus.node_says("06 00 01 00 01 90 01 00 03 5f 69 64");
    bus.sent();
    bus.pass(kDescriptionRetry);
    EXPECT_EQ(bus.sent(), Dumps{"04 00 00 00 10 a0 01 00 05 00"});
    bus.node_says(
        "18 00 01 00 00 90 09 74 68 79 6d 69 6f 2d 49 49 05 00 fe 05 20 00 4a 02 02 00 00 00 00 "
        "00");
    bus.node_says("06 00 01 00 01 90 01 00 03 5f 69 64");
    bus.node_says("06 00 01 00 01 90 20 00 03 61 62 63");
    ASSERT_EQ(bus.told<NodeDescribed>().size(), 1u);
    EXPECT_EQ(bus.network.node(1)->target->variables[1].name, "abc");
}

// Dump 11: a node of version 9 with 1 variable and 1 event.
constexpr const char* kPresent9 = "02 00 01 00 0c 90 09 00";
constexpr const char* kHeader9 =
    "13 00 01 00 00 90 04 6e 6f 64 65 09 00 00 01 20 00 3c 00 01 00 01 00 00 00";

TEST(Fragments, NewNodesAreAskedForOnePartAfterTheOther) {
    ScriptedBus bus;
    bus.node_says(kPresent9);
    EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 15 a0 01 00 09 00 ff ff"});
    bus.node_says(kHeader9);
    EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 15 a0 01 00 09 00 00 00"});
    bus.node_says("06 00 01 00 01 90 01 00 03 5f 69 64");
    EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 15 a0 01 00 09 00 01 00"});
    bus.node_says("06 00 01 00 02 90 03 74 61 70 01 3f");
    EXPECT_EQ(bus.told<NodeDescribed>().size(), 1u);
    EXPECT_EQ(bus.network.node(1)->protocol, 9);
}

TEST(Fragments, AreAskedForAgainThenTheWholeIs) {
    ScriptedBus bus;
    bus.node_says(kPresent9);
    bus.node_says(kHeader9);
    bus.sent();
    for (int tries = 2; tries <= 3; tries++) {
        bus.pass(kDescriptionRetry);
        bus.node_says(kPresent9);
        EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 15 a0 01 00 09 00 00 00"}) << tries;
    }
    bus.pass(kDescriptionRetry);
    EXPECT_EQ(bus.sent(), Dumps{"04 00 00 00 10 a0 01 00 05 00"});
}

TEST(Fragments, AnotherHostThatAsksForPartsMakesUsAskForTheWhole) {
    ScriptedBus bus;
    bus.node_says(kPresent9);
    bus.node_says(kHeader9);
    bus.sent();
    bus.node_says("06 00 00 00 15 a0 01 00 09 00 00 00");
    EXPECT_EQ(bus.sent(), Dumps{"04 00 00 00 10 a0 01 00 05 00"});
}

TEST(OldNodes, OfVersion4DescribeThemselvesUnaskedAndMayBeSilent) {
    ScriptedBus bus;
    bus.node_says(
        "18 00 01 00 00 90 09 74 68 79 6d 69 6f 2d 49 49 04 00 fe 05 20 00 4a 02 01 00 00 00 00 "
        "00");
    EXPECT_EQ(bus.sent_all(), Dumps{});
    bus.node_says("06 00 01 00 01 90 01 00 03 5f 69 64");
    EXPECT_EQ(bus.told<NodeDescribed>().size(), 1u);
    bus.pass(milliseconds(60000));
    EXPECT_TRUE(bus.told<NodeDisconnected>().empty());
}

// Found by fuzzing: the second question went to node 0, in a message that old nodes do not know.
TEST(OldNodes, OfVersion4AreAskedAgainByBroadcast) {
    ScriptedBus bus;
    bus.node_says(
        "18 00 01 00 00 90 09 74 68 79 6d 69 6f 2d 49 49 04 00 fe 05 20 00 4a 02 01 00 00 00 00 "
        "00");
    bus.pass(milliseconds(999));
    bus.forget();
    bus.pass(milliseconds(1));
    EXPECT_EQ(bus.sent_all(), (Dumps{"02 00 00 00 00 a0 05 00"}));
}

TEST(Versions, OutsideFourToNineAreRefusedOnceAndRemembered) {
    ScriptedBus bus;
    bus.node_says("02 00 01 00 0c 90 03 00");
    bus.node_says("02 00 01 00 0c 90 03 00");
    bus.node_says("02 00 02 00 0c 90 0a 00");
    ASSERT_EQ(bus.told<ProtocolMismatch>().size(), 2u);
    EXPECT_EQ(bus.told<ProtocolMismatch>()[0].protocol, 3);
    EXPECT_EQ(bus.told<ProtocolMismatch>()[1].protocol, 10);
    EXPECT_EQ(bus.sent(), Dumps{});
    EXPECT_TRUE(bus.network.nodes().empty());
    bus.node_says(kPresent1);  // new firmware
    EXPECT_EQ(bus.told<NodeAppeared>().size(), 1u);
}

TEST(Presence, ThreeSecondsOfSilenceDisconnectAndAnyMessageConnects) {
    ScriptedBus bus;
    bus.meet_robot(1);
    bus.pass(milliseconds(2999));
    EXPECT_TRUE(bus.network.node(1)->connected);
    bus.pass(milliseconds(1));
    EXPECT_FALSE(bus.network.node(1)->connected);
    ASSERT_EQ(bus.told<NodeDisconnected>().size(), 1u);
    EXPECT_FALSE(bus.told<NodeDisconnected>()[0].forgotten);
    bus.forget();
    bus.node_says("02 00 01 00 00 00 07 00");  // a user event
    EXPECT_TRUE(bus.network.node(1)->connected);
    EXPECT_EQ(bus.told<NodeReconnected>().size(), 1u);
    EXPECT_EQ(bus.sent(), Dumps{"04 00 00 00 10 a0 01 00 05 00"});
    bus.describe_robot(1);
    EXPECT_TRUE(bus.told<NodeDescribed>().empty());  // it is the same
}

TEST(Presence, ANodeThatComesBackAsAnotherIsDescribedAnew) {
    ScriptedBus bus;
    bus.meet_robot(1);
    bus.pass(kSilenceMax);
    bus.node_says(kPresent1);
    bus.describe_robot(1, 1000);
    EXPECT_EQ(bus.told<NodeDescribed>().size(), 1u);
    EXPECT_EQ(bus.network.node(1)->target->bytecode_size, 1000);
}

TEST(Presence, ANodeThatSaysGoodbyeIsForgotten) {
    ScriptedBus bus;
    bus.meet_robot(1);
    bus.node_says("00 00 01 00 04 90");
    EXPECT_TRUE(bus.network.nodes().empty());
    ASSERT_EQ(bus.told<NodeDisconnected>().size(), 1u);
    EXPECT_TRUE(bus.told<NodeDisconnected>()[0].forgotten);
    bus.node_says(kPresent1);
    EXPECT_EQ(bus.sent(), Dumps{"04 00 00 00 10 a0 01 00 05 00"});
}

TEST(Presence, WhoSaidGoodbyeIsNamedUntilItIsBackOrAPersonKnowsOfIt) {
    using Left = std::vector<std::pair<NodeId, std::string>>;
    ScriptedBus bus;
    bus.meet_robot(1);
    EXPECT_EQ(bus.network.left(), Left{});
    bus.node_says("00 00 01 00 04 90");
    EXPECT_EQ(bus.network.left(), (Left{{1, "robot"}}));
    bus.meet_robot(1);
    EXPECT_EQ(bus.network.left(), Left{});
    bus.node_says("00 00 01 00 04 90");
    bus.network.acknowledge_left();
    EXPECT_EQ(bus.network.left(), Left{});
    bus.meet_robot(1);
    bus.node_says("00 00 01 00 04 90");
    EXPECT_EQ(bus.network.left(), (Left{{1, "robot"}}));
}

TEST(Limits, OneNodeTooManyIsIgnoredAndToldOnce) {
    ScriptedBus bus;
    wire::NodePresent present{};
    present.version = 5;
    for (size_t id = 1; id <= kNodesMax + 2; id++) bus.node_sends(static_cast<NodeId>(id), present);
    EXPECT_EQ(bus.network.nodes().size(), kNodesMax);
    EXPECT_EQ(bus.told<TooManyNodes>().size(), 1u);
}

TEST(Limits, DescriptionsThatCannotBeRightAreGivenUp) {
    ScriptedBus bus;
    wire::Description header{};
    header.name = {"x", 1};
    header.protocol_version = 5;
    header.variables_size = 10;
    header.variable_count = kDescriptionItemsMax;
    bus.node_sends(1, header);
    EXPECT_TRUE(bus.told<DescriptionFailed>().empty());
    bus.variable(1, "a", 10);
    EXPECT_TRUE(bus.told<DescriptionFailed>().empty());
    bus.variable(1, "b", 1);
    ASSERT_EQ(bus.told<DescriptionFailed>().size(), 1u);
    EXPECT_EQ(bus.told<DescriptionFailed>()[0].why,
              "its variables need 11 words up to \"b\", but it announces memory for 10");
    header.variable_count++;
    bus.node_sends(2, header);
    ASSERT_EQ(bus.told<DescriptionFailed>().size(), 2u);
    EXPECT_EQ(bus.told<DescriptionFailed>()[1].why,
              "it announces 4097 variables; 4096 are the most that is accepted");
}

TEST(Limits, TextsOfOneNodeAreBounded) {
    ScriptedBus bus;
    wire::Description header{};
    header.name = {"x", 1};
    header.protocol_version = 5;
    header.local_event_count = kDescriptionItemsMax;
    bus.node_sends(1, header);
    const std::string doc(255, 'd');
    wire::LocalEventDescription event{};
    event.doc = {doc.data(), 255};
    const size_t fitting = (kDescriptionBytesMax - 1) / doc.size();
    for (size_t i = 0; i < fitting; i++) bus.node_sends(1, event);
    EXPECT_TRUE(bus.told<DescriptionFailed>().empty());
    bus.node_sends(1, event);
    EXPECT_EQ(bus.told<DescriptionFailed>().size(), 1u);
}

TEST(Limits, EventsAndFramesThatNobodyTakesAreDroppedAndCounted) {
    Network network;
    wire::Frame event{};
    event.type = 1;
    for (size_t i = 0; i < kEventsMax + 1; i++) network.receive(Time{}, event);
    EXPECT_EQ(network.counts().dropped, 1u);
    EXPECT_EQ(network.take_events().size(), kEventsMax);
    for (size_t i = 0; i < kFramesMax + 1; i++) EXPECT_TRUE(network.emit("1", {}).ok());
    EXPECT_EQ(network.counts().dropped, 2u);
    EXPECT_EQ(network.take_frames().size(), kFramesMax);
}

TEST(Texts, FromTheBusCannotReachATerminalUnclean) {
    ScriptedBus bus;
    bus.node_says(
        "15 00 01 00 00 90 06 1b 5b 48 c3 bc ff 05 00 00 01 20 00 3c 00 00 00 00 00 00 00");
    ASSERT_EQ(bus.told<NodeDescribed>().size(), 1u);
    EXPECT_EQ(bus.told<NodeDescribed>()[0].name, "?[H\xc3\xbc?");
}

TEST(Malformed, FramesAreCountedAndChangeNothing) {
    ScriptedBus bus;
    bus.meet_robot(1);
    bus.node_says("03 00 01 00 0a 90 05 00 03");        // half a word too few
    bus.node_says("05 00 01 00 0a 90 05 00 03 00 09");  // a byte too many
    bus.node_says("01 00 01 00 0c 90 05");
    bus.node_says("02 00 01 00 2a 9f 05 00");  // no such message
    EXPECT_EQ(bus.network.counts().malformed, 4u);
    EXPECT_EQ(bus.network.node(1)->at.pc, 0);
}

TEST(Names, NodesAreFoundByNumberOrNameAndNearNamesAreSuggested) {
    ScriptedBus bus;
    EXPECT_EQ(bus.network.find("robot").error().what,
              "there is no node \"robot\": no node answers on this network");
    bus.meet_robot(7);
    EXPECT_EQ(bus.network.find("robot").value(), 7);
    EXPECT_EQ(bus.network.find("7").value(), 7);
    EXPECT_EQ(bus.network.find("robto").error().what,
              "there is no node \"robto\"; did you mean robot? The nodes are: 7 robot");
    EXPECT_EQ(bus.network.find("8").error().what, "there is no node \"8\"; the nodes are: 7 robot");
    bus.meet_robot(9);
    EXPECT_EQ(bus.network.find("robot").error().what,
              "2 nodes are named \"robot\": name the one that is meant by its number (7, 9)");
    bus.pass(kSilenceMax);
    EXPECT_EQ(bus.network.find("7").error().what, "node 7 \"robot\" is disconnected");
}

TEST(Events, OfNodesAndHostsAreToldWithTheirNames) {
    ScriptedBus bus;
    bus.network.set_common({.events = {{"ping", 2}, {"pong", 0}}, .constants = {}});
    bus.node_says("04 00 2a 00 00 00 07 00 f8 ff");
    bus.node_says("00 00 00 00 05 00");
    ASSERT_EQ(bus.told<UserEvent>().size(), 2u);
    EXPECT_EQ(bus.events[0].node, 42);
    EXPECT_EQ(bus.told<UserEvent>()[0].name, "ping");
    EXPECT_EQ(bus.told<UserEvent>()[0].arguments, (std::vector<int16_t>{7, -8}));
    EXPECT_EQ(bus.events[1].node, 0);
    EXPECT_EQ(bus.told<UserEvent>()[1].number, 5);
}

TEST(Events, AreEmittedByNameOrNumberWithTheRightCountOfArguments) {
    ScriptedBus bus;
    bus.network.set_common({.events = {{"ping", 2}, {"pong", 0}}, .constants = {}});
    const std::vector<int16_t> two = {7, -8};
    EXPECT_TRUE(bus.network.emit("ping", two).ok());
    EXPECT_TRUE(bus.network.emit("4", two).ok());
    EXPECT_EQ(bus.sent(),
              (Dumps{"04 00 00 00 00 00 07 00 f8 ff", "04 00 00 00 04 00 07 00 f8 ff"}));
    EXPECT_EQ(bus.network.emit("pong", two).error().what,
              "event \"pong\" takes 0 arguments, found 2");
    EXPECT_EQ(bus.network.emit("pnig", two).error().what,
              "there is no event \"pnig\"; did you mean ping?");
    EXPECT_EQ(bus.network.emit("32768", two).error().code, Code::NotFound);
    const std::vector<int16_t> most(wire::kArgumentsMax), too_many(wire::kArgumentsMax + 1);
    EXPECT_TRUE(bus.network.emit("9", most).ok());
    EXPECT_EQ(bus.network.emit("9", too_many).error().code, Code::Limit);
}

}  // namespace
}  // namespace vagus::debug
