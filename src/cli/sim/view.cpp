#include "cli/sim/view.hpp"

#include <algorithm>
#include <cmath>

namespace vagus::cli {
namespace {

constexpr Duration kTrailEvery = std::chrono::milliseconds(100);
constexpr Duration kFreshFor = std::chrono::milliseconds(500);
constexpr int kImageColumns = 240;   // of a floor with a picture on it
constexpr double kContrastMin = 45;  // luminance between a thing and the floor
constexpr Rgb kBorderColour{105, 85, 70};
constexpr Rgb kLampOn{255, 235, 120};
constexpr Rgb kLampOff{120, 115, 100};
constexpr Rgb kBeacon{190, 70, 200};

Rgb rgb(const sim::Colour& colour) {
    const auto part = [](double value) {
        return static_cast<uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
    };
    return {part(colour.r), part(colour.g), part(colour.b)};
}

double luminance(Rgb colour) {
    return 0.3 * colour.r + 0.59 * colour.g + 0.11 * colour.b;
}

// A white wall on a white floor is drawn as a grey one.
Rgb apart_from(Rgb floor, Rgb colour) {
    if (std::abs(luminance(floor) - luminance(colour)) >= kContrastMin) return colour;
    const double factor = luminance(colour) > kContrastMin * 2 ? 0.6 : 1.0;
    const int lift = factor < 1 ? 0 : static_cast<int>(kContrastMin * 1.5);
    const auto part = [factor, lift](uint8_t value) {
        return static_cast<uint8_t>(
            std::clamp<int>(static_cast<int>(value * factor) + lift, 0, 255));
    };
    return {part(colour.r), part(colour.g), part(colour.b)};
}

Point at(const sim::Pose& pose, Point local) {
    const double cosine = std::cos(pose.angle);
    const double sine = std::sin(pose.angle);
    return {pose.at.x + local.x * cosine - local.y * sine,
            pose.at.y + local.x * sine + local.y * cosine};
}

Outline rectangle(const sim::Pose& pose, double width, double length) {
    Outline outline;
    const double x = width / 2;
    const double y = length / 2;
    for (const Point corner : {Point{-x, -y}, Point{x, -y}, Point{x, y}, Point{-x, y}}) {
        outline.corners.push_back(at(pose, corner));
    }
    return outline;
}

Outline outline_of(const sim::ObjectView& object) {
    const sim::ObjectDefinition& definition = *object.definition;
    if (definition.radius > 0) return {{}, {object.pose.at.x, object.pose.at.y}, definition.radius};
    return rectangle(object.pose, definition.width, definition.length);
}

ShapeView shape_of(const sim::ObjectView& object, Rgb floor) {
    ShapeView shape{ShapeKind::Solid, outline_of(object), rgb(object.definition->colour)};
    switch (object.definition->kind) {
        case sim::ObjectKind::Wall:
        case sim::ObjectKind::Box:
        case sim::ObjectKind::Cylinder:
            shape.colour = apart_from(floor, shape.colour);
            break;
        case sim::ObjectKind::Patch:
            shape.kind = ShapeKind::Patch;
            break;
        case sim::ObjectKind::Light:
            shape.kind = ShapeKind::Light;
            shape.colour = object.on ? kLampOn : kLampOff;
            break;
        case sim::ObjectKind::Infrared:
            shape.kind = ShapeKind::Light;
            shape.colour = object.on ? kBeacon : kLampOff;
            break;
    }
    // Lamps have no size of their own.
    const bool lamp = shape.kind == ShapeKind::Light;
    if (lamp) shape.outline = {{}, {object.pose.at.x, object.pose.at.y}, 0.02};
    return shape;
}

GroundImage image_of(const sim::World& world) {
    const sim::WorldDefinition& definition = world.definition();
    if (definition.ground_image.empty()) return {};
    GroundImage image{kImageColumns, 0, {}};
    image.rows = std::clamp(static_cast<int>(kImageColumns * definition.height / definition.width),
                            1, kImageColumns);
    for (int row = 0; row < image.rows; row++) {
        for (int column = 0; column < image.columns; column++) {
            const double x = (column + 0.5) / image.columns * definition.width;
            const double y = (1 - (row + 0.5) / image.rows) * definition.height;
            image.pixels.push_back(rgb(world.ground_at({x, y})));
        }
    }
    return image;
}

// The light that a person sees first: the one on top, else the brightest.
std::optional<Rgb> led_of(const std::vector<sim::Lamp>& lamps) {
    std::optional<Rgb> brightest;
    for (const sim::Lamp& lamp : lamps) {
        const Rgb colour = rgb(lamp.colour);
        if (colour == Rgb{}) continue;
        if (lamp.name == "leds.top") return colour;
        if (!brightest || luminance(*brightest) < luminance(colour)) brightest = colour;
    }
    return brightest;
}

RobotPicture picture_of(const sim::World& world, const sim::RobotView& robot, Rgb floor) {
    RobotPicture view;
    view.name = std::string(robot.name);
    view.at = {robot.pose.at.x, robot.pose.at.y};
    view.angle = robot.pose.angle;
    view.paint = apart_from(floor, rgb(robot.paint));
    view.led = led_of(world.lamps(robot.id));
    for (const sim::Point corner : robot.outline) {
        view.outline.corners.push_back(at(robot.pose, {corner.x, corner.y}));
    }
    for (const sim::Beam& beam : world.beams(robot.id)) {
        view.rays.push_back({{beam.from.x, beam.from.y}, {beam.to.x, beam.to.y}, beam.hit});
    }
    return view;
}

int first_of(std::span<const int16_t> values) {
    return values.empty() ? 0 : values.front();
}

std::string state_text(const session::NodeState& state) {
    if (state.name.empty()) return "starting";
    if (!state.fault.empty()) return "fault";
    if (!state.has_script && state.state != debug::ProgramState::Running) return "no script";
    return debug::name_of(state.state);
}

}  // namespace

const Dials& dials_of(sim::RobotType type) {
    static const Dials kThymio = {
        {{"prox", "prox.horizontal", 4500}, {"ground", "prox.ground.delta", 1000}},
        {{"left", "motor.left.target", "motor.left.speed"},
         {"right", "motor.right.target", "motor.right.speed"}}};
    static const Dials kEpuck = {
        {{"prox", "prox", 4000}},
        {{"left", "speed.left", "speed.left"}, {"right", "speed.right", "speed.right"}}};
    static const Dials kCarbot = {
        {{"touch", "touch.sectors", 1}, {"sonar", "sonar.distance", 3000}},
        {{"front", "wheel.front.angle", "wheel.front.speed", "at", "rolls"},
         {"rear", "wheel.rear.angle", "wheel.rear.speed", "at", "rolls"}}};
    switch (type) {
        case sim::RobotType::Thymio2:
            return kThymio;
        case sim::RobotType::Epuck:
            return kEpuck;
        case sim::RobotType::Carbot:
            return kCarbot;
    }
    return kThymio;
}

SimView::SimView(const session::SimSession& session) : image_(image_of(session.world())) {}

void SimView::forget() {
    trails_.clear();
    variables_.clear();
    next_trail_ = {};
}

void SimView::follow(const session::SimSession& session, size_t selected) {
    const auto nodes = session.nodes();
    if (selected < nodes.size()) follow_variables(session, nodes[selected].id);
    if (session.now() < next_trail_) return;
    next_trail_ = session.now() + kTrailEvery;
    for (const sim::RobotView& robot : session.world().robots()) {
        std::deque<Point>& trail = trails_[robot.id];
        trail.push_back({robot.pose.at.x, robot.pose.at.y});
        if (trail.size() > kTrailPoints) trail.pop_front();
    }
}

void SimView::follow_variables(const session::SimSession& session, uint16_t node) {
    for (const auto& [name, values] : session.script_variables(node)) {
        Remembered& before = variables_[{node, name}];
        const auto& old = before.values;
        if (std::equal(values.begin(), values.end(), old.begin(), old.end())) continue;
        if (!old.empty()) before.changed = session.now();
        before.values.assign(values.begin(), values.end());
    }
}

void SimView::add_variables(const session::SimSession& session, uint16_t node,
                            PanelView& panel) const {
    for (const auto& [name, values] : session.script_variables(node)) {
        const auto known = variables_.find({node, name});
        const bool fresh = known != variables_.end() && known->second.changed > Time{} &&
                           session.now() - known->second.changed < kFreshFor;
        panel.variables.push_back({name, {values.begin(), values.end()}, fresh});
    }
}

PanelView SimView::panel(const session::SimSession& session, size_t selected) const {
    PanelView panel;
    for (const session::EventCount& event : session.events()) {
        panel.events.push_back({event.name, event.count, event.arguments, event.last});
    }
    const auto nodes = session.nodes();
    if (selected >= nodes.size()) return panel;
    const session::NodeState& state = nodes[selected];
    const sim::RobotView robot = session.world().robots()[state.robot.number - 1];
    panel.node_name = state.name.empty() ? std::string(robot.name) : state.name;
    if (robot.nodes > 1 && !state.name.empty())
        panel.node_name = std::string(robot.name) + " " + state.name;
    panel.node_id = state.id;
    panel.state = state_text(state);
    panel.wrong = !state.fault.empty();
    const Dials& dials = dials_of(robot.type);
    for (const Dial& dial : dials.bars) {
        const auto values = session.node_variable(robot.id, dial.variable);
        panel.bars.push_back({std::string(dial.label), {values.begin(), values.end()}, dial.full});
    }
    for (const WheelDial& dial : dials.wheels) {
        panel.wheels.push_back({std::string(dial.label), std::string(dial.target_word),
                                std::string(dial.speed_word),
                                first_of(session.node_variable(robot.id, dial.target)),
                                first_of(session.node_variable(robot.id, dial.speed))});
    }
    add_variables(session, state.id, panel);
    return panel;
}

View SimView::view(const session::SimSession& session, size_t selected) const {
    const sim::World& world = session.world();
    const sim::WorldDefinition& definition = world.definition();
    View view;
    view.title = definition.name;
    view.width = definition.width;
    view.height = definition.height;
    view.ground = rgb(definition.ground);
    view.image = image_;
    // Marks lie under all else.
    std::vector<ShapeView> standing;
    for (const sim::ObjectView& object : world.objects()) {
        ShapeView shape = shape_of(object, view.ground);
        (shape.kind == ShapeKind::Patch ? view.shapes : standing).push_back(std::move(shape));
    }
    if (!definition.open) view.border = kBorderColour;
    view.shapes.insert(view.shapes.end(), standing.begin(), standing.end());
    for (const sim::RobotView& robot : world.robots()) {
        view.robots.push_back(picture_of(world, robot, view.ground));
        const auto trail = trails_.find(robot.id);
        if (trail != trails_.end()) {
            view.robots.back().trail.assign(trail->second.begin(), trail->second.end());
        }
    }
    const auto nodes = session.nodes();
    if (selected < nodes.size()) view.selected = nodes[selected].robot.number - 1;
    view.panel = panel(session, selected);
    view.now = session.now();
    for (Diagnostic& one : session.mistakes()) {
        view.problems.push_back({text_of(one), std::move(one.source)});
    }
    view.problems_title = "the script has mistakes; what was loaded before runs on";
    if (view.problems.empty()) {
        view.problems_title = "a script was stopped by what it did";
        for (const auto& state : nodes) {
            if (!state.fault.empty()) view.problems.push_back({state.fault, {}});
        }
    }
    return view;
}

}  // namespace vagus::cli
