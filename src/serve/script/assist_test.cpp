#include "serve/script/assist.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Fixture {
    aesl::Target target;
    aesl::CommonDefinitions common{{{"ping", uint16_t{2}}}, {{"LIMIT", 5}}};
    Fixture() {
        target.variables = {{"id", 1}, {"prox.horizontal", 7}, {"motor.left.target", 1}};
        target.local_events = {{"button.center", "the button in the middle"}};
        target.natives = {{"math.min", "the smaller one", {{"dest", -1}, {"a", -1}, {"b", -1}}}};
    }
    ScriptView view(std::string_view source) const { return {source, target, common}; }
    // Labels of what is offered at the |.
    std::vector<std::string> labels(std::string text) const {
        const size_t at = text.find('|');
        text.erase(at, 1);
        std::vector<std::string> found;
        for (const Suggestion& one : complete(view(text), at).items) found.push_back(one.label);
        return found;
    }
};

TEST(Assist, OffersWhatFitsThePlace) {
    const Fixture f;
    EXPECT_THAT(f.labels("onevent |"), ElementsAre("button.center", "ping"));
    EXPECT_THAT(f.labels("emit |"), ElementsAre("ping"));
    EXPECT_THAT(f.labels("call |"), ElementsAre("math.min"));
    EXPECT_THAT(f.labels("callsub |\nsub go\n"), ElementsAre("go"));
    EXPECT_THAT(f.labels("var own\nown = |"), Contains("prox.horizontal"));
    EXPECT_THAT(f.labels("var own\nown = |"), Contains("LIMIT"));
    EXPECT_THAT(f.labels("var own\nown = |"), Not(Contains("while")));
    EXPECT_THAT(f.labels("var own\n|"), Contains("while"));
    EXPECT_TRUE(f.labels("var |").empty());
    EXPECT_TRUE(f.labels("# a |").empty());
}

TEST(Assist, SaysWhatAThingIs) {
    const Fixture f;
    const auto title = [&](std::string_view source, aesl::Position at) {
        const auto found = hover(f.view(source), at);
        return found ? found->title + "/" + found->help : "";
    };
    EXPECT_EQ(title("id = prox.horizontal[2]", {1, 8}),
              "prox.horizontal: int16[7] of the node, at address 1/");
    EXPECT_EQ(title("call math.min(id,id,id)", {1, 7}), "math.min(dest, a, b)/the smaller one");
    EXPECT_EQ(title("onevent button.center", {1, 10}),
              "button.center: an event of the node/the button in the middle");
    EXPECT_EQ(title("emit ping [1,2]", {1, 6}), "ping: an event of the project with 2 arguments/");
    EXPECT_EQ(title("id = LIMIT", {1, 6}), "LIMIT = 5/");
    EXPECT_EQ(title("id = 3", {1, 4}), "");
}

TEST(Assist, KnowsWhoOwnsAName) {
    const Fixture f;
    const auto owner = [&](const char* name, aesl::MentionKind kind) {
        return owner_of(f.view("var own"), name, kind);
    };
    EXPECT_EQ(owner("own", aesl::MentionKind::Variable), Owner::Script);
    EXPECT_EQ(owner("id", aesl::MentionKind::Variable), Owner::Node);
    EXPECT_EQ(owner("ping", aesl::MentionKind::Event), Owner::Project);
    EXPECT_EQ(owner("button.center", aesl::MentionKind::Event), Owner::Node);
    EXPECT_EQ(owner("LIMIT", aesl::MentionKind::Constant), Owner::Project);
}

TEST(Assist, RefusesNamesThatCannotBe) {
    const Fixture f;
    const ScriptView script = f.view("var own\nsub go\n");
    EXPECT_EQ(fault_of_name(script, "speed"), "");
    EXPECT_EQ(fault_of_name(script, "left.speed"), "");
    for (const char* name : {"", "1a", "a b", "while", "a-b", ".a"}) {
        EXPECT_THAT(fault_of_name(script, name), HasSubstr("is no name")) << name;
    }
    EXPECT_THAT(fault_of_name(script, "own"), HasSubstr("line 1 declares"));
    EXPECT_THAT(fault_of_name(script, "id"), HasSubstr("something else"));
}

}  // namespace
}  // namespace vagus::serve
