#include "sim/arena.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/trig.hpp"
#include "sim/sight.hpp"

namespace vagus::sim {
namespace {

// Box2D is made for bodies of 0.1 to 10 of its units, lets them sink 0.005 units into each other
// and watches 0.1 unit around them for others. With one unit a decimetre a robot is one of them,
// the slop is half a millimetre, and a robot on its way is sorted anew every tenth step (decision
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

struct Body {
    b2Body* body = nullptr;  // owned by the world of Box2D
    Kind kind = Kind::None;
    Drive drive;
    float turn_step_max = 0;  // rad/s that its tyres can change in one step
};

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
    explicit Insides(const ArenaSize& size) : world(b2Vec2(0, 0)), sight(size) {
        // Bodies move at most 2 mm in a step: nothing can pass through anything, and looking for
        // the time of impact would only cost.
        world.SetContinuousPhysics(false);
        world.SetContactListener(&touches);
        if (!size.open) build_border(size);
    }

    void build_border(const ArenaSize& size);
    BodyId add(b2Body* body, Kind kind);
    void tell_sight(uint32_t index);
    void prepare_robot(Body& body, const Stand& stand) const;
    void prepare_loose(Body& body) const;

    b2World world;
    TouchList touches;
    Sight sight;
    std::vector<Body> bodies;
    std::vector<uint32_t> free_slots;  // of bodies that were removed
    std::vector<uint32_t> active;      // robots and loose objects, ascending
    bool sight_current = false;
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
    bodies[index] = {.body = body, .kind = kind, .drive = {}, .turn_step_max = 0};
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
    return id;
}

void Arena::remove(BodyId id) {
    Body& body = insides_->bodies[id.index];
    insides_->world.DestroyBody(body.body);
    insides_->sight.remove(id.index);
    std::erase(insides_->active, id.index);
    body = {};
    insides_->free_slots.push_back(id.index);
    insides_->sight_current = false;
}

void Arena::place(BodyId id, const Pose& pose) {
    b2Body& body = *insides_->bodies[id.index].body;
    body.SetTransform(to_units(pose.at), static_cast<float>(pose.angle));
    body.SetLinearVelocity(b2Vec2(0, 0));
    body.SetAngularVelocity(0);
    body.SetAwake(true);
    insides_->tell_sight(id.index);
    insides_->sight.fixed_moved();
}

void Arena::Insides::tell_sight(uint32_t index) {
    const b2Body& body = *bodies[index].body;
    const double angle = body.GetAngle();
    sight.put(index, {body.GetPosition().x / kUnitsPerMetre, body.GetPosition().y / kUnitsPerMetre,
                      trig::cos(angle), trig::sin(angle)});
    sight_current = false;
}

void Arena::drive(BodyId robot, const Drive& drive) {
    insides_->bodies[robot.index].drive = drive;
}

// The wheels pull the body toward the speed they want, as strongly as their tyres hold. The
// direction is that of the middle of the step, which makes a curve of short chords a true one.
void Arena::Insides::prepare_robot(Body& robot, const Stand& stand) const {
    b2Body& body = *robot.body;
    const double half_turn = robot.drive.turn * kArenaStep / 2;
    const double forward = robot.drive.forward * kUnitsPerMetre;
    const double sideways = robot.drive.sideways * kUnitsPerMetre;
    const double cosine = stand.cosine - stand.sine * half_turn;
    const double sine = stand.sine + stand.cosine * half_turn;
    const b2Vec2 wanted(static_cast<float>(forward * cosine - sideways * sine),
                        static_cast<float>(forward * sine + sideways * cosine));
    constexpr auto kStepMax =
        static_cast<float>(kTyreFriction * kGravity * kArenaStep * kUnitsPerMetre);
    const auto turn = static_cast<float>(robot.drive.turn);
    const bool still = forward == 0 && sideways == 0 && turn == 0 && !body.IsAwake();
    if (still) return;
    body.SetLinearVelocity(pull(body.GetLinearVelocity(), wanted, kStepMax));
    body.SetAngularVelocity(pull(body.GetAngularVelocity(), turn, robot.turn_step_max));
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

void Arena::step() {
    Insides& in = *insides_;
    for (const uint32_t index : in.active) {
        Body& body = in.bodies[index];
        if (body.kind == Kind::Robot)
            in.prepare_robot(body, in.sight.stand(index));
        else
            in.prepare_loose(body);
    }
    in.touches.touches.clear();
    in.world.Step(static_cast<float>(kArenaStep), kVelocityIterations, kPositionIterations);
    for (const uint32_t index : in.active) {
        b2Body& body = *in.bodies[index].body;
        if (!body.IsAwake()) continue;
        if (std::fabs(body.GetAngle()) > kUnwindAngle) {
            const double turns = std::round(body.GetAngle() / (2 * trig::kPi));
            body.SetTransform(body.GetPosition(),
                              static_cast<float>(body.GetAngle() - turns * 2 * trig::kPi));
        }
        in.tell_sight(index);
    }
}

Pose Arena::pose(BodyId id) const {
    const b2Body& body = *insides_->bodies[id.index].body;
    return {{body.GetPosition().x / kUnitsPerMetre, body.GetPosition().y / kUnitsPerMetre},
            body.GetAngle()};
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
    if (insides_->sight_current) return;
    insides_->sight.refresh();
    insides_->sight_current = true;
}

void Arena::look(BodyId robot, const RayFan& rays, double eye, std::span<double> distances) const {
    assert(insides_->sight_current);
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
