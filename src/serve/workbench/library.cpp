#include "serve/workbench/library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "base/file.hpp"
#include "base/project_border.hpp"
#include "serve/json.hpp"
#include "serve/project/paths.hpp"
#include "serve/project/scan.hpp"
#include "serve/workbench/new_files.hpp"
#include "session/project_file.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRobotMark = "robot";  // the same: made for the nodes of a target
constexpr const char* kMark = "example";     // of .vagus/, in a copy: which one it is of

// As they are on the start screen; others follow.
constexpr const char* kOrder[] = {"follow-wall", "thymio",        "find-object", "rooms",
                                  "obstacle",    "infrared",      "patterns",    "follow-object",
                                  "carbot",      "traffic-light", "epuck"};

fs::path user_folder(const char* variable, const char* below_home) {
    const char* said = std::getenv(variable);
    if (said && *said == '/') return fs::path(said) / "vagus";
    const char* home = std::getenv("HOME");
    return fs::path(home && *home ? home : ".") / below_home / "vagus";
}

Json json_in(const fs::path& file) {
    const Result<std::string> text = read_file(file.string());
    Json json = text.ok() ? Json::parse(text.value(), nullptr, false) : Json();
    return json.is_object() ? json : Json::object();
}

// "Carbot, Thymio II"
std::string robots_in(const fs::path& world) {
    std::set<std::string> names;
    const Json file = json_in(world);
    for (const Json& robot : file.value("robots", Json::array())) {
        const std::string type = robot.value("type", "");
        names.insert(type == "thymio2" ? "Thymio II" : type == "epuck" ? "e-puck" : "Carbot");
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

size_t count_of(std::string_view text, std::string_view word) {
    size_t count = 0;
    for (size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++count;
    return count;
}

std::string content_of(const fs::path& folder, const session::ProjectFile& project) {
    size_t plans = 0;
    std::error_code failed;
    for (const FolderEntry& entry : entries_of(folder, failed)) {
        if (entry.name.ends_with(".plan.json")) ++plans;
    }
    if (plans > 1) return fmt::format("{} plans", plans);
    if (!project.plan.empty()) {
        const size_t actors = json_in(folder / project.plan).value("actors", Json()).size();
        return fmt::format("Plan · {} actors", actors);
    }
    size_t nodes = 0;
    for (const std::string& script : project.scripts) {
        const auto text = read_file((folder / script).string());
        if (text.ok()) nodes += count_of(text.value(), "<node ");
    }
    return nodes == 1 ? "Script · 1 node" : fmt::format("Scripts · {} nodes", nodes);
}

}  // namespace

fs::path user_data_folder(const std::string& given) {
    return given.empty() ? user_folder("XDG_DATA_HOME", ".local/share") : fs::path(given);
}
fs::path user_config_folder(const std::string& given) {
    return given.empty() ? user_folder("XDG_CONFIG_HOME", ".config") : fs::path(given);
}

Library::Library(LibraryPlaces places)
    : places_(std::move(places)), recent_((places_.data / "recent.json").string()) {}

// ---- examples ----

Json Library::examples() const {
    std::vector<std::pair<size_t, Json>> found;
    std::error_code failed;
    for (const FolderEntry& entry : entries_of(places_.examples, failed)) {
        if (entry.is != FolderEntry::Is::Folder) continue;
        const std::string id = entry.name;
        const fs::path folder = places_.examples / id;
        const auto read = session::open_project((folder / kProjectFileName).string());
        // Those without a world need a compiler or a robot.
        if (!read.ok() || read.value().world.empty()) continue;
        const auto place = std::find(std::begin(kOrder), std::end(kOrder), id);
        found.emplace_back(place - std::begin(kOrder),
                           Json{{"id", id},
                                {"name", read.value().name},
                                {"help", read.value().help},
                                {"robot", robots_in(folder / read.value().world)},
                                {"content", content_of(folder, read.value())}});
    }
    std::sort(found.begin(), found.end());
    Json list = Json::array();
    for (auto& [place, example] : found) list.push_back(std::move(example));
    return list;
}

// Its own, and those beside it that its project file names.
std::vector<std::string> Library::folders_of_example(const std::string& id) const {
    std::set<std::string> folders = {id};
    const auto read = session::open_project((places_.examples / id / kProjectFileName).string());
    if (!read.ok()) return {id};
    std::vector<std::string> named = read.value().scripts;
    named.insert(named.end(), read.value().toolboxes.begin(), read.value().toolboxes.end());
    named.push_back(read.value().world);
    for (const std::string& path : named) {
        const fs::path beside = (fs::path(id) / path).lexically_normal();
        if (!beside.empty() && *beside.begin() != "..") folders.insert(beside.begin()->string());
    }
    return {folders.begin(), folders.end()};
}

// Seen from the folder of examples. What the studio keeps beside a project is nobody else's, also
// where somebody has opened or served an example in its place.
std::vector<fs::path> Library::files_of_example(const std::string& id) const {
    std::vector<fs::path> files;
    std::error_code failed;
    for (const std::string& folder : folders_of_example(id)) {
        fs::recursive_directory_iterator at(places_.examples / folder, failed);
        for (; !failed && at != fs::recursive_directory_iterator(); at.increment(failed)) {
            if (at->path().filename() == kOwnFolder) {
                at.disable_recursion_pending();
            } else if (at->is_regular_file(failed)) {
                files.push_back(at->path().lexically_relative(places_.examples));
            }
        }
    }
    return files;
}

Status Library::copy_example(const std::string& id, const fs::path& to) const {
    std::error_code failed;
    fs::create_directories(to / ".vagus", failed);
    for (const fs::path& file : files_of_example(id)) {
        fs::create_directories((to / file).parent_path(), failed);
        if (!fs::copy_file(places_.examples / file, to / file, failed)) break;
    }
    if (!failed) fs::copy_file(places_.examples / kProjectFileName, to / kProjectFileName, failed);
    if (failed) {
        return Error{Code::Unavailable, fmt::format("{}: cannot copy the example there: {}",
                                                    to.string(), failed.message())};
    }
    return write_file_unsynced((to / ".vagus" / kMark).string(), id + "\n");
}

bool Library::is_untouched(const std::string& id, const fs::path& copy) const {
    std::error_code failed;
    for (const fs::path& file : files_of_example(id)) {
        if (!same_bytes(places_.examples / file, copy / file)) return false;
    }
    return !fs::exists(copy / ".vagus" / "journal", failed) ||
           fs::is_empty(copy / ".vagus" / "journal", failed);
}

Result<std::string> Library::copy_of_example(const std::string& id, bool again) {
    std::error_code failed;
    if (!check_path(id).ok() ||
        !fs::is_regular_file(places_.examples / id / kProjectFileName, failed)) {
        return Error{Code::NotFound, fmt::format("there is no example \"{}\"", id)};
    }
    fs::path latest;
    for (size_t number = 1; number <= kCopiesMax; ++number) {
        const fs::path copy = places_.data / "projects" / numbered(id, number);
        if (!fs::exists(copy, failed)) {
            if (again && !latest.empty()) return (latest / id).string();
            TRY(copy_example(id, copy));
            return (copy / id).string();
        }
        if (example_of(copy) != id) continue;
        if (!again && is_untouched(id, copy)) return (copy / id).string();
        latest = copy;
    }
    return Error{Code::Limit, fmt::format("{}: there are more than {} copies; delete some",
                                          (places_.data / "projects").string(), kCopiesMax)};
}

std::string Library::example_of(const fs::path& folder) const {
    const auto text = read_file((folder / ".vagus" / kMark).string());
    if (!text.ok()) return {};
    return text.value().substr(0, text.value().find('\n'));
}

// ---- new projects ----

Result<fs::path> Library::new_folder(const std::string& name) const {
    TRY(check_path(name));
    if (name.find('/') != name.npos) {
        return Error{Code::BadInput, name + ": expected the name of a folder, without /"};
    }
    const fs::path folder = places_.data / "projects" / name;
    std::error_code failed;
    if (fs::exists(folder, failed)) {
        return Error{Code::BadInput,
                     fmt::format("{}: there is a project of that name; choose another name, or "
                                 "open it",
                                 folder.string())};
    }
    fs::create_directories(folder, failed);
    if (failed) {
        return Error{Code::Unavailable,
                     fmt::format("{}: cannot be made: {}", folder.string(), failed.message())};
    }
    return folder;
}

Result<std::string> Library::make_project(const std::string& name, const std::string& robot,
                                          bool plan) {
    const fs::path folder = TRY(new_folder(name));
    for (const NewFile& file : new_project_files(name, robot, plan, places_.examples.string())) {
        TRY(write_file_unsynced((folder / file.path).string(), file.text));
    }
    return folder.string();
}

Result<std::string> Library::make_robot_project(const std::string& target) {
    std::error_code failed;
    for (size_t number = 1; number <= kCopiesMax; ++number) {
        const std::string name = numbered("robot", number);
        const fs::path there = places_.data / "projects" / name;
        if (fs::exists(there, failed)) {
            // The one that was made for this robot before.
            if (json_in(there / kProjectFileName).value("target", "") == target) {
                return there.string();
            }
            continue;
        }
        const fs::path folder = TRY(new_folder(name));
        for (const NewFile& file : robot_project_files(target)) {
            TRY(write_file_unsynced((folder / file.path).string(), file.text));
        }
        std::error_code made;
        fs::create_directories(folder / ".vagus", made);
        TRY(write_file_unsynced((folder / ".vagus" / kRobotMark).string(), target + "\n"));
        return folder.string();
    }
    return Error{Code::Limit, "there are too many robot projects; delete some"};
}

bool Library::is_robot_project(const fs::path& folder) const {
    std::error_code failed;
    return fs::exists(folder / ".vagus" / kRobotMark, failed);
}

// ---- recent ----

// Whatever the file holds: what does not fit was not written by us and is passed over.
Json Library::kept_recent() const {
    const Json kept = recent_.get("recent");
    Json list = Json::array();
    for (const Json& entry : kept.is_array() ? kept : Json::array()) {
        const auto is = [&entry](const char* key, bool (Json::*kind)() const noexcept) {
            return entry.contains(key) && (entry[key].*kind)();
        };
        const bool whole = entry.is_object() && is("path", &Json::is_string) &&
                           is("name", &Json::is_string) && is("when_wall", &Json::is_number);
        if (!whole || list.size() >= kRecentMax) continue;
        const std::string& path = entry["path"].get_ref<const std::string&>();
        const std::string& name = entry["name"].get_ref<const std::string&>();
        if (path.size() > kRecentPathBytesMax || name.size() > kRecentNameBytesMax) continue;
        list.push_back({{"path", path}, {"name", name}, {"when_wall", entry["when_wall"]}});
    }
    return list;
}

Json Library::recent() const {
    Json list = kept_recent();
    std::error_code failed;
    for (Json& entry : list) {
        entry["there"] = fs::exists(entry["path"].get<std::string>(), failed);
    }
    return list;
}

void Library::opened(const std::string& path, const std::string& name, double now_wall) {
    forget(path);
    Json list = Json::array({Json{{"path", path}, {"name", name}, {"when_wall", now_wall}}});
    for (const Json& entry : kept_recent()) {
        if (list.size() < kRecentMax) list.push_back(entry);
    }
    // What was opened is no reason to fail.
    (void)recent_.put("recent", std::move(list)).ok();
}

void Library::forget(const std::string& path) {
    Json list = Json::array();
    for (const Json& entry : kept_recent()) {
        if (entry["path"] != path) list.push_back(entry);
    }
    (void)recent_.put("recent", std::move(list)).ok();
}

}  // namespace vagus::serve
