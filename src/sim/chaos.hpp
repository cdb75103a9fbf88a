// Faults that a run is to survive, as plain data: what breaks, where, from when to when. A world
// carries them out (world.hpp); docs/testing.md, "Chaos", says what each kind means.
//
//     WorldOptions options;
//     options.chaos.faults.push_back({.kind = ChaosKind::Unplugged,
//                                     .where = "drive",
//                                     .from = std::chrono::seconds(3),
//                                     .until = std::chrono::seconds(5)});
//     for (const ChaosFault& fault : options.chaos.faults) show(began_sentence(fault));
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "base/result.hpp"
#include "base/time.hpp"

namespace vagus::sim {

constexpr size_t kChaosFaultsMax = 1000;                     // of one run
constexpr double kChaosTimeMax = 1e6;                        // s: when a fault begins or ends
constexpr double kChaosDelayMax = 60;                        // s: how late a link is
constexpr double kChaosNoiseMax = 32767;                     // in units of the sensor
constexpr double kChaosMixUnlessSaid = 0.05;                 // s: how long a frame is held back
constexpr size_t kChaosDrawnMax = 100;                       // faults of one random set
constexpr Duration kChaosWithin = std::chrono::seconds(20);  // a random set begins, unless told

// How long a node that hangs is left alone by its watchdog (insight, section 6).
constexpr Duration kWatchdog = std::chrono::milliseconds(100);

// What stands for the computer that the plan runs on, as the place of a fault.
constexpr std::string_view kMainComputer = "main";

enum class ChaosKind : uint8_t {
    Lost,       // of a link: frames are lost, both ways
    Doubled,    // of a link: frames arrive twice
    Delayed,    // of a link: frames arrive later, in their order
    Reordered,  // of a link: frames are held back, and others pass them
    Reset,      // of a node: as switched off and on, its program is saved
    Hung,       // of a node: it executes nothing until its watchdog resets it
    Unplugged,  // of a node: no frame gets to it or from it
    Stuck,      // of a sensor: it keeps its values
    Noisy,      // of a sensor: its values are wrong at random
    Dead,       // of a sensor: it reads 0
    Slow,       // of the main computer: it hears and says everything later
};

struct ChaosFault {
    ChaosKind kind = ChaosKind::Lost;
    // The node, "drive", of one robot among several "carbot/drive"; of links also kMainComputer, of
    // a robot with a project "ROBOT/main". Of Slow: empty, or "ROBOT/main".
    std::string where = {};
    std::string sensor = {};  // a variable of the node: Stuck, Noisy, Dead
    Time from{};
    std::optional<Time> until = {};  // empty: to the end of the run. Not of Reset and Hung
    double chance = 1;               // of each frame: Lost, Doubled, Reordered
    double by = 0;      // s: Delayed, Reordered (at most), Slow; Noisy: the standard deviation
    uint64_t seed = 1;  // of what is random in it, together with the seed of the world
    Place place = {};   // in its file
};

// A set that the world draws by itself, from the nodes and sensors that it has.
struct ChaosDraw {
    size_t count = 1;
    std::optional<uint64_t> seed = {};  // empty: that of the world
    Duration within = kChaosWithin;     // they begin by then
    std::vector<ChaosKind> kinds = {};  // of these only; empty: of all
};

struct Chaos {
    std::string file = "chaos";  // for the sentences of errors
    std::vector<ChaosFault> faults = {};
    std::optional<ChaosDraw> draw = {};  // added to the faults

    bool empty() const { return faults.empty() && !draw; }
};

// What a fault can be done to.
struct ChaosTarget {
    std::string node;  // as in ChaosFault::where
    std::vector<std::string> sensors;
};

// "lost": as in a file.
std::string_view name_of(ChaosKind kind);
const std::vector<ChaosKind>& chaos_kinds();
// Names with commas between them: "lost,hung". The Error lists those that there are.
Result<std::vector<ChaosKind>> parse_chaos_kinds(std::string_view text);
bool is_of_link(ChaosKind kind);
bool is_of_sensor(ChaosKind kind);
// It happens at one instant, and ends by itself.
bool is_instant(ChaosKind kind);
// When its effect is over; empty: at the end of the run.
std::optional<Time> end_of(const ChaosFault& fault);

// Sentences for people: "the link of drive loses 50 % of its frames", "drive is plugged in again".
std::string began_sentence(const ChaosFault& fault);
std::string ended_sentence(const ChaosFault& fault);

// Of the variables of a node those that tell what it senses: not what a script or a person sets.
bool is_sensor(std::string_view variable);

// What is random in a fault, in one of its streams, in a world of that seed.
uint64_t chaos_seed(const ChaosFault& fault, uint64_t seed, uint64_t stream);

// The same set for the same targets and seed, by the time of their beginnings. Without a place for
// any of the kinds there are none.
std::vector<ChaosFault> draw_chaos(const std::vector<ChaosTarget>& targets, const ChaosDraw& draw,
                                   uint64_t seed);

}  // namespace vagus::sim
