// The versions of a project on a robot (docs/decisions/0120). The folder as it was given is version
// 0 and is never changed; what was deployed is below it, and a link says which one is in force:
//
//     PROJECT/.vagus/versions/incoming/   on its way here
//                             4/deployed.json, 4/files/…
//                             current     link to 4; without it version 0 is in force
//                             trial.json  current has not shown yet that it starts
//
// Each change of what is in force is one rename, and everything it leads to is on the disk before:
// after a power cut at any moment it is the one or the other, whole.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/folder_lock.hpp"
#include "base/result.hpp"
#include "serve/workbench/bundle.hpp"

namespace vagus::serve {

constexpr size_t kVersionsKept = 5;  // beside version 0

// A version in force that has not started yet.
struct VersionTrial {
    uint32_t version = 0;
    uint32_t back = 0;   // what is in force again if it does not start
    uint32_t tries = 0;  // boots that began with it
};

class Versions {
public:
    explicit Versions(std::filesystem::path project);
    // What is deployed is kept in another place than below the project.
    Versions(std::filesystem::path project, std::filesystem::path root)
        : project_(std::move(project)), root_(std::move(root)) {}

    // Deletes what an interrupted deployment has left. Once, at the boot. The Error: see hold().
    Status tidy_up();
    // From here on, as long as this is there, no other server changes the versions of the folder;
    // two of them would delete each other's. The Error says that another one does.
    Status hold();

    uint32_t current() const;
    std::vector<uint32_t> all() const;  // without 0, the oldest first
    // The folder of its vagus.json.
    std::filesystem::path folder(uint32_t version) const;
    Result<Bundle> bundle(uint32_t version) const;
    // The one that `version` came after, or the next older one that is there; 0 at last.
    uint32_t before(uint32_t version) const;

    // ---- another version, on its way here ----
    // In place of one that was begun before.
    Status begin();
    Status add(const std::string& path, std::string_view content);
    // The folder of its vagus.json, before it has a number.
    std::filesystem::path incoming(const Bundle& bundle) const;
    // On the disk, under its number; not in force yet.
    Result<uint32_t> finish(Bundle bundle);
    void forget_incoming();

    // ---- what is in force ----
    Status put_in_force(uint32_t version);
    std::optional<VersionTrial> trial() const;
    Status write_trial(const VersionTrial& trial);
    void end_trial();
    void remove(uint32_t version);
    // Of those above, the newest stay.
    void remove_old();

private:
    std::filesystem::path place(uint32_t version) const;

    std::filesystem::path project_, root_;
    std::optional<FolderLock> held_;
};

}  // namespace vagus::serve
