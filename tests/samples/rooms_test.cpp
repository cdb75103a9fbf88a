// examples/rooms: in which room Carbot ends, for every room of the plan.
#include <gmock/gmock.h>

#include <functional>

#include "trial.hpp"

namespace vagus::samples {
namespace {

using testing::Contains;

// The middle of each room's share behind its door, as examples/rooms/flat.world.json has them.
struct Room {
    std::string name;
    sim::Point middle;
};
const Room kKitchen{"kitchen", {1.7, 4.9}};
const Room kOffice{"office", {5.3, 4.9}};
const Room kBedroom{"bedroom", {1.7, 1.1}};
const Room kBathroom{"bathroom", {5.3, 1.1}};

// A start that looks 1 degree aside leads 8 cm aside at the far doors.
constexpr double kNearMetres = 0.3;

TrialOptions to_room(const std::string& world, const std::string& room) {
    return {.plan = example("rooms/GoToRoom.plan.json"),
            .world = world,
            .off_metres = 0.05,
            .off_radians = 0.02,
            .set = {{"room", plan::Value(room)}}};
}

void go_to(const Room& room, const std::string& world,
           const std::function<void(const Trial&)>& judge = {}) {
    Worst off("from the middle, m"), took("time, s"), contact("longest contact of the hull, s");
    try_seeds(to_room(world, room.name), [&](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok) << trial.ran.ended.message;
        EXPECT_THAT(trial.ran.states, Contains("tell: Done"));
        const sim::Point& end = trial.ran.way.back().pose.at;
        EXPECT_LT(off.note(metres_between(end, room.middle)), kNearMetres);
        EXPECT_LE(contact.note(seconds(trial.longest_contact())), 2);
        took.note(seconds(trial.ran.way.back().at));
        if (judge) judge(trial);
    });
}

TEST(Rooms, CarbotGoesToEveryRoom) {
    for (const Room& room : {kKitchen, kBedroom, kBathroom}) {
        SCOPED_TRACE(room.name);
        go_to(room, example("rooms/flat.world.json"));
    }
}

// The box in the office's door is removed after a minute.
TEST(Rooms, CarbotWaitsUntilABoxInTheDoorIsGone) {
    go_to(kOffice, example("rooms/flat.world.json"), [](const Trial& trial) {
        EXPECT_THAT(trial.ran.states, Contains("drive! LaneNotFree"));
        EXPECT_GT(seconds(trial.ran.way.back().at), 60);
    });
}

TEST(Rooms, ARoomThatThereIsNotIsTold) {
    try_seeds(to_room(example("rooms/flat.world.json"), "attic"), [](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok);
        EXPECT_THAT(trial.ran.states, Contains("unknownRoom: Done"));
    });
}

// The world for which the plan was not made: the same walls, furnished, with people about.
TEST(Rooms, CarbotGoesToEveryRoomOfAFurnishedFlat) {
    for (const Room& room : {kKitchen, kOffice, kBedroom, kBathroom}) {
        SCOPED_TRACE(room.name);
        go_to(room, test_world("furnished.world.json"));
    }
}

// Its patience is 120 s.
TEST(Rooms, CarbotGivesUpBeforeADoorThatStaysShut) {
    try_seeds(to_room(test_world("shut.world.json"), "kitchen"), [](const Trial& trial) {
        EXPECT_EQ(trial.ran.ended.result, plan::PlanResult::Ok);
        EXPECT_THAT(trial.ran.states, Contains("noWay: Done"));
        EXPECT_LT(trial.ran.way.back().pose.at.y, 3.8) << "it is in the kitchen";
        EXPECT_NEAR(seconds(trial.ran.way.back().at), 120, 1);
    });
}

}  // namespace
}  // namespace vagus::samples
