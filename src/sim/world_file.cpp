#include "sim/world_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/file_format.hpp"
#include "base/json.hpp"
#include "base/json_object.hpp"
#include "sim/robot_grid.hpp"
#include "sim/world_check.hpp"

namespace vagus::sim {
namespace {

// ---- Values that JsonObject does not know. Each leaves its complaint and gives a harmless value.
// ----

// An array of exactly `count` numbers. Ranges are checked later, by world_check.
std::vector<double> read_numbers(JsonObject& in, std::string_view key, size_t count,
                                 const std::string& example) {
    std::vector<double> values;
    const JsonValue* list = in.find(key, JsonKind::Array, Need::Optional);
    if (list == nullptr) return values;
    for (const JsonValue& item : list->items)
        if (item.is_number() && values.size() < count) values.push_back(item.number);
    if (values.size() == count && list->items.size() == count) return values;
    in.complain(list->at, in.name() + "." + std::string(key) + ": expected " +
                              std::to_string(count) + " numbers; write them as " + example);
    return {};
}

void read_point(JsonObject& in, std::string_view key, Need need, Point& into) {
    if (need == Need::Required && in.find(key, need) == nullptr) return;
    const std::vector<double> values = read_numbers(in, key, 2, "[0.5, 1]");
    if (!values.empty()) into = {values[0], values[1]};
}

void read_colour(JsonObject& in, std::string_view key, Colour& into) {
    const std::vector<double> values = read_numbers(in, key, 3, "[1, 0.5, 0]");
    if (!values.empty()) into = {values[0], values[1], values[2]};
}

void read_number(JsonObject& in, std::string_view key, double& into) {
    into = in.number(key, {.fallback = into});
}

constexpr ObjectKind kObjectKinds[] = {ObjectKind::Wall,  ObjectKind::Box,   ObjectKind::Cylinder,
                                       ObjectKind::Patch, ObjectKind::Light, ObjectKind::Infrared};
constexpr RobotType kRobotTypes[] = {RobotType::Thymio2, RobotType::Epuck, RobotType::Carbot};

// One of an enumeration by its name.
template <typename Enum, size_t kCount>
Enum read_word(JsonObject& in, std::string_view key, const Enum (&all)[kCount]) {
    std::vector<std::string_view> words;
    for (const Enum each : all) words.push_back(name_of(each));
    const std::string word = in.word(key, words, Need::Required, words.front());
    return all[std::find(words.begin(), words.end(), word) - words.begin()];
}

// ---- The elements of the file ----

ObjectDefinition read_object(const JsonValue& json, const std::string& name,
                             Complaints& complaints) {
    JsonObject in(json, name, complaints);
    ObjectDefinition object;
    object.id = in.text("id", Need::Optional);
    object.kind = read_word(in, "kind", kObjectKinds);
    read_point(in, "at", Need::Required, object.at);
    read_number(in, "angle", object.angle);
    Point size;
    read_point(in, "size", Need::Optional, size);
    object.width = size.x;
    object.length = size.y;
    read_number(in, "radius", object.radius);
    read_number(in, "height", object.height);
    read_number(in, "mass", object.mass);
    read_colour(in, "colour", object.colour);
    in.finish();
    return object;
}

RobotDefinition read_robot(JsonObject& in, int64_t node) {
    RobotDefinition robot;
    robot.name = in.text("name", Need::Required);
    robot.type = read_word(in, "type", kRobotTypes);
    read_point(in, "at", Need::Required, robot.at);
    read_number(in, "angle", robot.angle);
    robot.project = in.text("project", Need::Optional);
    if (!robot.project.empty()) node = 1;  // it is alone on its bus
    robot.node =
        static_cast<uint16_t>(in.integer("node", {.low = 1, .high = kNodeLast, .fallback = node}));
    if (in.find("port", Need::Optional) != nullptr)
        robot.port = static_cast<uint16_t>(in.integer("port", {.low = 0, .high = 65535}));
    robot.script = in.text("script", Need::Optional);
    read_colour(in, "paint", robot.paint);
    return robot;
}

bool is_count(double value) {
    return value >= 1 && value <= static_cast<double>(kRobotsMax) && value == std::floor(value);
}

// One number for both directions, or one for each.
void read_spacing(JsonObject& in, const RobotGrid& grid, Point& into) {
    const JsonValue* json = in.find("spacing", Need::Required);
    if (json == nullptr) return;
    if (json->is_number()) {
        into = {json->number, json->number};
    } else {
        read_point(in, "spacing", Need::Required, into);
    }
    const bool apart = (grid.columns == 1 || into.x > 0) && (grid.rows == 1 || into.y > 0);
    if (apart) return;
    in.complain(json->at, in.name() +
                              ".spacing: expected metres above 0 between robots; write it as 0.3, "
                              "or as [0.3, 0.4] for columns and rows");
}

// What is wrong leaves one robot.
RobotGrid read_grid(JsonObject& in) {
    RobotGrid grid;
    const JsonValue* json = in.find("grid", Need::Optional);
    if (json == nullptr) {
        if (const JsonValue* spacing = in.find("spacing", Need::Optional)) {
            in.complain(spacing->at, in.name() +
                                         ".spacing: is for a grid of robots; write \"grid\": "
                                         "[columns, rows], or remove it");
        }
        return grid;
    }
    const std::vector<double> counts = read_numbers(in, "grid", 2, "[6, 5]");
    if (counts.empty()) return grid;
    if (!is_count(counts[0]) || !is_count(counts[1]) ||
        counts[0] * counts[1] > static_cast<double>(kRobotsMax)) {
        in.complain(json->at, in.name() +
                                  ".grid: expected columns and rows, whole numbers from 1 "
                                  "on and at most " +
                                  std::to_string(kRobotsMax) +
                                  " robots together; write them as [6, 5]");
        return grid;
    }
    grid.columns = static_cast<size_t>(counts[0]);
    grid.rows = static_cast<size_t>(counts[1]);
    read_spacing(in, grid, grid.spacing);
    return grid;
}

// What only one robot can have, or what does not fit all of them.
void check_copies(JsonObject& in, const RobotDefinition& first, size_t count) {
    if (first.port.value_or(0) != 0) {
        in.complain(in.find("port", Need::Optional)->at,
                    in.name() +
                        ".port: robots of a grid cannot share a port; write 0, which gives "
                        "each a free one");
    }
    const size_t last = first.node + count * nodes_of(first.type) - 1;
    if (first.project.empty() && last > kNodeLast) {
        in.complain(in.at(), in.name() + ".node: the last robot of the grid would have the node " +
                                 std::to_string(last) + ", and " + std::to_string(kNodeLast) +
                                 " is the last there can be; begin at a smaller one");
    }
}

// A robot, or with "grid" many of them, goes behind those that are there.
void read_robots(const JsonValue& json, const std::string& name, int64_t& node,
                 std::vector<RobotDefinition>& robots, Complaints& complaints) {
    JsonObject in(json, name, complaints);
    const RobotDefinition robot = read_robot(in, node);
    const RobotGrid grid = read_grid(in);
    const size_t count = grid.columns * grid.rows;
    if (in.find("grid", Need::Optional) == nullptr) {
        robots.push_back(robot);
    } else if (robots.size() + count > kRobotsMax) {
        in.complain(in.at(), name + ".grid: with it there would be " +
                                 std::to_string(robots.size() + count) + " robots, and " +
                                 std::to_string(kRobotsMax) + " are the most; make it smaller");
    } else {
        check_copies(in, robot, count);
        for (RobotDefinition& one : spread(robot, grid)) robots.push_back(std::move(one));
    }
    if (robot.project.empty()) node += static_cast<int64_t>(count) * nodes_of(robot.type);
    in.finish();
}

Action read_action(JsonObject& in, const std::string& verb, Complaints& complaints) {
    if (verb == "add") {
        AddObject add;
        const JsonValue* object = in.find("object", JsonKind::Object, Need::Required);
        if (object != nullptr) add.object = read_object(*object, in.name() + ".object", complaints);
        return add;
    }
    if (verb == "move") {
        MoveObject move{.id = in.text("id", Need::Required), .at = {}, .angle = {}};
        read_point(in, "at", Need::Required, move.at);
        if (in.find("angle", Need::Optional) != nullptr) move.angle = in.number("angle", {});
        return move;
    }
    if (verb == "press" || verb == "release") {
        return PressButton{.robot = in.text("robot", Need::Required),
                           .button = in.text("button", Need::Required),
                           .pressed = verb == "press"};
    }
    if (verb == "light") {
        std::string id = in.text("id", Need::Required);
        const bool given = in.find("on", JsonKind::Bool, Need::Required) != nullptr;
        return SwitchLight{.id = std::move(id), .on = given && in.boolean("on", true)};
    }
    if (verb == "cut" || verb == "restore") {
        return CutFleet{.robot = in.text("robot", Need::Optional), .cut = verb == "cut"};
    }
    if (verb == "keeper") {
        const bool given = in.find("on", JsonKind::Bool, Need::Required) != nullptr;
        return RunKeeper{.on = given && in.boolean("on", true)};
    }
    return RemoveObject{in.text("id", Need::Required)};
}

TimelineEntry read_entry(const JsonValue& json, const std::string& name, Complaints& complaints) {
    JsonObject in(json, name, complaints);
    TimelineEntry entry;
    const double seconds =
        in.number("t", {.low = 0, .high = kTimelineEndMax, .need = Need::Required});
    entry.at = Time(static_cast<Time::rep>(std::floor(seconds * 1e6 + 0.5)));
    const std::string verb = in.word(
        "do", {"add", "remove", "move", "press", "release", "light", "cut", "restore", "keeper"},
        Need::Required);
    if (verb.empty()) return entry;  // complained of; its other keys mean nothing
    entry.action = read_action(in, verb, complaints);
    in.finish();
    return entry;
}

void read_ground(const JsonValue& json, WorldDefinition& world, Complaints& complaints) {
    JsonObject in(json, "ground", complaints);
    read_colour(in, "colour", world.ground);
    world.ground_image = in.text("image", Need::Optional);
    if (json.find("colour") != nullptr && json.find("image") != nullptr)
        in.complain(json.at, "ground: has a colour and an image; keep one of them");
    in.finish();
}

Duration read_delay(JsonObject& in, std::string_view key, Duration fallback) {
    const double seconds = in.number(key, {.fallback = seconds_of(fallback)});
    // Ranges are checked later; whatever could not be counted in microseconds is beyond them.
    const double counted = std::clamp(seconds, -2 * kFleetDelayMax, 2 * kFleetDelayMax);
    return Duration(static_cast<Duration::rep>(std::floor(counted * 1e6 + 0.5)));
}

void read_fleet(const JsonValue& json, FleetDefinition& fleet, Complaints& complaints) {
    JsonObject in(json, "fleet", complaints);
    fleet.latency = read_delay(in, "latency", fleet.latency);
    fleet.jitter = read_delay(in, "jitter", fleet.jitter);
    read_number(in, "loss", fleet.loss);
    read_number(in, "twice", fleet.twice);
    in.finish();
}

// The items of a list, at most `max`.
const std::vector<JsonValue>& read_list(JsonObject& in, std::string_view key, size_t max) {
    static const std::vector<JsonValue> kNothing;
    const std::vector<JsonValue>& items = in.items(key, Need::Optional);
    if (items.size() <= max) return items;
    in.complain(in.find(key, Need::Optional)->at,
                std::string(key) + ": expected at most " + std::to_string(max) +
                    " of them, found " + std::to_string(items.size()) + "; remove some");
    return kNothing;
}

WorldDefinition read_all(const JsonValue& json, Complaints& complaints) {
    JsonObject in(json, "the world", complaints);
    WorldDefinition world;
    check_format(in, FileFormat::World);
    world.name = in.text("name", Need::Optional);
    world.help = in.text("help", Need::Optional);
    world.seed = static_cast<uint64_t>(in.integer("seed", {.low = 0, .fallback = 1}));
    Point size = {world.width, world.height};
    read_point(in, "size", Need::Required, size);
    world.width = size.x;
    world.height = size.y;
    world.open = in.boolean("open", false);
    if (const JsonValue* ground = in.find("ground", JsonKind::Object, Need::Optional))
        read_ground(*ground, world, complaints);
    for (const JsonValue& item : read_list(in, "objects", kObjectsMax)) {
        world.objects.push_back(
            read_object(item, numbered("objects", world.objects.size()), complaints));
    }
    size_t entry = 0;
    int64_t node = 1;  // the next one, if every robot of the common bus takes its own from 1 on
    for (const JsonValue& item : read_list(in, "robots", kRobotsMax)) {
        read_robots(item, numbered("robots", entry++), node, world.robots, complaints);
    }
    if (const JsonValue* fleet = in.find("fleet", JsonKind::Object, Need::Optional))
        read_fleet(*fleet, world.fleet, complaints);
    for (const JsonValue& item : read_list(in, "timeline", kTimelineMax)) {
        world.timeline.push_back(
            read_entry(item, numbered("timeline", world.timeline.size()), complaints));
    }
    in.finish();
    return world;
}

// The place of an element of the tree by its name, "objects[3].mass"; of its nearest parent if it
// is not written.
Place place_of(const JsonValue& top, std::string_view name) {
    const JsonValue* at = &top;
    while (!name.empty()) {
        const size_t end = std::min(name.find_first_of(".[", 1), name.size());
        const std::string_view step = name.substr(0, end);
        name.remove_prefix(end);
        if (step.front() == '[') {
            const size_t index = std::stoul(std::string(step.substr(1)));
            if (index >= at->items.size()) break;
            at = &at->items[index];
        } else {
            const JsonValue* next = at->find(step.front() == '.' ? step.substr(1) : step);
            if (next == nullptr) break;
            at = next;
        }
    }
    return at->at;
}

// What the whole must keep to is looked at once each part is right.
WorldDefinition read_checked(const JsonValue& json, Complaints& complaints) {
    WorldDefinition world = read_all(json, complaints);
    if (!complaints.empty()) return world;
    for (const Problem& one : find_problems(world)) {
        const std::string element = element_of_file(json, one.element);
        complaints.push_back({place_of(json, element), element + ": " + one.what});
    }
    return world;
}

}  // namespace

Result<WorldDefinition> read_world(std::string_view text, std::string_view file) {
    const JsonValue json = TRY(parse_format(text, file, FileFormat::World));
    Complaints complaints;
    WorldDefinition world = read_checked(json, complaints);
    if (!complaints.empty()) return first_complaint(complaints, file);
    return world;
}

std::vector<Error> mistakes_of_world(std::string_view text, std::string_view file) {
    const Result<JsonValue> json = parse_format(text, file, FileFormat::World);
    if (!json.ok()) return {json.error()};
    Complaints complaints;
    read_checked(json.value(), complaints);
    return errors_of(std::move(complaints), file);
}

std::vector<std::string> hints_of_world(std::string_view text, std::string_view file) {
    std::vector<std::string> lines;
    const Result<JsonValue> json = parse_json(text, file);
    if (!json.ok()) return lines;
    Complaints complaints;
    for (const Problem& hint : find_hints(read_all(json.value(), complaints))) {
        const std::string element = element_of_file(json.value(), hint.element);
        const std::string line = at_place(file, place_of(json.value(), element),
                                          "warning: " + element + ": " + hint.what);
        // The robots of a grid have one entry, and one slip.
        if (lines.empty() || lines.back() != line) lines.push_back(line);
    }
    return lines;
}

Error error_in_world(const Error& error, std::string_view text, std::string_view file) {
    const Result<JsonValue> json = parse_json(text, file);
    if (!json.ok()) return json.error();
    const size_t end = std::min(error.what.find(": "), error.what.size());
    const std::string element = element_of_file(json.value(), error.what.substr(0, end));
    Error placed = first_complaint(
        {{place_of(json.value(), element), element + error.what.substr(end)}}, file);
    placed.code = error.code;
    return placed;
}

size_t entry_of_robot(std::string_view text, std::string_view file, size_t robot) {
    const Result<JsonValue> json = parse_json(text, file);
    const JsonValue* robots = json.ok() ? json.value().find("robots") : nullptr;
    return robots == nullptr ? robot : entry_of_robot(*robots, robot);
}

Status check_world(const WorldDefinition& world) {
    if (const auto problem = find_problem(world))
        return Error{Code::BadInput, problem->element + ": " + problem->what};
    return Status::done();
}

}  // namespace vagus::sim
