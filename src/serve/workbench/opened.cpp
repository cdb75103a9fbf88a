#include "serve/workbench/opened.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/project_border.hpp"
#include "serve/project/files.hpp"
#include "serve/workbench/folder_project.hpp"
#include "session/project_file.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kWhatOpens =
    "open a folder with a vagus.json, or with files NAME.aesl, NAME.plan.json, NAME.world.json, "
    "such a file alone, or a recording NAME.mcap";

// How what its folder's files name is called from the root; empty stays empty.
std::string from_root(const OpenedProject& opened, const std::string& named) {
    if (named.empty()) return named;
    const fs::path path = (fs::path(opened.folder) / named).lexically_normal();
    return path.lexically_relative(opened.root).generic_string();
}

Result<OpenedProject> open_folder(const fs::path& folder) {
    const fs::path file = folder / kProjectFileName;
    OpenedProject opened;
    opened.folder = opened.file = folder.string();
    opened.root = project_border(file.string());
    // One that cannot be read opens all the same, so that it can be put right.
    const auto read = session::open_project(file.string());
    const auto inside = [&](const std::string& named) { return from_root(opened, named); };
    opened.project_file = inside(kProjectFileName);
    opened.name = folder.filename().string();
    if (!read.ok()) {
        opened.help = read.error().what;
        return opened;
    }
    const session::ProjectFile& project = read.value();
    if (!project.name.empty()) opened.name = project.name;
    opened.help = project.help;
    opened.plan = inside(project.plan);
    opened.world = inside(project.world);
    for (const std::string& script : project.scripts) opened.scripts.push_back(inside(script));
    for (const std::string& one : project.toolboxes) opened.toolboxes.push_back(inside(one));
    opened.target = project.target;
    opened.start_set = project.start_set;
    opened.stops_alone = project.stops_alone;
    opened.safe_stop = project.safe_stop;
    opened.fleet = project.fleet;
    return opened;
}

// One without a vagus.json: of each kind the only file is what runs.
Result<OpenedProject> open_bare_folder(const fs::path& folder, const std::string& named) {
    const FolderFiles files = files_of_folder(folder);
    if (!files.any()) {
        return Error{Code::NotFound,
                     fmt::format("{}: expected a vagus.json in this folder, found none, nor a "
                                 "script, plan or world; {}",
                                 named, kWhatOpens)};
    }
    OpenedProject opened;
    opened.folder = opened.file = folder.string();
    const std::string border = project_border((folder / kProjectFileName).string());
    opened.root = border.empty() ? folder : fs::path(border);
    const auto inside = [&](const std::string& name) { return from_root(opened, name); };
    opened.name = folder.filename().string();
    opened.plan = inside(only_one(files.plans));
    opened.world = inside(only_one(files.worlds));
    if (files.scripts.size() == 1) opened.scripts = {inside(files.scripts.front())};
    for (const std::string& one : files.toolboxes) opened.toolboxes.push_back(inside(one));
    return opened;
}

Result<OpenedProject> open_file(const fs::path& file) {
    const std::string kind = kind_of_file(file.filename().string());
    OpenedProject opened;
    opened.file = file.string();
    opened.folder = file.parent_path().string();
    const std::string border = project_border(file.string());
    opened.root = border.empty() ? fs::path(opened.folder) : fs::path(border);
    const std::string path = file.lexically_relative(opened.root).generic_string();
    opened.only = {path};
    opened.name = file.filename().string();
    if (kind == "script") {
        opened.scripts = {path};
        opened.target.clear();
    } else if (kind == "plan") {
        opened.plan = path;
        // What it runs in lies beside it.
        const std::string world = one_beside(opened.name, files_of_folder(opened.folder).worlds);
        opened.world = from_root(opened, world);
        if (!world.empty()) opened.only.push_back(opened.world);
    } else if (kind == "world") {
        opened.world = path;
    } else {
        return Error{Code::BadInput,
                     fmt::format("{}: cannot be opened; {}", file.string(), kWhatOpens)};
    }
    return opened;
}

}  // namespace

Error no_project_file_in(const std::string& folder) {
    return Error{Code::NotFound, folder + ": expected a vagus.json in this folder, found none"};
}

Result<OpenedProject> open_path(const std::string& named) {
    std::error_code failed;
    const fs::path path = fs::canonical(named, failed);
    if (failed) {
        return Error{Code::NotFound,
                     fmt::format("{}: there is no such file or folder; {}", named, kWhatOpens)};
    }
    const bool file = fs::is_regular_file(path, failed);
    if (!file && !fs::is_directory(path, failed)) {
        return Error{Code::BadInput,
                     fmt::format("{}: expected a file or a folder, found a pipe or a device; {}",
                                 named, kWhatOpens)};
    }
    if (file && path.filename() == kProjectFileName) return open_folder(path.parent_path());
    if (file) return open_file(path);
    if (fs::is_regular_file(path / kProjectFileName, failed)) return open_folder(path);
    return open_bare_folder(path, named);
}

std::string OpenedProject::doc_of(const std::string& named) const {
    std::error_code failed;
    const fs::path inside =
        fs::weakly_canonical(named, failed).lexically_relative(root).lexically_normal();
    return inside.empty() || *inside.begin() == ".." ? named : inside.generic_string();
}

nlohmann::json OpenedProject::to_json() const {
    nlohmann::json json = {{"folder", folder},   {"name", name},     {"help", help},
                           {"scripts", scripts}, {"target", target}, {"border", root.string()}};
    if (project_file.empty()) json["bare"] = true;
    if (!copy_of.empty()) json["copy_of"] = copy_of;
    if (!recording.empty()) json["recording"] = recording;
    if (!plan.empty()) json["plan"] = plan;
    if (!world.empty()) json["world"] = world;
    return json;
}

}  // namespace vagus::serve
