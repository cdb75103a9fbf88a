// Expected frames are those of docs/spec/aseba-wire-and-vm.md, sections 1.5 and 2.10.
#include "hub/hub.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/rng.hpp"

namespace vagus::hub {
namespace {

using Hex = std::vector<uint8_t>;

wire::Frame frame_of(const Hex& bytes) {
    wire::FrameReader reader;
    EXPECT_EQ(reader.feed(bytes.data(), static_cast<uint16_t>(bytes.size())), bytes.size());
    EXPECT_TRUE(reader.complete());
    return reader.frame();
}

// All that waits for a link, which is taken from the queue.
Hex received(Hub& hub, LinkId link) {
    Hex copy;
    for (auto bytes = hub.output(link); !bytes.empty(); bytes = hub.output(link)) {
        copy.insert(copy.end(), bytes.begin(), bytes.end());
        hub.sent(link, bytes.size());
    }
    return copy;
}

LinkId add(Hub& hub, LinkOptions options = {.name = "link"}) {
    return hub.add(options).value();
}

const Hex kEvent{4, 0, 1, 0, 4, 0, 5, 0, 0, 0};
const Hex kRunNode1{2, 0, 0, 0, 3, 0xa0, 1, 0};
const Hex kListNodes{2, 0, 0, 0, 0x11, 0xa0, 5, 0};

TEST(Hub, GivesAFrameToAllButItsSender) {
    Hub hub;
    const LinkId a = add(hub), b = add(hub), c = add(hub);
    for (const Hex& each : {kEvent, kRunNode1, kListNodes}) {
        hub.receive(a, frame_of(each));
        EXPECT_EQ(received(hub, a), Hex{});
        EXPECT_EQ(received(hub, b), each);
        EXPECT_EQ(received(hub, c), each);
    }
}

// Of a link whose words count no longer, but for some.
TEST(Hub, TakesOnlyTheTypesThatAreAllowed) {
    Hub hub;
    const LinkId a = add(hub), b = add(hub);
    hub.allow_only(a, {frame_of(kEvent).type});
    for (const Hex& each : {kRunNode1, kListNodes}) {
        hub.receive(a, frame_of(each));
        EXPECT_EQ(received(hub, b), Hex{});
    }
    hub.receive(a, frame_of(kEvent));
    EXPECT_EQ(received(hub, b), kEvent);
    hub.receive(b, frame_of(kRunNode1));  // others are heard as before
    EXPECT_EQ(received(hub, a), kRunNode1);
}

TEST(Hub, EchoesToTheSenderIfAsked) {
    Hub hub;
    const LinkId a = add(hub, {.name = "a", .echo = true}), b = add(hub);
    hub.receive(a, frame_of(kEvent));
    EXPECT_EQ(received(hub, a), kEvent);
    EXPECT_EQ(received(hub, b), kEvent);
    hub.receive(b, frame_of(kEvent));
    EXPECT_EQ(received(hub, b), Hex{});
}

// Dump 9: node 1 behind a link with remapLocal=5, remapTarget=1; hosts A and B.
TEST(Hub, RemapsTheNodeOfDump9) {
    Hub hub;
    const LinkId node = add(hub, {.name = "node", .remap = Remap{5, 1}});
    const LinkId a = add(hub), b = add(hub);

    hub.receive(a, frame_of(kListNodes));
    EXPECT_EQ(received(hub, node), kListNodes);
    EXPECT_EQ(received(hub, b), kListNodes);
    hub.receive(node, frame_of({2, 0, 1, 0, 0x0c, 0x90, 5, 0}));
    const Hex present{2, 0, 5, 0, 0x0c, 0x90, 5, 0};
    EXPECT_EQ(received(hub, a), present);
    EXPECT_EQ(received(hub, b), present);

    const Hex ask1{2, 0, 0, 0, 7, 0xa0, 1, 0};
    hub.receive(a, frame_of(ask1));
    EXPECT_EQ(received(hub, b), ask1);
    EXPECT_EQ(received(hub, node), Hex{});

    const Hex ask5{2, 0, 0, 0, 7, 0xa0, 5, 0};
    hub.receive(a, frame_of(ask5));
    EXPECT_EQ(received(hub, node), ask1);
    EXPECT_EQ(received(hub, b), ask5);
    hub.receive(node, frame_of({4, 0, 1, 0, 0x0a, 0x90, 0, 0, 0, 0}));
    const Hex state{4, 0, 5, 0, 0x0a, 0x90, 0, 0, 0, 0};
    EXPECT_EQ(received(hub, a), state);
    EXPECT_EQ(received(hub, b), state);
}

TEST(Hub, ARemappedLinkKeepsItsOtherSourcesAndAllBroadcasts) {
    Hub hub;
    const LinkId node = add(hub, {.name = "node", .remap = Remap{5, 1}});
    const LinkId host = add(hub);
    const Hex from2{0, 0, 2, 0, 9, 0};
    hub.receive(node, frame_of(from2));
    EXPECT_EQ(received(hub, host), from2);
    hub.receive(host, frame_of(kEvent));  // source 1 on another link is not renamed
    EXPECT_EQ(received(hub, node), kEvent);
}

TEST(Hub, RemapsEveryCommandOfTheTableAndNothingElse) {
    for (uint32_t type = 0; type <= 0xffff; ++type) {
        const bool command = (type >= 0x8000 && type <= 0x8003) ||
                             (type >= 0xa001 && type <= 0xa010) ||
                             (type >= 0xa012 && type <= 0xa015);  // section 2.1, fork M included
        Hub hub;
        const LinkId host = add(hub), node = add(hub, {.name = "node", .remap = Remap{5, 1}});
        Hex bytes{2, 0, 0, 0, 0, 0, 5, 0};
        bytes[4] = static_cast<uint8_t>(type & 0xff);
        bytes[5] = static_cast<uint8_t>(type >> 8);
        hub.receive(host, frame_of(bytes));
        bytes[6] = command ? 1 : 5;
        ASSERT_EQ(received(hub, node), bytes) << "type " << type;
    }
}

TEST(Hub, RemapsOnlyForTheLinkThatHasIt) {
    Hub hub;
    const LinkId host = add(hub);
    const LinkId first = add(hub, {.name = "first", .remap = Remap{5, 1}});
    const LinkId plain = add(hub);
    const LinkId second = add(hub, {.name = "second", .remap = Remap{5, 2}});
    const Hex run5{2, 0, 0, 0, 3, 0xa0, 5, 0};
    hub.receive(host, frame_of(run5));
    EXPECT_EQ(received(hub, first), (Hex{2, 0, 0, 0, 3, 0xa0, 1, 0}));
    EXPECT_EQ(received(hub, plain), run5);
    EXPECT_EQ(received(hub, second), (Hex{2, 0, 0, 0, 3, 0xa0, 2, 0}));
}

// D10: one such frame ended the process of the reference.
TEST(Hub, ForwardsWhatItCannotDecodeVerbatim) {
    const Hex undecodable[] = {
        {3, 0, 9, 0, 0xef, 0xbe, 1, 2, 3},  // unknown type, odd
        {1, 0, 9, 0, 4, 0, 7},              // user event of half a word
        {3, 0, 1, 0, 0x0a, 0x90, 5, 0, 3},  // a state cut short
        {3, 0, 1, 0, 0x0d, 0x90, 1, 1, 9},  // DeviceInfo of fork M
        {2, 0, 1, 0, 6, 0x90, 7, 0},        // dump 8
        {1, 0, 0, 0, 3, 0xa0, 1},           // a command without a whole destination
        {0, 0, 0, 0, 0xff, 0xff},           // the invalid marker
    };
    for (const Hex& each : undecodable) {
        Hub hub;
        const LinkId a = add(hub), b = add(hub);
        hub.receive(a, frame_of(each));
        EXPECT_EQ(received(hub, b), each);
    }
}

TEST(Hub, ACommandWithoutDestinationDoesNotReachARemappedLink) {
    Hub hub;
    const LinkId host = add(hub), plain = add(hub);
    const LinkId node = add(hub, {.name = "node", .remap = Remap{0xffff, 1}});
    const Hex short_run{1, 0, 0, 0, 3, 0xa0, 5};
    hub.receive(host, frame_of(short_run));
    EXPECT_EQ(received(hub, node), Hex{});
    EXPECT_EQ(received(hub, plain), short_run);
}

TEST(Hub, AnnouncesEveryNodeOfALinkThatCloses) {
    Hub hub;
    const LinkId nodes = add(hub), a = add(hub), b = add(hub);
    for (const uint8_t id : Hex{3, 1, 3}) {
        hub.receive(nodes, frame_of({2, 0, id, 0, 0x0c, 0x90, 5, 0}));
    }
    hub.receive(nodes, frame_of(kRunNode1));  // source 0: a host, nobody to announce
    received(hub, a);
    received(hub, b);
    hub.remove(nodes);
    const Hex gone{0, 0, 1, 0, 4, 0x90, 0, 0, 3, 0, 4, 0x90};
    EXPECT_EQ(received(hub, a), gone);
    EXPECT_EQ(received(hub, b), gone);
    EXPECT_FALSE(hub.has(nodes));
}

TEST(Hub, AnnouncesARemappedNodeUnderTheNameOthersKnow) {
    Hub hub;
    const LinkId node = add(hub, {.name = "node", .remap = Remap{5, 1}});
    const LinkId host = add(hub);
    hub.receive(node, frame_of({2, 0, 1, 0, 0x0c, 0x90, 5, 0}));
    received(hub, host);
    hub.remove(node);
    EXPECT_EQ(received(hub, host), (Hex{0, 0, 5, 0, 4, 0x90}));
}

TEST(Hub, DoesNotAnnounceANodeThatIsStillHeardOnAnotherLink) {
    Hub hub;
    const LinkId old_link = add(hub), new_link = add(hub), host = add(hub);
    for (const LinkId link : {old_link, new_link}) hub.receive(link, frame_of(kEvent));
    received(hub, host);
    hub.remove(old_link);
    EXPECT_EQ(received(hub, host), Hex{});
    hub.remove(new_link);
    EXPECT_EQ(received(hub, host), (Hex{0, 0, 1, 0, 4, 0x90}));
}

TEST(Hub, DoesNotAnnounceTwiceWhatAForeignSwitchAnnounced) {
    Hub hub;
    const LinkId other_switch = add(hub), host = add(hub);
    hub.receive(other_switch, frame_of(kEvent));
    hub.receive(other_switch, frame_of({0, 0, 1, 0, 4, 0x90}));
    received(hub, host);
    hub.remove(other_switch);
    EXPECT_EQ(received(hub, host), Hex{});
}

TEST(Hub, RemembersNoMoreNodesOfALinkThanItsLimit) {
    Hub hub;
    const LinkId liar = add(hub);
    for (size_t id = 1; id <= kNodesPerLinkMax + 1; ++id) {
        wire::Frame event{};
        event.source = static_cast<uint16_t>(id);
        hub.receive(liar, event);
    }
    EXPECT_EQ(hub.nodes(liar).size(), kNodesPerLinkMax);
    EXPECT_EQ(hub.nodes(liar).back(), kNodesPerLinkMax);
}

TEST(Hub, RefusesOneLinkTooManyAndNamesIt) {
    Hub hub;
    for (size_t i = 0; i < kLinksMax; ++i) add(hub);
    const auto refused = hub.add({.name = "tcp:10.0.0.1:5"});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, Code::Limit);
    EXPECT_NE(refused.error().what.find("tcp:10.0.0.1:5"), std::string::npos);
    EXPECT_EQ(hub.links().size(), kLinksMax);
}

TEST(Hub, ALinkThatNeverReadsCostsTheOthersNothing) {
    Hub hub;
    const LinkId sender = add(hub), stuck = add(hub), reader = add(hub);
    wire::Frame event{};
    size_t read = 0;
    const size_t sent = kQueueFramesMax + 1;
    for (size_t i = 0; i < sent; ++i) {
        event.source = static_cast<uint16_t>(1 + i % 100);
        hub.receive(sender, event);
        wire::Frame out;
        while (hub.take(reader, out)) ++read;
    }
    EXPECT_EQ(read, sent);
    EXPECT_EQ(hub.stats(reader).dropped, (Dropped{0, 0}));
    EXPECT_EQ(hub.stats(stuck).dropped, (Dropped{kDropFramesAtOnce, 0}));
    EXPECT_EQ(hub.stats(stuck).frames_queued, sent);
    EXPECT_EQ(hub.stats(sender).frames_received, sent);
}

// Found by the fuzz target: a second Stop was counted as queued, and neither came nor was dropped.
TEST(Hub, AStopThatMeetsOneThatWaitsIsNotCountedAgain) {
    Hub hub;
    const LinkId host = add(hub), robot = add(hub);
    wire::Frame stop{};
    stop.type = static_cast<uint16_t>(wire::MessageType::Stop);
    stop.size = 2;
    stop.payload[0] = 9;
    for (int i = 0; i < 3; ++i) hub.receive(host, stop);
    wire::Frame out;
    EXPECT_TRUE(hub.take(robot, out));
    EXPECT_FALSE(hub.take(robot, out));
    EXPECT_EQ(hub.stats(robot).frames_queued, 1u);
    EXPECT_EQ(hub.stats(robot).dropped, Dropped{});
}

// Links come and go and send anything; every link that stays gets what a plain reading of 1.5 says.
TEST(Hub, RandomTrafficAgreesWithThePlainRule) {
    const uint64_t seed = 20;
    SCOPED_TRACE("seed " + std::to_string(seed));
    SplitMix64 random(seed);
    Hub hub;
    std::vector<LinkId> links;
    for (int step = 0; step < 20000; ++step) {
        if (links.size() < 2 || (links.size() < 8 && random.below(50) == 0))
            links.push_back(add(hub));
        if (links.size() > 3 && random.below(60) == 0) {
            hub.remove(links.back());
            links.pop_back();
            for (const LinkId link : links) received(hub, link);
        }
        wire::Frame frame{};
        frame.source = static_cast<uint16_t>(random.below(5));
        frame.type = static_cast<uint16_t>(random.next());
        frame.size = static_cast<uint16_t>(random.below(wire::kPayloadMax + 1));
        frame.payload[0] = static_cast<uint8_t>(random.next());
        const LinkId from = links[random.below(links.size())];
        hub.receive(from, frame);
        Hex expected(wire::kFrameMax);
        expected.resize(wire::encode(frame, expected.data()));
        for (const LinkId link : links) {
            ASSERT_EQ(received(hub, link), link == from ? Hex{} : expected) << "step " << step;
        }
    }
}

// What nodes tell hosts fills no queue of a node, however many nodes there are.
TEST(Hub, GivesALinkThatEndsAtANodeOnlyWhatTheNodeLooksAt) {
    Hub hub;
    const LinkId host = add(hub), other = add(hub);
    const LinkId node = add(hub, {.name = "node", .only_node = 5});
    const Hex run5{2, 0, 0, 0, 3, 0xa0, 5, 0};
    const Hex unknown{2, 0, 0, 0, 0x16, 0xa0, 6, 0};
    const Hex present{2, 0, 1, 0, 0x0c, 0x90, 5, 0};
    for (const Hex& each : {kEvent, kListNodes, kRunNode1, run5, unknown, present}) {
        hub.receive(host, frame_of(each));
        EXPECT_EQ(received(hub, other), each);
    }
    Hex expected;
    for (const Hex& each : {kEvent, kListNodes, run5, unknown}) {
        expected.insert(expected.end(), each.begin(), each.end());
    }
    EXPECT_EQ(received(hub, node), expected);
}

TEST(Hub, TellsOnceWhichNodesItHasQueuedSomethingFor) {
    Hub hub;
    const LinkId host = add(hub);
    // Not in the order of their ids, and two of the same.
    const LinkId node5 = add(hub, {.name = "node", .only_node = 5});
    const LinkId node1 = add(hub, {.name = "node", .only_node = 1});
    const LinkId again1 = add(hub, {.name = "node", .only_node = 1});
    const auto reached = [&hub] {
        std::vector<LinkId> links = hub.take_reached();
        std::sort(links.begin(), links.end());
        return links;
    };
    hub.receive(host, frame_of(kRunNode1));
    hub.receive(host, frame_of(kRunNode1));
    EXPECT_EQ(reached(), (std::vector<LinkId>{node1, again1}));
    EXPECT_EQ(received(hub, node1).size(), 2 * kRunNode1.size());
    EXPECT_TRUE(reached().empty());
    hub.receive(node1, frame_of(kEvent));  // from a node: to all others
    EXPECT_EQ(reached(), (std::vector<LinkId>{node5, again1}));
    hub.receive(host, frame_of(kListNodes));
    hub.remove(node5);
    EXPECT_EQ(reached(), (std::vector<LinkId>{node1, again1}));
    const Hex present{2, 0, 1, 0, 0x0c, 0x90, 5, 0};  // for hosts: no node looks at it
    hub.receive(node1, frame_of(present));
    EXPECT_TRUE(reached().empty());
    EXPECT_EQ(received(hub, again1), [] {
        Hex all;
        for (const Hex& each : {kRunNode1, kRunNode1, kEvent, kListNodes})
            all.insert(all.end(), each.begin(), each.end());
        return all;
    }());
}

TEST(Hub, SaysOnceOnWhichLinksAnIdIsShared) {
    Hub hub;
    const LinkId a = add(hub, {.name = "a"}), b = add(hub, {.name = "b"});
    const LinkId c = add(hub, {.name = "c", .remap = Remap{1, 2}});
    const Hex from1{0, 0, 1, 0, 9, 0}, from2{0, 0, 2, 0, 9, 0};
    hub.receive(a, frame_of(from1));
    hub.receive(b, frame_of(from2));
    hub.receive(a, frame_of(kListNodes));  // hosts all have the id 0
    hub.receive(b, frame_of(kListNodes));
    EXPECT_TRUE(hub.take_shared_ids().empty());
    hub.receive(b, frame_of(from1));
    hub.receive(b, frame_of(from1));
    hub.receive(a, frame_of(from1));
    EXPECT_EQ(hub.take_shared_ids(), (std::vector<SharedId>{{1, "a", "b"}}));
    hub.receive(c, frame_of(from2));  // known to the others as node 1
    EXPECT_EQ(hub.take_shared_ids(), (std::vector<SharedId>{{1, "a", "c"}, {1, "b", "c"}}));
    hub.remove(b);
    const LinkId again = add(hub, {.name = "again"});
    hub.receive(again, frame_of(from1));
    EXPECT_EQ(hub.take_shared_ids(), (std::vector<SharedId>{{1, "a", "again"}, {1, "c", "again"}}));
}

TEST(Hub, ANodeThatMovesToAnotherLinkSharesNothing) {
    Hub hub;
    const LinkId a = add(hub, {.name = "a"}), b = add(hub, {.name = "b"});
    const Hex from1{0, 0, 1, 0, 9, 0}, gone1{0, 0, 1, 0, 4, 0x90};
    hub.receive(a, frame_of(from1));
    hub.receive(a, frame_of(gone1));
    hub.receive(b, frame_of(from1));
    EXPECT_TRUE(hub.take_shared_ids().empty());
}

TEST(Hub, OneSharedIdTooManyIsNotTold) {
    Hub hub;
    const LinkId a = add(hub, {.name = "a"}), b = add(hub, {.name = "b"}), c = add(hub);
    for (uint16_t node = 1; node <= kSharedIdsMax / 2 + 1; node++) {
        const auto id = static_cast<uint8_t>(node);
        for (const LinkId link : {a, b, c}) hub.receive(link, frame_of({0, 0, id, 0, 9, 0}));
    }
    EXPECT_EQ(hub.take_shared_ids().size(), kSharedIdsMax);
}

}  // namespace
}  // namespace vagus::hub
