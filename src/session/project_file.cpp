#include "session/project_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "base/file.hpp"
#include "base/file_format.hpp"
#include "base/json_object.hpp"
#include "base/project_border.hpp"
#include "net/target.hpp"

namespace vagus::session {
namespace {

namespace fs = std::filesystem;

// A file that the project names, and where.
struct Named {
    Place at;
    std::string key;
    std::string path;
};

struct Reading {
    ProjectFile project;
    std::vector<Named> files;
    Complaints complaints;
};

bool is_good_path(JsonObject& in, const JsonValue& json, std::string_view key) {
    if (json.kind != JsonKind::String) {
        in.complain(json.at, fmt::format("\"{}\" of {} holds paths in quotes, not {}", key,
                                         in.name(), name_of(json.kind)));
        return false;
    }
    const bool fits = !json.text.empty() && json.text.size() <= kProjectPathBytesMax &&
                      json.text.find('\0') == std::string::npos;
    if (fits) return true;
    in.complain(json.at, fmt::format("\"{}\" of {}: expected a path of 1 to {} bytes; leave the "
                                     "key out if there is no such file",
                                     key, in.name(), kProjectPathBytesMax));
    return false;
}

std::string read_path(Reading& reading, JsonObject& in, std::string_view key) {
    const JsonValue* json = in.find(key, JsonKind::String, Need::Optional);
    if (json == nullptr || !is_good_path(in, *json, key)) return "";
    reading.files.push_back({json->at, std::string(key), json->text});
    return json->text;
}

std::vector<std::string> read_paths(Reading& reading, JsonObject& in, std::string_view key) {
    std::vector<std::string> paths;
    const std::vector<JsonValue>& items = in.items(key, Need::Optional);
    if (items.size() > kProjectPathsMax) {
        in.complain(in.find(key, Need::Optional)->at,
                    fmt::format("\"{}\" of {}: expected at most {} paths, found {}; remove some",
                                key, in.name(), kProjectPathsMax, items.size()));
        return paths;
    }
    std::set<std::string_view> seen;
    for (const JsonValue& item : items) {
        if (!is_good_path(in, item, key)) continue;
        if (!seen.insert(item.text).second) {
            in.complain(item.at, fmt::format("\"{}\" of {} names {} twice; keep one of them", key,
                                             in.name(), json_quote(item.text)));
            continue;
        }
        reading.files.push_back({item.at, std::string(key), item.text});
        paths.push_back(item.text);
    }
    return paths;
}

void read_target(Reading& reading, JsonObject& in) {
    reading.project.target = in.text("target", Need::Optional, "sim");
    if (reading.project.target == "sim") return;
    const auto target = net::parse_target(reading.project.target);
    if (target.ok()) return;
    in.complain(in.find("target", Need::Optional)->at,
                fmt::format("\"target\" of {}: expected \"sim\" or a target: {}", in.name(),
                            target.error().what));
}

// Values as `--set` takes them.
std::string set_text(const JsonValue& value) {
    if (value.kind == JsonKind::Bool) return value.boolean ? "true" : "false";
    return value.text;
}

void read_set(Reading& reading, JsonObject& start) {
    const JsonValue* set = start.find("set", JsonKind::Object, Need::Optional);
    if (set == nullptr) return;
    if (set->members.size() > kProjectVariablesMax) {
        start.complain(set->at,
                       fmt::format("\"set\" of {}: expected at most {} variables, found "
                                   "{}; remove some",
                                   start.name(), kProjectVariablesMax, set->members.size()));
        return;
    }
    std::set<std::string_view> seen;
    for (const JsonMember& member : set->members) {
        const JsonKind kind = member.value.kind;
        const bool constant =
            kind == JsonKind::Bool || kind == JsonKind::String || member.value.is_number();
        if (!constant) {
            start.complain(member.value.at,
                           fmt::format("the value of {} in \"set\" is {}; write a number, a text, "
                                       "true or false",
                                       json_quote(member.key), name_of(kind)));
        } else if (!seen.insert(member.key).second) {
            start.complain(member.at, fmt::format("\"set\" has the variable {} a second time; "
                                                  "remove one",
                                                  json_quote(member.key)));
        } else {
            reading.project.start_set.emplace_back(member.key, set_text(member.value));
        }
    }
}

void read_start(Reading& reading, JsonObject& in) {
    const JsonValue* json = in.find("start", JsonKind::Object, Need::Optional);
    if (json == nullptr) return;
    JsonObject start(*json, "\"start\"", reading.complaints);
    reading.project.start_plan = start.boolean("plan", false);
    read_set(reading, start);
    start.finish();
    if (reading.project.start_plan && reading.project.plan.empty()) {
        in.complain(json->at,
                    "\"start\" begins the plan, but the project has no \"plan\"; name "
                    "one, or write \"plan\": false");
    }
}

Result<JsonValue> parse(std::string_view text, const std::string& file) {
    if (text.size() > kProjectBytesMax) {
        return Error{Code::Limit, fmt::format("{}: has {} bytes; {} are the most that is read",
                                              file, text.size(), kProjectBytesMax)};
    }
    return parse_format(text, file, FileFormat::Project);
}

// Its complaints are left in it.
Reading read_members(const JsonValue& json, const std::string& file) {
    Reading reading;
    reading.project.file = file;
    JsonObject in(json, "the project", reading.complaints);
    check_format(in, FileFormat::Project);
    reading.project.name = in.text("name", Need::Optional);
    reading.project.help = in.text("help", Need::Optional);
    reading.project.plan = read_path(reading, in, "plan");
    reading.project.scripts = read_paths(reading, in, "scripts");
    reading.project.world = read_path(reading, in, "world");
    reading.project.toolboxes = read_paths(reading, in, "toolboxes");
    read_target(reading, in);
    read_start(reading, in);
    reading.project.safe_stop = toolbox::read_safe_stop(in, reading.complaints);
    reading.project.stops_alone =
        in.word("when_alone", {"run", "stop"}, Need::Optional, "run") == "stop";
    reading.project.fleet = fleet::read_project_part(in, reading.complaints);
    in.finish();
    return reading;
}

Result<Reading> read_all(std::string_view text, const std::string& file) {
    const JsonValue json = TRY(parse(text, file));
    Reading reading = read_members(json, file);
    if (!reading.complaints.empty()) return first_complaint(reading.complaints, file);
    return reading;
}

Status check_file(const std::string& file, const Named& named) {
    const auto refuse = [&](Code code, const std::string& why) {
        return Error{code, at_place(file, named.at, "\"" + named.key + "\": " + why)};
    };
    const Result<std::string> path = path_beside(file, named.path);
    if (!path.ok()) return refuse(path.error().code, path.error().what);
    std::error_code error;
    if (fs::is_regular_file(path.value(), error)) return Status::done();
    return refuse(Code::NotFound, "there is no file " + path.value() +
                                      "; the path counts from the folder of this file");
}

}  // namespace

std::string ProjectFile::path_of(const std::string& named) const {
    return (fs::path(file).parent_path() / named).lexically_normal().string();
}

Result<ProjectFile> read_project_file(std::string_view text, const std::string& file) {
    return TRY(read_all(text, file)).project;
}

std::vector<Error> mistakes_of_project(std::string_view text, const std::string& file) {
    const Result<JsonValue> json = parse(text, file);
    if (!json.ok()) return {json.error()};
    return errors_of(read_members(json.value(), file).complaints, file);
}

Result<ProjectFile> open_project(const std::string& folder_or_file) {
    std::error_code error;
    const bool folder = fs::is_directory(folder_or_file, error);
    const std::string file =
        folder ? (fs::path(folder_or_file) / kProjectFileName).string() : folder_or_file;
    const std::string text = TRY(read_file(file));
    Reading reading = TRY(read_all(text, file));
    for (const Named& named : reading.files) TRY(check_file(file, named));
    return std::move(reading.project);
}

}  // namespace vagus::session
