// The part of the studio's server that edits: texts, files, scripts, what is wrong with them. It
// declares their commands and topics at the desk; the owner of the studio tells it which
// project is open and when time passes.
//
//     Editing editing(desk, files, scripts, epoch);
//     editing.on_text_changed([&](const std::string& path) { target.script_changed(path); });
//     files.enter(folder);
//     editing.set_project({.plan = "WallFollow.plan.json", .project_file = "vagus.json"});
//     editing.tick(now);
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "serve/edit/doc_finding.hpp"
#include "serve/edit/documents.hpp"
#include "serve/edit/edited_project.hpp"
#include "serve/edit/file_desk.hpp"
#include "serve/edit/findings.hpp"
#include "serve/edit/plan_desk.hpp"
#include "serve/edit/script_desk.hpp"
#include "serve/edit/search.hpp"
#include "serve/edit/template_desk.hpp"

namespace vagus::serve {

class Editing {
public:
    // All borrowed. Takes Files::on_change for itself. `epoch`: as hello tells it, another one for
    // each life of this server.
    Editing(Desk& desk, Files& files, Scripts& scripts, const std::string& epoch);

    // After files.enter(), files.leave(), and when vagus.json says something else.
    void set_project(EditedProject project);

    // Called when everything here has followed.
    void on_text_changed(std::function<void(const std::string& path)> changed) {
        listeners_.text_changed = std::move(changed);
    }
    void on_saved(std::function<void(const std::string& path)> saved) {
        listeners_.saved = std::move(saved);
    }
    // A file or a folder with all that is in it.
    void on_renamed(std::function<void(const std::string& from, const std::string& to)> renamed) {
        listeners_.renamed = std::move(renamed);
    }
    // A line of the console.
    void on_say(std::function<void(const std::string& kind, const std::string& text)> say) {
        listeners_.say = std::move(say);
    }

    // Everything that is wrong now; checks first what was not checked since the last change.
    std::vector<DocFinding> findings() { return findings_.all(); }

    // What the plans of the project can be made of, as of now.
    const plan::Library& templates() { return findings_.toolboxes().library->templates(); }

    // Files are told the time here, too.
    void tick(Time now);
    Time next_tick() const;

private:
    void text_changed(const std::string& path);

    Files& files_;
    Scripts& scripts_;
    EditedProject project_;
    EditListeners listeners_;
    uint64_t session_;  // of the files that scripts were read from
    Documents documents_;
    FileDesk file_desk_;
    ScriptDesk script_desk_;
    Search search_;
    Findings findings_;
    PlanDesk plan_desk_;
    TemplateDesk template_desk_;
};

}  // namespace vagus::serve
