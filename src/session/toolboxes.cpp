#include "session/toolboxes.hpp"

#include "aesl/project.hpp"
#include "base/file.hpp"
#include "toolbox/builtin.hpp"
#include "toolbox/load.hpp"

namespace vagus::session {

Result<toolbox::ProjectEvents> read_project_events(const std::string& path) {
    const std::string text = TRY(read_file(path));
    const aesl::Project project = TRY(aesl::parse_project(text, path));
    toolbox::ProjectEvents events;
    for (const aesl::GlobalEvent& event : project.common.events) {
        events[event.name] =
            event.size ? std::optional<size_t>(static_cast<size_t>(*event.size)) : std::nullopt;
    }
    return events;
}

Status add_toolboxes(run::CodeLibrary& library, const toolbox::Parts& parts,
                     const std::vector<std::string>& files) {
    toolbox::add_builtin(library, parts);
    for (const std::string& file : files) {
        TRY(toolbox::load_toolbox(library, file, parts, read_project_events));
    }
    return Status::done();
}

}  // namespace vagus::session
