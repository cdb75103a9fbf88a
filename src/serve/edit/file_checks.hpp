// The checks of files that are not scripts: plans, worlds, toolboxes, vagus.json. All read texts as
// they are edited, never the disk behind them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/code.hpp"
#include "serve/edit/doc_finding.hpp"
#include "serve/edit/edited_project.hpp"
#include "serve/project/files.hpp"
#include "session/bus_names.hpp"

namespace vagus::serve {

// What a check has found, and the documents that it read with their versions (0: not there): it
// holds as long as these are the same.
struct Checkup {
    std::vector<DocFinding> findings;
    std::map<std::string, uint32_t> read;
};

// Texts for checkers, which remembers what it was asked.
class CheckedTexts {
public:
    explicit CheckedTexts(Files& files) : files_(files) {}
    Result<std::string> read(const std::string& path) const;
    // The same for a path on the disk, below the root.
    Result<std::string> read_absolute(const std::string& path) const;
    std::map<std::string, uint32_t> take_read() { return std::exchange(read_, {}); }

private:
    Files& files_;
    mutable std::map<std::string, uint32_t> read_;
};

// The templates that plans of a project can use.
struct Toolboxes {
    std::unique_ptr<run::CodeLibrary> library;
    // Some toolbox is a shared library: it is not loaded into the studio, so nobody knows what it
    // declares.
    bool incomplete = false;
    Checkup checkup;
};
Toolboxes load_toolboxes(Files& files, const std::vector<std::string>& paths);

// A plan with the sub-plans that it names.
Checkup check_plan(Files& files, const std::string& path, const Toolboxes& toolboxes,
                   const std::optional<session::BusNames>& names);
// The same if its text were another one.
Checkup check_plan_as(Files& files, const std::string& path, const std::string& text,
                      const Toolboxes& toolboxes, const std::optional<session::BusNames>& names);
Checkup check_world_file(Files& files, const std::string& path);
Checkup check_toolbox_file(Files& files, const std::string& path);
Checkup check_project_file(Files& files, const std::string& path);

}  // namespace vagus::serve
