// Any text as a project file: refused with a sentence and a place, or values that can be looked at.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "session/project_file.hpp"

using namespace vagus;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto read = session::read_project_file(text, "folder/vagus.json");
    if (!read.ok()) {
        if (!read.error().what.starts_with("folder/vagus.json:")) std::abort();
        return 0;
    }
    const session::ProjectFile& project = read.value();
    if (project.scripts.size() > session::kProjectPathsMax) std::abort();
    if (project.start_plan && project.plan.empty()) std::abort();
    for (const std::string& script : project.scripts) {
        if (script.empty() || project.path_of(script).empty()) std::abort();
    }
    return 0;
}
