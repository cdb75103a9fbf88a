// One member for tests, and what a broker would say to it, by hand.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fleet/member.hpp"

namespace vagus::fleet {

struct MemberCase {
    static constexpr const char* kFleet = "lab";

    explicit MemberCase(ProjectPart part = {}, const std::string& instance = "i1")
        : member({.fleet = kFleet,
                  .robot = "r1",
                  .instance = instance,
                  .epoch = 7,
                  .project = std::move(part),
                  .description = {"Alarm", "0.1.0", "", "", {}, {}, {}, {}}},
                 0s) {}

    void hear(const LinkEvent& event) {
        member.hear(event, now);
        take();
    }
    void hear(const Topic& topic, const Message& message, bool retained = false) {
        hear(Received{{topic, message}, retained});
    }
    void connection(const std::string& state, const std::string& instance) {
        hear({.kind = Kind::Connection, .robot = "r1"}, Connection{state, instance, 7});
    }
    void question(const std::string& instance) {
        hear({.kind = Kind::Ask, .robot = "r1", .name = "name"}, Ask{instance});
    }
    void name_answer(const std::string& instance) {
        hear({.kind = Kind::Answer, .robot = "r1", .name = "name"},
             Answer{.id = "i1", .done = true, .instance = instance});
    }
    void event(const std::string& robot, const Event& event, const std::string& name = "alarm") {
        hear({.kind = Kind::Event, .robot = robot, .name = name}, event);
    }
    void command(Command command) {
        hear({.kind = Kind::Command, .robot = "r1", .name = command.verb}, command);
    }
    void tick(Time time) {
        now = time;
        member.tick(now);
        take();
    }
    void hold() {
        hear(Connected{});
        question("i1");
        connection("online", "i1");
        ASSERT_EQ(member.standing(), Member::Standing::Holding);
        actions.clear();
    }
    // Another one, i2, has the name.
    void stay_out() {
        hear(Connected{});
        connection("online", "i2");
        name_answer("i2");
        ASSERT_EQ(member.standing(), Member::Standing::Out);
    }
    void take() {
        for (MemberAction& action : member.take()) actions.push_back(std::move(action));
    }

    template <typename Action>
    std::vector<Action> all() const {
        std::vector<Action> list;
        for (const MemberAction& action : actions) {
            if (const auto* one = std::get_if<Action>(&action)) list.push_back(*one);
        }
        return list;
    }
    // What was published, read again as others read it.
    template <typename What>
    std::vector<What> published() const {
        std::vector<What> list;
        for (const Post& post : all<Post>()) {
            const auto heard = read(kFleet, post.topic, post.payload);
            EXPECT_TRUE(heard.ok()) << heard.error().what;
            if (!heard.ok()) continue;
            if (const auto* one = std::get_if<What>(&heard.value().message)) list.push_back(*one);
        }
        return list;
    }
    std::vector<std::string> connections() const {
        std::vector<std::string> list;
        for (const Connection& one : published<Connection>()) list.push_back(one.state);
        return list;
    }

    Time now{};
    Member member;
    std::vector<MemberAction> actions;
};

}  // namespace vagus::fleet
