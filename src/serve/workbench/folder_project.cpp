#include "serve/workbench/folder_project.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "aesl/project.hpp"
#include "base/file.hpp"
#include "base/json.hpp"
#include "base/project_border.hpp"
#include "serve/project/open_text.hpp"
#include "serve/project/scan.hpp"
#include "serve/workbench/new_files.hpp"
#include "serve/workbench/opened.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

// "hall" of hall.plan.json.
std::string first_name(const std::string& file) {
    return file.substr(0, file.find('.', 1));
}

// Of what is open, and what a run of it takes. Names in its folder; empty: to be written.
struct Parts {
    std::string name, plan, world, script;
    std::vector<std::string> toolboxes;
};

Parts parts_of(const OpenedProject& opened, const std::string& shown, const FolderFiles& files) {
    const bool alone = opened.is_alone();
    const std::string open = fs::path(alone ? opened.file : opened.real(shown)).filename().string();
    const std::string kind = kind_of_file(open);
    const auto part = [&](const char* of, const std::vector<std::string>& names) {
        const bool is_meant =
            kind == of && std::find(names.begin(), names.end(), open) != names.end();
        return is_meant ? open : alone ? one_beside(open, names) : only_one(names);
    };
    Parts parts;
    parts.name = alone ? first_name(open) : fs::path(opened.folder).filename().string();
    // A script alone is a script to begin with, whatever plans lie beside it.
    if (kind != "script") parts.plan = part("plan", files.plans);
    parts.world = part("world", files.worlds);
    parts.script = part("script", files.scripts);
    parts.toolboxes = files.toolboxes;
    return parts;
}

std::vector<aesl::Script> scripts_of(const fs::path& folder, const std::string& file) {
    if (file.empty()) return {};
    const auto text = read_file((folder / file).string());
    if (!text.ok()) return {};
    const auto project = aesl::parse_project(text.value(), file);
    return project.ok() ? project.value().scripts : std::vector<aesl::Script>();
}

// By the names that nodes have: the scripts know best, plans are made for a Carbot.
std::string robot_for(const Parts& parts, const fs::path& folder) {
    for (const aesl::Script& script : scripts_of(folder, parts.script)) {
        if (script.node == "drive") return "carbot";
        if (script.node == "thymio-II") return "thymio2";
        if (script.node == "epuck0") return "epuck";
    }
    return parts.plan.empty() ? "thymio2" : "carbot";
}

std::string project_text(const Parts& parts) {
    std::vector<JsonMember> members = {json_member("format", "vagus-project/1"),
                                       json_member("name", parts.name)};
    if (!parts.plan.empty()) members.push_back(json_member("plan", parts.plan));
    if (!parts.script.empty()) {
        members.push_back(json_member("scripts", json_array({json_string(parts.script)})));
    }
    members.push_back(json_member("world", parts.world));
    if (!parts.toolboxes.empty()) {
        std::vector<JsonValue> listed;
        for (const std::string& one : parts.toolboxes) listed.push_back(json_string(one));
        members.push_back(json_member("toolboxes", json_array(std::move(listed))));
    }
    members.push_back(json_member("target", "sim"));
    if (!parts.plan.empty()) {
        JsonValue yes;
        yes.kind = JsonKind::Bool;
        yes.boolean = true;
        members.push_back(json_member("start", {json_member("plan", std::move(yes))}));
    }
    return format_json(json_object(std::move(members)));
}

// Those that are not there. The one that makes it a project is the last: a disk that is full before
// leaves a folder that can be made one.
std::vector<NewFile> missing_files(Parts parts, const fs::path& folder, const fs::path& examples) {
    std::vector<NewFile> missing;
    if (parts.world.empty()) {
        const std::string robot = robot_for(parts, folder);
        if (parts.script.empty()) {
            parts.script = parts.name + ".aesl";
            missing.push_back(
                {parts.script, new_scripts(robot, !parts.plan.empty(), examples.string())});
        }
        parts.world = parts.name + ".world.json";
        missing.push_back({parts.world, new_room(parts.name, robot, parts.script)});
    }
    missing.push_back({kProjectFileName, project_text(parts)});
    return missing;
}

}  // namespace

FolderFiles files_of_folder(const fs::path& folder) {
    FolderFiles files;
    std::error_code failed;
    for (const FolderEntry& entry : entries_of(folder, failed)) {
        if (entry.is != FolderEntry::Is::File || entry.failed) continue;
        const std::string kind = kind_of_file(entry.name);
        if (kind == "plan") files.plans.push_back(entry.name);
        if (kind == "world") files.worlds.push_back(entry.name);
        if (kind == "script") files.scripts.push_back(entry.name);
        if (kind == "toolbox") files.toolboxes.push_back(entry.name);
    }
    for (auto* names : {&files.plans, &files.worlds, &files.scripts, &files.toolboxes}) {
        std::sort(names->begin(), names->end());
    }
    return files;
}

std::string only_one(const std::vector<std::string>& names) {
    return names.size() == 1 ? names.front() : "";
}

std::string one_beside(const std::string& file, const std::vector<std::string>& names) {
    const auto same = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
        return first_name(name) == first_name(file);
    });
    return same != names.end() ? *same : only_one(names);
}

Result<std::string> make_project_of(const OpenedProject& opened, const std::string& shown,
                                    const fs::path& examples) {
    const fs::path folder = opened.folder;
    const std::string there = innermost_project((folder / kProjectFileName).string());
    if (!there.empty()) return there;
    const Parts parts = parts_of(opened, shown, files_of_folder(folder));
    for (const NewFile& file : missing_files(parts, folder, examples)) {
        const std::string path = (folder / file.path).string();
        std::error_code failed;
        if (fs::exists(path, failed)) {
            return Error{Code::Refused, path +
                                            ": there is such a file already, and it would be "
                                            "replaced; rename it first"};
        }
        TRY(write_file(path, file.text));
    }
    return folder.string();
}

}  // namespace vagus::serve
