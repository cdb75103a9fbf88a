// A host beside a world with one robot: sends it driving events, keeps it alive, and notes what it
// hears and when.
//
//     Pilot pilot(carbot_in(room), "carbot/carbot.aesl");
//     pilot.send("drive.forward", {7, 1000, 0, 200});
//     EXPECT_TRUE(pilot.wait_for("drive.arrived", {7}, 10s));
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/sim_session.hpp"

namespace vagus {

struct Heard {
    Time at{};
    std::string event;
    std::vector<int16_t> arguments;
};

class Pilot {
public:
    // The script is a path from examples/.
    Pilot(sim::WorldDefinition world, const std::string& script, uint64_t seed = 1);
    // Its text instead.
    Pilot(sim::WorldDefinition world, const std::string& path, const std::string& text,
          uint64_t seed);
    // Another text of the same script, which goes to the nodes in the next milliseconds.
    void reload(const std::string& text) { session_.reload(path_, text); }

    void send(const std::string& event, const std::vector<int16_t>& arguments);
    // From now on drive.alive comes every 100 ms, with this token.
    void keep_alive(int16_t token) { alive_ = token; }
    void fall_silent() { alive_.reset(); }

    void step(Duration span);
    // Lets time pass until the event comes, at most `span`. False if it did not.
    bool wait_for(const std::string& event, const std::vector<int16_t>& arguments, Duration span);
    // The same with any arguments, which it gives; nothing if it did not come.
    std::optional<std::vector<int16_t>> next(const std::string& event, Duration span);
    // How often it was heard, with these arguments or with any.
    size_t count(const std::string& event, const std::vector<int16_t>& arguments) const;
    size_t count(const std::string& event) const;

    sim::World& world() { return session_.world(); }
    Time now() const { return session_.now(); }
    sim::Pose pose() const;
    // Of a variable of the robot's nodes.
    int16_t variable(const std::string& name, size_t index = 0) const;
    // Lines of all that happened.
    std::string trace() { return session_.take_trace(); }

private:
    void millisecond();

    session::SimSession session_;
    std::string path_;
    std::optional<int16_t> alive_;
    std::vector<Heard> heard_;
};

// The text of a script of examples/.
std::string text_of(const std::string& script);

}  // namespace vagus
