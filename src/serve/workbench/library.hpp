// The user's own folder: copies of examples, new projects, what was opened before.
//
//     Library library({.data = "/home/me/.local/share/vagus", .examples = "share/vagus/examples"});
//     const std::string copy = TRY(library.copy_of_example("follow-wall"));
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "serve/json.hpp"
#include "serve/workbench/folder_project.hpp"
#include "serve/workbench/kept.hpp"
#include "serve/workbench/recorded_project.hpp"

namespace vagus::serve {

constexpr size_t kRecentMax = 20;
constexpr size_t kRecentPathBytesMax = 1024;
constexpr size_t kRecentNameBytesMax = 200;

struct LibraryPlaces {
    std::filesystem::path data;      // of the user
    std::filesystem::path examples;  // that came with the program
};

// The folder that was given; without one $XDG_DATA_HOME/vagus, or ~/.local/share/vagus.
std::filesystem::path user_data_folder(const std::string& given);
// The folder that was given; without one $XDG_CONFIG_HOME/vagus, or ~/.config/vagus.
std::filesystem::path user_config_folder(const std::string& given);

class Library {
public:
    explicit Library(LibraryPlaces places);

    // ---- examples ----
    Json examples() const;  // [Example]
    // The path of a copy to open, with what the example names: the copy there is if nobody changed
    // it, else a new one. With `again` the newest there is, changed or not.
    Result<std::string> copy_of_example(const std::string& id, bool again = false);
    // The example that a folder is a copy of; empty if none.
    std::string example_of(const std::filesystem::path& folder) const;

    // ---- new projects ----
    // A script that runs, in a world with that robot. `robot` as in the protocol.
    Result<std::string> make_project(const std::string& name, const std::string& robot, bool plan);
    // A project around a robot that was connected to: no script yet.
    Result<std::string> make_robot_project(const std::string& target);

    // The folder of what is open, made a project (folder_project.hpp).
    Result<std::string> make_project_of(const OpenedProject& opened,
                                        const std::string& shown) const {
        return serve::make_project_of(opened, shown, places_.examples);
    }

    // What a recording from anywhere is opened as.
    Result<RecordedProject> project_of_recording(const std::string& path) const {
        return serve::project_of_recording(path, places_.data / "projects");
    }
    bool is_robot_project(const std::filesystem::path& folder) const;

    // ---- recent ----
    Json recent() const;  // [Recent]
    void opened(const std::string& path, const std::string& name, double now_wall);
    void forget(const std::string& path);

private:
    Result<std::filesystem::path> new_folder(const std::string& name) const;
    Status copy_example(const std::string& id, const std::filesystem::path& to) const;
    bool is_untouched(const std::string& id, const std::filesystem::path& copy) const;
    std::vector<std::string> folders_of_example(const std::string& id) const;
    std::vector<std::filesystem::path> files_of_example(const std::string& id) const;

    LibraryPlaces places_;
    Json kept_recent() const;

    Kept recent_;
};

}  // namespace vagus::serve
