#include "toolbox/toolbox_events.hpp"

#include <fmt/format.h>

#include "base/nearest.hpp"

namespace vagus::toolbox {

namespace {

std::string mend_for(const std::string& event, const ProjectEvents& known) {
    std::vector<std::string> names;
    for (const auto& [name, size] : known) names.push_back(name);
    const std::string near = nearest(event, names);
    return near.empty() ? "declare it there" : fmt::format("did you mean \"{}\"?", near);
}

// What is sent fits exactly; of what is heard the rest is not looked at.
bool fits(const EventCheck& check, std::optional<size_t> declared) {
    if (!declared) return true;
    return check.sent ? check.words == *declared : check.words <= *declared;
}

}  // namespace

void check_events(const EventChecks& checks, const std::string& project_path, Place project_at,
                  const ReadProject& read_project, Complaints& complaints) {
    const auto complain = [&complaints](Place at, std::string what) {
        if (complaints.size() < kComplaintsMax) complaints.push_back({at, std::move(what)});
    };
    const Result<ProjectEvents> events = read_project(project_path);
    if (!events.ok()) {
        complain(project_at, fmt::format("\"project\" cannot be used: {}", events.error().what));
        return;
    }
    for (const EventCheck& check : checks) {
        const auto found = events.value().find(check.event);
        if (found == events.value().end()) {
            complain(check.at,
                     fmt::format("the event \"{}\", {}, is not in the project {}; {}", check.event,
                                 check.of, project_path, mend_for(check.event, events.value())));
        } else if (!fits(check, found->second)) {
            complain(check.at,
                     fmt::format("the event \"{}\", {}, carries {} words with its token, but the "
                                 "project {} declares {}; let it declare {}",
                                 check.event, check.of, check.words, project_path, *found->second,
                                 check.words));
        }
    }
}

}  // namespace vagus::toolbox
