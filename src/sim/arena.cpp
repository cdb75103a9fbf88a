#include "sim/arena.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/trig.hpp"
#include "sim/sight.hpp"
#include "sim/spacing.hpp"

namespace vagus::sim {
namespace {

// Box2D is made for bodies of 0.1 to 10 of its units, lets them sink 0.005 units into each other
// and watches 0.1 unit around them for others. With one unit a decimetre a robot is one of them,
// the slop is half a millimetre, and a robot on its way is sorted again every tenth step (decision
// 0070).
constexpr double kUnitsPerMetre = 10;
constexpr int kVelocityIterations = 6;
constexpr int kPositionIterations = 2;
constexpr double kBorderThickness = 0.5;  // m, outside of the world
constexpr double kGravity = 9.81;
constexpr double kTyreFriction = 1.0;    // rubber on a table
constexpr double kGroundFriction = 0.4;  // a wooden box on a table
constexpr float kBodyFriction = 0.15F;   // plastic along a wall
constexpr double kUnwindAngle = 8;       // rad: beyond, whole turns are taken off a body's angle

float to_units(double metres) {
    return static_cast<float>(metres * kUnitsPerMetre);
}

b2Vec2 to_units(const Point& point) {
    return {to_units(point.x), to_units(point.y)};
}

// Moves `from` toward `to` by at most `most`, as a friction of that strength can.
b2Vec2 pull(const b2Vec2& from, const b2Vec2& to, float most) {
    const b2Vec2 way = to - from;
    const float length = way.Length();
    return length <= most ? to : from + (most / length) * way;
}

float pull(float from, float to, float most) {
    return from + b2Clamp(to - from, -most, most);
}

enum class Kind : uint8_t { None, Fixed, Loose, Robot };

// As Box2D counts: units, radians, seconds.
struct Motion {
    b2Vec2 at{0, 0};
    b2Vec2 speed{0, 0};
    float angle = 0;
    float turn = 0;

    bool is_rest() const { return speed.x == 0 && speed.y == 0 && turn == 0; }
};

struct Body {
    b2Body* body = nullptr;  // owned by the world of Box2D
    Kind kind = Kind::None;
    bool solved = true;  // by Box2D; else it is alone, and Box2D does not look at it
    Motion motion;       // now; the speeds only while it is not solved
    Drive drive;
    float turn_step_max = 0;  // rad/s that its tyres can change in one step
};

Motion motion_of(const b2Body& body) {
    return {body.GetPosition(), body.GetLinearVelocity(), body.GetAngle(),
            body.GetAngularVelocity()};
}

bool is_rest(const Drive& drive) {
    return drive.forward == 0 && drive.sideways == 0 && drive.turn == 0;
}

// Also one that fell asleep at the end of this step.
bool has_moved(const Body& body) {
    return body.body->IsAwake() || !(body.body->GetPosition() == body.motion.at) ||
           body.body->GetAngle() != body.motion.angle;
}

// An angle without whole turns, once it has some.
float unwound(float angle) {
    if (std::fabs(angle) <= kUnwindAngle) return angle;
    const double turns = std::round(angle / (2 * trig::kPi));
    return static_cast<float>(angle - turns * 2 * trig::kPi);
}

BodyId id_of(b2Fixture& fixture) {
    return {static_cast<uint32_t>(fixture.GetBody()->GetUserData().pointer)};
}

class TouchList : public b2ContactListener {
public:
    void BeginContact(b2Contact* contact) override {
        BodyId a = id_of(*contact->GetFixtureA());
        BodyId b = id_of(*contact->GetFixtureB());
        if (b < a) std::swap(a, b);
        touches.push_back({a, b});
    }
    std::vector<Touch> touches;
};

}  // namespace

struct Arena::Insides {
    explicit Insides(const ArenaSize& size) : world(b2Vec2(0, 0)), sight(size), spacing(sight) {
        // Bodies move at most 2 mm in a step: nothing can pass through anything, and looking for
        // the time of impact would only cost.
        world.SetContinuousPhysics(false);
        world.SetContactListener(&touches);
        if (!size.open) build_border(size);
    }

    void build_border(const ArenaSize& size);
    BodyId add(b2Body* body, Kind kind);
    void tell_sight(uint32_t index);
    void turn_wheels(const Body& body, const Stand& stand, Motion& motion) const;
    void prepare_robot(Body& body, const Stand& stand) const;
    void prepare_loose(Body& body) const;
    void glide(uint32_t index);
    void fetch(uint32_t index);
    void space_all();
    void solve();
    void hand_over_changed();
    void hand_over(uint32_t index);

    b2World world;
    TouchList touches;
    Sight sight;
    std::vector<Body> bodies;
    std::vector<uint32_t> free_slots;  // of bodies that were removed
    std::vector<uint32_t> active;      // robots and loose objects, ascending
    std::vector<uint8_t> strayed;      // of the active ones, in this step
    Spacing spacing;                   // of the active ones
    bool spaced = false;               // nobody came, went or was put elsewhere since the last step
};

Arena::Arena(const ArenaSize& size) : insides_(std::make_unique<Insides>(size)) {}
Arena::Arena(Arena&&) noexcept = default;
Arena& Arena::operator=(Arena&&) noexcept = default;
Arena::~Arena() = default;

void Arena::Insides::build_border(const ArenaSize& size) {
    b2BodyDef definition;
    definition.userData.pointer = kBorder.index;
    b2Body* const body = world.CreateBody(&definition);
    const double half = kBorderThickness / 2;
    const double w = size.width;
    const double h = size.height;
    const std::array<std::array<double, 4>, 4> walls = {
        {{w / 2, -half, w / 2 + 2 * half, half},
         {w / 2, h + half, w / 2 + 2 * half, half},
         {-half, h / 2, half, h / 2 + 2 * half},
         {w + half, h / 2, half, h / 2 + 2 * half}}};
    for (const auto& [x, y, half_width, half_height] : walls) {
        b2PolygonShape shape;
        shape.SetAsBox(to_units(half_width), to_units(half_height), to_units(Point{x, y}), 0);
        body->CreateFixture(&shape, 0);
    }
}

BodyId Arena::Insides::add(b2Body* body, Kind kind) {
    uint32_t index = static_cast<uint32_t>(bodies.size());
    if (free_slots.empty()) {
        bodies.emplace_back();
    } else {
        index = free_slots.back();
        free_slots.pop_back();
    }
    body->GetUserData().pointer = index;
    bodies[index] = {.body = body, .kind = kind, .motion = motion_of(*body), .drive = {}};
    spaced = false;
    if (kind != Kind::Fixed)
        active.insert(std::lower_bound(active.begin(), active.end(), index), index);
    return {index};
}

namespace {

b2Body* create_body(b2World& world, b2BodyType type, const Pose& pose) {
    b2BodyDef definition;
    definition.type = type;
    definition.position = to_units(pose.at);
    definition.angle = static_cast<float>(pose.angle);
    return world.CreateBody(&definition);
}

void give_shape(b2Body& body, const Outline& outline) {
    b2FixtureDef fixture;
    fixture.friction = kBodyFriction;
    b2CircleShape disc;
    b2PolygonShape polygon;
    if (outline.corners.empty()) {
        disc.m_radius = to_units(outline.radius);
        fixture.shape = &disc;
    } else {
        std::array<b2Vec2, kOutlineMax> corners;
        for (size_t i = 0; i < outline.corners.size(); ++i)
            corners[i] = to_units(outline.corners[i]);
        polygon.Set(corners.data(), static_cast<int32>(outline.corners.size()));
        fixture.shape = &polygon;
    }
    body.CreateFixture(&fixture);
}

void give_mass(b2Body& body, double mass, double inertia) {
    b2MassData data;
    data.mass = static_cast<float>(mass);
    data.center = b2Vec2(0, 0);
    data.I = static_cast<float>(inertia * kUnitsPerMetre * kUnitsPerMetre);
    body.SetMassData(&data);
}

}  // namespace

BodyId Arena::add_robot(const Outline& outline, const Pose& pose, const RobotBody& robot) {
    b2Body* const body = create_body(insides_->world, b2_dynamicBody, pose);
    give_shape(*body, outline);
    give_mass(*body, robot.mass, robot.inertia);
    const BodyId id = insides_->add(body, Kind::Robot);
    const double torque = kTyreFriction * robot.mass * kGravity * robot.grip;
    insides_->bodies[id.index].turn_step_max =
        static_cast<float>(torque / robot.inertia * kArenaStep);
    insides_->sight.add(id.index, outline, robot.height, Mobility::Moving);
    insides_->tell_sight(id.index);
    insides_->spacing.add(id.index, Company::MayBeAlone);
    return id;
}

BodyId Arena::add_object(const ObjectDefinition& object) {
    const bool loose = object.mass > 0;
    b2Body* const body = create_body(insides_->world, loose ? b2_dynamicBody : b2_staticBody,
                                     {object.at, object.angle});
    const double w = object.width / 2;
    const double h = object.length / 2;
    const std::array<Point, 4> corners = {{{-w, -h}, {w, -h}, {w, h}, {-w, h}}};
    const bool disc = object.radius > 0;
    const Outline outline = disc ? Outline{{}, object.radius} : Outline{corners, 0};
    give_shape(*body, outline);
    if (loose) {
        const double square = disc ? object.radius * object.radius / 2
                                   : (w * w + h * h) / 3;  // of a disc, of a plate
        give_mass(*body, object.mass, object.mass * square);
    }
    const BodyId id = insides_->add(body, loose ? Kind::Loose : Kind::Fixed);
    insides_->sight.add(id.index, outline, object.height,
                        loose ? Mobility::Moving : Mobility::Fixed);
    insides_->tell_sight(id.index);
    if (loose) insides_->spacing.add(id.index, Company::Never);
    return id;
}

void Arena::remove(BodyId id) {
    Body& body = insides_->bodies[id.index];
    insides_->world.DestroyBody(body.body);
    if (body.kind != Kind::Fixed) insides_->spacing.remove(id.index);
    insides_->sight.remove(id.index);
    std::erase(insides_->active, id.index);
    body = {};
    insides_->free_slots.push_back(id.index);
    insides_->spaced = false;
}

void Arena::place(BodyId id, const Pose& pose) {
    Body& placed = insides_->bodies[id.index];
    b2Body& body = *placed.body;
    body.SetTransform(to_units(pose.at), static_cast<float>(pose.angle));
    body.SetLinearVelocity(b2Vec2(0, 0));
    body.SetAngularVelocity(0);
    body.SetAwake(true);
    placed.motion = motion_of(body);
    insides_->tell_sight(id.index);
    insides_->spaced = false;
    if (placed.kind == Kind::Fixed)
        insides_->sight.fixed_moved();
    else
        insides_->sight.anchor(id.index);
}

void Arena::Insides::tell_sight(uint32_t index) {
    const Motion& motion = bodies[index].motion;
    const auto [sine, cosine] = trig::sin_cos(motion.angle);
    sight.put(index, {motion.at.x / kUnitsPerMetre, motion.at.y / kUnitsPerMetre, cosine, sine});
}

void Arena::drive(BodyId robot, const Drive& drive) {
    insides_->bodies[robot.index].drive = drive;
}

// The wheels pull the body toward the speed they want, as strongly as their tyres hold. The
// direction is that of the middle of the step, which makes a curve of short chords a true one.
void Arena::Insides::turn_wheels(const Body& robot, const Stand& stand, Motion& motion) const {
    const double half_turn = robot.drive.turn * kArenaStep / 2;
    const double forward = robot.drive.forward * kUnitsPerMetre;
    const double sideways = robot.drive.sideways * kUnitsPerMetre;
    const double cosine = stand.cosine - stand.sine * half_turn;
    const double sine = stand.sine + stand.cosine * half_turn;
    const b2Vec2 wanted(static_cast<float>(forward * cosine - sideways * sine),
                        static_cast<float>(forward * sine + sideways * cosine));
    constexpr auto kStepMax =
        static_cast<float>(kTyreFriction * kGravity * kArenaStep * kUnitsPerMetre);
    motion.speed = pull(motion.speed, wanted, kStepMax);
    motion.turn = pull(motion.turn, static_cast<float>(robot.drive.turn), robot.turn_step_max);
}

void Arena::Insides::prepare_robot(Body& robot, const Stand& stand) const {
    b2Body& body = *robot.body;
    if (is_rest(robot.drive) && !body.IsAwake()) return;
    Motion motion = motion_of(body);
    turn_wheels(robot, stand, motion);
    body.SetLinearVelocity(motion.speed);
    body.SetAngularVelocity(motion.turn);
}

// What lies on the ground is slowed by it. The turning friction is that of a body whose weight
// stands a few centimetres around its middle.
void Arena::Insides::prepare_loose(Body& loose) const {
    b2Body& body = *loose.body;
    if (!body.IsAwake()) return;
    constexpr double kLossOfSpeed = kGroundFriction * kGravity * kArenaStep;  // m/s
    constexpr double kLever = 0.05;                                           // m
    constexpr auto kStepMax = static_cast<float>(kLossOfSpeed * kUnitsPerMetre);
    constexpr auto kTurnMax = static_cast<float>(kLossOfSpeed / kLever);
    body.SetLinearVelocity(pull(body.GetLinearVelocity(), b2Vec2(0, 0), kStepMax));
    body.SetAngularVelocity(pull(body.GetAngularVelocity(), 0, kTurnMax));
}

// A robot that is alone goes as its wheels turn: the same sums as those of Box2D for a body that
// touches nothing, to the last bit.
void Arena::Insides::glide(uint32_t index) {
    Body& robot = bodies[index];
    Motion& motion = robot.motion;
    if (is_rest(robot.drive) && motion.is_rest()) return;
    const Stand& stand = sight.stand(index);
    turn_wheels(robot, stand, motion);
    constexpr auto kStep = static_cast<float>(kArenaStep);
    motion.at += kStep * motion.speed;
    if (motion.turn == 0) {  // sine and cosine are what they were
        sight.put(index, {motion.at.x / kUnitsPerMetre, motion.at.y / kUnitsPerMetre, stand.cosine,
                          stand.sine});
        return;
    }
    motion.angle = unwound(motion.angle + kStep * motion.turn);
    tell_sight(index);
}

// Where Box2D has brought a body.
void Arena::Insides::fetch(uint32_t index) {
    Body& moved = bodies[index];
    b2Body& body = *moved.body;
    const float angle = unwound(body.GetAngle());
    if (angle != body.GetAngle()) body.SetTransform(body.GetPosition(), angle);
    moved.motion = motion_of(body);
    tell_sight(index);
}

// Gives bodies that are not alone any more to Box2D, and takes back those that are now.
void Arena::Insides::hand_over(uint32_t index) {
    Body& robot = bodies[index];
    b2Body& body = *robot.body;
    robot.solved = !spacing.is_alone(index);
    if (!robot.solved) {
        robot.motion = motion_of(body);
        body.SetEnabled(false);
        return;
    }
    body.SetTransform(robot.motion.at, robot.motion.angle);
    body.SetLinearVelocity(robot.motion.speed);
    body.SetAngularVelocity(robot.motion.turn);
    body.SetEnabled(true);
    body.SetAwake(true);
}

// At the start, and after somebody came, went or was put elsewhere.
void Arena::Insides::space_all() {
    sight.refresh();
    for (const uint32_t index : active) spacing.settle(index);
    spaced = true;
    hand_over_changed();
}

void Arena::Insides::hand_over_changed() {
    for (const uint32_t index : spacing.take_changed())
        if (bodies[index].solved == spacing.is_alone(index)) hand_over(index);
}

// Those that are not alone, by Box2D.
void Arena::Insides::solve() {
    bool awake = false;
    for (const uint32_t index : active) {
        Body& body = bodies[index];
        if (!body.solved) continue;
        if (body.kind == Kind::Robot)
            prepare_robot(body, sight.stand(index));
        else
            prepare_loose(body);
        awake = awake || body.body->IsAwake();
    }
    if (awake) world.Step(static_cast<float>(kArenaStep), kVelocityIterations, kPositionIterations);
    for (size_t i = 0; i < active.size(); ++i) {
        const uint32_t index = active[i];
        if (!bodies[index].solved) continue;
        if (awake && has_moved(bodies[index])) fetch(index);
        strayed[i] = spacing.has_strayed(index) ? 1 : 0;
    }
}

void Arena::step() {
    Crew alone(1);
    step(alone);
}

void Arena::step(Crew& crew) {
    Insides& in = *insides_;
    if (!in.spaced) in.space_all();
    in.touches.touches.clear();
    in.strayed.resize(in.active.size());
    // Bodies that are alone move while Box2D solves the others: neither reads the other.
    const auto go_alone = [&in](size_t i) {
        const uint32_t index = in.active[i];
        if (in.bodies[index].solved) return;
        in.glide(index);
        in.strayed[i] = in.spacing.has_strayed(index) ? 1 : 0;
    };
    crew.beside([&in] { in.solve(); }, in.active.size(), go_alone);
    for (size_t i = 0; i < in.active.size(); ++i)
        if (in.strayed[i] != 0) in.spacing.settle(in.active[i]);
    in.hand_over_changed();
}

Pose Arena::pose(BodyId id) const {
    const Motion& motion = insides_->bodies[id.index].motion;
    return {{motion.at.x / kUnitsPerMetre, motion.at.y / kUnitsPerMetre}, motion.angle};
}

std::span<const Touch> Arena::touches() const {
    return insides_->touches.touches;
}

void Arena::touched_parts(BodyId id, std::vector<TouchedPart>& parts) const {
    const b2Body& body = *insides_->bodies[id.index].body;
    const auto local = [&body](const b2Vec2& point) {
        const b2Vec2 at = body.GetLocalPoint(point);
        return Point{at.x / kUnitsPerMetre, at.y / kUnitsPerMetre};
    };
    for (const b2ContactEdge* edge = body.GetContactList(); edge != nullptr; edge = edge->next) {
        if (!edge->contact->IsTouching()) continue;
        b2WorldManifold manifold;
        edge->contact->GetWorldManifold(&manifold);
        const int last = edge->contact->GetManifold()->pointCount - 1;
        parts.push_back({local(manifold.points[0]), local(manifold.points[last])});
    }
}

void Arena::prepare_looks() {
    insides_->sight.refresh();
}

void Arena::look(BodyId robot, const RayFan& rays, double eye, std::span<double> distances) const {
    insides_->sight.look(robot.index, rays, eye, distances);
}

void Arena::look_wide(BodyId robot, double ahead, std::span<const double> tangents,
                      std::span<Column> columns) const {
    insides_->sight.look_wide(robot.index, ahead, tangents, columns);
}

void Arena::slice(BodyId self, const Pose& eye, std::span<const double> tangents,
                  std::vector<Slice>& slices) const {
    const Stand stand = {eye.at.x, eye.at.y, trig::cos(eye.angle), trig::sin(eye.angle)};
    insides_->sight.slice(self.index, stand, tangents, slices);
}

}  // namespace vagus::sim
