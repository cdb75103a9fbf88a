#include "aesl/mentions.hpp"

#include <gtest/gtest.h>

namespace vagus::aesl {
namespace {

constexpr std::string_view kScript =
    "const NEAR = 3\nvar speed = NEAR\n\nonevent prox\n  if speed > LIMIT then\n    callsub turn\n"
    "    call math.min(speed, speed, NEAR)\n    emit ping speed\n  end\n\nsub turn\n  speed = 0\n";

std::vector<Mention> of(std::string_view name) {
    std::vector<Mention> found;
    for (const Mention& one : mentions(kScript, {.events = {}, .constants = {{"LIMIT", 5}}})) {
        if (one.name == name) found.push_back(one);
    }
    return found;
}

TEST(Mentions, NamesAndWhatTheyStandFor) {
    EXPECT_EQ(of("speed").size(), 6u);
    EXPECT_TRUE(of("speed")[0].declares);
    EXPECT_FALSE(of("speed")[1].declares);
    EXPECT_EQ(of("NEAR")[0].kind, MentionKind::Constant);
    EXPECT_TRUE(of("NEAR")[0].declares);
    EXPECT_EQ(of("NEAR")[2].kind, MentionKind::Constant);
    EXPECT_EQ(of("LIMIT")[0].kind, MentionKind::Constant);  // of the project
    EXPECT_EQ(of("prox")[0].kind, MentionKind::Event);
    EXPECT_TRUE(of("prox")[0].handles);
    EXPECT_EQ(of("ping")[0].kind, MentionKind::Event);
    EXPECT_EQ(of("math.min")[0].kind, MentionKind::Native);
    ASSERT_EQ(of("turn").size(), 2u);
    EXPECT_EQ(of("turn")[0].kind, MentionKind::Sub);
    EXPECT_TRUE(of("turn")[1].declares);
}

TEST(Mentions, PlacesCountFromOneAndEndBehindTheName) {
    const Mention prox = of("prox")[0];
    EXPECT_EQ(prox.at, (Position{4, 9}));
    EXPECT_EQ(prox.end, (Position{4, 13}));
    EXPECT_EQ(kScript.substr(prox.offset, 4), "prox");
}

TEST(Mentions, AScriptThatDoesNotCompileHasThemToo) {
    const auto found = mentions("var a\nif a === ) then b", {});
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[2].name, "b");
}

// | is the cursor.
Cursor cursor(std::string text) {
    const size_t at = text.find('|');
    text.erase(at, 1);
    return cursor_at(text, at);
}

TEST(Cursor, ThePlaceAsksForAKindOfName) {
    EXPECT_EQ(cursor("|").wanted, Wanted::Statement);
    EXPECT_EQ(cursor("var a\nmo|").wanted, Wanted::Statement);
    EXPECT_EQ(cursor("onevent |").wanted, Wanted::Handler);
    EXPECT_EQ(cursor("onevent pr|").wanted, Wanted::Handler);
    EXPECT_EQ(cursor("emit p|").wanted, Wanted::Emitted);
    EXPECT_EQ(cursor("callsub |").wanted, Wanted::Sub);
    EXPECT_EQ(cursor("call math.|").wanted, Wanted::Native);
    EXPECT_EQ(cursor("a = b|").wanted, Wanted::Expression);
    EXPECT_EQ(cursor("a = |").wanted, Wanted::Expression);
    EXPECT_EQ(cursor("if a == 1 then\n  |").wanted, Wanted::Statement);
    EXPECT_EQ(cursor("if a == 1 then |").wanted, Wanted::Statement);
    EXPECT_EQ(cursor("var |").wanted, Wanted::NewName);
    EXPECT_EQ(cursor("a = 1 # on|").wanted, Wanted::Comment);
    EXPECT_EQ(cursor("#* a\n b| *#").wanted, Wanted::Comment);
}

TEST(Cursor, TheWordThatIsBeingTyped) {
    EXPECT_EQ(cursor("a = motor.le|").word_begin, 4u);
    EXPECT_EQ(cursor("a = |").word_begin, 4u);
    EXPECT_EQ(cursor("a = b|c").word_begin, 4u);
}

TEST(Cursor, WhichArgumentOfWhichNative) {
    EXPECT_EQ(cursor("call math.min(a, b[1], |").native, "math.min");
    EXPECT_EQ(cursor("call math.min(a, b[1], |").argument, 2u);
    EXPECT_EQ(cursor("call math.min(|").argument, 0u);
    EXPECT_EQ(cursor("call math.min(a)\n|").native, "");
    EXPECT_EQ(cursor("a = (b + |").native, "");
}

}  // namespace
}  // namespace vagus::aesl
