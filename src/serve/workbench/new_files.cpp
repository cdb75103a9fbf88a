#include "serve/workbench/new_files.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "serve/edit/templates.hpp"

namespace vagus::serve {

namespace {

constexpr const char* kThymioScript = R"(# Runs when the program starts.
motor.left.target = 0
motor.right.target = 0

# Each time the distance sensors have been read, ten times a second.
# The five in front are prox.horizontal[0] to prox.horizontal[4], from left to right.
onevent prox
    if prox.horizontal[2] > 1000 then
        call leds.top(32, 0, 0)
    else
        call leds.top(0, 32, 0)
    end

# When the button with the arrow ahead is pressed or let go.
# In the simulator, select the robot in the world: its buttons are below it.
onevent button.forward
    if button.forward == 1 then
        motor.left.target = 200
        motor.right.target = 200
    end

# The button in the middle stops the robot.
onevent button.center
    motor.left.target = 0
    motor.right.target = 0
)";

constexpr const char* kEpuckScript = R"(# Runs when the program starts.
speed.left = 0
speed.right = 0

# Each time the infrared sensors have been read, 33 times a second. prox[0] looks ahead.
onevent ir_sensors
    if prox[0] > 300 then
        color.red = 100
        color.green = 0
    else
        color.red = 0
        color.green = 100
    end
)";

std::string aesl(const std::string& nodes) {
    return "<!DOCTYPE aesl-source>\n<network>\n\n\n<!--list of global events-->\n\n\n<!--list of "
           "constants-->\n\n\n<!--show keywords state-->\n<keywords flag=\"true\"/>\n" +
           nodes + "\n\n</network>\n";
}

std::string node(const std::string& name, int id, const std::string& script) {
    return fmt::format(
        "\n\n<!--node {0}-->\n<node nodeId=\"{1}\" name=\"{0}\"><![CDATA[{2}]]></node>", name, id,
        script);
}

std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump();
}

// A room for the robot, with something to drive around: each robot has one of its size.
struct Room {
    const char* size;
    const char* start;
    const char* box;
    const char* post;
};
constexpr Room kTable = {"[1.6, 1.2]", "[0.4, 0.4]",
                         R"("at": [1.1, 0.8], "angle": 0.5, "size": [0.2, 0.15])",
                         R"("at": [0.8, 0.3], "radius": 0.05)"};
constexpr Room kHall = {"[6, 4.5]", "[1.2, 1.2]",
                        R"("at": [4, 3], "angle": 0.5, "size": [0.8, 0.5])",
                        R"("at": [3, 1.2], "radius": 0.15)"};

// A short way, so that there is something to see.
constexpr const char* kDrivingPlan = R"(
  "toolboxes": ["drive"],
  "configuration": {
    "distance": { "type": "float", "initial": 50, "unit": "cm", "help": "how far it drives" }
  },
  "start": {
    "actor": "driveAhead"
  },
  "actors": {
    "driveAhead": {
      "template": "Forward",
      "in": { "distance": "distance" },
      "states": { "ForwardSuccessful": "turnLeft" }
    },
    "turnLeft": {
      "template": "Turn",
      "in": { "angle": 90 },
      "states": { "TurnSuccessful": "@terminate" }
    }
  },
  "layout": {
    "driveAhead": [80, 80],
    "turnLeft": [320, 80]
  }
}
)";

// For robots whose scripts obey no driving commands.
constexpr const char* kWaitingPlan = R"(
  "start": {
    "actor": "wait"
  },
  "actors": {
    "wait": {
      "template": "Wait",
      "in": { "seconds": 1 },
      "states": { "Done": "@terminate" }
    }
  },
  "layout": {
    "wait": [80, 80]
  }
}
)";

// A plan is called by a name of a language: letters, digits and _ (docs/plans.md, P1).
std::string plan_name(const std::string& name) {
    std::string letters;
    for (const char letter : name) {
        const bool good = std::isalnum(static_cast<unsigned char>(letter)) != 0;
        letters += good ? letter : '_';
    }
    return std::isdigit(static_cast<unsigned char>(letters.front())) != 0 ? "plan_" + letters
                                                                          : letters;
}

std::string plan_text(const std::string& name, const std::string& robot, bool small) {
    if (!small) return new_plan(plan_name(name));
    return fmt::format("{{\n  \"format\": \"vagus-plan/1\",\n  \"name\": {},",
                       quoted(plan_name(name))) +
           (robot == "epuck" ? kWaitingPlan : kDrivingPlan);
}

// Scripts that obey driving commands come from the examples; without those, empty ones.
std::string example_or(const std::string& examples, const std::string& path,
                       const std::string& otherwise) {
    const auto text = read_file((std::filesystem::path(examples) / path).string());
    return text.ok() ? text.value() : otherwise;
}

}  // namespace

std::string new_room(const std::string& name, const std::string& robot, const std::string& script) {
    const Room& room = robot == "carbot" ? kHall : kTable;
    return fmt::format(
        R"({{
  "format": "vagus-world/1",
  "name": {},
  "size": {},
  "objects": [
    {{ "id": "box", "kind": "box", {} }},
    {{ "id": "post", "kind": "cylinder", {}, "colour": [0.8, 0.3, 0.2] }}
  ],
  "robots": [{{ "name": "{}", "type": "{}", "at": {}, "script": {} }}]
}}
)",
        quoted(name), room.size, room.box, room.post, robot == "thymio2" ? "thymio" : robot, robot,
        room.start, quoted(script));
}

std::string new_scripts(const std::string& robot, bool plan, const std::string& examples) {
    if (robot == "epuck") return kEpuckScript;
    if (robot == "thymio2") {
        const std::string own = aesl(node("thymio-II", 1, kThymioScript));
        return plan ? example_or(examples, "thymio/drive.aesl", own) : own;
    }
    return example_or(examples, "carbot/carbot.aesl",
                      aesl(node("drive", 1, "") + node("bumper", 2, "") + node("range", 3, "") +
                           node("head", 4, "")));
}

std::vector<NewFile> new_project_files(const std::string& name, const std::string& robot, bool plan,
                                       const std::string& examples) {
    const std::string script = name + ".aesl";
    // The scripts of a Carbot are there to be driven by a plan.
    const bool drawn = plan || robot == "carbot";
    std::string project =
        fmt::format("{{\n  \"format\": \"vagus-project/1\",\n  \"name\": {},\n", quoted(name));
    if (drawn) project += fmt::format("  \"plan\": {},\n", quoted(name + ".plan.json"));
    project += fmt::format("  \"scripts\": [{}],\n  \"world\": {},\n  \"target\": \"sim\"",
                           quoted(script), quoted(name + ".world.json"));
    project += drawn ? ",\n  \"start\": {\n    \"plan\": true\n  }\n}\n" : "\n}\n";
    std::vector<NewFile> files = {{"vagus.json", project},
                                  {script, new_scripts(robot, plan, examples)},
                                  {name + ".world.json", new_room(name, robot, script)}};
    if (drawn) files.push_back({name + ".plan.json", plan_text(name, robot, plan)});
    return files;
}

std::string new_scripts_file() {
    return aesl("");
}

std::vector<NewFile> robot_project_files(const std::string& target) {
    return {{"vagus.json",
             fmt::format("{{\n  \"format\": \"vagus-project/1\",\n  \"name\": \"Robot\",\n  "
                         "\"help\": {},\n  \"scripts\": [\"robot.aesl\"],\n  \"target\": {}\n}}\n",
                         quoted("The nodes of " + target), quoted(target))},
            {"robot.aesl", aesl("")}};
}

}  // namespace vagus::serve
