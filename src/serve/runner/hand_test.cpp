#include "serve/runner/hand.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "base/test_folder.hpp"
#include "session/sim_session.hpp"
#include "sim/world.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;

// Counts how often it saw its button down, and up.
constexpr const char* kWorld = R"({
  "format": "vagus-world/1", "size": [1, 1],
  "robots": [{ "name": "anna", "type": "thymio2", "at": [0.5, 0.5], "script": "count.aesl" }]
})";
constexpr std::string_view kScript = R"(var down var up
onevent button.center
if button.center == 1 then
down += 1
else
up += 1
end
)";

class ButtonsTest : public testing::Test {
protected:
    ButtonsTest() {
        folder.write("count.aesl", kScript);
        auto opened = session::open_sim(folder.write("w.world.json", kWorld), {});
        EXPECT_TRUE(opened.ok());
        session.emplace(std::move(opened.value()));
        EXPECT_TRUE(session->settle());
    }
    sim::World& world() { return session->world(); }
    Status say(bool down) { return buttons.press(world(), {0, "anna", "center", down}); }
    void pass(int milliseconds) {
        for (int i = 0; i < milliseconds; ++i) {
            buttons.release_due(world());
            session->step(1ms);
        }
    }
    std::string seen() {
        const auto words = [this](std::string_view name) {
            for (const aesl::VariablePlace& place : session->program(1)->variables) {
                if (place.name == name) return world().variables_of(1)[place.address];
            }
            return int16_t{-1};
        };
        return std::to_string(words("down")) + " down, " + std::to_string(words("up")) + " up";
    }

    test::Folder folder;
    std::optional<session::SimSession> session;
    Buttons buttons;
};

TEST_F(ButtonsTest, AClickWithinOneInstantIsSeen) {
    ASSERT_TRUE(say(true).ok());
    ASSERT_TRUE(say(false).ok());
    pass(50);
    EXPECT_EQ(seen(), "1 down, 0 up");
    pass(2);
    EXPECT_EQ(seen(), "1 down, 1 up");
    pass(100);
    EXPECT_EQ(seen(), "1 down, 1 up");
}

TEST_F(ButtonsTest, AButtonThatIsHeldIsUpAsSoonAsItIsLetGo) {
    ASSERT_TRUE(say(true).ok());
    pass(60);
    EXPECT_EQ(seen(), "1 down, 0 up");
    ASSERT_TRUE(say(false).ok());
    pass(2);
    EXPECT_EQ(seen(), "1 down, 1 up");
}

TEST_F(ButtonsTest, AClickBehindAClickEndsAtItsOwnTime) {
    ASSERT_TRUE(say(true).ok());
    ASSERT_TRUE(say(false).ok());
    pass(20);
    ASSERT_TRUE(say(true).ok());
    pass(40);
    // The second is held: the time of the first does not end it.
    EXPECT_EQ(seen().substr(0, 6), "2 down");
    ASSERT_TRUE(say(false).ok());
    pass(12);
    EXPECT_EQ(seen(), "2 down, 1 up");
}

TEST_F(ButtonsTest, WhoIsNotThereIsAnError) {
    EXPECT_FALSE(buttons.press(world(), {0, "nobody", "center", true}).ok());
    EXPECT_FALSE(buttons.press(world(), {0, "nobody", "center", false}).ok());
    EXPECT_FALSE(buttons.press(world(), {0, "anna", "escape", true}).ok());
}

}  // namespace
}  // namespace vagus::serve
