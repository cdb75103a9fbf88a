#include "sim/world_file.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/nearest.hpp"
#include "sim/world_check.hpp"

namespace vagus::sim {
namespace {

// Walks the JSON tree into the definitions. Remembers its first failure and then reads zeros, so
// that the functions below say only what the format is.
class FileReader {
public:
    explicit FileReader(std::string_view file) : file_(file) {}

    WorldDefinition world(const Json& json);
    const std::optional<Error>& error() const { return error_; }

    void fail(Place at, const std::string& element, const std::string& what) {
        if (error_) return;
        error_ = Error{Code::BadInput, std::string(file_) + ":" + std::to_string(at.line) + ":" +
                                           std::to_string(at.column) + ": " +
                                           (element.empty() ? "" : element + ": ") + what};
    }

private:
    // An element: where it is in the tree, and what it is called in sentences.
    struct Element {
        const Json& json;
        std::string name;
    };
    // Members of an object, after the check of its keys.
    using Keys = std::vector<std::string>;

    bool is(const Element& element, JsonKind kind) {
        if (error_) return false;
        if (element.json.kind == kind) return true;
        wrong(element, std::string(name_of(kind)));
        return false;
    }
    void wrong(const Element& element, const std::string& expected) {
        const Json& json = element.json;
        const std::string found =
            json.is_number() ? json.text : std::string(name_of(json.kind));
        fail(json.at, element.name, "expected " + expected + ", found " + found);
    }

    bool open(const Element& element, const Keys& required, const Keys& optional);
    void check_keys(const Element& element, const Keys& known);
    static std::string below(const Element& element, const std::string& key) {
        return element.name.empty() ? key : element.name + "." + key;
    }
    // The member of that key, read by `read` into `into`; leaves `into` alone if there is none.
    template <typename T>
    void member(const Element& element, const char* key, T (FileReader::*read)(const Element&),
                T& into) {
        if (error_) return;
        const Json* json = element.json.find(key);
        if (json != nullptr) into = (this->*read)(Element{*json, below(element, key)});
    }
    template <typename T>
    std::vector<T> list(const Element& element, size_t max, T (FileReader::*read)(const Element&));

    double number(const Element& element);
    bool boolean(const Element& element);
    std::string string(const Element& element);
    uint64_t seed(const Element& element);
    uint16_t word(const Element& element);
    Point point(const Element& element);
    Colour colour(const Element& element);
    std::vector<double> numbers(const Element& element, size_t count, const char* example);
    Time seconds(const Element& element);

    ObjectKind object_kind(const Element& element);
    RobotType robot_type(const Element& element);
    ObjectDefinition object(const Element& element);
    RobotDefinition robot(const Element& element);
    TimelineEntry entry(const Element& element);
    Action action(const Element& element, const std::string& verb);
    void ground(const Element& element, WorldDefinition& world);
    std::vector<ObjectDefinition> object_list(const Element& element) {
        return list(element, kObjectsMax, &FileReader::object);
    }
    std::vector<RobotDefinition> robot_list(const Element& element) {
        std::vector<RobotDefinition> robots = list(element, kRobotsMax, &FileReader::robot);
        uint16_t number = 0;
        for (size_t i = 0; i < robots.size(); ++i) {
            ++number;
            if (element.json.items[i].find("node") == nullptr) robots[i].node = number;
        }
        return robots;
    }
    std::vector<TimelineEntry> timeline(const Element& element) {
        return list(element, kTimelineMax, &FileReader::entry);
    }

    std::string_view file_;
    std::optional<Error> error_;
};

WorldDefinition FileReader::world(const Json& json) {
    WorldDefinition world;
    const Element top{json, ""};
    if (!open(top, {"format", "size"},
              {"name", "help", "seed", "open", "ground", "objects", "robots", "timeline"}))
        return world;
    std::string format;
    member(top, "format", &FileReader::string, format);
    if (format != "vagus-world/1") {
        fail(json.find("format")->at, "format",
             "expected \"vagus-world/1\", found \"" + format + "\"; this program reads no other");
    }
    member(top, "name", &FileReader::string, world.name);
    member(top, "help", &FileReader::string, world.help);
    member(top, "seed", &FileReader::seed, world.seed);
    Point size;
    member(top, "size", &FileReader::point, size);
    world.width = size.x;
    world.height = size.y;
    member(top, "open", &FileReader::boolean, world.open);
    if (const Json* ground_json = json.find("ground"); ground_json != nullptr)
        ground({*ground_json, "ground"}, world);
    member(top, "objects", &FileReader::object_list, world.objects);
    member(top, "robots", &FileReader::robot_list, world.robots);
    member(top, "timeline", &FileReader::timeline, world.timeline);
    return world;
}

bool FileReader::open(const Element& element, const Keys& required, const Keys& optional) {
    if (!is(element, JsonKind::Object)) return false;
    Keys known = required;
    known.insert(known.end(), optional.begin(), optional.end());
    check_keys(element, known);
    for (const std::string& key : required) {
        if (element.json.find(key) == nullptr)
            fail(element.json.at, element.name, "\"" + key + "\" is missing; add it");
    }
    return !error_;
}

void FileReader::check_keys(const Element& element, const Keys& known) {
    std::vector<std::string_view> seen;
    for (const JsonMember& each : element.json.members) {
        if (std::find(known.begin(), known.end(), each.key) == known.end()) {
            const std::string guess = nearest(each.key, known);
            fail(each.at, below(element, each.key),
                 guess.empty() ? "there is no such key here; take it out, or see docs/formats.md"
                               : "there is no such key here; did you mean \"" + guess + "\"?");
        } else if (std::find(seen.begin(), seen.end(), each.key) != seen.end()) {
            fail(each.at, below(element, each.key), "stands twice; keep one of them");
        }
        if (error_) return;
        seen.push_back(each.key);
    }
}

template <typename T>
std::vector<T> FileReader::list(const Element& element, size_t max,
                                T (FileReader::*read)(const Element&)) {
    std::vector<T> values;
    if (!is(element, JsonKind::Array)) return values;
    if (element.json.items.size() > max) {
        fail(element.json.at, element.name,
             "expected at most " + std::to_string(max) + " of them, found " +
                 std::to_string(element.json.items.size()) + "; take some away");
    }
    for (size_t i = 0; i < element.json.items.size() && !error_; ++i) {
        values.push_back(
            (this->*read)({element.json.items[i], element.name + "[" + std::to_string(i) + "]"}));
    }
    return values;
}

double FileReader::number(const Element& element) {
    if (error_) return 0;
    if (!element.json.is_number()) wrong(element, "a number");
    return element.json.number;
}

bool FileReader::boolean(const Element& element) {
    return is(element, JsonKind::Bool) && element.json.boolean;
}

std::string FileReader::string(const Element& element) {
    return is(element, JsonKind::String) ? element.json.text : "";
}

// All 64 bits: the tree holds whole numbers up to 2^63 - 1, so larger ones are read from their text.
uint64_t FileReader::seed(const Element& element) {
    if (error_) return 0;
    const std::string& text = element.json.text;
    const bool digits = element.json.is_number() && !text.empty() && text.size() <= 20 &&
                        text.find_first_not_of("0123456789") == std::string::npos;
    if (digits && (text.size() < 20 || text <= "18446744073709551615")) return std::stoull(text);
    wrong(element, "a whole number from 0 to 18446744073709551615");
    return 0;
}

uint16_t FileReader::word(const Element& element) {
    if (error_) return 0;
    const Json& json = element.json;
    if (json.kind == JsonKind::Int && json.integer >= 0 && json.integer <= 65535)
        return static_cast<uint16_t>(json.integer);
    wrong(element, "a whole number from 0 to 65535");
    return 0;
}

std::vector<double> FileReader::numbers(const Element& element, size_t count,
                                        const char* example) {
    std::vector<double> values(count, 0.0);
    if (!is(element, JsonKind::Array)) return values;
    if (element.json.items.size() != count) {
        fail(element.json.at, element.name,
             "expected " + std::to_string(count) + " numbers, found " +
                 std::to_string(element.json.items.size()) + "; write them as " + example);
        return values;
    }
    for (size_t i = 0; i < count; ++i)
        values[i] = number({element.json.items[i], element.name + "[" + std::to_string(i) + "]"});
    return values;
}

Point FileReader::point(const Element& element) {
    const std::vector<double> values = numbers(element, 2, "[0.5, 1]");
    return {values[0], values[1]};
}

Colour FileReader::colour(const Element& element) {
    const std::vector<double> values = numbers(element, 3, "[1, 0.5, 0]");
    return {values[0], values[1], values[2]};
}

Time FileReader::seconds(const Element& element) {
    const double value = number(element);
    if (value >= 0 && value <= kTimelineEndMax)
        return Time(static_cast<Time::rep>(std::floor(value * 1e6 + 0.5)));
    if (!error_) wrong(element, "seconds from 0 to 1000000");
    return {};
}

ObjectKind FileReader::object_kind(const Element& element) {
    const std::string text = string(element);
    std::string all;
    for (const ObjectKind kind : {ObjectKind::Wall, ObjectKind::Box, ObjectKind::Cylinder,
                                  ObjectKind::Patch, ObjectKind::Light, ObjectKind::Infrared}) {
        if (text == name_of(kind)) return kind;
        all += (all.empty() ? "" : ", ") + std::string(name_of(kind));
    }
    fail(element.json.at, element.name, "expected one of " + all + ", found \"" + text + "\"");
    return ObjectKind::Wall;
}

RobotType FileReader::robot_type(const Element& element) {
    const std::string text = string(element);
    for (const RobotType type : {RobotType::Thymio2, RobotType::Epuck})
        if (text == name_of(type)) return type;
    fail(element.json.at, element.name,
         "expected one of thymio2, epuck, found \"" + text + "\"");
    return RobotType::Thymio2;
}

ObjectDefinition FileReader::object(const Element& element) {
    ObjectDefinition object;
    if (!open(element, {"kind", "at"},
              {"id", "angle", "size", "radius", "height", "mass", "colour"}))
        return object;
    member(element, "id", &FileReader::string, object.id);
    member(element, "kind", &FileReader::object_kind, object.kind);
    member(element, "at", &FileReader::point, object.at);
    member(element, "angle", &FileReader::number, object.angle);
    Point size;
    member(element, "size", &FileReader::point, size);
    object.width = size.x;
    object.length = size.y;
    member(element, "radius", &FileReader::number, object.radius);
    member(element, "height", &FileReader::number, object.height);
    member(element, "mass", &FileReader::number, object.mass);
    member(element, "colour", &FileReader::colour, object.colour);
    return object;
}

RobotDefinition FileReader::robot(const Element& element) {
    RobotDefinition robot;
    if (!open(element, {"name", "type", "at"}, {"angle", "node", "port", "script", "paint"}))
        return robot;
    member(element, "name", &FileReader::string, robot.name);
    member(element, "type", &FileReader::robot_type, robot.type);
    member(element, "at", &FileReader::point, robot.at);
    member(element, "angle", &FileReader::number, robot.angle);
    member(element, "node", &FileReader::word, robot.node);
    member(element, "port", &FileReader::word, robot.port);
    member(element, "script", &FileReader::string, robot.script);
    member(element, "paint", &FileReader::colour, robot.paint);
    return robot;
}

TimelineEntry FileReader::entry(const Element& element) {
    TimelineEntry entry;
    if (!is(element, JsonKind::Object)) return entry;
    std::string verb;
    if (element.json.find("t") == nullptr || element.json.find("do") == nullptr)
        fail(element.json.at, element.name, "an entry needs \"t\" and \"do\"; add what is missing");
    member(element, "do", &FileReader::string, verb);
    entry.action = action(element, verb);
    member(element, "t", &FileReader::seconds, entry.at);
    return entry;
}

Action FileReader::action(const Element& element, const std::string& verb) {
    if (verb == "add") {
        AddObject add;
        if (open(element, {"t", "do", "object"}, {}))
            member(element, "object", &FileReader::object, add.object);
        return add;
    }
    if (verb == "move") {
        MoveObject move;
        if (!open(element, {"t", "do", "id", "at"}, {"angle"})) return move;
        member(element, "id", &FileReader::string, move.id);
        member(element, "at", &FileReader::point, move.at);
        double angle = 0;
        member(element, "angle", &FileReader::number, angle);
        if (element.json.find("angle") != nullptr) move.angle = angle;
        return move;
    }
    if (verb == "press" || verb == "release") {
        PressButton press{.robot = "", .button = "", .pressed = verb == "press"};
        if (!open(element, {"t", "do", "robot", "button"}, {})) return press;
        member(element, "robot", &FileReader::string, press.robot);
        member(element, "button", &FileReader::string, press.button);
        return press;
    }
    if (verb == "light") {
        SwitchLight light;
        if (!open(element, {"t", "do", "id", "on"}, {})) return light;
        member(element, "id", &FileReader::string, light.id);
        member(element, "on", &FileReader::boolean, light.on);
        return light;
    }
    RemoveObject remove;
    if (verb != "remove" && !error_) {
        fail(element.json.find("do")->at, below(element, "do"),
             "expected one of add, remove, move, press, release, light, found \"" + verb + "\"");
    }
    if (open(element, {"t", "do", "id"}, {})) member(element, "id", &FileReader::string, remove.id);
    return remove;
}

void FileReader::ground(const Element& element, WorldDefinition& world) {
    if (!open(element, {}, {"colour", "image"})) return;
    const bool both =
        element.json.find("colour") != nullptr && element.json.find("image") != nullptr;
    if (both)
        fail(element.json.at, element.name, "has a colour and an image; keep one of them");
    member(element, "colour", &FileReader::colour, world.ground);
    member(element, "image", &FileReader::string, world.ground_image);
}

// The place of an element of the tree by its name, "objects[3].mass"; of its nearest parent if it is
// not written.
Place place_of(const Json& top, std::string_view name) {
    const Json* at = &top;
    while (!name.empty()) {
        const size_t end = std::min(name.find_first_of(".[", 1), name.size());
        const std::string_view step = name.substr(0, end);
        name.remove_prefix(end);
        if (step.front() == '[') {
            const size_t index = std::stoul(std::string(step.substr(1)));
            if (index >= at->items.size()) break;
            at = &at->items[index];
        } else {
            const Json* next = at->find(step.front() == '.' ? step.substr(1) : step);
            if (next == nullptr) break;
            at = next;
        }
    }
    return at->at;
}

}  // namespace

Result<WorldDefinition> read_world(std::string_view text, std::string_view file) {
    const Json json = TRY(parse_json(text, file));
    FileReader reader(file);
    WorldDefinition world = reader.world(json);
    if (!reader.error()) {
        if (const auto problem = find_problem(world))
            reader.fail(place_of(json, problem->element), problem->element, problem->what);
    }
    if (reader.error()) return *reader.error();
    return world;
}

Status check_world(const WorldDefinition& world) {
    if (const auto problem = find_problem(world))
        return Error{Code::BadInput, problem->element + ": " + problem->what};
    return Status::done();
}

}  // namespace vagus::sim
