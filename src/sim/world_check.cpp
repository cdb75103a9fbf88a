#include "sim/world_check.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>

#include "base/time.hpp"
#include "sim/standing.hpp"

namespace vagus::sim {
namespace {

using Found = std::optional<Problem>;

struct Problems {
    std::vector<Problem> list = {};
    void add(Found found) {
        if (found && list.size() < kProblemsMax) list.push_back(std::move(*found));
    }
};

constexpr double kFullTurn = 2 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180;

std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

struct Range {
    double low;
    double high;
    const char* unit;  // "m"
};

Found check_range(const std::string& element, double value, Range range, const char* fix) {
    if (value >= range.low && value <= range.high) return std::nullopt;
    return Problem{element, "expected a number from " + text_of(range.low) + " to " +
                                text_of(range.high) + " (" + range.unit + "), found " +
                                text_of(value) + "; " + fix};
}

Found check_count(const std::string& element, size_t count, size_t max) {
    if (count <= max) return std::nullopt;
    return Problem{element, "expected at most " + std::to_string(max) + " of them, found " +
                                std::to_string(count) + "; remove some"};
}

Found check_colour(const std::string& element, const Colour& colour) {
    for (const double part : {colour.r, colour.g, colour.b}) {
        if (auto found = check_range(element, part, {0, 1, "red, green, blue"},
                                     "divide by 255 if the colour is in bytes"))
            return found;
    }
    return std::nullopt;
}

Found check_point(const std::string& element, const Point& point, double low, double high) {
    for (const double part : {point.x, point.y}) {
        if (auto found = check_range(element, part, {low, high, "m"}, "lengths are in metres"))
            return found;
    }
    return std::nullopt;
}

// "angles are in radians: 90 degrees are 1.5708"
std::string radians_hint(double angle) {
    char radians[32];
    std::snprintf(radians, sizeof radians, "%.4f", std::fmod(angle, 360) * kDegree);
    return "angles are in radians: " + text_of(angle) + " degrees are " + radians;
}

Found check_angle(const std::string& element, double angle) {
    return check_range(element, angle, {-kAngleMax, kAngleMax, "rad"}, radians_hint(angle).c_str());
}

// More than a full turn (rounded up in its third decimal) is rarely meant.
Found hint_of_angle(const std::string& element, double angle) {
    if (std::fabs(angle) <= kFullTurn + 0.001) return std::nullopt;
    return Problem{element, text_of(angle) + " is more than a full turn; " + radians_hint(angle)};
}

// Outside of the walls nothing can be seen or touched, and nobody comes in.
Found check_inside(const Point& at, const std::string& element, const WorldDefinition& world) {
    const bool inside = at.x >= 0 && at.x <= world.width && at.y >= 0 && at.y <= world.height;
    if (inside || world.open) return std::nullopt;
    return Problem{element, "[" + text_of(at.x) + ", " + text_of(at.y) +
                                "] is outside of the walls around the world; place it from 0 to " +
                                text_of(world.width) + " and from 0 to " + text_of(world.height) +
                                ", or write \"open\": true"};
}

bool is_rectangle(const ObjectDefinition& object) {
    return object.radius == 0;
}

bool is_bare(const ObjectDefinition& object) {
    return object.width == 0 && object.length == 0 && object.radius == 0;
}

// Which of size and radius an object of this kind has.
Found check_shape(const ObjectDefinition& object, const std::string& element) {
    const std::string kind(name_of(object.kind));
    const bool point_like = object.kind == ObjectKind::Light || object.kind == ObjectKind::Infrared;
    if (point_like && is_bare(object)) return std::nullopt;
    if (object.radius != 0 && (object.width != 0 || object.length != 0))
        return Problem{element, "has a size and a radius; keep one of them"};
    const bool needs_disc = object.kind == ObjectKind::Cylinder || point_like;
    if (needs_disc && is_rectangle(object))
        return Problem{element, "a " + kind + " needs a radius; write \"radius\": 0.05"};
    const bool needs_rectangle = object.kind == ObjectKind::Wall || object.kind == ObjectKind::Box;
    if (needs_rectangle && (!is_rectangle(object) || is_bare(object)))
        return Problem{element, "a " + kind + " needs a size; write \"size\": [0.2, 0.1]"};
    if (is_bare(object))
        return Problem{element, "a " + kind + " needs a size or a radius; write \"radius\": 0.05"};
    return std::nullopt;
}

Found check_lengths(const ObjectDefinition& object, const std::string& element) {
    const Range range = {kObjectSizeMin, kWorldSizeMax, "m"};
    const char* fix = "lengths are in metres";
    if (is_bare(object)) return std::nullopt;
    if (!is_rectangle(object)) return check_range(element + ".radius", object.radius, range, fix);
    if (auto found = check_range(element + ".size", object.width, range, fix)) return found;
    return check_range(element + ".size", object.length, range, fix);
}

Found check_mass(const ObjectDefinition& object, const std::string& element) {
    const bool movable = object.kind == ObjectKind::Box || object.kind == ObjectKind::Cylinder;
    if (object.mass != 0 && !movable) {
        return Problem{element + ".mass", "a " + std::string(name_of(object.kind)) +
                                              " cannot be moved; leave mass out, or make it a box"};
    }
    return check_range(element + ".mass", object.mass, {0, kMassMax, "kg"},
                       "write 0 for what never moves");
}

Found check_button(const PressButton& press, const WorldDefinition& world,
                   const std::string& element) {
    for (const RobotDefinition& robot : world.robots) {
        if (robot.name != press.robot) continue;
        std::string all;
        for (const std::string_view button : buttons_of(robot.type)) {
            if (button == press.button) return std::nullopt;
            all += (all.empty() ? "" : ", ") + std::string(button);
        }
        if (all.empty()) all = "none";
        return Problem{element + ".button", "robot " + robot.name + " has no button \"" +
                                                press.button + "\"; it has: " + all};
    }
    return Problem{element + ".robot", "there is no robot \"" + press.robot +
                                           "\" in this world; use the name of one in \"robots\""};
}

// The ids that exist while the timeline goes by.
class Timeline {
public:
    explicit Timeline(const WorldDefinition& world) : world_(world) {
        for (const ObjectDefinition& object : world.objects)
            if (!object.id.empty()) ids_[object.id] = object.kind;
        for (const RobotDefinition& robot : world.robots) robots_.insert(robot.name);
    }

    Found check(const TimelineEntry& entry, const std::string& element) {
        const double seconds = seconds_of(entry.at);
        if (auto found = check_range(element + ".t", seconds, {0, kTimelineEndMax, "s"},
                                     "times count from the start of the run"))
            return found;
        element_ = &element;
        return std::visit([this](const auto& action) { return this->apply(action); }, entry.action);
    }

private:
    Found apply(const AddObject& add) {
        const std::string element = *element_ + ".object";
        if (auto found = find_problem(add.object, element)) return found;
        if (auto found = check_inside(add.object.at, element + ".at", world_)) return found;
        if (add.object.id.empty()) return std::nullopt;
        if (ids_.contains(add.object.id) || robots_.contains(add.object.id)) {
            return Problem{*element_ + ".object.id",
                           "\"" + add.object.id + "\" exists already; choose another id"};
        }
        ids_[add.object.id] = add.object.kind;
        return std::nullopt;
    }
    Found apply(const RemoveObject& remove) {
        if (auto found = known(remove.id)) return found;
        ids_.erase(remove.id);
        return std::nullopt;
    }
    Found apply(const MoveObject& move) {
        if (auto found = check_point(*element_ + ".at", move.at, -kWorldSizeMax, 2 * kWorldSizeMax))
            return found;
        if (auto found = check_inside(move.at, *element_ + ".at", world_)) return found;
        if (move.angle) {
            if (auto found = check_angle(*element_ + ".angle", *move.angle)) return found;
        }
        return robots_.contains(move.id) ? std::nullopt : known(move.id);
    }
    Found apply(const PressButton& press) { return check_button(press, world_, *element_); }
    Found apply(const CutFleet& cut) {
        if (cut.robot.empty()) return std::nullopt;
        for (const RobotDefinition& robot : world_.robots) {
            if (robot.name == cut.robot && !robot.project.empty()) return std::nullopt;
        }
        return Problem{*element_ + ".robot",
                       "there is no robot \"" + cut.robot +
                           "\" with a project of its own in this world; use the name of one, or "
                           "leave \"robot\" out to mean all of them"};
    }
    static Found apply(const RunKeeper&) { return std::nullopt; }
    Found apply(const SwitchLight& light) {
        if (auto found = known(light.id)) return found;
        const ObjectKind kind = ids_[light.id];
        if (kind == ObjectKind::Light || kind == ObjectKind::Infrared) return std::nullopt;
        return Problem{*element_ + ".id", "\"" + light.id + "\" is a " +
                                              std::string(name_of(kind)) +
                                              "; only a light or an infrared can be switched"};
    }
    Found known(const std::string& id) const {
        if (ids_.contains(id)) return std::nullopt;
        return Problem{*element_ + ".id",
                       "there is no object \"" + id +
                           "\" at that time; give the object that id, or correct this one"};
    }

    const WorldDefinition& world_;
    std::map<std::string, ObjectKind> ids_;
    std::set<std::string> robots_;
    const std::string* element_ = nullptr;
};

Found check_object(const ObjectDefinition& object, const std::string& element,
                   const WorldDefinition& world, std::set<std::string>& ids) {
    if (auto found = find_problem(object, element)) return found;
    if (auto found = check_inside(object.at, element + ".at", world)) return found;
    if (!object.id.empty() && !ids.insert(object.id).second) {
        return Problem{element + ".id",
                       "\"" + object.id + "\" is the id of an earlier object; choose another"};
    }
    return std::nullopt;
}

void check_objects(const WorldDefinition& world, Problems& problems) {
    problems.add(check_count("objects", world.objects.size(), kObjectsMax));
    std::set<std::string> ids;
    for (size_t i = 0; i < world.objects.size(); ++i) {
        problems.add(check_object(world.objects[i], numbered("objects", i), world, ids));
    }
}

Found check_robot(const RobotDefinition& robot, const std::string& element,
                  const WorldDefinition& world) {
    if (robot.name.empty()) return Problem{element + ".name", "is empty; give the robot a name"};
    for (const ObjectDefinition& object : world.objects) {
        if (object.id == robot.name)
            return Problem{element + ".name", "\"" + robot.name +
                                                  "\" is the id of an object, too; "
                                                  "choose another"};
    }
    const double margin = kWorldSizeMax;
    if (auto found = check_point(element + ".at", robot.at, -margin, 2 * margin)) return found;
    if (auto found = check_inside(robot.at, element + ".at", world)) return found;
    if (auto found = check_angle(element + ".angle", robot.angle)) return found;
    if (auto found = check_colour(element + ".paint", robot.paint)) return found;
    if (!robot.project.empty() && !robot.script.empty()) {
        return Problem{element + ".script",
                       "robot " + robot.name +
                           " has a project, which names its scripts; remove \"script\" or "
                           "\"project\""};
    }
    return check_range(
        element + ".node", robot.node, {1, 65535.0 - nodes_of(robot.type), "node id"},
        "0 is the host, 65535 is nobody, and a robot of several nodes takes the next "
        "ids, too");
}

// " (robot c has the nodes 1 to 4)" of a robot that is several nodes.
std::string reach_text(const RobotDefinition& robot) {
    const int last = robot.node + nodes_of(robot.type) - 1;
    if (last == robot.node) return "";
    return " (robot " + robot.name + " has the nodes " + std::to_string(robot.node) + " to " +
           std::to_string(last) + ")";
}

// What only one robot of a world can have.
struct Taken {
    std::set<std::string> names = {};
    std::set<uint16_t> nodes = {};
    std::set<uint16_t> ports = {};
};

Found check_nodes(const RobotDefinition& robot, const std::string& element, Taken& taken) {
    Found found;
    if (!robot.project.empty()) return found;  // nobody else is on its bus
    for (uint32_t node = robot.node; node < robot.node + nodes_of(robot.type); ++node) {
        if (taken.nodes.insert(static_cast<uint16_t>(node)).second || found) continue;
        found =
            Problem{element + ".node",
                    std::to_string(node) + " is a node of an earlier robot" + reach_text(robot) +
                        "; robots without a project are on one bus, choose another"};
    }
    return found;
}

Found check_among_others(const RobotDefinition& robot, const std::string& element,
                         const WorldDefinition& world, Taken& taken) {
    if (auto found = check_robot(robot, element, world)) return found;
    if (const auto solid = stands_in(robot, world)) {
        return Problem{element + ".at", "robot " + robot.name + " would overlap " + *solid};
    }
    if (!taken.names.insert(robot.name).second)
        return Problem{element + ".name", "\"" + robot.name + "\" is taken; choose another"};
    if (auto found = check_nodes(robot, element, taken)) return found;
    if (robot.port.value_or(0) != 0 && !taken.ports.insert(*robot.port).second)
        return Problem{element + ".port", std::to_string(*robot.port) +
                                              " is the port of an earlier robot; choose another"};
    return std::nullopt;
}

void check_robots(const WorldDefinition& world, Problems& problems) {
    problems.add(check_count("robots", world.robots.size(), kRobotsMax));
    Taken taken;
    for (size_t i = 0; i < world.robots.size(); ++i) {
        problems.add(check_among_others(world.robots[i], numbered("robots", i), world, taken));
    }
}

void check_timeline(const WorldDefinition& world, Problems& problems) {
    problems.add(check_count("timeline", world.timeline.size(), kTimelineMax));
    Timeline timeline(world);
    for (size_t i = 0; i < world.timeline.size(); ++i) {
        const std::string element = numbered("timeline", i);
        Found found = timeline.check(world.timeline[i], element);
        if (!found && i > 0 && world.timeline[i].at < world.timeline[i - 1].at) {
            found = Problem{element + ".t",
                            "is before the entry above it; put the entries in the order of time"};
        }
        problems.add(std::move(found));
    }
}

void check_fleet(const FleetDefinition& fleet, Problems& problems) {
    for (const auto& [key, span] :
         {std::pair("fleet.latency", fleet.latency), std::pair("fleet.jitter", fleet.jitter)}) {
        problems.add(
            check_range(key, seconds_of(span), {0, kFleetDelayMax, "s"}, "delays are in seconds"));
    }
    for (const auto& [key, share] :
         {std::pair("fleet.loss", fleet.loss), std::pair("fleet.twice", fleet.twice)}) {
        problems.add(check_range(key, share, {0, kFleetChanceMax, "of the messages"},
                                 "0.01 is one of a hundred"));
    }
}

}  // namespace

std::string numbered(std::string_view list, size_t index) {
    return std::string(list) + "[" + std::to_string(index) + "]";
}

std::optional<Problem> find_problem(const ObjectDefinition& object, const std::string& element) {
    if (auto found = check_point(element + ".at", object.at, -kWorldSizeMax, 2 * kWorldSizeMax))
        return found;
    if (auto found = check_angle(element + ".angle", object.angle)) return found;
    if (auto found = check_shape(object, element)) return found;
    if (auto found = check_lengths(object, element)) return found;
    if (auto found = check_range(element + ".height", object.height,
                                 {kObjectSizeMin, kWorldSizeMax, "m"}, "lengths are in metres"))
        return found;
    if (auto found = check_mass(object, element)) return found;
    return check_colour(element + ".colour", object.colour);
}

std::vector<Problem> find_hints(const WorldDefinition& world) {
    std::vector<Problem> hints;
    const auto look = [&hints](const std::string& element, double angle) {
        const Found hint = hint_of_angle(element + ".angle", angle);
        if (hint && hints.size() < kHintsMax) hints.push_back(*hint);
    };
    for (size_t i = 0; i < world.objects.size(); ++i) {
        look(numbered("objects", i), world.objects[i].angle);
    }
    for (size_t i = 0; i < world.robots.size(); ++i) {
        look(numbered("robots", i), world.robots[i].angle);
    }
    for (size_t i = 0; i < world.timeline.size(); ++i) {
        const Action& action = world.timeline[i].action;
        if (const auto* add = std::get_if<AddObject>(&action)) {
            look(numbered("timeline", i) + ".object", add->object.angle);
        } else if (const auto* move = std::get_if<MoveObject>(&action)) {
            look(numbered("timeline", i), move->angle.value_or(0));
        }
    }
    return hints;
}

std::vector<Problem> find_problems(const WorldDefinition& world) {
    Problems problems;
    for (const double side : {world.width, world.height}) {
        if (problems.list.empty())
            problems.add(check_range("size", side, {kWorldSizeMin, kWorldSizeMax, "m"},
                                     "sizes are in metres"));
    }
    problems.add(check_colour("ground.colour", world.ground));
    check_objects(world, problems);
    check_robots(world, problems);
    check_timeline(world, problems);
    check_fleet(world.fleet, problems);
    return std::move(problems.list);
}

std::optional<Problem> find_problem(const WorldDefinition& world) {
    const std::vector<Problem> problems = find_problems(world);
    return problems.empty() ? std::nullopt : std::optional(problems.front());
}

}  // namespace vagus::sim
