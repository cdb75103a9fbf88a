#include "sim/world.hpp"

#include <algorithm>
#include <array>
#include <thread>
#include <utility>

#include "base/file.hpp"
#include "base/nearest.hpp"
#include "base/project_border.hpp"
#include "base/trig.hpp"
#include "sim/camera.hpp"
#include "sim/frame_notes.hpp"
#include "sim/world_check.hpp"
#include "sim/world_file.hpp"
#include "sim/world_insides.hpp"

namespace vagus::sim {

namespace {

constexpr size_t kManyRobots = 200;  // from here on more threads gain time

unsigned threads_for(const WorldDefinition& definition, const WorldOptions& options) {
    const auto has_pool = [](const RobotDefinition& robot) {
        return robot.type == RobotType::Epuck;
    };
    const auto& robots = definition.robots;
    if (!options.sd_folder.empty() || std::any_of(robots.begin(), robots.end(), has_pool)) return 1;
    const unsigned many = robots.size() < kManyRobots ? 1 : std::thread::hardware_concurrency();
    return std::clamp(options.threads.value_or(many), 1u, kThreadsMax);
}

}  // namespace

World::Insides::Insides(WorldDefinition its_definition, Picture its_picture,
                        WorldOptions its_options)
    : definition(std::move(its_definition)),
      picture(std::move(its_picture)),
      options(std::move(its_options)),
      somebody_sees_colours(
          std::any_of(definition.robots.begin(), definition.robots.end(),
                      [](const RobotDefinition& each) { return sees_colours(each.type); })),
      crew(threads_for(definition, options)),
      turns(definition, bus,
            [this](size_t index, const wire::Frame& frame) { note_frame(index, frame); }) {}

Result<World> World::load(std::string_view text, std::string_view file, WorldOptions options) {
    Chaos chaos = std::exchange(options.chaos, {});  // its errors are in another file
    Result<World> world = create(TRY(read_world(text, file)), std::move(options));
    if (!world.ok()) return error_in_world(world.error(), text, file);
    TRY(world.value().insides_->open_chaos(std::move(chaos)));
    return world;
}

namespace {

// A CAN identifier has eight bits for the source.
Status check_can(const WorldDefinition& definition, std::optional<BusModel> model) {
    const BusModel common = common_bus_model(definition, model);
    for (size_t i = 0; i < definition.robots.size(); ++i) {
        const RobotDefinition& robot = definition.robots[i];
        const BusModel its = robot.project.empty() ? common : own_bus_model(robot, model);
        if (its != BusModel::Can) continue;
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

namespace {

Status put_at_starts(WorldDefinition& definition, const std::vector<RobotStart>& starts) {
    for (const RobotStart& start : starts) {
        const auto found =
            std::find_if(definition.robots.begin(), definition.robots.end(),
                         [&](const RobotDefinition& robot) { return robot.name == start.robot; });
        if (found == definition.robots.end()) {
            return Error{Code::NotFound, no_robot(definition, start.robot, " in this world")};
        }
        found->at = start.pose.at;
        found->angle = start.pose.angle;
    }
    return Status::done();
}

}  // namespace

Result<World> World::create(WorldDefinition definition, WorldOptions options) {
    TRY(put_at_starts(definition, options.starts));
    const Status checked = check_world(definition);
    if (!checked.ok()) return checked.error();
    const Status fits = check_can(definition, options.bus);
    if (!fits.ok()) return fits.error();
    if (options.threads && (*options.threads < 1 || *options.threads > kThreadsMax)) {
        return Error{Code::BadInput, "threads: expected 1 to " + std::to_string(kThreadsMax) +
                                         ", found " + std::to_string(*options.threads)};
    }
    Picture picture;
    if (!definition.ground_image.empty()) {
        Result<Picture> read = read_ground(options.folder, definition.ground_image);
        if (!read.ok()) return Error{read.error().code, "ground.image: " + read.error().what};
        picture = std::move(read.value());
    }
    auto insides =
        std::make_unique<Insides>(std::move(definition), std::move(picture), std::move(options));
    insides->crew.work_alone(!insides->options.threads);
    const Status joined = insides->turns.join(insides->options.bus);
    if (!joined.ok()) return joined.error();
    insides->populate();
    TRY(insides->open_chaos(std::exchange(insides->options.chaos, {})));
    return World(std::move(insides));
}

Status World::Insides::open_chaos(Chaos of) {
    if (of.empty()) return Status::done();
    chaos.emplace(
        TRY(NodeChaos::make(std::move(of), seed(), turns.chaos_nodes(), turns.own_bus_robots())));
    turns.suffer(&*chaos);
    return Status::done();
}

World::World(std::unique_ptr<Insides> insides) : insides_(std::move(insides)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

void World::Insides::populate() {
    const uint32_t next_object = inhabitants ? inhabitants->next_object() : 1;
    inhabitants = std::make_unique<Inhabitants>(definition, picture, options, next_object);
    now = Time{};
    rest = Duration{};
    timeline_next = 0;
    reseeded.reset();
    if (chaos) chaos->restart();
    turns.move_in(*inhabitants);
    run_timeline();
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

// One instant: timeline, nodes by id, bodies. What nodes send is delivered at the next.
void World::Insides::begin_instant() {
    turns.accept(now);
    now += kNodeStep;
    run_timeline();
    if (chaos) pass_chaos();
    inhabitants->arena().prepare_looks();
    const std::span<const Colour> colours =
        somebody_sees_colours ? inhabitants->colours() : std::span<const Colour>();
    turns.run({inhabitants->arena(), inhabitants->ground(), colours, inhabitants->beacons(), now,
               clock_stops_with_nodes},
              crew);
}

void World::Insides::end_instant() {
    if (now % kPhysicsStep == Duration::zero()) move_bodies();
}

// No time passes, so a modelled bus cannot carry anything: what there is to say is said beside it.
void World::Insides::hold_instant() {
    turns.hold();
}

void World::Insides::run_timeline() {
    while (timeline_next < definition.timeline.size() &&
           definition.timeline[timeline_next].at <= now) {
        if (told_of_timeline) told_of_timeline(timeline_next);
        act(definition.timeline[timeline_next++].action);
    }
}

// Faults from time 0 on begin with the first instant.
void World::Insides::pass_chaos() {
    while (const auto edge = chaos->next(now)) {
        turns.take_edge(*edge, now);
        const ChaosFault& fault = *edge->fault;
        const auto robot = turns.robot_of(fault);
        std::string what = edge->begins ? began_sentence(fault) : ended_sentence(fault);
        const auto index = static_cast<size_t>(&fault - chaos->faults().data());
        note(robot, ChaosNote{std::move(what), index, edge->begins});
    }
}

namespace {

size_t index_of(const WorldDefinition& definition, std::string_view robot) {
    const auto found =
        std::find_if(definition.robots.begin(), definition.robots.end(),
                     [robot](const RobotDefinition& each) { return each.name == robot; });
    return static_cast<size_t>(found - definition.robots.begin());
}

}  // namespace

// What was deleted from outside before its entry came is left alone.
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
        push_button(index_of(definition, press->robot), press->button, press->pressed);
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

void World::Insides::note_frame(size_t index, const wire::Frame& frame) {
    if (auto emitted = emitted_in(frame))
        note(index, std::move(*emitted), frame.source);
    else if (auto fault = fault_in(frame))
        note(index, std::move(*fault), frame.source);
}

void World::Insides::note(size_t index, decltype(Happening::what) what, uint16_t node) {
    note(RobotId{static_cast<uint32_t>(index) + 1}, std::move(what), node);
}

void World::Insides::note(RobotId robot, decltype(Happening::what) what, uint16_t node) {
    if (happenings.size() < kHappeningsMax) {
        happenings.push_back({now, robot, node, std::move(what)});
    } else {
        ++happenings_lost;
    }
}

// ---- Bodies ----

void World::Insides::move_bodies() {
    Arena& arena = inhabitants->arena();
    turns.drive(arena, now, crew);
    arena.step(crew);
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
            knock(*index);
            note(*index, Contact{inhabitants->name_of(other)});
        }
    }
}

// ---- The public side ----

Time World::now() const {
    return insides_->now;
}

void World::stops_with_nodes() {
    insides_->clock_stops_with_nodes = true;
}

void World::reset() {
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
    insides_->turns.send_to(robot.number - 1, host, frame);
}

hub::Hub& World::bus_of(RobotId robot) {
    return insides_->turns.bus_of(robot.number - 1);
}

std::optional<BusLoad> World::bus_load() const {
    return insides_->turns.load();
}

std::optional<BusLoad> World::bus_load(RobotId robot) const {
    return insides_->turns.load_of(robot.number - 1);
}

hub::Hub* World::private_bus(RobotId robot) {
    const auto index = index_of(insides_->definition, robot);
    return index ? insides_->turns.private_bus(*index) : nullptr;
}

void World::host_left(RobotId robot) {
    const auto index = index_of(insides_->definition, robot);
    if (index) insides_->turns.host_left(*index);
}

const std::vector<ChaosFault>& World::chaos() const {
    static const std::vector<ChaosFault> kNone;
    return insides_->chaos ? insides_->chaos->faults() : kNone;
}

uint64_t World::chaos_seed() const {
    return insides_->seed();
}

std::vector<ChaosTarget> World::chaos_targets() {
    return targets_of(insides_->turns.chaos_nodes());
}

uint64_t World::turns_taken() const {
    return insides_->turns.turns_taken();
}

unsigned World::threads() const {
    return insides_->crew.size();
}

void World::use_one_thread(bool one) {
    insides_->crew.work_alone(one);
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
                         .own_bus = !robot.project.empty(),
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

bool World::touches(RobotId robot) const {
    const auto index = index_of(insides_->definition, robot);
    if (!index) return false;
    std::vector<TouchedPart> parts;
    insides_->inhabitants->arena().touched_parts(insides_->robot(*index).body(), parts);
    return !parts.empty();
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
    return index ? variables(robot, insides_->definition.robots[*index].node)
                 : std::span<const int16_t>();
}

std::span<const int16_t> World::variables(RobotId robot, uint16_t node) const {
    const auto index = index_of(insides_->definition, robot);
    return index ? insides_->turns.variables_of(*index, node, insides_->now)
                 : std::span<const int16_t>();
}

std::optional<RunningHandler> World::running_handler(RobotId robot, uint16_t node) const {
    const auto index = index_of(insides_->definition, robot);
    if (!index) return std::nullopt;
    const Machine* const machine = insides_->turns.machine_of(*index, node, insides_->now);
    if (machine == nullptr || machine->instructions_of_handler() == 0) return std::nullopt;
    return RunningHandler{machine->instructions_of_handler(), machine->vm().pc};
}

std::span<const int16_t> World::variables_of(uint16_t node) const {
    return insides_->turns.variables_of(node, insides_->now);
}

}  // namespace vagus::sim
