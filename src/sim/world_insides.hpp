// What a World consists of: for world.cpp, which passes its time, and world_acts.cpp, which acts on
// it from outside. Nobody else includes it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sim/crew.hpp"
#include "sim/inhabitants.hpp"
#include "sim/node_turns.hpp"
#include "sim/world.hpp"

namespace vagus::sim {

struct World::Insides {
    Insides(WorldDefinition its_definition, Picture its_picture, WorldOptions its_options);

    void populate();
    void forget_happenings();
    void begin_instant();
    void end_instant();
    void hold_instant();
    void run_timeline();
    void act(const Action& action);
    Status open_chaos(Chaos of);
    void pass_chaos();
    uint64_t seed() const { return reseeded.value_or(options.seed.value_or(definition.seed)); }
    void note_frame(size_t robot, const wire::Frame& frame);
    void move_bodies();
    void note_touches();
    void note(size_t robot, decltype(Happening::what) what, uint16_t node = 0);
    void note(RobotId robot, decltype(Happening::what) what, uint16_t node = 0);
    void knock(size_t index);
    void push_button(size_t index, std::string_view button, bool pressed);
    Status set_button(RobotId id, std::string_view button, bool pressed);
    Status move_robot(RobotId robot, const Pose& to);
    Status tap(RobotId robot);
    Status do_act(const Act& act);
    Robot& robot(size_t index) { return *inhabitants->robots()[index]; }

    WorldDefinition definition;
    Picture picture;
    WorldOptions options;
    std::unique_ptr<Inhabitants> inhabitants;
    hub::Hub bus;
    bool somebody_sees_colours;  // else nobody asks which they are
    bool clock_stops_with_nodes = false;
    Crew crew;
    NodeTurns turns;
    std::optional<NodeChaos> chaos;    // nothing: nothing breaks
    std::optional<uint64_t> reseeded;  // since time 0
    size_t timeline_next = 0;
    Time now{};
    Duration rest{};  // asked for, but less than a step
    std::vector<Happening> happenings;
    uint64_t happenings_lost = 0;
    std::function<void(const Act&)> told_of_act;
    std::function<void(size_t)> told_of_timeline;
};

// A handle from outside as an index, checked.
inline std::optional<size_t> index_of(const WorldDefinition& definition, RobotId robot) {
    if (robot.number == 0 || robot.number > definition.robots.size()) return std::nullopt;
    return robot.number - 1;
}

inline Error no_robot() {
    return {Code::NotFound, "there is no such robot in this world; look it up by its name"};
}

}  // namespace vagus::sim
