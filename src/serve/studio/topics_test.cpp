#include "serve/studio/topics.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "serve/json.hpp"
#include "serve/studio/merge_patch.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;

constexpr ClientId kPage{1}, kOther{2};

struct Sent {
    ClientId client;
    bool binary;
    std::string bytes;
    Json json() const { return Json::parse(bytes); }
};

// Topics with a clock that tests turn, and what it has sent.
struct TopicsFixture {
    Topics topics;
    std::vector<Sent> sent;
    double clock = 0;
    int made = 0;
    ClientId full{0};  // a page without room

    TopicsFixture() {
        topics.document("clock", [this](const Json&) {
            ++made;
            return Json{{"t", clock}, {"state", "running"}};
        });
        topics.stream("console", 3);
    }
    std::vector<std::string> flush(Time now) {
        sent.clear();
        return topics.flush(
            now, [this](ClientId client) { return client != full; },
            [this](ClientId client, bool binary, std::string bytes) {
                sent.push_back({client, binary, std::move(bytes)});
            });
    }
    void watch(ClientId client, Json in) {
        ASSERT_FALSE(topics.watch(client, in, Time{}).has_value());
    }
};

TEST(MergePatch, HoldsWhatChangedAndNullForWhatWent) {
    const Json from = {{"a", 1}, {"b", {{"c", 1}, {"d", 2}}}, {"list", {1, 2}}};
    const Json to = {{"b", {{"c", 1}, {"d", 3}}}, {"list", {1}}, {"new", "x"}};
    const Json patch = merge_patch(from, to);
    EXPECT_EQ(patch, (Json{{"a", nullptr}, {"b", {{"d", 3}}}, {"list", {1}}, {"new", "x"}}));
    Json patched = from;
    patched.merge_patch(patch);
    EXPECT_EQ(patched, to);
    EXPECT_EQ(merge_patch(to, to), Json::object());
}

TEST(Topics, ADocumentComesWholeThenInPatches) {
    TopicsFixture f;
    f.watch(kPage, {{"watch", 5}, {"topic", "clock"}});
    f.flush(0s);
    ASSERT_EQ(f.sent.size(), 1u);
    EXPECT_EQ(f.sent[0].json(),
              (Json{{"watch", 5}, {"whole", {{"t", 0.0}, {"state", "running"}}}}));
    f.clock = 1.5;
    f.flush(1s);
    EXPECT_TRUE(f.sent.empty());  // nobody said that it changed
    f.topics.touch("clock");
    f.flush(1s);
    ASSERT_EQ(f.sent.size(), 1u);
    EXPECT_EQ(f.sent[0].json(), (Json{{"watch", 5}, {"patch", {{"t", 1.5}}}}));
    f.topics.touch("clock");
    f.flush(2s);
    EXPECT_TRUE(f.sent.empty());  // made again, and the same
}

TEST(Topics, NoFasterThanAskedAndNothingThatNobodyWatches) {
    TopicsFixture f;
    f.topics.touch("clock");
    f.flush(0s);
    EXPECT_EQ(f.made, 0);
    f.watch(kPage, {{"watch", 1}, {"topic", "clock"}, {"rate", 10}});
    f.flush(0s);
    f.clock = 1;
    f.topics.touch("clock");
    f.flush(99ms);
    EXPECT_TRUE(f.sent.empty());
    EXPECT_EQ(f.topics.next_due(99ms), 100ms);
    f.flush(100ms);
    EXPECT_EQ(f.sent.size(), 1u);
    f.topics.unwatch(kPage, 1);
    EXPECT_FALSE(f.topics.watched("clock"));
    EXPECT_EQ(f.topics.next_due(100ms), Time::max());
}

TEST(Topics, APageWithoutRoomGetsWhatItMissedInOne) {
    TopicsFixture f;
    f.watch(kPage, {{"watch", 1}, {"topic", "clock"}});
    f.watch(kOther, {{"watch", 1}, {"topic", "clock"}});
    f.flush(0s);
    f.full = kPage;
    for (int i = 1; i <= 10; ++i) {
        f.clock = i;
        f.topics.touch("clock");
        f.flush(std::chrono::seconds(i));
        ASSERT_EQ(f.sent.size(), 1u);
        EXPECT_EQ(f.sent[0].client, kOther);
    }
    f.full = ClientId{0};
    f.flush(11s);
    ASSERT_EQ(f.sent.size(), 1u);
    EXPECT_EQ(f.sent[0].json(), (Json{{"watch", 1}, {"patch", {{"t", 10.0}}}}));
}

// Else the server would turn round in circles for as long as a page does not read.
TEST(Topics, APageWithoutRoomIsNotDueAtOnce) {
    TopicsFixture f;
    f.watch(kPage, {{"watch", 1}, {"topic", "clock"}});
    f.full = kPage;
    f.flush(5s);
    EXPECT_EQ(f.topics.next_due(5s), 5s + 50ms);
}

TEST(Topics, AStreamTellsWhatItLeftOut) {
    TopicsFixture f;
    f.watch(kPage, {{"watch", 1}, {"topic", "console"}});
    for (int i = 0; i < 5; ++i) f.topics.add("console", {{"kind", "note"}, {"text", i}});
    f.flush(0s);
    ASSERT_EQ(f.sent.size(), 1u);
    const Json message = f.sent[0].json();
    EXPECT_EQ(message["left_out"], 2);  // three are kept
    ASSERT_EQ(message["items"].size(), 3u);
    EXPECT_EQ(message["items"][0]["number"], 2);
    f.flush(1s);
    EXPECT_TRUE(f.sent.empty());
}

TEST(Topics, AStreamThatWasForgottenGoesOnCounting) {
    TopicsFixture f;
    f.watch(kPage, {{"watch", 1}, {"topic", "console"}});
    for (int i = 0; i < 3; ++i) f.topics.add("console", {{"kind", "note"}, {"text", i}});
    f.topics.forget("console");
    f.topics.add("console", {{"kind", "note"}, {"text", 3}});
    f.flush(0s);
    ASSERT_EQ(f.sent.size(), 1u);
    const Json message = f.sent[0].json();
    EXPECT_EQ(message["left_out"], 0);
    ASSERT_EQ(message["items"].size(), 1u);
    EXPECT_EQ(message["items"][0]["number"], 3);
}

TEST(Topics, AStreamBeginsWithTheLastOnesAskedFor) {
    TopicsFixture f;
    for (int i = 0; i < 3; ++i) f.topics.add("console", {{"kind", "note"}, {"text", i}});
    f.watch(kPage, {{"watch", 1}, {"topic", "console"}, {"of", {{"last", 1}}}});
    f.flush(0s);
    ASSERT_EQ(f.sent.size(), 1u);
    EXPECT_EQ(f.sent[0].json()["items"].size(), 1u);
}

TEST(Topics, BinaryFramesHaveTheirHead) {
    struct Once final : BinaryWatch {
        bool told = false;
        std::optional<std::pair<double, std::string>> next() override {
            if (std::exchange(told, true)) return std::nullopt;
            return std::pair(2.5, std::string("ab"));
        }
    };
    TopicsFixture f;
    f.topics.binary("poses", [](const Json&) { return std::make_unique<Once>(); });
    f.watch(kPage, {{"watch", 258}, {"topic", "poses"}});
    f.flush(0s);
    ASSERT_EQ(f.sent.size(), 1u);
    EXPECT_TRUE(f.sent[0].binary);
    // Kind 3, three zeros, 258 as 02 01 00 00, then 2.5 = 0x4004000000000000.
    const std::string expected(
        "\x03\0\0\0\x02\x01\0\0\0\0\0\0\0\0\x04\x40"
        "ab",
        18);
    EXPECT_EQ(f.sent[0].bytes, expected);
    f.flush(1s);
    EXPECT_TRUE(f.sent.empty());
}

TEST(Topics, WrongSubscriptionsAreRefused) {
    TopicsFixture f;
    EXPECT_EQ(f.topics.watch(kPage, {{"watch", 1}, {"topic", "clocks"}}, 0s)->code, "not_found");
    EXPECT_EQ(f.topics.watch(kPage, {{"watch", 1}, {"topic", "doc"}}, 0s)->code, "bad_message");
    for (uint32_t i = 0; i < Protocol::get().limit("watches"); ++i) {
        ASSERT_FALSE(f.topics.watch(kPage, {{"watch", i + 1}, {"topic", "clock"}}, 0s));
    }
    EXPECT_EQ(f.topics.watch(kPage, {{"watch", 1000}, {"topic", "clock"}}, 0s)->code, "limit");
    f.topics.drop(kPage);
    EXPECT_FALSE(f.topics.watch(kPage, {{"watch", 1000}, {"topic", "clock"}}, 0s));
}

// What was seen: one document that threw kept all that come after it from every page.
TEST(Topics, ADocumentThatCannotBeMadeKeepsNoOtherBack) {
    TopicsFixture f;
    int tried = 0;
    f.topics.document("breakpoints", [&](const Json&) -> Json {
        ++tried;
        throw std::runtime_error("no such line");
    });
    f.watch(kPage, {{"watch", 1}, {"topic", "breakpoints"}});
    f.watch(kPage, {{"watch", 2}, {"topic", "clock"}});
    EXPECT_EQ(f.flush(1s), std::vector<std::string>{"breakpoints: no such line"});
    ASSERT_EQ(f.sent.size(), 1u);
    EXPECT_EQ(f.sent[0].json()["watch"], 2);
    // It is tried again later, not at each turn.
    EXPECT_TRUE(f.flush(1s + kThrownAgain / 2).empty());
    EXPECT_EQ(f.topics.next_due(1s), 1s + kThrownAgain);
    EXPECT_EQ(f.flush(1s + kThrownAgain).size(), 1u);
    EXPECT_EQ(tried, 2);
}

}  // namespace
}  // namespace vagus::serve
