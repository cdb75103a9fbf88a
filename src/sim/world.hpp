// A 2D world seen from above, with robots in it, each robot a set of Aseba nodes on one bus. It is
// told the time and never asks for it, and opens no socket: the same file, seed and calls give the
// same bytes, also on several threads.
//
//     Result<World> loaded = World::load(text, "arena.world.json");
//     World& world = loaded.value();
//     const hub::LinkId host = world.bus().add({.name = "host"}).value();  // a host like any other
//     world.step(std::chrono::milliseconds(30));                           // at any speed
//     for (const Happening& happening : world.happenings()) show(happening);
//     for (const RobotView& robot : world.robots()) draw(robot.outline, robot.pose);
//
// Time runs in milliseconds for the nodes and in steps of kPhysicsStep for the bodies. At one
// instant: the timeline, then deliveries of the bus, then the nodes by ascending id, then the
// bodies (architecture, decision 2).
//
// The world does not know: files, sockets, projects. Its opener loads the robots' scripts
// over the bus, gives the bus its listeners, and puts names to the numbers of events.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "hub/hub.hpp"
#include "sim/can_bus.hpp"
#include "sim/chaos.hpp"
#include "sim/definitions.hpp"
#include "sim/drawing.hpp"
#include "sim/frame_numbers.hpp"
#include "sim/ground.hpp"
#include "sim/witness.hpp"

namespace vagus::sim {

constexpr Duration kPoseEvery = std::chrono::milliseconds(100);  // `pose` lines of the trace
constexpr size_t kHappeningsMax = 100000;  // in one step(); what is beyond is counted, not kept

// Handles; 0 is nothing. That of a robot is its place in the file, from 1. That of an object is
// never used twice, not even over reset().
struct RobotId {
    uint32_t number = 0;
    auto operator<=>(const RobotId&) const = default;
};
struct ObjectId {
    uint32_t number = 0;
    auto operator<=>(const ObjectId&) const = default;
};

// How frames get from node to node.
enum class BusModel : uint8_t {
    Ideal,  // at the next millisecond, however many
    Can,    // over a CAN bus of 1 Mbit/s with all its nodes on it (can_bus.hpp)
};

// Where a robot begins instead of where its file says.
struct RobotStart {
    std::string robot;  // its name
    Pose pose;
};

struct WorldOptions {
    std::optional<uint64_t> seed = {};  // instead of that of the file
    std::vector<RobotStart> starts = {};
    std::string folder = ".";          // where paths of the file start
    std::string sd_folder = {};        // the card of every robot that has a slot; empty: no card
    std::optional<BusModel> bus = {};  // of each bus; empty: Can with a Carbot, otherwise Ideal
    // How many threads sense and run scripts, 1 to kThreadsMax; empty: one for a few robots; for
    // many, there is one for each processor, and the first is alone until use_one_thread(false).
    // The bytes are the same. Robots that share something, a folder of cards or the energy of
    // e-pucks, always have one.
    std::optional<unsigned> threads = {};
    Chaos chaos = {};  // what breaks; empty: nothing
};

// ---- What there is to draw. Everything in metres and radians. ----

struct RobotView {
    RobotId id;
    std::string_view name;  // views and spans here: valid until the world is changed or stepped
    RobotType type = RobotType::Thymio2;
    uint16_t node = 0;     // its first one
    uint16_t nodes = 1;    // how many it has, with neighbouring ids
    bool own_bus = false;  // they are not on the common bus: it has a project of its own
    Pose pose;
    Colour paint;
    // A convex polygon in the frame of the robot, counter-clockwise.
    std::span<const Point> outline;
};

struct ObjectView {
    ObjectId id;
    const ObjectDefinition* definition = nullptr;  // as it was added; borrowed as above
    Pose pose;                                     // where it is now
    bool on = true;                                // lights and beacons
};

// ---- What happened in a step ----

// A node sent a user event.
struct Emitted {
    std::vector<int16_t> arguments;
    uint16_t event = 0;
};
// A script did what it must not, and is paused.
struct Fault {
    std::string what;  // "division by zero at 12"
    uint16_t pc = 0;
};
// Where a robot is, every kPoseEvery.
struct PoseNote {
    Pose pose;
};
// A robot has begun to touch something.
struct Contact {
    std::string with;  // name of a robot, id of an object, or "border"; "" for an object without id
};
// A fault of WorldOptions::chaos has begun, or is over.
struct ChaosNote {
    std::string what;  // "drive is unplugged"
    size_t fault = 0;  // of World::chaos()
    bool begins = true;
};
struct Happening {
    Time at{};
    RobotId robot;      // ChaosNote of a main computer: nobody
    uint16_t node = 0;  // Emitted and Fault: the node concerned
    std::variant<Emitted, Fault, PoseNote, Contact, ChaosNote> what;
};

// What the nodes put on a bus of model Can. The first of `nodes` is the one place on it that all
// hosts share, called "main", node 0; then come the nodes by id.
struct NodeLoad {
    uint16_t node = 0;
    CanLoad load;
};
struct BusLoad {
    CanLoad all;
    std::vector<NodeLoad> nodes;
};

// What a node executes: so many instructions since its handler began, and where it is.
struct RunningHandler {
    uint64_t instructions = 0;
    uint16_t pc = 0;
};

// What is done to a world from outside, as by a hand from above: what World::act() does, and
// those below that are named as its kinds.
struct Act {
    enum class Kind : uint8_t { Press, Release, Tap, MoveRobot, Move, Remove, Light, Put };
    Kind kind = Kind::Tap;
    RobotId robot = {};         // Press, Release, Tap, MoveRobot
    ObjectId object = {};       // Move, Remove, Light
    std::string button = {};    // Press, Release
    Pose to = {};               // MoveRobot, Move
    bool on = false;            // Light
    ObjectDefinition put = {};  // Put
};

class World {
public:
    // From the text of a world file; `file` is for the sentences of errors. Reads the ground image,
    // if there is one.
    static Result<World> load(std::string_view text, std::string_view file,
                              WorldOptions options = {});
    static Result<World> create(WorldDefinition definition, WorldOptions options = {});
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    ~World();

    // Lets `span` pass. Whole kNodeStep are simulated; the rest is kept for the next call.
    void step(Duration span);
    // One kNodeStep in two halves, for code with something of its own at each instant after the
    // nodes and before the bodies: a plan. Call them in turn; happenings() are those of both.
    //
    //     world.begin_instant();   // time + 1 ms, timeline, deliveries, nodes, what they sent
    //     plan.look(world.now());  // what it sends is delivered at the next instant
    //     world.end_instant();     // bodies
    void begin_instant();
    void end_instant();
    // A kNodeStep in which no time passes: frames are delivered and scripts run, while timeline,
    // sensors, timers and bodies are paused. So scripts can be loaded before the time 0 of a run.
    void hold_instant();
    Time now() const;
    // Its owner does not step it while a node is paused, but for the moment that it
    // takes to notice: so a pause ends no driving command (sim/carbot/gate.hpp).
    void stops_with_nodes();
    // Everything as at the start, time 0; the links of the bus stay, scripts and variables are
    // gone.
    void reset();
    // What the last step() saw, by time. `lost` are those beyond kHappeningsMax.
    std::span<const Happening> happenings() const;
    uint64_t happenings_lost() const;

    // ---- The bus ----
    // All nodes of all robots are on it, but for those with a bus of their own. Add links for
    // hosts, for sockets (net), for tests; frames for the robots go through it.
    //
    // Over a Can bus a frame arrives at the first millisecond at or after the end of its
    // transmission, never before the next one. What a host sends begins its way at the time of the
    // last step; what the bus has no room for waits in the hub, bounded as for any link.
    hub::Hub& bus();
    // The bus that the robot's nodes are on: its own if it has a project, else that of all.
    hub::Hub& bus_of(RobotId robot);
    // What a host says to one robot of several: the frame goes over the bus as any other, hosts see
    // it, but the nodes of other robots do not take it.
    void send_to(RobotId robot, hub::LinkId host, const wire::Frame& frame);
    // Of the common bus, or of that of the robot. Empty if it is ideal.
    std::optional<BusLoad> bus_load() const;
    std::optional<BusLoad> bus_load(RobotId robot) const;
    // The private switch behind the robot's `port`: that robot alone is on it. nullptr if it has no
    // port.
    hub::Hub* private_bus(RobotId robot);
    // The host at the robot's `port` has left or was replaced: its breakpoints go with it (section
    // 1.4).
    void host_left(RobotId robot);

    // How often a node was looked at, all together: one that has nothing to do is not.
    uint64_t turns_taken() const;
    unsigned threads() const;
    // From now on one thread steps the world, or all of threads() do: the caller chooses by how
    // long each takes (thread_choice.hpp). The bytes are the same.
    void use_one_thread(bool one);

    // ---- Looking ----
    const WorldDefinition& definition() const;  // as it was loaded
    std::vector<RobotView> robots() const;      // in the order of the file
    std::vector<ObjectView> objects() const;    // in the order of their adding
    std::vector<Lamp> lamps(RobotId robot) const;
    std::vector<Beam> beams(RobotId robot) const;  // distance sensors as they are now
    bool has_camera(RobotId robot) const;
    // What the robot's camera sees now (camera.hpp). Fails with NotFound if it has none.
    Result<Picture> render(RobotId robot) const;
    Colour ground_at(Point at) const;
    // Something solid touches the robot's body.
    bool touches(RobotId robot) const;
    std::optional<RobotId> find_robot(std::string_view name) const;
    std::optional<ObjectId> find_object(std::string_view id) const;
    // The variables of the robot's first node, of any of its nodes, of any node on the common bus:
    // for tests and views that do not go over the bus. Empty if there is no such robot or node.
    std::span<const int16_t> variables(RobotId robot) const;
    std::span<const int16_t> variables(RobotId robot, uint16_t node) const;
    std::span<const int16_t> variables_of(uint16_t node) const;
    // What one of the robot's nodes executes now. None: it waits for its next event.
    std::optional<RunningHandler> running_handler(RobotId robot, uint16_t node) const;

    // ---- Acting, as a hand from above. Fails with NotFound, Limit, or BadInput. ----
    Result<ObjectId> add(const ObjectDefinition& object);
    Status remove(ObjectId object);
    Status move(ObjectId object, const Pose& to);
    Status move(RobotId robot, const Pose& to);
    Status switch_light(ObjectId light, bool on);
    // Buttons by name ("forward", "center" …); on an e-puck there are none.
    Status press(RobotId robot, std::string_view button);
    Status release(RobotId robot, std::string_view button);
    // A knock on the body.
    Status tap(RobotId robot);
    // Any of these.
    Status act(const Act& act);
    // Is told of each that was done.
    void on_act(std::function<void(const Act&)> told);

    // ---- Chance ----
    // From now on all that is random here is drawn from another seed, and nothing else changes:
    // noise of sensors, slip of wheels, math.rand of each node, what is random in faults. Each
    // stream is drawn again from the seed and its own place (its robot, node, fault), so the same
    // seed at the same instant gives the same bytes. What was drawn before stays: how a wheel is
    // made, which faults there are. reset() undoes it.
    void reseed(uint64_t seed);

    // ---- What breaks ----
    // The faults of the options, with those that were drawn. Those of main computers are for the
    // world's opener to carry out (host_chaos.hpp): here they are only told.
    const std::vector<ChaosFault>& chaos() const;
    uint64_t chaos_seed() const;  // of the last reseed()
    // What could break.
    std::vector<ChaosTarget> chaos_targets();

    // ---- Recording ----
    // Registers, stack and variables of a node as bytes: equal states give equal bytes. Empty if
    // there is no such node.
    std::string state_of(RobotId robot, uint16_t node) const;

    // ---- Why it happens ----
    // From now on the frames of all buses have numbers (frame_numbers.hpp).
    FrameNumbers& number_frames();
    // nullptr if they have none.
    FrameNumbers* frame_numbers();
    // Follows the scripts instruction by instruction (witness.hpp); nullptr: nobody any more.
    void watch(Witness* witness);
    // Is told of each entry of the timeline that is carried out, by its index in the definition.
    void on_timeline(std::function<void(size_t entry)> told);

private:
    struct Insides;
    explicit World(std::unique_ptr<Insides> insides);
    std::unique_ptr<Insides> insides_;
};

}  // namespace vagus::sim
