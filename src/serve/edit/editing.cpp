#include "serve/edit/editing.hpp"

#include <algorithm>

namespace vagus::serve {

Editing::Editing(Desk& desk, Files& files, Scripts& scripts, const std::string& epoch)
    : files_(files),
      scripts_(scripts),
      session_(files.session()),
      documents_(desk, files, listeners_, epoch),
      file_desk_(desk, files, scripts, project_, listeners_, epoch),
      script_desk_(desk, files, scripts, epoch, [this] { return findings_.files_of_project(); }),
      search_(desk, files, scripts, epoch),
      findings_(desk, files, scripts, project_),
      plan_desk_(desk, files, findings_),
      template_desk_(desk, files, scripts, findings_, project_, listeners_, epoch) {
    files_.on_change([this](const std::string& path) { text_changed(path); });
}

void Editing::set_project(EditedProject project) {
    project_ = std::move(project);
    if (session_ != files_.session()) {
        session_ = files_.session();
        scripts_.reread();
    }
    documents_.project_changed();
    script_desk_.project_changed();
    findings_.project_changed();
}

void Editing::text_changed(const std::string& path) {
    scripts_.changed(path);
    documents_.text_changed(path);
    script_desk_.text_changed(path);
    findings_.text_changed(path);
    listeners_.text_changed(path);
}

void Editing::tick(Time now) {
    files_.tick(now);
    if (const auto trouble = files_.take_trouble()) listeners_.say("error", *trouble);
    for (const std::string& path : documents_.tick(now)) text_changed(path);
    script_desk_.tick();
    findings_.tick(now);
}

Time Editing::next_tick() const {
    const Time next = std::min(documents_.next_tick(), findings_.next_tick());
    return std::min(next, files_.next_tick());
}

}  // namespace vagus::serve
