#include "sim/world.hpp"

#include <algorithm>
#include <array>

#include "base/file.hpp"
#include "base/project_border.hpp"
#include "base/trig.hpp"
#include "sim/camera.hpp"
#include "sim/frame_notes.hpp"
#include "sim/frames_for_others.hpp"
#include "sim/inhabitants.hpp"
#include "sim/node_bus.hpp"
#include "sim/world_check.hpp"
#include "sim/world_file.hpp"

namespace vagus::sim {

// One node's places on the bus.
struct Berth {
    size_t robot = 0;          // index of the robot it belongs to
    size_t place = 0;          // among its machines
    hub::LinkId link;          // on the bus of all, if that is ideal
    hub::LinkId private_link;  // on that behind the robot's own port, if it has one
    FramesForOthers for_others = {};
};

// How a frame leaves its node when the bus is modelled.
enum class Crossing : uint8_t { Timed, AtOnce };

struct World::Insides {
    Insides(WorldDefinition its_definition, Picture its_picture, WorldOptions its_options)
        : definition(std::move(its_definition)),
          picture(std::move(its_picture)),
          options(std::move(its_options)) {}

    Status join_bus();
    void populate();
    void join_nodes();
    void forget_happenings();
    void begin_instant();
    void end_instant();
    void hold_instant();
    void run_timeline();
    void act(const Action& action);
    void deliver(size_t index);
    void collect(size_t index, Crossing crossing);
    void note_frame(size_t robot, const wire::Frame& frame);
    void move_bodies();
    void note_touches();
    void note(size_t robot, decltype(Happening::what) what, uint16_t node = 0);
    Status set_button(RobotId id, std::string_view button, bool pressed);
    Robot& robot(size_t index) { return *inhabitants->robots()[index]; }
    Machine& machine(const Berth& berth) { return *robot(berth.robot).machines()[berth.place]; }

    WorldDefinition definition;
    Picture picture;
    WorldOptions options;
    std::unique_ptr<Inhabitants> inhabitants;
    hub::Hub bus;
    std::optional<NodeBus> node_bus;  // between the nodes and `bus`, if it is a Can
    std::vector<Berth> berths;        // by ascending node id
    std::vector<size_t> by_node;      // indices of robots by ascending node id
    std::vector<std::unique_ptr<hub::Hub>> private_buses;  // by index of the robot
    size_t timeline_next = 0;
    Time now{};
    Duration rest{};  // asked for, but less than a step
    std::vector<Happening> happenings;
    uint64_t happenings_lost = 0;
};

Result<World> World::load(std::string_view text, std::string_view file, WorldOptions options) {
    Result<World> world = create(TRY(read_world(text, file)), std::move(options));
    if (world.ok()) return world;
    return error_in_world(world.error(), text, file);
}

namespace {

// A Carbot is made for it.
BusModel bus_of(const WorldDefinition& definition) {
    const bool has_carbot =
        std::any_of(definition.robots.begin(), definition.robots.end(),
                    [](const RobotDefinition& robot) { return robot.type == RobotType::Carbot; });
    return has_carbot ? BusModel::Can : BusModel::Ideal;
}

// A CAN identifier has eight bits for the source.
Status check_can(const WorldDefinition& definition) {
    for (size_t i = 0; i < definition.robots.size(); ++i) {
        const RobotDefinition& robot = definition.robots[i];
        const int last = robot.node + nodes_of(robot.type) - 1;
        if (last <= wire::kCanSourceMax) continue;
        return Error{Code::BadInput, "robots[" + std::to_string(i) + "].node: expected ids up to " +
                                         std::to_string(wire::kCanSourceMax) +
                                         ", for a CAN bus carries no others; found " +
                                         std::to_string(last) + "; give robot " + robot.name +
                                         " a smaller one"};
    }
    return Status::done();
}

Result<Picture> read_ground(const std::string& folder, const std::string& named) {
    const std::string path = TRY(path_beside(folder + "/.", named));
    const std::string bytes = TRY(read_file(path));
    return read_png(bytes, path);
}

}  // namespace

Result<World> World::create(WorldDefinition definition, WorldOptions options) {
    const Status checked = check_world(definition);
    if (!checked.ok()) return checked.error();
    options.bus = options.bus.value_or(bus_of(definition));
    if (options.bus == BusModel::Can) {
        const Status fits = check_can(definition);
        if (!fits.ok()) return fits.error();
    }
    Picture picture;
    if (!definition.ground_image.empty()) {
        Result<Picture> read = read_ground(options.folder, definition.ground_image);
        if (!read.ok()) return Error{read.error().code, "ground.image: " + read.error().what};
        picture = std::move(read.value());
    }
    auto insides =
        std::make_unique<Insides>(std::move(definition), std::move(picture), std::move(options));
    const Status joined = insides->join_bus();
    if (!joined.ok()) return joined.error();
    insides->populate();
    return World(std::move(insides));
}

World::World(std::unique_ptr<Insides> insides) : insides_(std::move(insides)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Status World::Insides::join_bus() {
    for (size_t i = 0; i < definition.robots.size(); ++i) by_node.push_back(i);
    std::sort(by_node.begin(), by_node.end(), [this](size_t a, size_t b) {
        return definition.robots[a].node < definition.robots[b].node;
    });
    private_buses.resize(definition.robots.size());
    if (options.bus == BusModel::Can) node_bus.emplace(bus, TRY(bus.add({.name = "nodes"})));
    for (const size_t index : by_node) {
        const RobotDefinition& robot = definition.robots[index];
        if (robot.port) private_buses[index] = std::make_unique<hub::Hub>();
        for (size_t place = 0; place < nodes_of(robot.type); ++place) {
            Berth berth{index, place, {}, {}, {}};
            const auto id = static_cast<uint16_t>(robot.node + place);
            const hub::LinkOptions link{.name = robot.name, .only_node = id};
            if (!node_bus) berth.link = TRY(bus.add(link));
            if (robot.port) berth.private_link = TRY(private_buses[index]->add(link));
            berths.push_back(berth);
        }
    }
    return Status::done();
}

void World::Insides::populate() {
    const uint32_t next_object = inhabitants ? inhabitants->next_object() : 1;
    inhabitants = std::make_unique<Inhabitants>(definition, picture, options, next_object);
    now = Time{};
    rest = Duration{};
    timeline_next = 0;
    join_nodes();
    run_timeline();
}

// With the names that their descriptions give them; those of one robot among several have its name
// before them.
void World::Insides::join_nodes() {
    if (!node_bus) return;
    if (node_bus->size() > 0) {
        node_bus->reset();
        return;
    }
    for (const Berth& berth : berths) {
        const std::string& name = definition.robots[berth.robot].name;
        const std::string prefix = definition.robots.size() > 1 ? name + "/" : "";
        node_bus->join(machine(berth).id(), prefix + machine(berth).name());
    }
}

// ---- Time ----

void World::step(Duration span) {
    insides_->forget_happenings();
    insides_->rest += span;
    while (insides_->rest >= kNodeStep) {
        insides_->rest -= kNodeStep;
        insides_->begin_instant();
        insides_->end_instant();
    }
}

void World::begin_instant() {
    insides_->forget_happenings();
    insides_->begin_instant();
}

void World::end_instant() {
    insides_->end_instant();
}

void World::hold_instant() {
    insides_->forget_happenings();
    insides_->hold_instant();
}

void World::Insides::forget_happenings() {
    happenings.clear();
    happenings_lost = 0;
}

// One instant: timeline, deliveries, nodes by id, bodies. What nodes send is delivered at the next.
void World::Insides::begin_instant() {
    if (node_bus) node_bus->accept(now);
    now += kNodeStep;
    run_timeline();
    if (node_bus) node_bus->advance(now);
    for (size_t i = 0; i < berths.size(); ++i) deliver(i);
    inhabitants->arena().prepare_looks();
    const Surroundings around = {inhabitants->arena(), inhabitants->ground(),
                                 inhabitants->colours(), inhabitants->beacons(), now};
    for (const size_t index : by_node) {
        robot(index).sense(around);
        for (Machine* const machine : robot(index).machines()) machine->run();
    }
    for (size_t i = 0; i < berths.size(); ++i) collect(i, Crossing::Timed);
}

void World::Insides::end_instant() {
    if (now % kPhysicsStep == Duration::zero()) move_bodies();
}

// No time passes, so a modelled bus cannot carry anything: what there is to say is said beside it.
void World::Insides::hold_instant() {
    if (node_bus) node_bus->accept_at_once();
    for (size_t i = 0; i < berths.size(); ++i) deliver(i);
    for (const Berth& berth : berths) machine(berth).run();
    for (size_t i = 0; i < berths.size(); ++i) collect(i, Crossing::AtOnce);
}

void World::Insides::run_timeline() {
    while (timeline_next < definition.timeline.size() &&
           definition.timeline[timeline_next].at <= now)
        act(definition.timeline[timeline_next++].action);
}

namespace {

size_t index_of(const WorldDefinition& definition, std::string_view robot) {
    const auto found =
        std::find_if(definition.robots.begin(), definition.robots.end(),
                     [robot](const RobotDefinition& each) { return each.name == robot; });
    return static_cast<size_t>(found - definition.robots.begin());
}

}  // namespace

// What a hand from outside has taken away before its entry came is left alone.
void World::Insides::act(const Action& action) {
    Inhabitants& all = *inhabitants;
    const auto with_object = [&all](const std::string& id, const auto& act_on) {
        if (const auto object = all.find(id)) (void)act_on(*object);
    };
    if (const auto* add = std::get_if<AddObject>(&action)) (void)all.add(add->object);
    if (const auto* remove = std::get_if<RemoveObject>(&action))
        with_object(remove->id, [&all](ObjectId id) { return all.remove(id); });
    if (const auto* light = std::get_if<SwitchLight>(&action))
        with_object(light->id, [&](ObjectId id) { return all.switch_light(id, light->on); });
    if (const auto* press = std::get_if<PressButton>(&action))
        robot(index_of(definition, press->robot)).set_button(press->button, press->pressed);
    const auto* move = std::get_if<MoveObject>(&action);
    if (move == nullptr) return;
    const size_t moved = index_of(definition, move->id);
    if (moved < definition.robots.size()) {
        const double angle = all.arena().pose(robot(moved).body()).angle;
        all.move_robot(moved, {move->at, move->angle.value_or(angle)});
        return;
    }
    for (const Object& object : all.objects()) {
        if (object.definition.id != move->id) continue;
        (void)all.move(object.id, {move->at, move->angle.value_or(all.pose_of(object).angle)});
        return;
    }
}

// ---- The bus ----

void World::Insides::deliver(size_t index) {
    Berth& berth = berths[index];
    Machine& node = machine(berth);
    node.begin_millisecond();
    wire::Frame frame;
    const auto take = [&] {
        return node_bus ? node_bus->take(index, frame) : bus.take(berth.link, frame);
    };
    while (node.wants_frame() && take()) {
        if (!berth.for_others.take(frame)) node.receive(frame);
    }
    hub::Hub* const own_bus = private_buses[berth.robot].get();
    if (own_bus == nullptr) return;
    while (node.wants_frame() && own_bus->take(berth.private_link, frame)) node.receive(frame);
}

void World::Insides::collect(size_t index, Crossing crossing) {
    const Berth& berth = berths[index];
    std::vector<wire::Frame>& sent = machine(berth).sent();
    hub::Hub* const own_bus = private_buses[berth.robot].get();
    for (const wire::Frame& frame : sent) {
        if (!node_bus)
            bus.receive(berth.link, frame);
        else if (crossing == Crossing::Timed)
            node_bus->send(index, frame, now);
        else
            node_bus->send_at_once(index, frame);
        if (own_bus != nullptr) own_bus->receive(berth.private_link, frame);
        note_frame(berth.robot, frame);
    }
    sent.clear();
}

void World::Insides::note_frame(size_t index, const wire::Frame& frame) {
    if (auto emitted = emitted_in(frame))
        note(index, std::move(*emitted), frame.source);
    else if (auto fault = fault_in(frame))
        note(index, std::move(*fault), frame.source);
}

void World::Insides::note(size_t index, decltype(Happening::what) what, uint16_t node) {
    if (happenings.size() < kHappeningsMax) {
        happenings.push_back(
            {now, RobotId{static_cast<uint32_t>(index) + 1}, node, std::move(what)});
    } else {
        ++happenings_lost;
    }
}

// ---- Bodies ----

void World::Insides::move_bodies() {
    Arena& arena = inhabitants->arena();
    for (const auto& each : inhabitants->robots()) each->drive(arena);
    arena.step();
    note_touches();
    if (now % kPoseEvery != Duration::zero()) return;
    for (size_t i = 0; i < definition.robots.size(); ++i)
        note(i, PoseNote{arena.pose(robot(i).body())});
}

void World::Insides::note_touches() {
    for (const Touch& touch : inhabitants->arena().touches()) {
        const std::array<std::array<BodyId, 2>, 2> ways = {
            {{touch.a, touch.b}, {touch.b, touch.a}}};
        for (const auto& [self, other] : ways) {
            const auto index = inhabitants->robot_of(self);
            if (!index) continue;
            robot(*index).knock();
            note(*index, Contact{inhabitants->name_of(other)});
        }
    }
}

// ---- The public side ----

Time World::now() const {
    return insides_->now;
}

void World::reset() {
    wire::Frame frame;
    for (Berth& berth : insides_->berths) {
        berth.for_others.clear();
        while (!insides_->node_bus && insides_->bus.take(berth.link, frame)) {
        }
        hub::Hub* const own_bus = insides_->private_buses[berth.robot].get();
        while (own_bus != nullptr && own_bus->take(berth.private_link, frame)) {
        }
    }
    insides_->happenings.clear();
    insides_->populate();
}

std::span<const Happening> World::happenings() const {
    return insides_->happenings;
}

uint64_t World::happenings_lost() const {
    return insides_->happenings_lost;
}

hub::Hub& World::bus() {
    return insides_->bus;
}

void World::send_to(RobotId robot, hub::LinkId host, const wire::Frame& frame) {
    for (Berth& berth : insides_->berths) {
        if (berth.robot + 1 != robot.number) berth.for_others.add(frame);
    }
    insides_->bus.receive(host, frame);
}

std::optional<BusLoad> World::bus_load() const {
    if (!insides_->node_bus) return std::nullopt;
    return insides_->node_bus->load();
}

namespace {

// A handle from outside as an index, checked.
std::optional<size_t> index_of(const WorldDefinition& definition, RobotId robot) {
    if (robot.number == 0 || robot.number > definition.robots.size()) return std::nullopt;
    return robot.number - 1;
}

Error no_robot() {
    return {Code::NotFound, "there is no such robot in this world; look it up by its name"};
}

}  // namespace

hub::Hub* World::private_bus(RobotId robot) {
    const auto index = index_of(insides_->definition, robot);
    return index ? insides_->private_buses[*index].get() : nullptr;
}

void World::host_left(RobotId robot) {
    const auto index = index_of(insides_->definition, robot);
    if (!index) return;
    for (Machine* const machine : insides_->robot(*index).machines()) machine->host_left();
}

const WorldDefinition& World::definition() const {
    return insides_->definition;
}

std::vector<RobotView> World::robots() const {
    std::vector<RobotView> views;
    for (size_t i = 0; i < insides_->definition.robots.size(); ++i) {
        const RobotDefinition& robot = insides_->definition.robots[i];
        views.push_back({.id = {static_cast<uint32_t>(i) + 1},
                         .name = robot.name,
                         .type = robot.type,
                         .node = robot.node,
                         .nodes = nodes_of(robot.type),
                         .pose = insides_->inhabitants->arena().pose(insides_->robot(i).body()),
                         .paint = robot.paint,
                         .outline = insides_->robot(i).outline()});
    }
    return views;
}

std::vector<ObjectView> World::objects() const {
    std::vector<ObjectView> views;
    for (const Object& object : insides_->inhabitants->objects()) {
        views.push_back(
            {object.id, &object.definition, insides_->inhabitants->pose_of(object), object.on});
    }
    return views;
}

std::vector<Lamp> World::lamps(RobotId robot) const {
    const auto index = index_of(insides_->definition, robot);
    return index ? insides_->robot(*index).lamps() : std::vector<Lamp>{};
}

std::vector<Beam> World::beams(RobotId robot) const {
    const auto index = index_of(insides_->definition, robot);
    if (!index) return {};
    Arena& arena = insides_->inhabitants->arena();
    arena.prepare_looks();
    return insides_->robot(*index).beams(arena);
}

bool World::has_camera(RobotId robot) const {
    const auto index = index_of(insides_->definition, robot);
    return index && insides_->robot(*index).camera();
}

Result<Picture> World::render(RobotId robot) const {
    const auto index = index_of(insides_->definition, robot);
    if (!index) return no_robot();
    Inhabitants& all = *insides_->inhabitants;
    const std::optional<Point> place = insides_->robot(*index).camera();
    if (!place) {
        return Error{Code::NotFound,
                     insides_->definition.robots[*index].name + " has no camera; a carbot has one"};
    }
    const BodyId body = insides_->robot(*index).body();
    const Pose pose = all.arena().pose(body);
    const double cosine = trig::cos(pose.angle);
    const double sine = trig::sin(pose.angle);
    const Point at = {pose.at.x + cosine * place->x - sine * place->y,
                      pose.at.y + sine * place->x + cosine * place->y};
    return sim::render({all.arena(), all.ground(), all.colours()}, body, {at, pose.angle});
}

Colour World::ground_at(Point at) const {
    return insides_->inhabitants->ground().colour_at(at);
}

std::optional<RobotId> World::find_robot(std::string_view name) const {
    const size_t index = index_of(insides_->definition, name);
    if (index == insides_->definition.robots.size()) return std::nullopt;
    return RobotId{static_cast<uint32_t>(index) + 1};
}

std::optional<ObjectId> World::find_object(std::string_view id) const {
    return insides_->inhabitants->find(id);
}

std::span<const int16_t> World::variables(RobotId robot) const {
    const auto index = index_of(insides_->definition, robot);
    return index ? variables_of(insides_->definition.robots[*index].node)
                 : std::span<const int16_t>();
}

std::span<const int16_t> World::variables_of(uint16_t node) const {
    const auto& berths = insides_->berths;
    const auto found = std::lower_bound(
        berths.begin(), berths.end(), node,
        [this](const Berth& berth, uint16_t id) { return insides_->machine(berth).id() < id; });
    if (found == berths.end() || insides_->machine(*found).id() != node) return {};
    return insides_->machine(*found).variables();
}

Result<ObjectId> World::add(const ObjectDefinition& object) {
    if (find_robot(object.id)) {
        return Error{Code::Refused, "\"" + object.id + "\" is the name of a robot; choose another"};
    }
    return insides_->inhabitants->add(object);
}

Status World::remove(ObjectId object) {
    return insides_->inhabitants->remove(object);
}

Status World::move(ObjectId object, const Pose& to) {
    return insides_->inhabitants->move(object, to);
}

Status World::move(RobotId robot, const Pose& to) {
    const auto index = index_of(insides_->definition, robot);
    if (!index) return no_robot();
    const auto is_far = [](double value) {
        return !(value >= -kWorldSizeMax && value <= 2 * kWorldSizeMax);
    };
    if (is_far(to.at.x) || is_far(to.at.y) || !(to.angle >= -kAngleMax && to.angle <= kAngleMax)) {
        return Error{Code::BadInput,
                     "the robot would stand outside of every world; places are in "
                     "metres, angles in radians"};
    }
    insides_->inhabitants->move_robot(*index, to);
    return Status::done();
}

Status World::switch_light(ObjectId light, bool on) {
    return insides_->inhabitants->switch_light(light, on);
}

Status World::Insides::set_button(RobotId id, std::string_view button, bool pressed) {
    const auto index = index_of(definition, id);
    if (!index) return no_robot();
    const auto names = buttons_of(definition.robots[*index].type);
    if (std::find(names.begin(), names.end(), button) == names.end()) {
        std::string all;
        for (const std::string_view name : names)
            all += (all.empty() ? "" : ", ") + std::string(name);
        return Error{Code::NotFound, definition.robots[*index].name + " has no button \"" +
                                         std::string(button) +
                                         "\"; it has: " + (all.empty() ? "none" : all)};
    }
    robot(*index).set_button(button, pressed);
    return Status::done();
}

Status World::press(RobotId robot, std::string_view button) {
    return insides_->set_button(robot, button, true);
}

Status World::release(RobotId robot, std::string_view button) {
    return insides_->set_button(robot, button, false);
}

Status World::tap(RobotId robot) {
    const auto index = index_of(insides_->definition, robot);
    if (!index) return no_robot();
    insides_->robot(*index).knock();
    return Status::done();
}

}  // namespace vagus::sim
