#include "session/safe_stop.hpp"

#include "base/file.hpp"
#include "base/project_border.hpp"
#include "session/project_file.hpp"
#include "toolbox/builtin.hpp"
#include "toolbox/load.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::session {

const SafeStop& shipped_safe_stop() {
    static const SafeStop kShipped = toolbox::builtin_safe_stop();
    return kShipped;
}

Result<SafeStop> safe_stop_of(const std::vector<std::string>& toolboxes, const SafeStop& project) {
    SafeStop safe = shipped_safe_stop();
    for (const std::string& path : toolboxes) {
        if (path.ends_with(toolbox::kLibraryEnding)) continue;
        const std::string text = TRY(read_file(path));
        toolbox::overlay(safe, TRY(toolbox::read_toolbox(text, path, {})).safe_stop);
    }
    toolbox::overlay(safe, project);
    return safe;
}

Result<SafeStop> safe_stop_around(const std::string& file,
                                  const std::vector<std::string>& toolboxes) {
    const std::string folder = innermost_project(file);
    if (folder.empty()) return safe_stop_of(toolboxes, {});
    const ProjectFile project = TRY(open_project(folder));
    std::vector<std::string> all;
    for (const std::string& named : project.toolboxes) all.push_back(project.path_of(named));
    all.insert(all.end(), toolboxes.begin(), toolboxes.end());
    return safe_stop_of(all, project.safe_stop);
}

}  // namespace vagus::session
