// What editors ask about scripts, and changes of names across them: script.* and define.*, the
// topics script and scripts.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "serve/edit/event_names.hpp"
#include "serve/json.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

class ScriptDesk {
public:
    using FilesOfProject = std::function<std::set<std::string>()>;
    // All borrowed.
    ScriptDesk(Desk& desk, Files& files, Scripts& scripts, std::string epoch,
               FilesOfProject files_of_project);

    void text_changed(const std::string& path);
    void project_changed();
    // Nodes may be others by now.
    void tick();

private:
    void declare_questions();
    void declare_changes();
    void on_change(const std::string& name, std::function<void(const Call&)> obey);
    // The script that a call is about; fails the call if there is none.
    const CompiledScript* script_of(const Call& call);
    void complete(const Call& call);
    void hover(const Call& call);
    void definition(const Call& call);
    void references(const Call& call);
    void rename(const Call& call);
    void listing(const Call& call);
    void format_name(const Call& call);
    void change(const Call& call);
    std::vector<std::string> rename_elsewhere(const std::string& file, const EventName& name,
                                              const std::string& by, size_t& places);
    bool is_declared_elsewhere(const std::string& file, const std::string& event,
                               const std::set<std::string>& project);
    Json spots_of(const std::vector<Spot>& spots, size_t most);
    Json script_document(const Json& of);
    Json scripts_document();

    Desk& desk_;
    Files& files_;
    Scripts& scripts_;
    const std::string epoch_;
    const FilesOfProject files_of_project_;
    uint64_t targets_ = 0;
};

}  // namespace vagus::serve
