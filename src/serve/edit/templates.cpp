#include "serve/edit/templates.hpp"

#include <fmt/format.h>

#include "aesl/project.hpp"
#include "base/json.hpp"
#include "base/json_part.hpp"
#include "plan/formula.hpp"

namespace vagus::serve {

namespace {

using Members = std::vector<JsonMember>;

JsonValue number(std::string_view written) {
    JsonValue json;
    json.kind = JsonKind::Float;
    json.text = written;
    return json;
}

std::string project_of(const NewNode& node, aesl::CommonDefinitions common,
                       const std::string& source) {
    aesl::Project project;
    project.common = std::move(common);
    aesl::Script& script = project.scripts.emplace_back();
    script.node = node.name;
    script.node_id = node.id;
    script.source = source;
    return aesl::format_project(project);
}

}  // namespace

std::string name_of_file(std::string_view path) {
    const size_t slash = path.rfind('/');
    std::string_view stem = path.substr(slash == path.npos ? 0 : slash + 1);
    stem = stem.substr(0, stem.find('.'));
    std::string name;
    for (const char letter : stem) {
        const bool plain = (letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') ||
                           (letter >= 'a' && letter <= 'z');
        if (plain) {
            name += letter;
        } else if (!name.ends_with('_')) {
            name += '_';
        }
    }
    return plan::is_name(name) ? name : "New" + name;
}

std::string new_script(const NewNode& node) {
    return project_of(node, {},
                      "# What is written here runs once, at the start.\n"
                      "\n"
                      "# What follows \"onevent NAME\" runs each time that event comes.\n");
}

std::string new_plan(std::string_view name) {
    const Members wait = {json_member("template", "Wait"),
                          json_member("in", {json_member("seconds", "1")}),
                          json_member("states", {json_member("Done", "@terminate")})};
    const auto place = [](int x, int y) { return json_array({json_integer(x), json_integer(y)}); };
    // What has no place of its own is placed again each time the file is opened, around what has.
    const Members layout = {json_member("@start", place(80, 80)),
                            json_member("wait", place(80, 160))};
    return format_json(json_object(
        {json_member("format", "vagus-plan/1"), json_member("name", name),
         json_member("start", {json_member("actor", "wait")}),
         json_member("actors", {json_member("wait", wait)}), json_member("layout", layout)}));
}

std::string new_world(std::string_view name) {
    const JsonValue robot =
        json_object({json_member("name", "thymio"), json_member("type", "thymio2"),
                     json_member("at", json_array({number("0.5"), number("0.5")}))});
    return format_json(json_object(
        {json_member("format", "vagus-world/1"), json_member("name", name),
         json_member("size", json_array({json_integer(2), number("1.5")})),
         json_member("objects", json_array({})), json_member("robots", json_array({robot}))}));
}

std::string new_toolbox(const std::string& name, const std::string& script, const NewNode& node) {
    const Members work = {
        json_member("kind", "actor"),
        json_member("help", "What it does."),
        json_member("node", node.name),
        json_member("start", name + ".start"),
        json_member("stop", name + ".stop"),
        json_member("stopped", name + ".stopped"),
        json_member("states", {json_member("Done", {json_member("event", name + ".done")})})};
    return format_json(json_object({json_member("format", "vagus-toolbox/1"),
                                    json_member("name", name), json_member("project", script),
                                    json_member("templates", {json_member("Work", work)})}));
}

std::string new_toolbox_script(const std::string& name, const NewNode& node) {
    aesl::CommonDefinitions common;
    for (const char* event : {".start", ".stop", ".stopped", ".done"}) {
        common.events.push_back({name + event, 1});
    }
    const std::string token = node.args + "[0]";
    return project_of(
        node, std::move(common),
        fmt::format(
            "# A plan gives a token with each start, and takes only answers that carry it.\n"
            "var token = 0\n"
            "\n"
            "# The work begins here; this one is done at once.\n"
            "onevent {0}.start\n"
            "\ttoken = {1}\n"
            "\temit {0}.done token\n"
            "\n"
            "# The plan wants it to end: stop what moves, then say so.\n"
            "onevent {0}.stop\n"
            "\temit {0}.stopped [{1}]\n",
            name, token));
}

}  // namespace vagus::serve
