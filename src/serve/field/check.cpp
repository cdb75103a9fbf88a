#include "serve/field/check.hpp"

#include <algorithm>

#include "serve/edit/editing.hpp"
#include "serve/workbench/opened.hpp"
#include "session/project_file.hpp"

namespace vagus::serve {

namespace {

DocFinding finding_about(const std::string& doc, const std::string& what) {
    return {.doc = doc,
            .code = "project",
            .element = {},
            .at = {1, 1},
            .end = {1, 1},
            .what = what,
            .fixes = {}};
}

}  // namespace

std::vector<DocFinding> check_project(const std::filesystem::path& folder,
                                      const Scripts::TargetOf& target_of) {
    const auto opened = open_path(folder.string());
    if (!opened.ok()) return {finding_about("vagus.json", opened.error().what)};
    const OpenedProject& project = opened.value();
    if (project.project_file.empty()) {
        return {finding_about("vagus.json", no_project_file_in(folder.string()).what)};
    }
    // A desk at which nobody sits: parts that edit declare their commands there.
    Desk desk(Access("", std::nullopt), {.send = [](ClientId, bool, std::string) {},
                                         .close = [](ClientId, std::string) {},
                                         .log = [](const std::string&) {},
                                         .wall_ms = [] { return 0.0; }});
    Files files;
    Scripts scripts(files, target_of);
    Editing editing(desk, files, scripts, desk.epoch());
    files.enter(project.root);
    scripts.prefer(project.scripts);
    scripts.reread();
    editing.set_project({.plan = project.plan,
                         .world = project.world,
                         .project_file = project.project_file,
                         .toolboxes = project.toolboxes});
    std::vector<DocFinding> findings = editing.findings();
    const auto read = session::open_project(folder.string());
    const bool told = std::any_of(findings.begin(), findings.end(), [](const DocFinding& finding) {
        return finding.severity == Severity::Error;
    });
    if (!read.ok() && !told) {
        findings.push_back(finding_about(project.project_file, read.error().what));
    }
    return findings;
}

}  // namespace vagus::serve
